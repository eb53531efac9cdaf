// Options and a scene: loaded, solved and drawn in little memory and few steps. The first line is read as the words of
// a command line. What must hold: every status is one of the documented; a picture has all its lines; illuminance is
// finite and not negative; another budget and no flags give the same bits.
#include <vector>

#include "cli/arguments.h"
#include "fuzz/fuzz.h"
#include "model.h"

namespace {

using namespace shodo;

constexpr std::size_t kSmall = 300 << 10, kLarge = 8 << 20;
constexpr std::uint64_t kMostReports = 400;  // of progress
constexpr std::uint32_t kMostSubPatches = 8000;
alignas(16) unsigned char g_memory[kLarge];

/// The words of a line behind "shodo", each ended by a zero.
struct Words {
  explicit Words(std::string_view line) : text("shodo " + std::string(line)) {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      if (end > at) words.push_back(text.data() + at);
      if (end < text.size()) text[end] = 0;
      at = end + 1;
    }
  }

  std::string text;
  std::vector<char*> words;
};

/// Small pictures and few segments, whatever was asked for.
void limit(Options& options) {
  options.width = options.width % 48 + 1;
  options.height = options.height % 32 + 1;
  if (options.segments_first > 16) options.segments_first = 16;
  if (options.segments_mixed > 16) options.segments_mixed = 16;
  if (options.refine > 2) options.refine = 2;
  if (options.tolerance < 1e-6) options.tolerance = 1e-6;
}

struct Outcome {
  Status status;
  std::uint32_t lines = 0;
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a of maps and picture

  void add(const void* bytes, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      hash = (hash ^ static_cast<const unsigned char*>(bytes)[k]) * 0x100000001b3;
    }
  }
};

void expect_sound(const Model& model, Outcome& outcome) {
  for (const std::span<const float> values : {model.maps.direct_lx, std::span<const float>(model.maps.ambient_lx)}) {
    for (const float lx : values) SHODO_CHECK(lx >= 0 && lx <= std::numeric_limits<float>::max());
    outcome.add(values.data(), values.size_bytes());
  }
  SHODO_CHECK(model.statistics.solution_bound >= 0);
}

Outcome run(std::string_view input, const Options& options, std::size_t bytes) {
  fuzz::InputFiles files(input);
  Outcome outcome;
  std::uint64_t reports = 0;
  const Progress progress{[](void* count, Stage, std::uint64_t, std::uint64_t) {
                            return ++*static_cast<std::uint64_t*>(count) < kMostReports;
                          },
                          &reports};
  Model* model = nullptr;
  outcome.status = load("top.scn", files.top(), files.reader(), options, g_memory, bytes, model);
  if (!outcome.status.done() || model->scene.sub_patch_count > kMostSubPatches) return outcome;
  const bool enough = smallest_memory(*model) <= bytes;
  outcome.status = solve(*model, progress);
  if (!outcome.status.done()) {
    SHODO_CHECK(!enough || outcome.status.code != StatusCode::kMemory);
    return outcome;
  }
  expect_sound(*model, outcome);
  const LineSink sink{[](void* self, std::uint32_t y, std::span<const std::uint8_t> rgb) {
                        Outcome& out = *static_cast<Outcome*>(self);
                        SHODO_CHECK(y == out.lines++);
                        out.add(rgb.data(), rgb.size());
                        return true;
                      },
                      &outcome};
  outcome.status = draw(*model, progress, sink);
  SHODO_CHECK(!outcome.status.done() || outcome.lines == options.height);
  SHODO_CHECK(!enough || outcome.status.code != StatusCode::kMemory);
  return outcome;
}

void expect_alike(const Outcome& a, const Outcome& b) {
  if (a.status.done() && b.status.done()) SHODO_CHECK(a.hash == b.hash);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(input.find('\n'), size);
  Words words(input.substr(0, end));
  const std::string_view scene = input.substr(std::min(end + 1, size));
  Arguments arguments;
  std::string mistake;
  if (!parse_arguments(static_cast<int>(words.words.size()), words.words.data(), arguments, mistake)) {
    SHODO_CHECK(!mistake.empty() && mistake.find('\n') == std::string::npos);
    return 0;
  }
  Options options = arguments.options;
  limit(options);
  const Outcome large = run(scene, options, kLarge);
  fuzz::expect_told(large.status);
  if (!large.status.done()) return 0;
  expect_alike(large, run(scene, options, kSmall));
  if (options.flags == FlagMode::kScene) return 0;
  options.flags = options.flags == FlagMode::kOff ? FlagMode::kAuto : FlagMode::kOff;
  expect_alike(large, run(scene, options, kLarge));
  return 0;
}
