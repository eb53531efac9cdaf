// Hard cases of position and order: 8, 9, 31, 32.
#include <cmath>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "hard/variants.h"

namespace shodo::hard {

namespace {

/// A 1 x 2 x 3 box with a table in it and two lights; all coordinates are eighths.
void furnish(SceneText& scene) {
  scene.material("white", 0.7);
  scene.object("room");
  scene.room({0, 0, 0}, {1, 2, 3}, 3, 2);
  scene.object("table");
  scene.box({0.25, 0.5, 0.5}, {0.75, 1.25, 0.75}, 2, 2);
  scene.point_light({0.5, 0.25, 2.5}, 100);
  scene.area_light({0.25, 1.5, 2.875}, {0.25, 1.75, 2.875}, {0.75, 1.75, 2.875}, {0.75, 1.5, 2.875}, 1000);
  scene.camera("eye", {0.125, 0.125, 1}, {1, 2, 1}, {0, 0, 1}, 70);
}

}  // namespace

CaseResult far_origin() {
  Findings found;
  SceneText origin;
  furnish(origin);
  FullRun still(origin.text(), to_the_last_digits());
  const auto bits = still.bits();
  const auto pixels = still.picture();
  found.demand(!pixels.empty(), "a solution");
  for (const double far : {1.0, 1e3, 1e6, 1048576.0 * 1024, 1e9}) {
    // All coordinates are eighths: the shift is exact.
    SceneText moved([=](const Vec3& v) { return v + Vec3{far, -far, far}; });
    furnish(moved);
    FullRun run(moved.text(), to_the_last_digits());
    found.demand(run.done() && run.bits() == bits && run.picture() == pixels,
                 say("every bit of the unmoved run at %g", far));
  }
  // Not exact, the bare box: what the file's own digits leave is all that is lost. (With something in it that casts
  // shadows, samples round to other lattice points, and a form factor may change by one segment in 64.)
  const FullRun reference(bare_room_moved(0), to_the_last_digits());
  for (const double far : {1.0, 1e3, 1e6, 1e9}) {
    const FullRun run(bare_room_moved(far), to_the_last_digits());
    const double error = difference(reference, run);
    // A coordinate is off by far 2^-53; edges of a twelfth, and the light a sixth away, magnify it.
    found.demand(run.done() && error >= 0 && error < 1e-12 + far * 1e-14,
                 say("the file's own rounding at %g: %g", far, error));
    if (far == 1e6) found.worst(error);
  }
  found.demand(found.figure() < 1e-6, "1e-6 at 1e6");
  return found.result("relative change of E at 1e6 by an inexact shift; exact shifts to 1e9 change no bit");
}

CaseResult scaled() {
  // A point light's E goes with 1 / s^2, an area light's not at all; form factors never change. By powers of two every
  // bit stays, but for the factor.
  Findings found;
  const auto make = [](double s, bool point, bool furnished) {
    SceneText scene([=](const Vec3& v) { return s * v; });
    scene.material("white", 0.7);
    scene.object("room");
    scene.room({0, 0, 0}, {1, 2, 3}, 3, 2);
    if (furnished) {
      scene.object("table");
      scene.box({0.25, 0.5, 0.5}, {0.75, 1.25, 0.75}, 2, 2);
    }
    if (point) {
      scene.point_light({0.5, 0.25, 2.5}, 100);
    } else {
      scene.area_light({0.25, 1.5, 2.875}, {0.25, 1.75, 2.875}, {0.75, 1.75, 2.875}, {0.75, 1.5, 2.875}, 1000);
    }
    scene.camera("eye", {0.125, 0.125, 1}, {1, 2, 1}, {0, 0, 1}, 70);
    return scene.text();
  };
  for (const int kind : {0, 1, 2, 3}) {
    const bool furnished = kind >= 2, point = kind % 2 == 1;
    FullRun still(make(1, point, furnished), to_the_last_digits());
    found.demand(still.done() && still.sound(), "a solution");
    const auto pixels = still.picture();
    for (const double s : {1e-6, 1e-5, 1e-4, 1e-2, 0.1, 10.0, 1e3, 1e5, 1e6, 0x1p-20, 0x1p-3, 0x1p1, 0x1p20}) {
      FullRun run(make(s, point, furnished), to_the_last_digits());
      found.demand(run.done() && run.sound() && run.patches() == still.patches(), say("a solution at %g", s));
      const double factor = point ? 1 / (s * s) : 1;
      int exponent = 0;
      const bool exact = std::frexp(s, &exponent) == 0.5;
      double worst = 0;
      for (std::uint32_t i = 0; i < run.patches(); ++i) {
        worst = std::fmax(worst, relative(run.e0(i), factor * still.e0(i)));
        worst = std::fmax(worst, relative(run.ambient(i), factor * still.ambient(i)));
      }
      if (exact) {
        found.demand(worst == 0, say("every bit at the power of two %g", s));
        if (!point) found.demand(run.picture() == pixels, say("the same picture at %g", s));
      } else if (furnished) {
        // On a lattice of another step relative to the scene a segment in 64 may graze differently.
        found.demand(worst <= 0.02, say("the same to one segment in 64 at %g: %g", s, worst));
      } else {
        found.worst(worst);
        found.demand(worst <= 1e-12, say("1e-12 at %g: %g", s, worst));
      }
    }
  }
  return found.result(
      "largest relative change of E (times s^2 for a point light) at scales 1e-6 to 1e6; 0 at powers of "
      "two");
}

CaseResult mirror_symmetry() {
  // Two halves that are mirror images about x = 0, lights in the plane between and in pairs.
  Findings found;
  double of_bits = 0;
  for (const bool blocked : {false, true}) {
    SceneText scene;
    scene.material("white", 0.7);
    for (const bool mirrored : {false, true}) {
      scene.through(mirrored ? Map{[](const Vec3& v) { return Vec3{-v.x, v.y, v.z}; }} : Map{}, mirrored);
      scene.object(mirrored ? "left" : "right");
      scene.quad({0, 0, 0}, {2.1, 0, 0}, {2.1, 1.3, 0}, {0, 1.3, 0}, 4, 3, 2);
      scene.quad({0, 0, 1.7}, {0, 1.3, 1.7}, {2.1, 1.3, 1.7}, {2.1, 0, 1.7}, 3, 4, 2);
      scene.quad({2.1, 0, 0}, {2.1, 0, 1.7}, {2.1, 1.3, 1.7}, {2.1, 1.3, 0}, 3, 3, 2);
      scene.quad({0, 0, 0}, {0, 0, 1.7}, {2.1, 0, 1.7}, {2.1, 0, 0}, 3, 4, 2);
      scene.quad({0, 1.3, 0}, {2.1, 1.3, 0}, {2.1, 1.3, 1.7}, {0, 1.3, 1.7}, 4, 3, 2);
      if (blocked) scene.box({0.7, 0.3, 0.4}, {1.3, 0.8, 0.9}, 2, 2);
      scene.point_light({0.9, 0.2, 1.4}, 70);
    }
    scene.through({}, false);
    scene.point_light({0, 0.6, 1.1}, 100);
    const FullRun run(scene.text(), to_the_last_digits());
    found.demand(run.done() && run.sound(), "a solution");
    const std::vector<Keyed> all = by_key(run, scene);
    const std::size_t half = all.size() / 2;
    std::uint32_t equal = 0, patches = 0;
    for (std::size_t k = 0; k < half; ++k) {
      for (std::size_t i = 0; i < all[k].total.size(); ++i) {
        const double error = relative(all[k].total[i], all[half + k].total[i]);
        equal += error == 0 ? 1 : 0;
        ++patches;
        found.worst(error);
        found.demand(error <= 1e-12, say("mirrored values to 1e-12: %g", error));
      }
    }
    of_bits = 100.0 * equal / patches;
  }
  return found.result(say("largest relative difference of mirrored patches; %.0f %% are equal to the bit", of_bits));
}

CaseResult permuted_input() {
  Findings found;
  for (const double angle : {0.0, 0.1}) {
    SceneText scene(turn({1, 2, 3}, angle));
    furnish(scene);
    FullRun first(scene.text(), to_the_last_digits());
    found.demand(first.done() && first.sound(), "a solution");
    const auto pixels = first.picture();
    const std::vector<Keyed> expected = by_key(first, scene);
    for (std::uint64_t seed = 1; seed <= (thorough() ? 50 : 6); ++seed) {
      FullRun run(scene.text(seed), to_the_last_digits());
      found.demand(run.done(), "a solution");
      const double error = difference(expected, by_key(run, scene));
      found.worst(error);
      found.demand(error >= 0 && error <= 1e-12, say("E to 1e-12 in another order: %g", error));
      found.demand(run.picture() == pixels, "the same picture in another order");
    }
  }
  return found.result("largest relative difference of E with objects and polygons shuffled; the same picture");
}

}  // namespace shodo::hard
