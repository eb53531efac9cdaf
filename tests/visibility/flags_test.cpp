// Flags change no bit (auto), or what the scene asks for (scene): the values of both stages, against flags off.
#include <regex>

#include "support/flags_scenes.h"
#include "support/files.h"

namespace shodo {
namespace {

TEST(Flags, AutoChangesNoBitOfRandomScenes) {
  double off = 0, on = 0;
  for (std::uint32_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const Compared both = expect_same(random_scene(seed));
    off += static_cast<double>(both.off.statistics.tests_ambient);
    on += static_cast<double>(both.on.statistics.tests_ambient);
    if (HasFailure()) break;
  }
  // Scenes of some 25 facets leave less to win than a room of 500.
  EXPECT_LT(4 * on, off);
}

TEST(Flags, AutoChangesNoBitWhateverTheSegments) {
  for (const std::uint32_t first : {1u, 16u, 64u, 256u}) {
    for (const std::uint32_t mixed : {first, 256u}) {
      Options options;
      options.segments_first = first;
      options.segments_mixed = mixed;
      for (std::uint32_t seed = 200; seed < 204; ++seed) {
        SCOPED_TRACE(seed);
        expect_same(random_scene(seed), options);
      }
    }
  }
}

/// Room, table, cupboard against the wall and a shelf in it: one object.
std::string self_shadowing_room(double angle) {
  SceneText scene(angle);
  scene.object();
  const char* tail = "patches 3 3 sub 2 2";
  scene.box({0, 0, 0}, {4, 2.5, 3}, true, tail);
  scene.box({1, 0.7, 1}, {2, 0.75, 2}, false, "patches 2 2 sub 1 1");
  scene.box({3, 0, 0}, {4, 2, 0.5}, false, "patches 1 2 sub 2 2");
  scene.box({3.2, 1, 0.5}, {3.8, 1.05, 0.8}, false, "patches 1 1 sub 2 2");
  scene.line("light lamp point at" + scene.at({1.5, 2, 1.5}) + " intensity 100");
  scene.line("light outside point at" + scene.at({6, 1, 1}) + " intensity 1000");
  scene.line("light sun sun towards" + scene.at({0.3, -1, 0.2}) + " illuminance 5000");
  return scene.text();
}

/// A lamp, a window or a bright panel that one polygon hides from whole patches, where a box stands on a part of a
/// sub-patch: what looks without flags then asks for what is hidden, and so must what doesn't look.
TEST(Flags, AutoChangesNoBitWhereAHiddenLightFallsOnWhatIsPartlyCovered) {
  const std::string dark =
      "shodo 1\nmaterial wall diffuse 0.7\nobject room\n"
      "quad wall 0 0 0  0 0 4  6 0 4  6 0 0  patches 6 4\nquad wall 0 2.5 0  6 2.5 0  6 2.5 4  0 2.5 4  patches 6 4\n"
      "quad wall 0 0 0  6 0 0  6 2.5 0  0 2.5 0  patches 6 3\nquad wall 0 0 4  0 2.5 4  6 2.5 4  6 0 4  patches 3 6\n"
      "quad wall 0 0 0  0 2.5 0  0 2.5 4  0 0 4  patches 3 4\nquad wall 6 0 0  6 0 4  6 2.5 4  6 2.5 0  patches 4 3\n"
      "object partition\nquad wall 3 0 1  3 2.5 1  3 2.5 4  3 0 4\nquad wall 3 0 1  3 0 4  3 2.5 4  3 2.5 1\n"
      "object cupboard\n"
      "quad wall 4.27 0 2.31  4.27 0 3.13  4.27 1.2 3.13  4.27 1.2 2.31\n"
      "quad wall 5.11 0 2.31  5.11 1.2 2.31  5.11 1.2 3.13  5.11 0 3.13\n"
      "quad wall 4.27 0 2.31  4.27 1.2 2.31  5.11 1.2 2.31  5.11 0 2.31\n"
      "quad wall 4.27 0 3.13  5.11 0 3.13  5.11 1.2 3.13  4.27 1.2 3.13\n"
      "quad wall 4.27 1.2 2.31  4.27 1.2 3.13  5.11 1.2 3.13  5.11 1.2 2.31\n";
  for (const char* light :
       {"light lamp point at 0.5 2.2 3.2 intensity 300\n",
        "light far area quad 0.4 2.2 3  0.6 2.2 3  0.6 2.2 3.2  0.4 2.2 3.2 luminance 900\n",
        "light large area quad 0.2 2.4 1.2  2.6 2.4 1.2  2.6 2.4 3.8  0.2 2.4 3.8 luminance 900\n",
        "light lamp point at 0.5 2.2 3.2 intensity 300\nlight beyond point at 5.7 2.2 0.4 intensity 2\n",
        "light large area quad 0.2 2.4 1.2  2.6 2.4 1.2  2.6 2.4 3.8  0.2 2.4 3.8 luminance 900\n"
        "light beyond point at 5.7 2.2 0.4 intensity 2\n"}) {
    SCOPED_TRACE(light);
    expect_same(dark + light);
  }
}

/// One segment first, more where it is mixed: where the one starts doesn't speak for the others.
TEST(Flags, AutoChangesNoBitWhereOneSegmentComesFirst) {
  const std::string three =
      "shodo 1\nmaterial b diffuse 0.84\nmaterial c diffuse 0.63\nmaterial d diffuse 0.30\nobject o1\n"
      "quad c -2 2 2  2 2 2  2 -2 2  -2 -2 2\n"
      "quad d 1.1433 0.31772 -0.61832  1.1433 0.31815 0.38168  2.1433 0.46624 0.38168  2.1433 0.41438 -0.61832\n"
      "quad b 0.82913 0.634 0.79291  0.82913 0.634 1.7929  0.82913 -2 1.7929  0.82913 -2 0.79291 patches 3 3\n"
      "light l3 area quad -2.1 -0.5 -1  -2.1 0.9 -1  -2.1 0.9 1.2  -2.1 -0.5 1.2 luminance 3000 open\n";
  Options options;
  options.patch_size = 1.5;
  options.segments_first = 1;
  for (const std::uint32_t mixed : {16u, 64u}) {
    options.segments_mixed = mixed;
    options.rules.blocks = true;
    expect_same(three, options);
  }
}

/// The middle of a patch bent into a valley stands over it: the segment to the middle of a wall is free, but leaves
/// behind the patch by its normal. It doesn't speak for those above, which a screen stands in.
TEST(Flags, AutoChangesNoBitWhereTheFirstSegmentIsFreeButBehindAPatch) {
  SceneText scene;
  scene.object();
  scene.quad({{0, -0.4, 1}, {1, 0.4, 2}, {2, -0.4, 1}, {1, 0.4, 0}}, "patches 1 1");
  scene.quad({{4, -1.3, 0}, {4, -1.3, 2}, {4, 0.7, 2}, {4, 0.7, 0}}, "patches 1 1");
  scene.quad({{3, 0.05, 0.2}, {3, 0.05, 1.8}, {3, 0.65, 1.8}, {3, 0.65, 0.2}}, "patches 1 1");
  scene.line("light lamp point at 1 2 1 intensity 100");
  Options options;
  options.segments_first = 1;
  options.segments_mixed = 1;
  const LitBits one = lit(scene.text(), FlagMode::kAuto, options);
  for (const std::uint32_t mixed : {16u, 64u}) {
    options.segments_mixed = mixed;
    const Compared both = expect_same(scene.text(), options);
    EXPECT_LT(std::bit_cast<double>(both.on.ambient[1]), std::bit_cast<double>(one.ambient[1]));  // for the screen
  }
}

TEST(Flags, AutoChangesNoBitWhereOneObjectShadowsItself) {
  for (const double angle : {0.0, 0.1, 0.7}) {
    const Compared both = expect_same(self_shadowing_room(angle));
    EXPECT_GT(both.off.statistics.tests_ambient, 5 * both.on.statistics.tests_ambient);
    EXPECT_GT(both.off.statistics.tests_direct, 3 * both.on.statistics.tests_direct);
  }
}

TEST(Flags, AnEmptyRoomNeedsNoAmbientSegmentInAnyPosition) {
  for (const double angle : {0.0, 0.4}) {
    SceneText scene(angle);
    scene.object();
    scene.box({0, 0, 0}, {4, 2.5, 3}, true, "patches 4 4 sub 1 1");
    scene.line("light lamp point at" + scene.at({1.5, 2, 1.5}) + " intensity 100");
    const Compared both = expect_same(scene.text());
    EXPECT_GT(both.off.statistics.segments_ambient, 10000u);
    if (angle == 0) {
      EXPECT_EQ(both.on.statistics.segments_ambient, 0u);
    }
    EXPECT_LT(both.on.statistics.tests_ambient, both.off.statistics.tests_ambient / 20);
  }
}

/// A lamp over a screen over a floor, in a box; `screen` and `floor` get the flags given.
std::string screened(const std::string& screen, const std::string& floor, const std::string& lamp) {
  SceneText scene;
  scene.line("object floor " + floor);
  scene.quad({{0, 0, 0}, {0, 0, 2}, {2, 0, 2}, {2, 0, 0}}, "patches 4 4 sub 1 1");
  scene.line("object screen " + screen);
  scene.quad({{-1, 1, -1}, {3, 1, -1}, {3, 1, 3}, {-1, 1, 3}}, "patches 1 1 sub 1 1");
  scene.line("object roof");
  scene.quad({{0, 2, 0}, {2, 2, 0}, {2, 2, 2}, {0, 2, 2}}, "patches 4 4 sub 1 1");
  scene.line("object shelf");
  scene.quad({{0, 1.9, 0}, {0, 1.9, 0.5}, {0.5, 1.9, 0.5}, {0.5, 1.9, 0}}, "patches 1 1 sub 1 1");
  scene.line("light lamp point at 1 1.5 1 intensity 100 " + lamp);
  scene.line("light down area quad 0.9 1.7 0.9 1.1 1.7 0.9 1.1 1.7 1.1 0.9 1.7 1.1 luminance 1000 " + lamp);
  return scene.text();
}

float floor_lux(const LitBits& bits) { return std::bit_cast<float>(bits.sub_patch[5]); }
double floor_ambient(const LitBits& bits) { return std::bit_cast<double>(bits.ambient[5]); }

TEST(Flags, SceneFlagsAreReadInSceneModeOnly) {
  const std::string text = screened("direct -blocks ambient -blocks", "", "");
  const Compared both = expect_same(text);
  EXPECT_EQ(floor_lux(both.on), 0);
  EXPECT_TRUE(lit(screened("", "", ""), FlagMode::kScene) == both.on);
}

TEST(Flags, TakeTheBytesThatTheySay) {
  std::string text = "shodo 1\nmaterial white diffuse 0.5\nlight lamp point at 0 0 3 intensity 1\n";
  for (int k = 0; k < 9; ++k) {
    const std::string name = std::to_string(k);
    text += "object o" + name + "\nquad white 0 0 " + name + "  1 0 " + name + "  1 1 " + name + "  0 1 " + name + "\n";
    TestScene loaded(text);
    ASSERT_TRUE(loaded.status.done()) << to_text(loaded.status);
    const std::size_t before = loaded.arena.used();
    FlagTables flags;
    ASSERT_TRUE(flags.fill(loaded.scene, false, loaded.arena));
    EXPECT_EQ(loaded.arena.used() - before, FlagTables::bytes(loaded.scene)) << k;
  }
}

TEST(Flags, AnObjectThatDoesNotBlockLetsLightOfThatSetPass) {
  const LitBits shaded = lit(screened("", "", ""), FlagMode::kScene);
  const LitBits direct = lit(screened("direct -blocks", "", ""), FlagMode::kScene);
  const LitBits ambient = lit(screened("ambient -blocks", "", ""), FlagMode::kScene);
  EXPECT_EQ(floor_lux(shaded), 0);
  EXPECT_GT(floor_lux(direct), 0);
  EXPECT_EQ(floor_lux(ambient), 0);
  EXPECT_GT(floor_ambient(ambient), floor_ambient(shaded));
}

TEST(Flags, LightGoesUntestedToAnObjectThatNothingShadows) {
  const LitBits lit_floor = lit(screened("", "direct -shadowed_towards", ""), FlagMode::kScene);
  EXPECT_EQ(lit_floor.sub_patch[5], lit(screened("direct -blocks", "", ""), FlagMode::kScene).sub_patch[5]);
  EXPECT_EQ(floor_lux(lit(screened("", "direct -shadowed_leaving", ""), FlagMode::kScene)), 0);
}

TEST(Flags, LightGoesUntestedFromALightThatNothingShadows) {
  const LitBits lit_floor = lit(screened("", "", "direct -shadowed_leaving"), FlagMode::kScene);
  EXPECT_EQ(lit_floor.sub_patch[5], lit(screened("direct -blocks", "", ""), FlagMode::kScene).sub_patch[5]);
  EXPECT_EQ(floor_lux(lit(screened("", "", "direct -shadowed_towards"), FlagMode::kScene)), 0);
}

TEST(Flags, APairOfSurfacesIsUntestedOnlyIfNeitherWayIsTested) {
  const LitBits shaded = lit(screened("", "", ""), FlagMode::kScene);
  // One way nothing is tested, the other way all is.
  for (const std::string way : {"ambient -shadowed_towards", "ambient -shadowed_leaving"}) {
    EXPECT_EQ(floor_ambient(lit(screened("", way, ""), FlagMode::kScene)), floor_ambient(shaded)) << way;
  }
  const LitBits both = lit(screened("", "ambient -shadowed_towards -shadowed_leaving", ""), FlagMode::kScene);
  EXPECT_GT(floor_ambient(both), floor_ambient(shaded));
}

TEST(Flags, AGivenPlusIsWhatAutoDoesAnyway) {
  const std::string set = "+blocks +shadowed_towards +shadowed_leaving", all = "direct " + set + " ambient " + set;
  EXPECT_TRUE(lit(screened(all, all, ""), FlagMode::kScene) == lit(screened("", "", ""), FlagMode::kAuto));
}

TEST(Flags, WhatIsFoundIsWhatStandsBetween) {
  const LitBits bits = lit(screened("", "", ""), FlagMode::kAuto);
  const std::string none = " -blocks -shadowed_towards -shadowed_leaving";
  EXPECT_EQ(bits.found[0],
            " direct -blocks +shadowed_towards -shadowed_leaving ambient -blocks +shadowed_towards +shadowed_leaving");
  EXPECT_TRUE(bits.found[1].starts_with(" direct +blocks")) << bits.found[1];
  EXPECT_EQ(bits.found[2].substr(0, 15), " direct -blocks") << bits.found[2];
  EXPECT_EQ(bits.found[4], " direct -blocks -shadowed_towards +shadowed_leaving ambient" + none);
}

TEST(Flags, WhatWasNotFoundCanBeClearedInTheSceneAndNoBitChanges) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const std::string text = random_scene(seed);
    const LitBits found = lit(text, FlagMode::kAuto);
    EXPECT_TRUE(found == lit(with_flags(text, found.found), FlagMode::kScene));
    if (HasFailure()) break;
  }
}

