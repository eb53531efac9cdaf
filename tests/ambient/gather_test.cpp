// What sub-patches gather: the mean over lines, whole rooms of it.
#include "ambient/gather.h"
#include "ambient/sent_light.h"

#include <cmath>

#include "tests/ambient/gathered.h"

namespace shodo {
namespace {


/// Every line brings the same value: what is lost is the last of the 12 digits of what is sent (ambient/sent_light.h),
/// and that again of what was gathered before.
TEST(Gather, FurnaceGivesE0RhoOverOneMinusRhoOnEverySubPatch) {
  for (const double rho : {0.3, 0.8}) {
    Gathered box(grey(rho) + with_sub_patches(box_walls(4, 3, 2, 5, 4, 3, "white"), "3 2"), 64,
                 [](const Vec3&, std::uint32_t) { return 100.0; });
    ASSERT_TRUE(box.gather().done());
    const double expected = 100 * rho / (1 - rho);
    for (const float lx : box.lx) EXPECT_NEAR(lx, expected, 0x1p-12 * expected / (1 - rho));
  }
}

/// CIE 171 5.6, the values of references.md: one reflection, an open room. Around each point of the table the mean over
/// squares of 20 cm, which differs from the point's value by less than 0.02; 25 sub-patches of 4 cm have 1e5 lines
/// there, whose error is some N^-0.5 of a hemisphere of floor, 100 here.
TEST(Gather, OneReflectionFromAFloorMatchesCie171Case56) {
  const double z[] = {.75, 1.25, 1.75, 2.25, 2.75}, wall[] = {35.901, 27.992, 21.639, 16.716, 12.967};
  const double y[] = {.25, .75, 1.25, 1.75}, ceiling[] = {26.795, 30.939, 33.976, 35.567};
  const std::string text = black_and_white() + "object floor_\n" + facing("+z", "white", {0, 0, 0}, {4, 4, 0}) +
                           "object wall\n" + facing("+y", "black", {1.9, 0, 0}, {2.1, 0, 3}, "patches 75 5 sub 1 1") +
                           "object ceiling_\n" +
                           facing("-z", "black", {1.9, 0, 3}, {2.1, 4, 3}, "patches 100 5 sub 1 1");
  Gathered room(text, 65536, [](const Vec3&, std::uint32_t m) { return m == 0 ? 1000.0 : 0; });
  ASSERT_TRUE(room.gather().done());
  const auto around = [&](std::uint32_t m, const Vec3& at) {
    const Scene& s = room.scene.loaded.scene;
    double sum = 0;
    int count = 0;
    for (std::uint32_t k = 0; k < s.meshes[m].sub_patch_count(); ++k) {
      const Vec3 off = sub_patch_piece(s, s.meshes[m], k).centre() + s.origin - at;
      if (magnitude(off.y) + magnitude(off.z) > 0.1) continue;
      sum += room.gathered(m, k);
      ++count;
    }
    EXPECT_EQ(count, 25);
    return sum / count;
  };
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(around(1, {2, 0, z[k]}) / 5, wall[k], 0.3) << z[k];
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(around(2, {2, y[k], 3}) / 5, ceiling[k], 0.3) << y[k];
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

/// What a point gets from a piece, of what the piece sends: its 8 x 8 places by kernels, a segment each. Where all of
/// it stands in front, they say what part of the contour integral is seen, so that nothing is lost close by.
double slow_factor(const Gathered& g, const Vec3& from, const Vec3& normal, const LatticePoint& start,
                   std::uint32_t other, const Piece& piece, Intersector& intersector) {
  const Vec3 area = (1.0 / 64) * piece.vector_area();
  bool in_front = true;
  for (const Vec3& corner : piece.corner) in_front = in_front && dot(normal, corner - from) > -1e-9;
  double all = 0, seen = 0;
  for (int b = 0; b < 64; ++b) {
    const Vec3 to = piece.point((b % 8 + 0.5) / 8, (b / 8 + 0.5) / 8), way = to - from;
    const double squared = length_squared(way), cosines = dot(normal, way) * -dot(area, way);
    if (!(dot(normal, way) > 0) || !(cosines > 0)) continue;
    const double part = cosines / (M_PI * squared * squared);
    all += part;
    const LatticePoint end = sample_point(g.scene.loaded.scene, g.scene.geometry, other, 0, to);
    if (!intersector.blocked(start, end, {0, 1, LightSet::kAmbient}, Aim{})) seen += part;
  }
  return all > 0 && in_front ? seen / all * filled(from, normal, piece) : seen;
}

/// From 4 x 4 places of a sub-patch, of what all others send when they have gathered.
double slowly_gathered(const Gathered& after, std::uint32_t m, std::uint32_t local, Intersector& intersector) {
  const Scene& s = after.scene.loaded.scene;
  const Piece own = sub_patch_piece(s, s.meshes[m], local);
  const Vec3 normal = normalised(own.vector_area());
  double sum = 0;
  for (int a = 0; a < 16; ++a) {
    const Vec3 from = own.point((a % 4 + 0.5) / 4, (a / 4 + 0.5) / 4);
    const LatticePoint start = sample_point(s, after.scene.geometry, m, 0, from);
    for (std::uint32_t other = 0; other < s.meshes.size(); ++other) {
      const Mesh& mesh = s.meshes[other];
      for (std::uint32_t k = 0; other != m && k < mesh.sub_patch_count(); ++k) {
        const double sends = s.materials[mesh.material].diffuse.c[0] *
                             (static_cast<double>(after.direct[mesh.first_sub_patch + k]) + after.gathered(other, k));
        const Piece piece = sub_patch_piece(s, mesh, k);
        sum += sends * slow_factor(after, from, normal, start, other, piece, intersector);
      }
    }
  }
  return sum / 16;
}

/// Root mean square, of the mean illuminance; 16384 lines leave 0.004 (measured).
TEST(Gather, AgreesWithAGatherOverEverything) {
  Gathered room(furnished(0.6), 16384, spot);
  ASSERT_TRUE(room.gather().done());
  Intersector off(room.scene.geometry);
  const Scene& s = room.scene.loaded.scene;
  double square = 0, count = 0, mean = 0;
  for (std::uint32_t m = 0; m < s.meshes.size(); ++m) {
    for (std::uint32_t k = 0; k < s.meshes[m].sub_patch_count(); k += 47, ++count) {
      const double slow = slowly_gathered(room, m, k, off), fast = room.gathered(m, k);
      square += (slow - fast) * (slow - fast);
      mean += slow + static_cast<double>(room.direct[s.meshes[m].first_sub_patch + k]);
    }
  }
  mean /= count;
  EXPECT_LT(std::sqrt(square / count), 0.006 * mean);
}

/// Of all sub-patches of black walls and a black ceiling over a floor with a bright spot, against contour integrals:
/// root mean square, of the mean. Four times the lines leave half of it (N^-0.5; 0.6 is allowed), and at 16384
/// nothing stays that they can't remove (measured: 0.145, 0.079, 0.035, 0.018).
TEST(Gather, TheErrorFallsAsLinesGrow) {
  std::string text = black_and_white() + with_sub_patches(box_walls(4, 3, 2.5, 8, 6, 5, "black"), "2 2");
  text.replace(text.find("quad black"), 10, "quad white");
  text.replace(text.find("sub 2 2"), 7, "sub 1 1");
  std::vector<double> expected;
  double last = 1, mean = 0;
  for (const std::uint32_t lines : {256u, 1024u, 4096u, 16384u}) {
    Gathered room(text, lines, spot);
    ASSERT_TRUE(room.gather().done());
    const Scene& s = room.scene.loaded.scene;
    const Unhidden unhidden(room);
    double square = 0;
    std::size_t at = 0;
    for (std::uint32_t m = 1; m < s.meshes.size(); ++m) {
      for (std::uint32_t k = 0; k < s.meshes[m].sub_patch_count(); ++k, ++at) {
        if (last == 1) expected.push_back(unhidden(m, k));
        square += (room.gathered(m, k) - expected[at]) * (room.gathered(m, k) - expected[at]);
      }
    }
    if (last == 1) {
      for (const double lx : expected) mean += lx / static_cast<double>(expected.size());
    }
    const double error = std::sqrt(square / static_cast<double>(at)) / mean;
    EXPECT_LT(error, 0.6 * last) << lines;
    last = error;
  }
  EXPECT_LT(last, 0.02);
}

/// 16384 lines leave 0.2 % (measured).
TEST(Gather, KeepsTheEnergyOfTheSolution) {
  Gathered room(furnished(0.6), 16384, spot);
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
  EXPECT_NEAR(gathered, solved, 0.004 * solved);
}

/// A black floor of 5 x 5 patches a metre under one of 6 x 6 that are bright by turns.
Gathered under_tiles(std::uint32_t lines, const std::string& counts = "patches 5 5 sub 1 1") {
  return Gathered(black_and_white() + "object floor_\n" + facing("+z", "black", {0, 0, 0}, {3, 3, 0}, counts) +
                      "object tiles\n" + facing("-z", "white", {0, 0, 1}, {3, 3, 1}, "patches 6 6 sub 1 1"),
                  lines, [](const Vec3& p, std::uint32_t m) {
                    return m == 1 && (static_cast<int>(2 * p.x) + static_cast<int>(2 * p.y)) % 2 == 0 ? 2000.0 : 0;
                  });
}

/// What is brighter than a float counts as the largest.
TEST(Gather, LightAsLargeAsFloatsGoStaysANumber) {
  Gathered room(grey(0.99) + box_walls(4, 3, 2.5, 2, 2, 2, "white"), 64,
                [](const Vec3&, std::uint32_t m) { return m == 0 ? 3e38 : 0; });
  for (float& lx : room.lx) lx = std::min(lx, 3e38f);
  ASSERT_TRUE(room.gather().done());
  float most = 0;
  for (const float lx : room.lx) {
    EXPECT_TRUE(std::isfinite(lx));
    most = std::max(most, lx);
  }
  EXPECT_GT(most, 1e37f);
}

TEST(Gather, ZeroLinesAreTheDefault) {
  Gathered none = under_tiles(0), same = under_tiles(kGatherLines), other = under_tiles(kGatherLines - 1);
  const std::uint64_t before = none.scene.statistics.segments_ambient;
  for (Gathered* each : {&none, &same, &other}) ASSERT_TRUE(each->gather().done());
  EXPECT_EQ(none.lx, same.lx);
  EXPECT_NE(none.lx, other.lx);
  // On average, but for what borders do.
  const std::uint64_t asked = kGatherLines * std::uint64_t{25 + 36};
  const std::uint64_t lines = none.scene.statistics.segments_ambient - before;
  EXPECT_NEAR(static_cast<double>(lines), static_cast<double>(asked), 0.01 * static_cast<double>(asked));
}

TEST(Gather, FlagsOffAndAutoGiveTheSameBits) {
  const std::string more =
      "material glass diffuse 0.1 transmit 0.7\nobject more\n"
      "tri white 2.5 2 0.5  3 2.5 1  2.7 2.9 0.2 patches 2 sub 2\n"
      "grid white 3 2  0.2 0.2 0.5  0.5 0.2 0.7  0.9 0.2 0.5  0.2 0.6 0.5  0.5 0.7 0.7  0.9 0.6 0.6\n"
      "quad glass 3 0.2 0.1  3 2.8 0.1  3 2.8 2.4  3 0.2 2.4  patches 2 2 sub 1 1\n"
      "quad white 3.2 1 0.3  3.9 1.3 0.5  3.3 1.2 1  3.1 2 1.6  patches 2 2 sub 2 2\n"
      "light panel area  quad 1.5 1.5 2.4  1.5 2 2.4  2 2 2.4  2 1.5 2.4  luminance 100\n";
  Gathered off(furnished(0.6) + more, 32, spot), found(furnished(0.6) + more, 32, spot);
  ASSERT_TRUE(off.gather(FlagMode::kOff).done());
  ASSERT_TRUE(found.gather(FlagMode::kAuto).done());
  EXPECT_EQ(off.lx, found.lx);
  EXPECT_EQ(off.scene.statistics.segments_ambient, found.scene.statistics.segments_ambient);
}

TEST(Gather, BlackSurfacesReceiveAndHiddenSubPatchesKeepWhatTheyHave) {
  Gathered room(furnished(0.6) + "material black diffuse 0\nobject plate\nquad black 3 1 1.2  3.5 1 1.2  3.5 1.5 1.2  "
                                 "3 1.5 1.2 patches 2 1 sub 2 2\n",
                64, spot);
  const Mesh& plate = room.scene.loaded.scene.meshes.back();
  room.hidden[plate.first_sub_patch] = 1;
  room.scene.visible[plate.first_patch + 1] = 0;
  for (const std::uint32_t k : {0, 2, 3, 6, 7}) room.lx[plate.first_sub_patch + k] = 7;
  ASSERT_TRUE(room.gather().done());
  for (const std::uint32_t k : {0, 2, 3, 6, 7}) EXPECT_EQ(room.lx[plate.first_sub_patch + k], 7) << k;
  for (const std::uint32_t k : {1, 4, 5}) EXPECT_GT(room.lx[plate.first_sub_patch + k], 100) << k;
}

/// A sheet beside a floor, between it and a part of the ceiling: what it shows, a lit back, or the front or the back of
/// an area light, is as good as black. The floor has 5e4
/// lines, which leave 1e-3 of a lit hemisphere, 500; three times that is allowed.
TEST(Gather, BacksAndLightsAreMetAndSendNothing) {
  const auto lit_by = [](const std::string& sheet) {
    Gathered floor(black_and_white() + "object floor_\n" + facing("+z", "black", {0, 0, 0}, {2, 2, 0}) +
                       "object ceiling_\n" +
                       facing("-z", "white", {-10, -10, 2}, {12, 12, 2}, "patches 20 20 sub 1 1") + sheet,
                   16384, [](const Vec3&, std::uint32_t m) { return m > 0 ? 1000.0 : 0; });
    std::fill(floor.lx.begin(), floor.lx.end(), 0.0f);  // a white sheet lights the ceiling
    EXPECT_TRUE(floor.gather().done());
    return floor.gathered(0, 0);
  };
  const double open = lit_by(""), black = lit_by("object o\n" + facing("-x", "black", {2.5, -9, -1}, {2.5, 9, 1.9}));
  EXPECT_LT(black, 0.85 * open);
  EXPECT_NEAR(lit_by("object o\n" + facing("+x", "white", {2.5, -9, -1}, {2.5, 9, 1.9})), black, 1.4);
  const std::string light = "light l area quad 2.5 -9 -1  ", rest = "2.5 9 1.9  ", end = "luminance 500\n";
  EXPECT_NEAR(lit_by(light + "2.5 9 -1  " + rest + "2.5 -9 1.9  " + end), black, 1.4);
  EXPECT_NEAR(lit_by(light + "2.5 -9 1.9  " + rest + "2.5 9 -1  " + end), black, 1.4);
}

/// Lines lie as close as meshes need them, but a light that is far larger isn't swept by as many.
TEST(Gather, ALightFarLargerThanTheMeshesDoesntTakeAllLines) {
  Gathered small(black_and_white() + "object floor_\n" +
                     facing("+z", "white", {0, 0, 0}, {0.1, 0.1, 0}, "patches 4 4 sub 1 1") + "object over\n" +
                     facing("-z", "white", {0, 0, 0.1}, {0.1, 0.1, 0.1}, "patches 4 4 sub 1 1") +
                     "light sky area quad -9 -9 5  -9 9 5  9 9 5  9 -9 5  luminance 100\n",
                 64, [](const Vec3&, std::uint32_t) { return 100.0; });
  const std::uint64_t before = small.scene.statistics.segments_ambient;
  ASSERT_TRUE(small.gather().done());
  const std::uint64_t pieces = small.scene.statistics.segments_ambient - before;
  EXPECT_GT(pieces, 8u * 64 * 32);
  EXPECT_LT(pieces, 20u * 64 * 32);
}

struct Asked {
  std::uint64_t stop = 0, calls = 0, last = 0, total = 0;

  Progress progress() {
    return {[](void* to, Stage stage, std::uint64_t done, std::uint64_t of) {
              Asked& asked = *static_cast<Asked*>(to);
              EXPECT_EQ(stage, Stage::kSolution);
              EXPECT_TRUE(done < of && (asked.calls == 0 || done > asked.last)) << done << " of " << of;
              asked.last = done;
              asked.total = of;
              return ++asked.calls != asked.stop;
            },
            this};
  }
};

TEST(Gather, StopsWhenItIsToldToAndAsksOften) {
  Asked all;
  Gathered room(furnished(0.6), 64, spot);
  ASSERT_TRUE(room.gather(FlagMode::kAuto, all.progress()).done());
  const std::vector<float> whole = room.lx;
  EXPECT_EQ(all.calls, all.total);
  EXPECT_GE(all.calls, 32u);
  for (const std::uint64_t stop : {std::uint64_t{1}, all.calls / 2, all.calls - 1}) {
    room.start();
    Asked asked{.stop = stop};
    EXPECT_EQ(room.gather(FlagMode::kAuto, asked.progress()).code, StatusCode::kInterrupted);
    EXPECT_EQ(asked.calls, stop);
    EXPECT_TRUE(stop > 1 || room.lx != whole);
  }
  room.start();
  ASSERT_TRUE(room.gather().done());
  EXPECT_EQ(room.lx, whole);
}

TEST(Gather, WorksInTheBytesThatItSaysAndIsRefusedInLess) {
  for (const FlagMode flags : {FlagMode::kAuto, FlagMode::kOff}) {
    Gathered room(furnished(0.6) + "light lamp point at 1.5 1.5 0.4 intensity 100\n", 4, spot);
    const Scene& s = room.scene.loaded.scene;
    const std::uint32_t near = SentLight::uneven_count(s, room.scene.geometry.lattice.step());
    EXPECT_GT(near, 0u);
    Arena counted(room.memory.data(), room.memory.size() * 8);
    Intersector counting(room.scene.geometry, room.scene.loaded.scene, flags);
    ASSERT_TRUE(counting.take_flags(counted));
    Options options = room.scene.options;
    options.flags = flags;
    EXPECT_TRUE(room.gather(flags).done());
    const std::vector<float> with_plenty = room.lx;
    room.start();
    room.memory.resize((counted.used() + gather_bytes(s, room.scene.geometry, options, near)) / 8);
    EXPECT_TRUE(room.gather(flags).done());
    EXPECT_EQ(room.lx, with_plenty);
    room.memory.pop_back();
    EXPECT_EQ(room.gather(flags).code, StatusCode::kMemory);
  }
}

TEST(Gather, ThePapersRulesAndMirrorLightKeepThePapersInterpolation) {
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
  options.mirror_light = true;
  EXPECT_FALSE(options.gathers()) << "lines don't follow mirrors";
}

}  // namespace
}  // namespace shodo
