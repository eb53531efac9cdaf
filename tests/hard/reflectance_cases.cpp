// Hard cases of reflectance and energy: 1, 2, 26, 27, 28, 29.
#include <cmath>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo::hard {

CaseResult rho_to_1() {
  // A furnace: E0 is 1 everywhere, so E is 1 / (1 - rho), whatever the form factors, but for the row sums' error.
  Findings found;
  std::uint32_t sweeps = 0;
  for (const double rho : {0.0, 0.1, 0.5, 0.9, 0.99, 0.999, 0.9999}) {
    for (const double tolerance : {1e-4, 1e-8}) {
      Options options;
      options.tolerance = tolerance;
      AmbientScene scene(grey(rho) + box_walls(3, 2, 1, 3, 4, 2, "white"), options);
      scene.light([](const Vec3&, std::uint32_t) { return 1.0; });
      found.demand(scene.solve().done(), "a solution");
      const Statistics counted = scene.statistics;
      const StoredMatrix stored(scene);
      double row_error = 0;
      for (std::size_t i = 0; i < stored.n; ++i) row_error = std::fmax(row_error, std::fabs(stored.row_sum(i) - 1));
      const double bound = counted.solution_bound;
      for (std::size_t i = 0; i < stored.n; ++i) {
        const double error = std::fabs(scene.total(i) * (1 - rho) - 1);
        found.worst(error);
        found.demand(error <= row_error * rho / (1 - rho) * 1.01 + bound * 1.01 + 1e-12,
                     say("E within the row sums' error times rho / (1 - rho) and the solver's bound at %g: %g, rows "
                         "%g, bound %g",
                         rho, error, row_error, bound));
      }
      found.demand(bound <= std::fmax(tolerance, 1e-9), say("a bound within the tolerance at %g", rho));
      sweeps = std::max(sweeps, counted.sweeps);
    }
  }
  found.demand(sweeps > 0 && sweeps < 60, "less than 60 sweeps, reported");
  return found.result(
      say("largest error of E at rho 0 to 0.9999, within the rows' and the solver's bound; at most %u "
          "sweeps",
          sweeps));
}

CaseResult rho_exactly_1() {
  Findings found;
  for (const char* rho : {"1", "1.0001", "0.99991", "1e300", "0.5 1 0.5"}) {
    const FullRun run(std::string("shodo 1\nmaterial white diffuse ") + rho + "\n");
    found.demand(run.status.code == StatusCode::kScene && run.status.line == 2,
                 std::string("a refusal with the line of reflectance ") + rho);
  }
  const FullRun run("shodo 1\nmaterial white diffuse 0.9999\n");
  found.demand(run.done(), "0.9999 taken");
  return found.refused("reflectance above 0.9999, with the line");
}

CaseResult zero_lights() {
  Findings found;
  SceneText scene;
  scene.material("white", 0.9);
  scene.object("room");
  scene.room({0, 0, 0}, {3, 2, 2}, 3, 2);
  scene.camera("eye", {0.5, 1, 1}, {3, 1, 1}, {0, 0, 1}, 70);
  FullRun run(scene.text(), small_picture());
  found.demand(run.done(), "status 0");
  found.demand(run.sum(0, 6) == 0, "all illuminance exactly 0");
  const auto pixels = run.picture();
  found.demand(pixels.size() == std::size_t{64} * 48 * 3, "a picture");
  for (const std::uint8_t byte : pixels) found.demand(byte == 0, "a black picture");
  return found.result("lux in a room without a light; black picture, status 0");
}

CaseResult all_black_all_white() {
  Findings found;
  SceneText black;
  black.material("white", 0);
  black.object("room");
  black.room({0, 0, 0}, {3, 2, 2}, 4, 2);
  black.point_light({1, 1, 1}, 100);
  const FullRun dark(black.text(), small_picture());
  found.demand(dark.done() && dark.sound(), "finite values");
  for (std::uint32_t i = 0; i < dark.patches(); ++i) {
    found.demand(dark.total(i) == dark.e0(i) && dark.e0(i) > 0, "E = E0 exactly where nothing reflects");
  }
  // Open: a floor and two walls of 0.9999.
  SceneText white;
  white.material("white", 0.9999);
  white.object("corner");
  white.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, 4, 4);
  white.quad({0, 0, 0}, {0, 0, 2}, {2, 0, 2}, {2, 0, 0}, 4, 4);
  white.quad({0, 0, 0}, {0, 2, 0}, {0, 2, 2}, {0, 0, 2}, 4, 4);
  white.point_light({1, 1, 1}, 100);
  const FullRun bright(white.text(), small_picture());
  found.demand(bright.done() && bright.sound(), "finite values");
  // What leaves through the open side is lost for good: a patch sees the others with at most 0.4 of its view or so.
  double e0 = 0;
  for (std::uint32_t i = 0; i < bright.patches(); ++i) e0 = std::fmax(e0, bright.e0(i));
  found.worst(bright.largest() / e0);
  found.demand(bright.largest() < 4 * e0, "an open white corner a few times as bright as its direct light at most");
  return found.result("largest E over largest E0 in an open corner of reflectance 0.9999; E = E0 at 0");
}

CaseResult disconnected() {
  Findings found;
  SceneText scene;
  scene.material("white", 0.9);
  for (int k = 0; k < 50; ++k) {
    scene.object("box" + std::to_string(k));
    scene.room({2.0 * k, 0, 0}, {2.0 * k + 1, 1, 1}, 1, 2);
  }
  scene.point_light({20.5, 0.4, 0.6}, 100);
  const std::string text = scene.text();
  for (const FlagMode flags : {FlagMode::kAuto, FlagMode::kOff}) {
    Options options;
    options.flags = flags;
    const FullRun run(text, options);
    found.demand(run.done() && run.sound(), "a solution");
    found.demand(run.sum(0, 60) + run.sum(66, 300) == 0, "49 boxes exactly dark");
    found.demand(run.sum(60, 66) > 0, "one box lit");
  }
  AmbientScene placed(text);
  const StoredMatrix stored(placed);
  for (std::size_t i = 0; i < stored.n; ++i) {
    for (std::size_t j = 0; j < stored.n; ++j) {
      found.demand(i / 6 == j / 6 || stored.exchange[i * stored.n + j] == 0, "no form factor between boxes");
    }
  }
  return found.result("lux in 49 of 50 closed boxes; no entries between them");
}

CaseResult one_patch() {
  Findings found;
  for (const double height : {1e-3, 0.1, 1.0, 100.0, 1e4}) {
    SceneText scene;
    scene.material("white", 0.9);
    scene.object("plate");
    scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    scene.point_light({0.5, 0.5, height}, 100);
    const FullRun run(scene.text(), small_picture());
    found.demand(run.done() && run.sound() && run.patches() == 1, "a solution");
    found.demand(run.ambient(0) == 0 && run.total(0) == run.e0(0), "E = E0 exactly");
    // I times the solid angle over the area.
    const double a = 0.5 / height;
    const double expected = 100 * 4 * std::atan(a * a / std::sqrt(1 + 2 * a * a));
    found.worst(relative(run.e0(0), expected));
    found.demand(relative(run.e0(0), expected) < 1e-5, say("the solid angle's E0 at height %g", height));
  }
  return found.result("relative error of E0 of a plate under a light, against the solid angle; E = E0");
}

}  // namespace shodo::hard
