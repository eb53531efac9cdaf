// Hard cases of lights: 12, 13, 14, 35.
#include <cmath>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"

namespace shodo::hard {

CaseResult light_on_surface() {
  // Two rooms side by side; the light on the first one's ceiling, on an edge, in a corner, and on the wall between.
  Findings found;
  const struct {
    Vec3 at, inwards;
    int walls;  // that it lies on
  } places[] = {{{0.7, 0.9, 2}, {0, 0, -1}, 1}, {{0.7, 0, 2}, {0, 1, -1}, 2}, {{0, 0, 2}, {1, 1, -1}, 3},
                {{2, 1, 1}, {-1, 0, 0}, 1},     {{2, 0, 1}, {-1, 1, 0}, 2},   {{2, 2, 2}, {-1, -1, -1}, 3},
                {{0.3, 1.2, 0}, {0, 0, 1}, 1}};
  for (const auto& place : places) {
    for (const double angle : {0.0, 0.1, 1.3}) {
      const auto make = [&](const Vec3& at) {
        SceneText scene(turn({1, 2, 3}, angle));
        scene.material("white", 0.5);
        scene.object("lit");
        scene.room({0, 0, 0}, {2, 2, 2}, 3, 2);
        scene.object("next");
        scene.room({2, 0, 0}, {4, 2, 2}, 3, 2);
        scene.point_light(at, 100);
        return scene.text();
      };
      // As if infinitesimally in front: as at a hundred thousandth of the room in front.
      const FullRun run(make(place.at)), before(make(place.at + 2e-5 * place.inwards));
      found.demand(run.done() && run.sound() && before.done(), "a solution");
      found.demand(run.sum(6, 12) == 0, say("the next room exactly dark, turned by %g", angle));
      double flux = 0;
      for (std::uint32_t i = 0; i < run.mesh(6).first_patch; ++i) flux += run.model().patches[i].area * run.e0(i);
      const double expected = 400 * M_PI / (1 << place.walls);
      found.worst(relative(flux, expected));
      found.demand(relative(flux, expected) < 0.01,
                   say("the flux into its own room, turned by %g: %g", angle, flux / expected));
      for (std::uint32_t i = 0; i < run.mesh(6).first_patch; ++i) {
        // A hair in front of its own walls it would send them half its flux; on them it sends them nothing.
        if (run.e0(i) < 1e-6 * run.largest()) continue;
        const double off = std::fabs(run.e0(i) - before.e0(i));
        found.demand(off < 1e-3 * before.largest() || off < 0.01 * before.e0(i),
                     say("as if in front, turned by %g", angle));
      }
    }
  }
  return found.result(
      "largest relative error of the flux from a light on a ceiling, an edge, a corner, a common wall; the "
      "next room is 0");
}

CaseResult light_in_plane() {
  Findings found;
  for (int k = 0; k < 20; ++k) {
    const double z = 0.7 + 0.0937 * k;
    for (const double angle : {0.0, 0.1, 1.3}) {
      SceneText scene(turn({1, 2, 3}, angle));
      scene.material("white", 0);
      scene.object("plate");
      scene.quad({0.1, 0.3, z}, {2.3, 0.3, z}, {2.3, 1.9, z}, {0.1, 1.9, z}, 7, 5, 3);
      scene.quad({0, 0, -1.37}, {1, 0, -1.37}, {1, 1, -1.37}, {0, 1, -1.37});
      scene.point_light({3.1, 1.1, z}, 1e6);
      scene.area_light({3, 0, z}, {4, 0, z}, {4, 1, z}, {3, 1, z}, 1e6);
      const FullRun run(scene.text());
      found.demand(run.done() && run.sound(), "a solution");
      double most = 0;
      for (std::uint32_t i = 0; i < 35; ++i) most = std::fmax(most, run.e0(i));
      // The light's own maximum: square below it, at the least distance of 0.8.
      const double part = most / (1e6 / 0.64);
      if (angle == 0) {
        found.demand(most == 0, "exactly 0 in a plane that is exact in double");
      } else {
        found.worst(part);
        found.demand(part <= 1e-12, say("below 1e-12 of the light's maximum in a turned plane: %g", part));
      }
    }
  }
  return found.result("of the light's maximum in a turned plane that it lies in; exactly 0 where the plane is exact");
}

CaseResult light_on_sample() {
  Findings found;
  for (const double angle : {0.0, 0.1}) {
    for (const double height : {0.0, 1e-300, 1e-12, 1e-7, 1e-6}) {
      SceneText scene(turn({1, 2, 3}, angle));
      scene.material("white", 0.5);
      scene.object("room");
      scene.room({0, 0, 0}, {3, 3, 3}, 3, 1);
      scene.point_light({1.5, 1.5, height}, 100);  // the middle of the middle patch
      const FullRun run(scene.text());
      found.demand(run.done() && run.sound(), say("finite values at a height of %g", height));
      const double most = run.largest();
      // Half the sphere is above the floor, and a flux can't be more than 2 pi I.
      double flux = 0;
      for (std::uint32_t i = 0; i < run.patches(); ++i) flux += run.model().patches[i].area * run.e0(i);
      found.worst(most);
      found.demand(flux <= 400 * M_PI * 1.01, say("no more flux than the light has at %g", height));
      // In the floor's plane it sends the floor nothing at all.
      if (height > 1e-12)
        found.demand(run.model().statistics.lights_clamped > 0, say("clamped and reported at %g", height));
    }
  }
  return found.result("lux at most with a light of 100 cd on a sample or a hair above; finite, clamped, counted");
}

CaseResult window_grid() {
  // The sun square through a lattice of 50 x 50 openings over the floor, and aslant.
  Findings found;
  struct Floor {
    double slant;
    int patches, subs;  // along an edge
  };
  // The last three are a half and a quarter of the bars' spacing: equal samples everywhere would be in step with it.
  const Floor floors[] = {{0, 9, 3},    {0.05, 9, 3}, {0, 23, 3},   {0.05, 23, 3},
                          {0.1, 31, 3}, {0, 25, 4},   {0.1, 25, 4}, {0, 50, 4}};
  for (const auto& [slant, counts, subs] : floors) {
    SceneText scene;
    scene.material("white", 0);
    scene.object("floor");
    scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, counts, counts, subs);
    scene.object("bars");
    // Ten pitches further on every side, for the slant.
    const double pitch = 1.0 / 50, z = 0.2, low = -10 * pitch, high = 60 * pitch;
    for (int k = -10; k <= 60; ++k) {
      const double a = pitch * (k - 0.15), b = pitch * (k + 0.15);
      scene.quad({a, low, z}, {b, low, z}, {b, high, z}, {a, high, z});
      scene.quad({low, a, z}, {high, a, z}, {high, b, z}, {low, b, z});
    }
    scene.sun({slant, 0.6 * slant, -1}, 1000);
    const FullRun run(scene.text());
    found.demand(run.done() && run.sound(), "a solution");
    const double cosine = 1 / std::sqrt(1 + slant * slant * 1.36);
    const double lit = run.mean(0) / (1000 * cosine), open = 0.7 * 0.7;
    found.worst(relative(lit, open));
    found.demand(
        relative(lit, open) < 0.02,
        say("the sunlit fraction within 2 %% of the open one with %d x %d sub-patches: %g", subs, counts, lit / open));
  }
  return found.result("relative error of the sunlit fraction of a floor behind 50 x 50 bars");
}

}  // namespace shodo::hard
