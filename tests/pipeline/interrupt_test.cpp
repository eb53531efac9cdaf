// Stopping in the middle: whenever the caller says no, the stage at work ends with kInterrupted, and the model is good
// for another go.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model.h"
#include "shodo/shodo.h"
#include "support/collected_lines.h"

namespace shodo {
namespace {

/// Everything that a run can model, at once.
const std::string kScene =
    "shodo 1\ndisplay 1 250\ncamera eye eye 0.5 0.5 1 look 2 2 0.8 up 0 0 1 fov 80\n"
    "material white diffuse 0.7 0.6 0.5\nmaterial mirror diffuse 0.1 reflect 0.8\n"
    "material red diffuse 0.02 transmit 0.9 0.3 0.2\nmaterial lacquer diffuse 0.4 highlight 0.3 40\n"
    "object room\n"
    "quad white 0 0 0  3 0 0  3 3 0  0 3 0 patches 4 4 sub 5 4\n"
    "quad white 0 0 2  0 3 2  3 3 2  3 0 2 patches 4 4 sub 2 2\n"
    "quad lacquer 0 0 0  0 0 2  3 0 2  3 0 0 patches 2 3 sub 2 2\n"
    "quad mirror 0 0 0  0 3 0  0 3 2  0 0 2 patches 3 2 sub 1 1\n"
    "object pane\nquad red 1 1 0  2 2 0  2 2 1.5  1 1 1.5 patches 1 1 sub 1 1\n"
    "light sun sun towards 0.4 -0.3 -1 illuminance 1000\n"
    "light lamp area quad 1 1 1.9  1 1.5 1.9  1.5 1.5 1.9  1.5 1 1.9 luminance 500\n"
    "plane desk 0.5 2 0.7  1 2 0.7  1 2.5 0.7  0.5 2.5 0.7 patches 2 2 sub 2 2\n";

struct Call {
  Stage stage;
  std::uint64_t total;
};

/// Says no at one call, counted from 0, and notes all.
struct Stopper {
  std::size_t stop = ~std::size_t{0}, calls = 0;
  std::vector<Call> noted;

  Progress progress() {
    return {[](void* context, Stage stage, std::uint64_t, std::uint64_t total) {
              Stopper& own = *static_cast<Stopper*>(context);
              own.noted.push_back({stage, total});
              return own.calls++ != own.stop;
            },
            this};
  }
};

struct WholeRun {
  explicit WholeRun(const Options& options) : memory(std::size_t{1} << 20) {
    const Status status = load("top.scn", kScene, {}, options, memory.data(), memory.size() * 8, model);
    EXPECT_TRUE(status.done()) << status.message;
  }
  Status go(const Progress& progress) {
    pixels.clear();
    Status status = solve(*model, progress);
    const LineSink sink = collected_in(pixels);
    if (status.done()) status = draw(*model, progress, sink);
    const SeenSink seen{[](void* to, const SeenPoint& at) {
                          const std::uint32_t values[] = {at.x, at.y, at.mesh, at.light};
                          const std::uint8_t* bytes = reinterpret_cast<const std::uint8_t*>(values);
                          auto& all = *static_cast<std::vector<std::uint8_t>*>(to);
                          all.insert(all.end(), bytes, bytes + sizeof values);
                        },
                        &pixels};
    if (status.done()) status = see(*model, progress, seen);
    return status;
  }

  std::vector<std::uint64_t> memory;
  Model* model = nullptr;
  std::vector<std::uint8_t> pixels;
};

/// Of every stretch of calls from one loop: its first, second, middle and last.
std::vector<std::size_t> calls_worth_stopping_at(const std::vector<Call>& noted) {
  std::vector<std::size_t> chosen;
  for (std::size_t begin = 0; begin < noted.size();) {
    std::size_t end = begin;
    const auto goes_on = [&] {
      return noted[end].stage == noted[begin].stage && noted[end].total == noted[begin].total;
    };
    while (end < noted.size() && goes_on()) ++end;
    for (const std::size_t at : {begin, begin + 1, (begin + end) / 2, end - 1}) {
      if (at < end && (chosen.empty() || at > chosen.back())) chosen.push_back(at);
    }
    begin = end;
  }
  return chosen;
}

TEST(Interruption, AtAnyCallEndsTheRunAndTheNextGivesTheSamePicture) {
  for (const bool blocks : {false, true}) {
    Options options;
    options.width = 40;
    options.height = 30;
    options.gather = true;
    options.mirror_light = true;
    options.rules.blocks = blocks;
    WholeRun run(options);
    Stopper counted;
    ASSERT_TRUE(run.go(counted.progress()).done());
    const std::vector<std::uint8_t> whole = run.pixels;
    ASSERT_FALSE(whole.empty());
    const std::vector<std::size_t> stops = calls_worth_stopping_at(counted.noted);
    EXPECT_GT(stops.size(), 15u);
    for (const std::size_t stop : stops) {
      Stopper stopper;
      stopper.stop = stop;
      const Status status = run.go(stopper.progress());
      EXPECT_EQ(status.code, StatusCode::kInterrupted) << stop;
      EXPECT_EQ(stopper.calls, stop + 1);  // it isn't asked again
    }
    ASSERT_TRUE(run.go({}).done());
    EXPECT_EQ(run.pixels, whole);
  }
}

}  // namespace
}  // namespace shodo
