// Hard cases of thin, flat and close things: 3, 10, 11, 17, 33, 34.
#include <cmath>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "support/closed_factors.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo::hard {

namespace {

constexpr int kStrips = 20;

/// Strips are the meshes 5 to 24.
std::string strips(double width, bool uncut, double rho = 0.8) {
  SceneText scene;
  scene.material("white", rho);
  scene.object("room");
  cube_with_strips(scene, kStrips, width, uncut);
  scene.point_light({0.3, 0.5, 0.6}, 100);
  return scene.text();
}

}  // namespace

CaseResult sliver_1e4() {
  Findings found;
  Options unscaled;
  unscaled.scale_rows = false;
  for (const double width : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const std::string cut = strips(width, false), uncut = strips(width, true);
    AmbientScene placed(cut, unscaled);
    const StoredMatrix stored(placed);
    for (std::size_t i = 0; i < stored.n; ++i) {
      const double error = std::fabs(stored.row_sum(i) - 1);
      found.worst(error);
      found.demand(error < 0.01, say("row sums within 1 %% of 1 with strips of %g: %g", width, error));
    }
    const FullRun fine(cut), coarse(uncut);
    found.demand(fine.done() && fine.sound() && coarse.done(), "a solution");
    found.demand(fine.model().statistics.patches_dropped == 0, "no strip dropped");
    double mean = 0;
    for (std::uint32_t k = 0; k < kStrips; ++k) {
      const double total = fine.total(fine.mesh(5 + k).first_patch);
      mean += total / kStrips;
      found.demand(total > 0.5 * coarse.mean(5), say("no black strip of %g", width));
    }
    found.demand(relative(mean, coarse.mean(5)) < 0.01, say("strips of %g as bright as the uncut wall", width));
  }
  // Where the lattice ends: reported, and the rest as without them.
  for (const double width : {3e-6, 1e-6, 1e-7}) {
    const FullRun fine(strips(width, false)), coarse(strips(width, true));
    found.demand(fine.done() && fine.sound(), "a solution");
    found.demand(fine.model().statistics.patches_dropped == kStrips, say("strips of %g reported as dropped", width));
    for (std::uint32_t m = 0; m < 5; ++m) {
      found.demand(relative(fine.mean(m), coarse.mean(m)) < 0.01, say("walls beside strips of %g", width));
    }
  }
  return found.result("largest error of a row sum with strips of 1 x 1e-2 to 1e-5; finer ones are dropped and counted");
}

