// Hard cases of seams and overlaps: 4, 5, 6, 7, 16.
#include <cmath>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "support/aimed_segments.h"
#include "support/cut_wall.h"

namespace shodo::hard {

namespace {

/// Inside a box before it was turned by `back`'s inverse; 40 steps clear of its surface.
Where in_box(const Model& model, const Map& back, const Vec3& low, const Vec3& high) {
  return [&model, back, low, high](const LatticePoint& p) {
    const Vec3 v = back(scene_point(model.geometry.lattice, p) + model.scene.origin);
    const double clear = 40 * model.geometry.lattice.step();
    const auto least = [&](double margin) {
      return v.x >= low.x + margin && v.y >= low.y + margin && v.z >= low.z + margin && v.x <= high.x - margin &&
             v.y <= high.y - margin && v.z <= high.z - margin;
    };
    return least(clear) ? 1 : least(-clear) ? 0 : -1;
  };
}

void bright_outside(SceneText& scene) {
  for (const Vec3& at : {Vec3{4, 1, 1}, Vec3{-1, -1, -0.5}, Vec3{1, 1, 3.5}, Vec3{3.5, 3.5, 3}, Vec3{-0.01, 1, 1}}) {
    scene.point_light(at, 1e5);
  }
  scene.area_light({-1, -1, 4}, {-1, 4, 4}, {4, 4, 4}, {4, -1, 4}, 1e4);
  scene.sun({0, 0, -1}, 1e5);
  scene.sun({1, 1, -1}, 1e5);
  scene.sun({0, 1, 0}, 1e5);
}

}  // namespace

CaseResult t_junction() {
  // A box whose floor has 3 x 5 quads beside walls of 5, 4, 3, 7: every edge has T-junctions. Bright outside.
  Findings found;
  std::uint64_t segments = 0;
  Random random(11);
  for (int k = 0; k < (thorough() ? 200 : 12); ++k) {
    const Vec3 axis{random.signed_unit(), random.signed_unit(), random.signed_unit() + 0.01};
    const double angle = k == 0 ? 0 : 3 * random.signed_unit();
    const Vec3 x{2 + random.unit(), 0, 0}, y{0, 2 + random.unit(), 0}, z{0, 0, 2 + random.unit()};
    SceneText scene(turn(axis, angle));
    scene.material("white", 0.9);
    scene.object("room");
    cut_wall(scene, {}, x, y, 5, 3);
    cut_wall(scene, z, y, x, 4, 3);
    cut_wall(scene, {}, z, x, 1, 3);
    cut_wall(scene, y, x, z, 5, 2);
    cut_wall(scene, {}, y, z, 2, 7);
    const std::uint32_t walls = 15 + 12 + 3 + 10 + 14 + 12;
    cut_wall(scene, x, z, y, 3, 4);
    bright_outside(scene);
    const FullRun run(scene.text());
    found.demand(run.done() && run.sound(), "a solution");
    found.demand(run.sum(0, walls) == 0, "all walls of the closed room exactly dark");
    const Vec3 high{x.x, y.y, z.z};
    const Leaks leaks = shoot(run.model().geometry, in_box(run.model(), turn(axis, -angle), {}, high), 1000, 7);
    segments += leaks.segments;
    found.worst(static_cast<double>(leaks.leaks));
    found.demand(leaks.leaks == 0, "no leak through T-junctions");
  }
  found.demand(segments > 5000, "enough aimed segments");
  return found.result(say("of %llu segments aimed at edges and T-junctions leak; a closed room amid lights is 0",
                          static_cast<unsigned long long>(segments)));
}

CaseResult leaky_corner() {
  Findings found;
  for (const double angle : {0.0, 0.1, 0.7, 2.0}) {
    SceneText scene(turn({1, 2, 3}, angle));
    scene.material("white", 0.9);
    scene.object("dark");
    scene.room({0, 0, 0}, {2, 2, 2}, 4, 3);
    scene.object("ground");
    scene.quad({-3, -3, -1}, {5, -3, -1}, {5, 5, -1}, {-3, 5, -1}, 4, 4);
    bright_outside(scene);
    scene.camera("inside", {1, 1, 1}, {0, 0, 0}, {0, 0, 1}, 100);
    for (const FlagMode flags : {FlagMode::kAuto, FlagMode::kOff}) {
      Options options = small_picture(160, 120);
      options.flags = flags;
      FullRun run(scene.text(), options);
      found.demand(run.done() && run.sound(), "a solution");
      found.worst(run.sum(0, 6));
      found.demand(run.sum(0, 6) == 0, "all values inside exactly 0");
      found.demand(run.sum(6, 7) > 0, "light outside");
      const auto pixels = run.picture();
      found.demand(!pixels.empty(), "a picture");
      for (const std::uint8_t byte : pixels) found.demand(byte == 0, "a black picture from inside");
    }
  }
  return found.result("lux inside a dark room amid suns and lamps, in four positions");
}

CaseResult coplanar_overlap() {
  // A picture in the plane of a wall, before and after it in the file.
  Findings found;
  for (const double angle : {0.0, 0.1, 1.3}) {
    const auto make = [&](int order) {  // 0: no picture, 1: after the wall, 2: before
      SceneText scene(turn({1, 2, 3}, angle));
      scene.material("white", 0.2);
      scene.material("light", 0.8);
      const auto picture = [&] {
        scene.use("light");
        scene.object("picture");
        scene.quad({0.6, 0.7, 0}, {1.4, 0.7, 0}, {1.4, 1.3, 0}, {0.6, 1.3, 0}, 3, 3, 2);
        scene.use("white");
      };
      if (order == 2) picture();
      scene.object("wall");
      scene.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, 5, 5, 2);
      if (order == 1) picture();
      scene.sun({0.2, 0.1, -1}, 1000);
      scene.camera("eye", {0.9, 0.8, 3}, {1, 1, 0}, {0, 1, 0}, 45);
      return scene.text();
    };
    FullRun after(make(1), small_picture(120, 90)), before(make(2), small_picture(120, 90));
    found.demand(after.done() && before.done(), "a solution");
    const double expected = 1000 / std::sqrt(1.05);
    for (const auto& [run, picture] : {std::pair<const FullRun&, std::uint32_t>{after, 1}, {before, 0}}) {
      const Mesh& mesh = run.mesh(picture);
      for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
        const double lux = static_cast<double>(run.model().maps.direct_lx[mesh.first_sub_patch + k]);
        found.worst(relative(lux, expected));
        found.demand(relative(lux, expected) < 1e-5,
                     say("the picture fully lit, turned by %g: %g", angle, lux / expected));
      }
    }
    const auto first = after.picture(), second = before.picture();
    found.demand(!first.empty() && first == second, "the same image for both orders");
    // The smaller one is seen: the middle of the picture is as bright as 0.8 of the sun.
    FullRun bare(make(0), small_picture(120, 90));
    const auto wall = bare.picture();
    const std::size_t middle = (std::size_t{45} * 120 + 60) * 3;
    found.demand(first[middle] > wall[middle], "the smaller polygon in front");
  }
  return found.result(
      "largest relative error of a picture in its wall's plane; one image for both orders, the smaller "
      "one is seen");
}

