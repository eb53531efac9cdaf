
#include <algorithm>
#include <cmath>

#include "ambient/ambient_memory.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

std::string patchy_quad(const std::string& material, std::initializer_list<double> c, int u, int v) {
  std::string line = "quad " + material;
  for (const double value : c) line += " " + std::to_string(value);
  return line + " patches " + std::to_string(u) + " " + std::to_string(v) + " sub 1 1\n";
}

/// Ambient illuminance at the patch of mesh `mesh` whose centre is nearest to `place` (the file's coordinates).
double ambient_at(const AmbientScene& scene, std::uint32_t mesh, const Vec3& place) {
  double best = 1e30, value = 0;
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    const double apart = length_squared(scene.patches[i].centre + scene.loaded.scene.origin - place);
    if (scene.patches[i].mesh != mesh || apart >= best) continue;
    best = apart;
    value = scene.ambient.patch_lx[i];
  }
  EXPECT_LT(best, 0.01 * 0.01);  // the places are centres of patches
  return value;
}

/// CIE 171 5.6: a 4 x 4 m floor evenly lit; open room, so that no row may be scaled.
TEST(AmbientLight, OneReflectionFromAFloorMatchesCie171Case56) {
  const std::string text = grey(0.5) + "material black diffuse 0\n" + "object floor_\n" +
                           patchy_quad("white", {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0}, 8, 8) + "object wall\n" +
                           patchy_quad("black", {0, 0, 0, 0, 0, 3, 4, 0, 3, 4, 0, 0}, 18, 9) + "object ceiling_\n" +
                           patchy_quad("black", {0, 0, 3, 0, 4, 3, 4, 4, 3, 4, 0, 3}, 8, 9);
  AmbientScene scene(text);
  scene.light([](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  ASSERT_TRUE(scene.solve().done());
  EXPECT_EQ(scene.statistics.rows_scaled, 0u);
  const double z[] = {.75, 1.25, 1.75, 2.25, 2.75}, wall[] = {35.901, 27.992, 21.639, 16.716, 12.967};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(ambient_at(scene, 1, {2, 0, z[k]}) / 5, wall[k], 0.01 * wall[k]) << z[k];
  const double y[] = {.25, .75, 1.25, 1.75}, ceiling[] = {26.795, 30.939, 33.976, 35.567};
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(ambient_at(scene, 2, {2, y[k], 3}) / 5, ceiling[k], 0.01 * ceiling[k]) << y[k];
  }
}

/// CIE 171 5.7 with the values of references.md: a wall evenly lit, a black box in between.
TEST(AmbientLight, AnObstructionMatchesCie171Case57) {
  std::string text = grey(0.5) + "material black diffuse 0\n";
  text += "object lit\n" + patchy_quad("white", {0, 4, 0, 4, 4, 0, 4, 4, 3, 0, 4, 3}, 16, 24);
  text += "object wall\n" + patchy_quad("black", {0, 0, 0, 0, 0, 3, 4, 0, 3, 4, 0, 0}, 18, 17);
  // At y = 1.75 the last of the wall goes out of sight: a strip begins there.
  text += "object floor_\n" + patchy_quad("black", {0, 0, 0, 4, 0, 0, 4, 1.7, 0, 0, 1.7, 0}, 17, 17) +
          patchy_quad("black", {0, 1.7, 0, 4, 1.7, 0, 4, 1.75, 0, 0, 1.75, 0}, 17, 1) +
          patchy_quad("black", {0, 1.75, 0, 4, 1.75, 0, 4, 1.76, 0, 0, 1.76, 0}, 17, 1) +
          patchy_quad("black", {0, 1.76, 0, 4, 1.76, 0, 4, 2.5, 0, 0, 2.5, 0}, 17, 3);
  text += "object box\n" + patchy_quad("black", {0, 2.5, 0, 4, 2.5, 0, 4, 2.5, 1, 0, 2.5, 1}, 1, 1) +
          patchy_quad("black", {0, 2.7, 0, 0, 2.7, 1, 4, 2.7, 1, 4, 2.7, 0}, 1, 1) +
          patchy_quad("black", {0, 2.5, 1, 4, 2.5, 1, 4, 2.7, 1, 0, 2.7, 1}, 1, 1);
  AmbientScene scene(text);
  scene.light([](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  ASSERT_TRUE(scene.solve().done());
  const double z[] = {2.75, 2.25, 1.75, 1.25, .75, .25}, wall[] = {16.071, 16.330, 15.399, 13.322, 10.317, 7.079};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(ambient_at(scene, 1, {2, 0, z[k]}) / 5, wall[k], 0.02 * wall[k]) << z[k];
  const double y[] = {.25, .75, 1.25}, floor[] = {3.382, 3.629, 3.013};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(ambient_at(scene, 2, {2, y[k], 0}) / 5, floor[k], 0.02 * floor[k]) << y[k];
  EXPECT_EQ(ambient_at(scene, 4, {2, 1.755, 0}), 0);
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    if (scene.patches[i].mesh != 5) continue;
    EXPECT_EQ(scene.ambient.patch_lx[i], 0);
  }
}

/// CIE 171 5.8: direct light of the isotropic source in closed form, as a mean over each patch.
double isotropic_mean(const Vec3& centre, double side) {
  double sum = 0;
  constexpr int kDivisions = 20;
  for (int k = 0; k < kDivisions * kDivisions; ++k) {
    const double u = ((k % kDivisions + 0.5) / kDivisions - 0.5) * side;
    const double v = ((k / kDivisions + 0.5) / kDivisions - 0.5) * side;
    Vec3 p = centre;
    const bool along_x = std::abs(std::abs(p.x) - 2) < 1e-9, along_y = std::abs(std::abs(p.y) - 2) < 1e-9;
    (along_x ? p.y : p.x) += u;
    (along_x || along_y ? p.z : p.y) += v;
    const double squared = length_squared(p);
    sum += 10000 / (4 * M_PI) * 2 / (squared * std::sqrt(squared));
  }
  return sum / (kDivisions * kDivisions);
}

TEST(AmbientLight, InterreflectionInACubeHasTheMeanOfCie171Case58AtEveryReflectance) {
  const double rho[] = {.1, .3, .5, .7, .8, .9, .95};
  const double expected[] = {11.57, 44.64, 104.17, 243.06, 416.67, 937.50, 1979.17};
  for (int k = 0; k < 7; ++k) {
    AmbientScene scene(grey(rho[k]) + box_walls(4, 4, 4, 6, 6, 6, "white"));
    scene.light([](const Vec3& p, std::uint32_t) { return isotropic_mean(p - Vec3{2, 2, 2}, 4.0 / 6); });
    ASSERT_TRUE(scene.solve().done());
    EXPECT_NEAR(scene.mean(true), expected[k], 0.002 * expected[k]) << rho[k];
  }
}

/// The last row of references.md, and why rows are scaled.
TEST(AmbientLight, ScalingRowsBothWaysTakesTheErrorOfThatCubeFromPerMilleToNothing) {
  for (const bool scaled : {false, true}) {
    Options options;
    options.tiers = 0.01;
    options.scale_rows = scaled;
    options.tolerance = 1e-8;
    AmbientScene scene(grey(0.95) + box_walls(4, 4, 4, 6, 6, 6, "white"), options);
    scene.light([](const Vec3& p, std::uint32_t) { return isotropic_mean(p - Vec3{2, 2, 2}, 4.0 / 6); });
    ASSERT_TRUE(scene.solve().done());
    const double error = scene.mean(true) / (10000 * 0.95 / (96 * 0.05)) - 1;
    RecordProperty(scaled ? "scaled" : "unscaled", std::to_string(error));
    EXPECT_LT(std::abs(error), scaled ? 1e-4 : 1e-2);
  }
}

TEST(AmbientLight, LongCorridorsKeepTheirRowSumsAndDarkenSteadily) {
  Options options;
  options.scale_rows = false;
  AmbientScene scene(grey(0.8) + box_walls(1, 1, 1000, 1, 1, 100, "white"), options);
  scene.light([](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  const StoredMatrix stored(scene);
  for (std::size_t i = 0; i < stored.n; ++i) {
    EXPECT_GE(stored.row_sum(i), 0.99);
    EXPECT_LE(stored.row_sum(i), 1.01);
  }
  ASSERT_TRUE(scene.solve().done());
  double last = 1e30;
  for (std::uint32_t k = 0; k < 100; ++k) {
    // Wall y = 0 has its patches in the order of z.
    const double lx = scene.ambient.patch_lx[scene.loaded.scene.meshes[2].first_patch + k];
    if (lx < 1e-4 * 1000) break;  // below the solver's tolerance
    EXPECT_LT(lx, last);
    last = lx;
  }
}

TEST(AmbientLight, ClosedBoxesExchangeExactlyNothing) {
  // One inside the other, walls apart: light in the inner one stays there.
  std::string inner;
  for (const char* corners : {"1 1 1  2 1 1  2 2 1  1 2 1", "1 1 2  1 2 2  2 2 2  2 1 2",
                              "1 1 1  1 1 2  2 1 2  2 1 1", "1 2 1  2 2 1  2 2 2  1 2 2",
                              "1 1 1  1 2 1  1 2 2  1 1 2", "2 1 1  2 1 2  2 2 2  2 2 1"}) {
    inner += std::string("quad white ") + corners + " patches 2 2 sub 1 1\n";
  }
  AmbientScene scene(grey(0.9) + box_walls(7, 3, 3, 2, 2, 2, "white") + "object inner\n" + inner);
  scene.light([](const Vec3&, std::uint32_t m) { return m == 6 ? 1000.0 : 0; });
  ASSERT_TRUE(scene.solve().done());
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    if (scene.patches[i].mesh < 6) {
      EXPECT_EQ(scene.ambient.patch_lx[i], 0) << i;
    } else {
      EXPECT_GT(scene.ambient.patch_lx[i], 100);
    }
  }
}

const char* const kTable =
    "object table\nquad white 1 1 0.7 1 2 0.7 3 2 0.7 3 1 0.7 patches 2 2 sub 1 1\n"
    "quad white 1 1 0.75 3 1 0.75 3 2 0.75 1 2 0.75 patches 2 3 sub 1 1\n";

double e0_of(const Vec3& p, std::uint32_t) { return p.z < 0.01 ? 100 * (1 + p.x + p.y * p.y) : 0; }

TEST(AmbientLight, RowsComputedAgainGiveTheBitsOfRowsKept) {
  for (const std::uint32_t bits : {16u, 64u}) {
    Options options;
    options.row_value_bits = bits;
    const std::string text = grey(0.7) + box_walls(4, 3, 2.5, 4, 3, 3, "white") + kTable;
    expect_same_bits_in_any_memory(text, options, e0_of, {0, 2000, 4000},
                                   [](const AmbientScene& tight, const Arena& arena, std::uint64_t more) {
                                     EXPECT_EQ(tight.statistics.rows_kept == 0, more == 0);
                                     EXPECT_EQ(arena.used(), ambient_result_bytes(tight.loaded.scene));
                                   });
  }
}

/// The walls and the table as objects in another order, without changing any.
std::string objects_reversed(const std::string& text) {
  std::vector<std::string> objects;
  for (std::size_t at = text.find("object "); at != std::string::npos;) {
    const std::size_t next = text.find("object ", at + 1);
    objects.push_back(text.substr(at, next == std::string::npos ? next : next - at));
    at = next;
  }
  std::string reversed;
  for (auto object = objects.rbegin(); object != objects.rend(); ++object) reversed += *object;
  return reversed;
}

/// By place: centre and normal, since patches are numbered otherwise.
double same_place(const AmbientScene& from, std::size_t i, const AmbientScene& to) {
  for (std::size_t k = 0; k < to.patches.size(); ++k) {
    if (length_squared(from.patches[i].centre - to.patches[k].centre) < 1e-18 &&
        dot(from.patches[i].normal, to.patches[k].normal) > 0.9) {
      return to.ambient.patch_lx[k];
    }
  }
  ADD_FAILURE() << "no such patch";
  return 0;
}

TEST(AmbientLight, TheOrderOfObjectsChangesNoBit) {
  const std::string objects = box_walls(4, 3, 2.5, 4, 3, 3, "white") + kTable;
  AmbientScene one(grey(0.7) + objects), other(grey(0.7) + objects_reversed(objects));
  one.light(e0_of);
  other.light(e0_of);
  ASSERT_TRUE(one.solve().done());
  ASSERT_TRUE(other.solve().done());
  for (std::size_t i = 0; i < one.patches.size(); ++i) {
    EXPECT_EQ(one.ambient.patch_lx[i], same_place(one, i, other)) << i;
  }
}

TEST(AmbientLight, MirroredScenesAndTurnedVerticesGiveTheSameLightButForRounding) {
  // Mirrored about x = 0: the vertices run the other way round, and the sums in another order. The solver must be
  // as exact as the comparison, and values must not be rounded to 16 bits.
  Options options;
  options.tolerance = 1e-13;
  options.row_value_bits = 64;
  const auto room = [](double sign, bool turned) {
    const auto quad = [&](std::vector<std::array<double, 3>> c, const char* name) {
      if (sign < 0) std::reverse(c.begin(), c.end());
      if (turned) std::rotate(c.begin(), c.begin() + 2, c.end());
      std::string line = std::string("object ") + name + "\nquad white";
      for (const auto& p : c) {
        for (int k = 0; k < 3; ++k) line += " " + std::to_string(k == 0 ? sign * p[0] : p[static_cast<std::size_t>(k)]);
      }
      return line + " patches 4 4 sub 1 1\n";
    };
    return grey(0.6) + quad({{-1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {-1, 2, 0}}, "floor_") +
           quad({{-1, 0, 2}, {-1, 2, 2}, {2, 2, 2}, {2, 0, 2}}, "ceiling_") +
           quad({{-1, 0, 0}, {-1, 2, 0}, {-1, 2, 2}, {-1, 0, 2}}, "wall") +
           quad({{0, 0.5, 1}, {1, 0.5, 1.25}, {1, 1.5, 1.25}, {0, 1.5, 1}}, "screen");
  };
  AmbientScene one(room(1, false), options), mirrored(room(-1, false), options), turned(room(1, true), options);
  for (AmbientScene* scene : {&one, &mirrored, &turned}) {
    scene->light([](const Vec3& p, std::uint32_t) { return p.z < 0.01 ? 100 + 10 * p.y : 0; });
    ASSERT_TRUE(scene->solve().done());
  }
  for (std::size_t i = 0; i < one.patches.size(); ++i) {
    EXPECT_NEAR(same_place(one, i, turned), one.ambient.patch_lx[i], 1e-11) << i;
    double best = 1e30;
    for (std::size_t k = 0; k < mirrored.patches.size(); ++k) {
      const Vec3 c = mirrored.patches[k].centre, d = one.patches[i].centre;
      if (length_squared(Vec3{-c.x, c.y, c.z} - d) > 1e-18 ||
          dot(Vec3{-mirrored.patches[k].normal.x, mirrored.patches[k].normal.y, mirrored.patches[k].normal.z},
              one.patches[i].normal) < 0.9) {
        continue;
      }
      best = mirrored.ambient.patch_lx[k];
    }
    EXPECT_NEAR(best, one.ambient.patch_lx[i], 1e-11) << i;
  }
}

TEST(AmbientLight, HiddenAndDroppedPatchesNeitherSendNorReceive) {
  AmbientScene scene(grey(0.5) + box_walls(1, 1, 1, 2, 2, 2, "white"));
  scene.light([](const Vec3&, std::uint32_t) { return 100.0; });
  scene.visible[3] = 0;
  scene.patches[5].dropped = 1;
  ASSERT_TRUE(scene.solve().done());
  EXPECT_EQ(scene.ambient.patch_lx[3], 0);
  EXPECT_EQ(scene.ambient.patch_lx[5], 0);
  const StoredMatrix stored(scene);
  for (std::size_t j = 0; j < stored.n; ++j) {
    for (const std::size_t gone : {std::size_t{3}, std::size_t{5}}) {
      EXPECT_EQ(stored.form_factor(gone, j), 0);
      EXPECT_EQ(stored.form_factor(j, gone), 0);
    }
  }
}

TEST(AmbientLight, RowsLeaveRoomForAreaLights) {
  AmbientScene scene(grey(0.5) + box_walls(1, 1, 1, 2, 2, 2, "white"));
  scene.lights[0] = 0.25f;  // direct light says so; the walls alone fill the whole hemisphere
  scene.lights[1] = 1.0f;
  const StoredMatrix stored(scene);
  EXPECT_NEAR(stored.row_sum(0), 0.75, 1e-12);
  EXPECT_LT(stored.row_sum(1), 1e-5);
  EXPECT_NEAR(stored.row_sum(2), 1, 1e-12);
}

TEST(AmbientLight, RowsShortByLessThanAnAreaLightsErrorAreScaledUp) {
  // A box without a ceiling, in its place an area light whose form factors come out a hundredth too small: the walls'
  // rows make up for it. That is well within what direct light may be wrong by, 1/64, and beyond all other errors.
  const std::string whole = box_walls(1, 1, 1, 1, 1, 1, "white");
  const std::size_t ceiling = whole.find("object ceiling_"), next = whole.find("object wall_y0");
  const std::string open = grey(0.5) + whole.substr(0, ceiling) + whole.substr(next);
  Options options;
  options.tiers = 0;
  options.row_value_bits = 64;
  options.scale_rows = false;
  AmbientScene unscaled(open, options);
  const StoredMatrix stored(unscaled);
  options.scale_rows = true;
  AmbientScene scene(open, options);
  for (std::size_t i = 0; i < stored.n; ++i) {
    scene.lights[i] = static_cast<float>(0.99 * (1 - stored.row_sum(i)));
  }
  const StoredMatrix scaled(scene);
  EXPECT_EQ(scene.statistics.rows_scaled, stored.n);
  for (std::size_t i = 0; i < stored.n; ++i) {
    EXPECT_NEAR(scaled.row_sum(i), 1 - static_cast<double>(scene.lights[i]), 1e-12) << i;
  }
}

TEST(AmbientLight, NothingToLightIsFine) {
  const Scene empty;
  const Geometry geometry;
  Intersector intersector(geometry);
  std::uint64_t memory[300];  // for the stage's own structures
  Arena arena(memory, sizeof memory);
  AmbientLight ambient;
  Statistics statistics;
  ASSERT_TRUE(light_ambiently(empty, geometry, {}, {}, intersector, {}, {}, arena, ambient, statistics).done());
  EXPECT_LE(smallest_ambient_bytes(empty, geometry, {}), sizeof memory);
  EXPECT_EQ(statistics.sweeps, 0u);
  AmbientScene one(grey(0.9) + "object o\nquad white 0 0 0 1 0 0 1 1 0 0 1 0 patches 1 1 sub 1 1\n");
  one.light([](const Vec3&, std::uint32_t) { return 7.0; });
  ASSERT_TRUE(one.solve().done());
  EXPECT_EQ(one.ambient.patch_lx[0], 0);
}

TEST(AmbientLight, ProgressCanStopBothStages) {
  AmbientScene scene(grey(0.9) + box_walls(1, 1, 1, 2, 2, 2, "white"));
  scene.light([](const Vec3&, std::uint32_t) { return 7.0; });
  for (const Stage stage : {Stage::kFormFactors, Stage::kSolution}) {
    Stage stop = stage;
    Progress progress;
    progress.context = &stop;
    progress.report = [](void* context, Stage at, std::uint64_t, std::uint64_t) {
      return at != *static_cast<Stage*>(context);
    };
    EXPECT_EQ(scene.solve_in(scene.loaded.arena, progress).code, StatusCode::kInterrupted);
  }
}

}  // namespace
}  // namespace shodo
