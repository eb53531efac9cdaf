#include "ambient/gather.h"

#include <cmath>

#include "tests/ambient/gathered.h"

namespace shodo {
namespace {

/// Rows sum to 1 here by scaling, so single precision is all that is lost.
TEST(Gather, FurnaceGivesE0RhoOverOneMinusRhoOnEverySubPatch) {
  for (const double rho : {0.3, 0.8}) {
    Gathered box(grey(rho) + with_sub_patches(box_walls(4, 3, 2, 5, 4, 3, "white"), "3 2"), precise(),
                 [](const Vec3&, std::uint32_t) { return 100.0; });
    ASSERT_TRUE(box.gather().done());
    const double expected = 100 * rho / (1 - rho);
    for (const float lx : box.lx) EXPECT_NEAR(lx, expected, 1e-5 * expected);
  }
}

/// More blockers than lists have room for: those between a region and an object, and those of a group of sub-patches.
TEST(Gather, ListsThatAreTooLongChangeNoBit) {
  // A cloud of 48 x 48 small sheets, which neither send nor receive, in a room of six objects.
  std::string cloud = "object cloud\n";
  constexpr int kSide = 48;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double at = 0.2 + 1.6 * x / kSide, beside = 0.2 + 1.6 * y / kSide;
      const double high = 0.9 + 0.004 * ((7 * x + 3 * y) % 17);
      char line[200];
      std::snprintf(line, sizeof line, "quad white %g %g %g %g %g %g %g %g %g %g %g %g patches 1 1 sub 1 1\n", at,
                    beside, high, at + 0.02, beside, high, at + 0.02, beside + 0.02, high, at, beside + 0.02, high);
      cloud += line;
    }
  }
  Options options = precise();
  options.gather_error = 1e-2;
  const auto lit = [](const Vec3& p, std::uint32_t m) { return m == 0 ? 100 + 50 * p.x : 10.0; };
  const std::string room = grey(0.5) + with_sub_patches(box_walls(2, 2, 2, 4, 4, 4, "white"), "2 2");
  Gathered full(room + cloud, options, lit, [](const AmbientScene& scene, std::size_t patch) {
    return scene.loaded.scene.meshes[scene.patches[patch].mesh].patch_count() == 1;
  });
  ASSERT_TRUE(full.gather().done());
  const std::vector<float> with_lists = full.lx;
  full.start();
  ASSERT_TRUE(full.gather(FlagMode::kOff).done());
  EXPECT_EQ(full.lx, with_lists);
  // The cloud is there: less light arrives than without it.
  Gathered empty(room, options, lit);
  ASSERT_TRUE(empty.gather().done());
  EXPECT_LT(with_lists[5], 0.99 * empty.lx[5]);
}

/// The mean over the sub-patch of the mesh that is nearest to a place.
double value_at(const Gathered& g, std::uint32_t m, const Vec3& place) {
  const Scene& s = g.scene.loaded.scene;
  const Mesh& mesh = s.meshes[m];
  double best = 1e30, value = 0;
  for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
    const double apart = length_squared(sub_patch_piece(s, mesh, k).centre() + s.origin - place);
    if (apart >= best) continue;
    best = apart;
    value = static_cast<double>(g.lx[mesh.first_sub_patch + k]);
  }
  EXPECT_LT(best, 1e-4);
  return value;
}