/// With a patch for 16 and without sub-patches; doc/flags.md has the ratios of the full rooms, which are larger.
TEST(Flags, RoomsTakeATwentiethAndAFifthOfTheTestsForTheSameBits) {
  for (const std::string room : {"day", "evening"}) {
    SCOPED_TRACE(room);
    Options options;
    options.refine = 0.25;
    options.segments_mixed = 16;
    options.effects = false;
    FolderReader folder(source_folder() + "/data");
    std::string_view shared, top;
    ASSERT_TRUE(folder.read("room.scn", shared) && folder.read(room + ".scn", top));
    const auto coarse = [](std::string_view text) {
      return std::regex_replace(std::string(text), std::regex("( sub|\nsub \\w+) \\d+ \\d+"), "$1 1 1");
    };
    TestFiles named{{"room.scn", coarse(shared)}};
    for (const std::string path : {"planks.pgm", "cloth.pgm", "wood.pgm", "rug.ppm", "coast.ppm"}) {
      std::string_view texels;  // light asks for what patches reflect
      ASSERT_TRUE(folder.read("textures/" + path, texels));
      named["textures/" + path] = texels;
    }
    const Compared both = expect_same(coarse(top), options, named);
    EXPECT_GE(both.off.statistics.tests_ambient, 20 * both.on.statistics.tests_ambient);
    EXPECT_GE(both.off.statistics.tests_direct, 5 * both.on.statistics.tests_direct);
  }
}

}  // namespace
}  // namespace shodo