CaseResult coplanar_identical() {
  Findings found;
  for (const double angle : {0.0, 0.1, 1.3}) {
    const auto make = [&](bool opposite, bool exchanged) {
      SceneText scene(turn({1, 2, 3}, angle));
      scene.material("white", 0.5);
      const auto up = [&] {
        scene.object("up");
        scene.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, 3, 3, 2);
      };
      if (!exchanged) up();
      scene.object("other");
      if (opposite) {
        scene.quad({0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}, 3, 3, 2);
      } else {
        scene.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, 3, 3, 2);
      }
      if (exchanged) up();
      scene.sun({0.2, 0.1, -1}, 1000);
      scene.sun({0.1, 0.3, 1}, 500);
      scene.camera("eye", {0.9, 0.8, 3}, {1, 1, 0}, {0, 1, 0}, 45);
      return scene.text();
    };
    const double above = 1000 / std::sqrt(1.05), below = 500 / std::sqrt(1.1);
    for (const bool opposite : {false, true}) {
      std::vector<std::uint8_t> pixels;
      for (const bool exchanged : {false, true}) {
        FullRun run(make(opposite, exchanged), small_picture());
        found.demand(run.done() && run.sound(), "a solution");
        for (std::uint32_t m = 0; m < 2; ++m) {
          const double expected = opposite && (m == 1) != exchanged ? below : above;
          for (std::uint32_t k = 0; k < run.mesh(m).patch_count(); ++k) {
            const double lux = run.total(run.mesh(m).first_patch + k);
            found.worst(relative(lux, expected));
            found.demand(relative(lux, expected) < 1e-5,
                         say("%s, turned by %g: %g", opposite ? "each lit from its own side" : "both lit the same",
                             angle, lux / expected));
          }
        }
        const auto own = run.picture();
        found.demand(pixels.empty() || own == pixels, "the same image for both orders");
        pixels = own;
      }
    }
  }
  return found.result("largest relative error of a quad given twice: both lit the same, or each from its own side");
}