/// CIE 171 5.6, the values of references.md: one reflection, an open room, so nothing may be scaled up to 1.
TEST(Gather, OneReflectionFromAFloorMatchesCie171Case56) {
  Gathered room(grey(0.5) + "material black diffuse 0\nobject floor_\n" +
                    patchy("white", {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0}, 8, 8) + "object wall\n" +
                    patchy("black", {0, 0, 0, 0, 0, 3, 4, 0, 3, 4, 0, 0}, 18, 9) + "object ceiling_\n" +
                    patchy("black", {0, 0, 3, 0, 4, 3, 4, 4, 3, 4, 0, 3}, 8, 9),
                precise(), [](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  ASSERT_TRUE(room.gather().done());
  const double z[] = {.75, 1.25, 1.75, 2.25, 2.75}, wall[] = {35.901, 27.992, 21.639, 16.716, 12.967};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(value_at(room, 1, {2, 0, z[k]}) / 5, wall[k], 0.01 * wall[k]) << z[k];
  const double y[] = {.25, .75, 1.25, 1.75}, ceiling[] = {26.795, 30.939, 33.976, 35.567};
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(value_at(room, 2, {2, y[k], 3}) / 5, ceiling[k], 0.01 * ceiling[k]) << y[k];
  }
}

/// A room with a table-like slab and a bright spot on the floor.
std::string furnished(double rho) {
  return grey(rho) + with_sub_patches(box_walls(4, 3, 2.5, 8, 6, 5, "white"), "2 2") + "object slab\n" +
         "quad white 1 1 0.8  2 1 0.8  2 2 0.8  1 2 0.8  patches 3 3 sub 1 1\n"
         "quad white 1 1 0.7  1 2 0.7  2 2 0.7  2 1 0.7  patches 3 3 sub 1 1\n"
         "quad white 1 1 0.7  2 1 0.7  2 1 0.8  1 1 0.8  patches 2 1 sub 1 1\n"
         "quad white 1 2 0.7  1 2 0.8  2 2 0.8  2 2 0.7  patches 1 2 sub 1 1\n"
         "quad white 1 1 0.7  1 1 0.8  1 2 0.8  1 2 0.7  patches 1 2 sub 1 1\n"
         "quad white 2 1 0.7  2 2 0.7  2 2 0.8  2 1 0.8  patches 2 1 sub 1 1\n";
}

double spot(const Vec3& p, std::uint32_t m) { return m == 0 && p.x > 2 && p.y < 1.6 ? 5000.0 : 50.0; }

/// By kernels from 3 x 3 places of a sub-patch to 8 x 8 places of each sub-patch, a segment each, everything in the
/// file's order.
double slowly_gathered(Gathered& g, std::uint32_t m, std::uint32_t local, Intersector& intersector) {
  const Scene& s = g.scene.loaded.scene;
  const Piece own = sub_patch_piece(s, s.meshes[m], local);
  const Vec3 normal = normalised(own.vector_area());
  double sum = 0;
  for (int a = 0; a < 9; ++a) {
    const Vec3 from = own.point((a % 3 + 0.5) / 3, (a / 3 + 0.5) / 3);
    const LatticePoint start = sample_point(s, g.scene.geometry, m, 0, from);
    for (std::uint32_t other = 0; other < s.meshes.size(); ++other) {
      const Mesh& mesh = s.meshes[other];
      for (std::uint32_t k = 0; other != m && k < mesh.sub_patch_count(); ++k) {
        const Piece piece = sub_patch_piece(s, mesh, k);
        const Vec3 area = (1.0 / 64) * piece.vector_area();
        const std::size_t at = mesh.first_sub_patch + k;
        const double sends = s.materials[mesh.material].diffuse.c[0] *
                             (static_cast<double>(g.direct[at]) + static_cast<double>(g.lx[at]));
        for (int b = 0; b < 64; ++b) {
          const Vec3 to = piece.point((b % 8 + 0.5) / 8, (b / 8 + 0.5) / 8), way = to - from;
          const double squared = length_squared(way), cosines = dot(normal, way) * -dot(area, way);
          if (!(dot(normal, way) > 0) || !(cosines > 0)) continue;
          if (intersector.blocked(start, sample_point(s, g.scene.geometry, other, 0, to),
                                  {0, 1, LightSet::kAmbient}, Aim{})) {
            continue;
          }
          sum += sends * cosines / (M_PI * squared * squared);
        }
      }
    }
  }
  return sum / 9;
}

/// 3 % where the slab's shadow and its edges are: two to four segments a node, and contact with the wall.
TEST(Gather, AgreesWithAGatherOverEverything) {
  Gathered room(furnished(0.6), precise(), spot);
  Gathered again(furnished(0.6), precise(), spot);
  ASSERT_TRUE(again.gather().done());
  Intersector off(room.scene.geometry);
  const Scene& s = room.scene.loaded.scene;
  double square = 0, count = 0, mean = 0, worst = 0;
  for (std::uint32_t m = 0; m < s.meshes.size(); ++m) {
    for (std::uint32_t k = 0; k < s.meshes[m].sub_patch_count(); k += 23) {
      const std::size_t at = s.meshes[m].first_sub_patch + k;
      const double slow = slowly_gathered(room, m, k, off), fast = static_cast<double>(again.lx[at]);
      square += (slow - fast) * (slow - fast);
      mean += slow + static_cast<double>(room.direct[at]);
      worst = std::max(worst, std::abs(slow - fast));
      ++count;
    }
  }
  mean /= count;
  RecordProperty("rms", std::to_string(std::sqrt(square / count) / mean));
  RecordProperty("worst", std::to_string(worst / mean));
  EXPECT_LT(std::sqrt(square / count), 0.02 * mean);
}

/// A floor under half of which a coloured pane hangs, against a sum over 128 x 128 places of the floor.
TEST(Gather, PanesWeakenWhatComesThroughThemByTheMeanOfTheirChannels) {
  const double passes[3] = {0.9, 0.5, 0.1}, mean = (0.9 + 0.5 + 0.1) / 3;
  const auto scene = [&](bool pane) {
    return grey(0.5) + "material black diffuse 0\nmaterial red diffuse 0 transmit 0.9 0.5 0.1\nobject floor_\n" +
           patchy("white", {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0}, 8, 8) + "object ceiling_\n" +
           patchy("black", {0, 0, 3, 0, 4, 3, 4, 4, 3, 4, 0, 3}, 8, 8) +
           (pane ? "object pane_\n" + patchy("red", {-1, -1, 1.3, 2.1, -1, 1.3, 2.1, 5, 1.3, -1, 5, 1.3}, 1, 1) : "");
  };
  const auto lit = [](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; };
  Gathered room(scene(true), precise(), lit), bare(scene(false), precise(), lit);
  const Scene& s = room.scene.loaded.scene;
  ASSERT_EQ(s.channels, 3u);
  ASSERT_EQ(s.optics_of(s.meshes[2].material)->transmit.c[2], passes[2]);
  ASSERT_TRUE(room.gather().done());
  ASSERT_TRUE(bare.gather().done());
  const Mesh& ceiling = s.meshes[1];
  double dimmest = 1, brightest = 0, square = 0;
  for (std::uint32_t k = 0; k < ceiling.sub_patch_count(); ++k) {
    const Vec3 at = sub_patch_piece(s, ceiling, k).centre() + s.origin;
    double expected = 0, in_the_open = 0;
    for (int i = 0; i < 128 * 128; ++i) {
      const double x = (i % 128 + 0.5) / 32, y = (i / 128 + 0.5) / 32, squared = length_squared(at - Vec3{x, y, 0});
      const double lx = 500 * (3.0 * 3.0) / (M_PI * squared * squared) / (32 * 32);
      const double crosses = x + (at.x - x) * 1.3 / 3;
      expected += lx * (crosses < 2.1 ? mean : 1);
      in_the_open += lx;
    }
    dimmest = std::min(dimmest, expected / in_the_open);
    brightest = std::max(brightest, expected / in_the_open);
    const double open = static_cast<double>(bare.lx[std::size_t{ceiling.first_sub_patch + k} * 3]);
    EXPECT_NEAR(open, in_the_open, 0.005 * in_the_open);
    for (std::uint32_t c = 0; c < 3; ++c) {
      // The pane's edge lies across a column of patches of the floor; two to four segments say what of each it hides.
      const double found = static_cast<double>(room.lx[std::size_t{ceiling.first_sub_patch + k} * 3 + c]);
      EXPECT_NEAR(found, expected, 0.03 * in_the_open) << k << ' ' << c;
      square += (found - expected) * (found - expected) / (in_the_open * in_the_open);
    }
  }
  EXPECT_LT(std::sqrt(square / (3 * ceiling.sub_patch_count())), 0.01);
  // The pane shows: sub-patches see little or most of the floor through it.
  EXPECT_LT(dimmest, 0.65);
  EXPECT_GT(brightest, 0.85);
}

TEST(Gather, KeepsTheEnergyOfTheSolution) {
  Gathered room(furnished(0.6), precise(), spot);
  std::vector<float> before = room.lx;
  ASSERT_TRUE(room.gather().done());
  const Scene& s = room.scene.loaded.scene;
  double gathered = 0, solved = 0;
  for (const Mesh& mesh : s.meshes) {
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const double area = length(sub_patch_piece(s, mesh, k).vector_area());
      gathered += area * static_cast<double>(room.lx[mesh.first_sub_patch + k]);
      solved += area * static_cast<double>(before[mesh.first_sub_patch + k]);
    }
  }
  EXPECT_NEAR(gathered, solved, 0.01 * solved);
}

