// Runs the cases and hashes what comes out: FNV-1a over the bits of all map values, lowest byte first, and over the
// picture's bytes, each line after its number.
#include <bit>

#include "base/features.h"
#include "base/text.h"
#include "machines/cases.h"
#include "machines/hashes.h"
#include "model.h"

namespace machines {

namespace {

using namespace shodo;

class Hash {
 public:
  void add(std::uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3; }
  void add(std::uint32_t bits) {
    for (int k = 0; k < 4; ++k, bits >>= 8) add(static_cast<std::uint8_t>(bits));
  }
  void add(std::uint64_t bits) {
    add(static_cast<std::uint32_t>(bits));
    add(static_cast<std::uint32_t>(bits >> 32));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

struct Outcome {
  bool done = false;
  std::uint64_t maps = 0, picture = 0, smallest = 0, peak = 0;
  std::uint32_t recomputed = 0;
};

/// Illuminance of all sub-patches, direct and ambient; of all patches; what is hidden.
std::uint64_t hash_of_maps(const Model& model) {
  Hash hash;
  for (const float x : model.maps.direct_lx) hash.add(std::bit_cast<std::uint32_t>(x));
  for (const float x : model.maps.ambient_lx) hash.add(std::bit_cast<std::uint32_t>(x));
  for (const double x : model.direct.patch_lx) hash.add(std::bit_cast<std::uint64_t>(x));
  for (const double x : model.ambient.patch_lx) hash.add(std::bit_cast<std::uint64_t>(x));
  for (const std::uint8_t x : model.maps.hidden) hash.add(x);
  for (const float x : model.planes.direct_lx) hash.add(std::bit_cast<std::uint32_t>(x));
  for (const float x : model.planes.ambient_lx) hash.add(std::bit_cast<std::uint32_t>(x));
  for (const std::uint8_t x : model.planes.hidden) hash.add(x);
  return hash.value();
}

struct Drawing {
  Hash hash;
  LineSink sent;
};

bool take_line(void* context, std::uint32_t y, std::span<const std::uint8_t> rgb) {
  Drawing& drawing = *static_cast<Drawing*>(context);
  drawing.hash.add(y);
  for (const std::uint8_t byte : rgb) drawing.hash.add(byte);
  return drawing.sent.line == nullptr || drawing.sent.line(drawing.sent.context, y, rgb);
}

class Log {
 public:
  explicit Log(const Machine& machine) : machine_(machine) {}
  template <class T>
  Log& operator<<(const T& what) {
    text_.add(what);
    return *this;
  }
  Log& hex(std::uint64_t value, const char* before = "") {
    text_.add(before).add("0x");
    for (int shift = 60; shift >= 0; shift -= 4) text_.add("0123456789abcdef"[value >> shift & 15]);
    return *this;
  }
  ~Log() {
    text_.add('\n');
    machine_.print(line_);
  }

 private:
  const Machine& machine_;
  char line_[320] = {};
  TextBuilder text_{line_, sizeof line_};
};

Outcome run(const Machine& machine, const Case& c, std::span<unsigned char> memory, const LineSink& sent) {
  Outcome outcome;
  Options options;
  c.choose(options);
  std::string_view text;
  if (!find_file(c.scene, text)) {
    Log(machine) << "case " << c.name << ": no such file: " << c.scene;
    return outcome;
  }
  Model* model = nullptr;
  Drawing drawing{{}, sent};
  Status status = load(c.scene, text, compiled_in(), options, memory.data(), memory.size(), model);
  if (status.done()) outcome.smallest = smallest_memory(*model);
  if (status.done()) status = solve(*model, {});
  // Before the picture, which takes the memory of the patches where it is short.
  if (status.done()) outcome.maps = hash_of_maps(*model);
  if (status.done()) status = draw(*model, {}, {take_line, &drawing});
  if (!status.done()) {
    Log(machine) << "case " << c.name << ": " << status.file << ":" << status.line << ": " << status.message;
    return outcome;
  }
  outcome.picture = drawing.hash.value();
  outcome.peak = statistics(*model).memory_peak;
  outcome.recomputed = statistics(*model).rows_recomputed;
  outcome.done = true;
  return outcome;
}

const Hashes& expected(std::string_view name) {
  static constexpr Hashes kNone{"", 0, 0};
  for (const Hashes& hashes : kHashes) {
    if (name == hashes.name) return hashes;
  }
  return kNone;
}

/// The same bits in the smallest memory, where rows don't fit and are computed again in every sweep.
bool same_when_scarce(const Machine& machine, const Case& c, const Outcome& full) {
  const Outcome scarce = run(machine, c, machine.memory.first(static_cast<std::size_t>(full.smallest)), {});
  const bool same = scarce.done && scarce.maps == full.maps && scarce.picture == full.picture;
  Log(machine) << "scarce " << c.name << (same ? " same" : " differs") << " memory " << full.smallest << " recomputed "
               << scarce.recomputed;
  if (scarce.done && scarce.recomputed == 0) {
    Log(machine) << "case " << c.name << ": no row was computed again, so this shows nothing";
    return false;
  }
  return same;
}

/// A library without what the case needs says so when it loads, and never draws something else.
bool refused(const Machine& machine, const Case& c) {
  Options options;
  c.choose(options);
  std::string_view text;
  Model* model = nullptr;
  if (!find_file(c.scene, text)) return false;
  const Status status =
      load(c.scene, text, compiled_in(), options, machine.memory.data(), machine.memory.size(), model);
  const bool right = status.code == StatusCode::kUsage || (status.code == StatusCode::kScene && status.line > 0);
  Log(machine) << "case " << c.name << (right ? " refused " : " not refused ") << status.message;
  return right;
}

bool run_case(const Machine& machine, const Case& c, Outcome& outcome) {
  outcome = run(machine, c, machine.memory, c.sent ? machine.picture : LineSink{});
  if (!outcome.done) return false;
  const Hashes& wanted = expected(c.name);
  const bool same = outcome.maps == wanted.maps && outcome.picture == wanted.picture;
  (Log(machine) << "case " << c.name << " maps ").hex(outcome.maps).hex(outcome.picture, " picture ")
      << (same ? " same" : " differs") << " peak " << outcome.peak;
  if (!same) {
    (Log(machine) << "put in tests/machines/hashes.h:    {\"" << c.name << "\", ")
            .hex(outcome.maps)
            .hex(outcome.picture, ", ")
        << "},";
  }
  const bool again = c.scarce == Scarce::kAlways || (c.scarce == Scarce::kIfFast && machine.fast);
  return (!again || same_when_scarce(machine, c, outcome)) && same;
}

}  // namespace

int run_cases(const Machine& machine, std::string_view only) {
  if (const Status status = self_check(); !status.done()) {
    Log(machine) << status.message;
    return static_cast<int>(status.code);
  }
  Hash maps, picture;
  std::uint64_t peak = 0;
  bool same = true;
  for (const Case& c : all_cases()) {
    if (!only.empty() && only != c.name) continue;
    Outcome outcome;
    if ((!features::kFull && !c.lean) || (!features::kLuminaires && c.luminaires)) {
      same = refused(machine, c) && same;
      continue;
    }
    same = run_case(machine, c, outcome) && same;
    maps.add(outcome.maps);
    picture.add(outcome.picture);
    if (outcome.peak > peak) peak = outcome.peak;
  }
  (Log(machine) << "all maps ").hex(maps.value()).hex(picture.value(), " picture ")
      << (same ? " same" : " differs") << " peak " << peak;
  return same ? 0 : 1;
}

}  // namespace machines