CaseResult zero_area() {
  Findings found;
  const auto make = [](bool with, const Map& map) {
    SceneText scene(map);
    scene.material("white", 0.7);
    scene.object("room");
    scene.room({0, 0, 0}, {3, 2, 2}, 3, 2);
    if (with) {
      scene.object("nothing");
      scene.triangle({1, 1, 1}, {1.5, 1, 1}, {2, 1, 1});               // collinear
      scene.triangle({1, 1, 0.5}, {1, 1, 0.5}, {1, 1, 0.5});           // a point
      scene.triangle({1, 1, 0.5}, {1, 1, 0.5}, {1, 1.5, 0.5});         // an edge without length
      scene.quad({1, 1, 1}, {1.25, 1, 1}, {1.5, 1, 1}, {2, 1, 1});     // collinear
      scene.quad({1, 0.5, 1}, {2, 0.5, 1}, {2, 0.5, 1}, {1, 0.5, 1});  // there and back
      scene.quad({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    }
    scene.point_light({1.3, 0.9, 1.1}, 100);
    scene.camera("eye", {0.4, 0.5, 1}, {3, 1.5, 0.7}, {0, 0, 1}, 80);
    return scene.text();
  };
  for (const Map& map : {Map{}, turn({1, 2, 3}, 0.1)}) {
    FullRun without(make(false, map), small_picture()), with(make(true, map), small_picture());
    found.demand(with.done() && without.done(), "a solution");
    found.worst(with.model().statistics.polygons_dropped + with.model().statistics.patches_dropped);
    found.demand(found.figure() == 6, "all 6 counted");
    for (std::uint32_t i = 0; i < without.patches(); ++i) {
      found.demand(with.e0(i) == without.e0(i) && with.ambient(i) == without.ambient(i), "the rest equal to the bit");
    }
    found.demand(with.picture() == without.picture(), "the same picture");
  }
  return found.result("polygons without area, dropped and counted; the rest is the same to the bit");
}

CaseResult duplicate_vertices() {
  Findings found;
  const auto make = [](int kind) {
    SceneText scene;
    scene.material("white", 0.7);
    scene.object("room");
    scene.room({0, 0, 0}, {3, 2, 2}, 3, 2);
    scene.object("sail");
    const Vec3 a{1, 0.5, 0.5}, b{2, 0.7, 0.5}, c{1.5, 1.5, 1};
    const Vec3* quads[4][4] = {{&a, &a, &b, &c}, {&a, &b, &b, &c}, {&a, &b, &c, &c}, {&a, &b, &c, &a}};
    if (kind == 4) {
      scene.triangle(a, b, c);
    } else {
      const auto& q = quads[kind];
      scene.quad(*q[0], *q[1], *q[2], *q[3]);
    }
    scene.point_light({1.3, 0.9, 1.6}, 100);
    scene.camera("eye", {0.4, 0.5, 1}, {3, 1.5, 0.7}, {0, 0, 1}, 80);
    return scene.text();
  };
  FullRun triangle(make(4), small_picture());
  found.demand(triangle.done(), "a solution");
  const auto pixels = triangle.picture();
  for (int kind = 0; kind < 4; ++kind) {
    FullRun quad(make(kind), small_picture());
    found.demand(quad.done() && quad.sound(), "a solution");
    found.worst(difference(triangle, quad));
    found.demand(difference(triangle, quad) >= 0 && difference(triangle, quad) < 2e-3, "the triangle's light");
    std::size_t differ = 0;
    const auto own = quad.picture();
    for (std::size_t k = 0; k < own.size(); ++k) differ += std::abs(own[k] - pixels[k]) > 1 ? 1 : 0;
    found.demand(own.size() == pixels.size() && differ == 0, "the triangle's picture to one step");
  }
  return found.result("largest difference, of the largest E, of a quad with a repeated corner from the triangle");
}

namespace {

enum class Cut { kOneAgainstSix, kAlike, kOtherDiagonal, kSixAgainstSix };

/// Two rooms of 2 x 3 x 2 with a wall of `thickness` between, the first lit: meshes 0 to 4 and the lit face or faces,
/// then the second room's.
struct TwoRooms {
  std::string text;
  std::uint32_t lit_meshes = 0, all_meshes = 0;

  TwoRooms(double thickness, Cut cut, const Map& map) {
    SceneText scene(map);
    scene.material("white", 0.5);
    scene.object("lit");
    half(scene, 0, 2, 0);
    const bool six = cut == Cut::kSixAgainstSix;
    face(six ? 2 : 1, six ? 3 : 1, [&](double y0, double y1, double z0, double z1) {
      lit_meshes =
          1 + scene.quad({2, y0, z0}, {2, y0, z1}, {2, y1, z1}, {2, y1, z0}, 12 / (six ? 4 : 2), 12 / (six ? 4 : 2));
    });
    scene.object("dark");
    const double x = 2 + thickness;
    const bool cut_dark = six || cut == Cut::kOneAgainstSix;
    face(cut_dark ? 3 : 1, cut_dark ? 2 : 1, [&](double y0, double y1, double z0, double z1) {
      if (cut == Cut::kOtherDiagonal) {
        scene.quad({x, y1, z0}, {x, y1, z1}, {x, y0, z1}, {x, y0, z0}, 3, 3);
      } else {
        scene.quad({x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1}, 3, 3);
      }
    });
    all_meshes = 1 + half(scene, x, x + 2, 1);
    scene.point_light({1.1, 1.3, 0.9}, 100);
    text = scene.text();
  }

 private:
  /// Five walls without the one between.
  static std::uint32_t half(SceneText& scene, double a, double b, int side) {
    const int n = 4;
    scene.quad({a, 0, 0}, {b, 0, 0}, {b, 3, 0}, {a, 3, 0}, n, n);
    scene.quad({a, 0, 2}, {a, 3, 2}, {b, 3, 2}, {b, 0, 2}, n, n);
    scene.quad({a, 0, 0}, {a, 0, 2}, {b, 0, 2}, {b, 0, 0}, n, n);
    const std::uint32_t last = scene.quad({a, 3, 0}, {b, 3, 0}, {b, 3, 2}, {a, 3, 2}, n, n);
    if (side == 0) return scene.quad({a, 0, 0}, {a, 3, 0}, {a, 3, 2}, {a, 0, 2}, n, n);
    return std::max(last, scene.quad({b, 0, 0}, {b, 0, 2}, {b, 3, 2}, {b, 3, 0}, n, n));
  }
  template <class Put>
  static void face(int along_y, int along_z, Put put) {
    for (int i = 0; i < along_y; ++i) {
      for (int j = 0; j < along_z; ++j) {
        put(3.0 * i / along_y, 3.0 * (i + 1) / along_y, 2.0 * j / along_z, 2.0 * (j + 1) / along_z);
      }
    }
  }
};

}  // namespace

CaseResult thin_wall() {
  // The scene is 5.4 across: ten decades of its size, and nothing.
  Findings found;
  const std::vector<double> few{1e-5, 4e-6, 1e-6, 0},
      many{1e-3, 1e-4, 1e-5, 8e-6, 6e-6, 4e-6, 1e-6, 1e-7, 1e-9, 1e-11, 1e-13, 0};
  for (const Cut cut : {Cut::kOneAgainstSix, Cut::kAlike, Cut::kOtherDiagonal, Cut::kSixAgainstSix}) {
    for (const double angle : {0.0, 0.1, 1.0}) {
      const Map map = angle == 0 ? Map{} : turn({1, 2, 3}, angle);
      const TwoRooms thick(0.1, cut, map);
      const FullRun reference(thick.text);
      found.demand(reference.done(), "a solution");
      for (const double part : thorough() || angle == 0.1 ? many : few) {
        const TwoRooms thin(5.4 * part, cut, map);
        std::vector<std::uint64_t> bits;
        for (const FlagMode flags : {FlagMode::kAuto, FlagMode::kOff}) {
          if (flags == FlagMode::kOff && !thorough() && part != 4e-6) continue;
          Options options;
          options.flags = flags;
          const FullRun run(thin.text, options);
          found.demand(run.done() && run.sound(), "a solution");
          found.demand(run.sum(thin.lit_meshes, thin.all_meshes) == 0, say("a dark room exactly dark at %g", part));
          // Raised samples are in the boxes that blockers are looked for in.
          found.demand(flags == FlagMode::kAuto || run.bits() == bits, say("the same bits without flags at %g", part));
          bits = run.bits();
          double sum = 0, of_thick = 0;
          for (std::uint32_t m = 0; m < thin.lit_meshes; ++m) {
            sum += run.mean(m);
            of_thick += reference.mean(m);
            // Of every wall by itself, the thin one too.
            found.worst(relative(run.mean(m), reference.mean(m)));
            found.demand(relative(run.mean(m), reference.mean(m)) < 0.01,
                         say("the lit side within 1 %% at %g, mesh %u: %g", part, m, run.mean(m) / reference.mean(m)));
          }
          found.demand(relative(sum, of_thick) < 0.01, "the lit room within 1 %");
        }
      }
    }
  }
  return found.result(
      "largest change of a lit wall's mean E from a thick wall's, thickness 1e-3 of the scene to 0, four "
      "cuts, turned; the dark room is 0");
}

CaseResult close_plates() {
  Findings found;
  for (const char* counts : {"1 1", "8 8"}) {
    for (const double distance : {1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      const std::string d = number(distance), p = std::string(" patches ") + counts + " sub 1 1\n";
      Options options;
      options.scale_rows = false;
      AmbientScene scene(grey(0.5) + "object a\nquad white 0 0 0  1 0 0  1 1 0  0 1 0" + p +
                             "object b\nquad white 0 0 " + d + "  0 1 " + d + "  1 1 " + d + "  1 0 " + d + p,
                         options);
      const StoredMatrix stored(scene);
      for (const double f : stored.f) found.demand(f <= 1, say("F at most 1 at %g: %g", distance, f));
      const std::size_t half = stored.n / 2;
      double sum = 0;
      for (std::size_t i = 0; i < half; ++i) {
        for (std::size_t j = half; j < stored.n; ++j) sum += stored.form_factor(i, j) / static_cast<double>(half);
      }
      // Nearer than two lattice steps the plates are one, back to back, and see nothing of each other.
      if (distance < 4e-6) {
        found.demand(sum <= 1, "F at most 1 where the lattice ends");
        continue;
      }
      const double expected = near_plates(distance);
      found.worst(relative(sum, expected));
      found.demand(relative(sum, expected) < 0.01,
                   say("F within 1 %% of Howell's at %g x %s: %g", distance, counts, sum));
    }
  }
  return found.result("largest relative error of F of plates 1 to 1e-5 apart, against Howell C-11; F is never above 1");
}

CaseResult long_corridor() {
  Findings found;
  Options options = to_the_last_digits();
  AmbientScene scene(grey(0.8) + box_walls(1, 1, 1000, 1, 1, 100, "white"), options);
  scene.light([](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  const StoredMatrix stored(scene);
  found.demand(scene.solve().done(), "a solution");
  double least = 2;
  for (std::size_t i = 0; i < stored.n; ++i) {
    found.demand(stored.row_sum(i) >= 0.99 && stored.row_sum(i) <= 1 + 1e-12,
                 say("row sums in 0.99 to 1: %g", stored.row_sum(i)));
    least = std::fmin(least, stored.row_sum(i));
  }
  // Along each of the four long walls; to where it is as small as the solver's rounding.
  for (std::uint32_t m = 2; m < 6; ++m) {
    double last = 1e30;
    for (std::uint32_t k = 0; k < 100; ++k) {
      const Mesh& mesh = scene.loaded.scene.meshes[m];
      double lx = -1;
      for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
        const double z = scene.patches[mesh.first_patch + p].centre.z + scene.loaded.scene.origin.z;
        if (std::fabs(z - (10.0 * k + 5)) < 1) lx = scene.ambient.patch_lx[mesh.first_patch + p];
      }
      if (lx < 1e-9 * 1000) break;
      found.demand(lx < last, say("steady decay at %u of wall %u", k, m));
      found.worst(k + 1);
      last = lx;
    }
  }
  return found.result(
      say("patches along the corridor over which E falls steadily, to 1e-9 of its largest; row sums %.6f to 1", least));
}

}  // namespace shodo::hard