TEST(Gather, FlagsOffAndAutoGiveTheSameBits) {
  Options coarse;
  coarse.gather_error = 5e-3;  // off tests every triangle
  Gathered off(furnished(0.6), coarse, spot), found(furnished(0.6), coarse, spot);
  ASSERT_TRUE(off.gather(FlagMode::kOff).done());
  ASSERT_TRUE(found.gather(FlagMode::kAuto).done());
  EXPECT_EQ(off.lx, found.lx);
}

TEST(Gather, BlackSurfacesReceiveAndHiddenSubPatchesKeepWhatTheyHave) {
  Gathered room(furnished(0.6) + "material black diffuse 0\nobject plate\nquad black 3 1 1.2  3.5 1 1.2  3.5 1.5 1.2  "
                                 "3 1.5 1.2 patches 1 1 sub 2 2\n",
                precise(), spot);
  const Mesh& plate = room.scene.loaded.scene.meshes.back();
  room.hidden[plate.first_sub_patch] = 1;
  room.lx[plate.first_sub_patch] = 7;
  ASSERT_TRUE(room.gather().done());
  EXPECT_EQ(room.lx[plate.first_sub_patch], 7);
  for (std::uint32_t k = 1; k < 4; ++k) EXPECT_GT(room.lx[plate.first_sub_patch + k], 100);
}

TEST(Gather, ThePapersRulesKeepThePapersInterpolation) {
  Options options;
  options.gather = true;
  EXPECT_TRUE(options.gathers());
  options.rules.blocks = true;
  EXPECT_TRUE(options.gathers());
  for (int rule = 0; rule < 4; ++rule) {
    Options with = options;
    with.rules = {.rule1 = rule == 0, .rule2 = rule == 1, .rule2_repeated = rule == 2, .rule3 = rule == 3};
    EXPECT_FALSE(with.gathers());
  }
}

}  // namespace
}  // namespace shodo