CaseResult interpenetrating_boxes() {
  // Box b stands half in box a, and both in the floor; meshes 0 floor, 1 to 6 a, 7 to 12 b.
  Findings found;
  std::uint32_t buried = 0;
  for (const double angle : {0.0, 0.1, 1.3}) {
    const auto make = [&](bool outside) {
      SceneText scene(turn({1, 2, 3}, angle));
      scene.material("white", 0.7);
      scene.object("floor");
      scene.quad({-4, -4, 0}, {6, -4, 0}, {6, 6, 0}, {-4, 6, 0}, 10, 10, 2);
      scene.object("a");
      scene.box({0, 0, -1}, {2, 2, 1}, 8, 2);
      scene.object("b");
      scene.box({1, 0.5, -0.5}, {3, 1.5, 0.5}, 8, 2);
      if (outside) {
        scene.point_light({1, -2, 3}, 1000);
        scene.sun({0.3, 0.4, -1}, 1000);
      } else {
        scene.point_light({0.6, 1.1, 0.4}, 1e6);   // in a
        scene.point_light({1.4, 1.1, 0.2}, 1e6);   // in both
        scene.point_light({1.4, 1.1, -0.2}, 1e6);  // and under the floor
      }
      return scene.text();
    };
    const FullRun lit(make(true)), inner(make(false));
    found.demand(lit.done() && lit.sound() && inner.done(), "a solution");
    const Model& model = lit.model();
    const Map back = turn({1, 2, 3}, -angle);
    for (std::uint32_t m = 0; m < 13; ++m) {
      const Mesh& mesh = lit.mesh(m);
      for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
        const Vec3 p = back(sub_patch_piece(model.scene, mesh, k).centre() + model.scene.origin);
        // Clear of the borders by a sub-patch.
        const double half = m == 0 ? 0.25 : 0.1;
        const auto within = [&](const Vec3& low, const Vec3& high, double margin) {
          return p.x > low.x + margin && p.x < high.x - margin && p.y > low.y + margin && p.y < high.y - margin &&
                 p.z > low.z + margin && p.z < high.z - margin;
        };
        const auto in_other = [&](double margin) {
          return ((m == 0 || m >= 7) && within({0, 0, -1}, {2, 2, 1}, margin)) ||
                 (m < 7 && within({1, 0.5, -0.5}, {3, 1.5, 0.5}, margin));
        };
        const bool under = m != 0 && p.z < -half;
        const auto lux = [&](const FullRun& run) {
          return static_cast<double>(run.model().maps.direct_lx[mesh.first_sub_patch + k]) +
                 static_cast<double>(run.model().maps.ambient_lx[mesh.first_sub_patch + k]);
        };
        if (in_other(half) || under) {
          ++buried;
          found.worst(lux(lit));
          found.demand(lux(lit) == 0,
                       say("buried sub-patches 0: mesh %u at %g %g %g, turned by %g", m, p.x, p.y, p.z, angle));
        }
        if (!in_other(-half))
          found.demand(lux(inner) == 0, say("no light from inside: mesh %u, turned by %g", m, angle));
      }
    }
  }
  found.demand(buried > 1000, "buried sub-patches");
  return found.result(say("lux on %u buried sub-patches; lamps inside light nothing outside", buried));
}

}  // namespace shodo::hard
