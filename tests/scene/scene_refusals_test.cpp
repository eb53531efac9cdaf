// Every wrong scene is refused with the place of the mistake, what was expected and what was found.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstdio>
#include <string>

#include "support/scene_from_text.h"

namespace shodo {
namespace {

struct Refusal {
  std::string text;
  std::uint32_t line, column;
  std::string message;  // a part of it
};

void expect_refused(const Refusal& refusal, const Options& options = {}) {
  const TestScene s(refusal.text, options);
  EXPECT_EQ(s.status.code, StatusCode::kScene) << refusal.text;
  EXPECT_EQ(s.status.line, refusal.line) << refusal.text << "\n" << to_text(s.status);
  EXPECT_EQ(s.status.column, refusal.column) << refusal.text << "\n" << to_text(s.status);
  EXPECT_NE(std::string(s.status.message).find(refusal.message), std::string::npos) << refusal.text << "\n"
                                                                                    << to_text(s.status);
  EXPECT_STREQ(s.status.file, "top.scn");
  EXPECT_EQ(s.arena.used(), 0u) << "a refused scene must leave the arena as it was";
}

/// A mistake in line 5, after what most statements need.
Refusal after_start(const std::string& line, std::uint32_t column, const std::string& message) {
  return {"shodo 1\nmaterial m diffuse 0.5\nobject o\ntri m 0 0 0 0 0 1 1 0 0\n" + line + "\n", 5, column, message};
}

TEST(SceneRefusals, ATextOf4GiBIsRefusedBeforeItIsRead) {
  // Memory that nobody touches: lines and columns are counted in 32 bits.
  constexpr std::size_t kSize = 0xffffffff;
  void* const pages = mmap(nullptr, kSize, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED) GTEST_SKIP() << "no address space";
  const TestScene scene(std::string_view(static_cast<const char*>(pages), kSize));
  EXPECT_EQ(scene.status.code, StatusCode::kScene);
  EXPECT_NE(std::string(scene.status.message).find("4 GiB"), std::string::npos);
  munmap(pages, kSize);
}

TEST(SceneRefusals, TheVersionStandsFirstAndOnce) {
  for (const Refusal& refusal : {
           Refusal{"", 1, 1, "expected 'shodo 1' as the first statement, found the end of the file"},
           Refusal{"\n# shodo 1\n", 3, 1, "expected 'shodo 1' as the first statement"},
           Refusal{"unit m\nshodo 1", 1, 1, "expected 'shodo 1' as the first statement, found 'unit'"},
           Refusal{"shodo", 1, 6, "expected format version 1, found the end of the file"},
           Refusal{"shodo\n1", 1, 6, "expected format version 1, found the end of the line"},
           Refusal{"shodo 2", 1, 7, "expected format version 1, found '2'"},
           Refusal{"shodo 1.0", 1, 7, "expected format version 1"},
           Refusal{"shodo 1 2", 1, 9, "expected the end of the line, found '2'"},
           Refusal{"Shodo 1", 1, 1, "expected 'shodo 1'"},
           Refusal{"\xef\xbb\xbfSHODO 1", 1, 1, "expected 'shodo 1'"},
           Refusal{"shodo 1\nshodo 1", 2, 1, "once only"},
       }) {
    expect_refused(refusal);
  }
}

TEST(SceneRefusals, UnknownStatements) {
  expect_refused(after_start("foo 1 2", 1,
                             "expected a statement (background, camera, display, grid, glass, include, light, "
                             "material, obj, object, plane, quad, sub, tri, unit), found 'foo'"));
  expect_refused(after_start("  Quad", 3, "found 'Quad'"));
  expect_refused(after_start("\t\tquads", 3, "found 'quads'"));
  expect_refused(after_start(std::string(300, 'x'), 1, "found 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...'"));
  expect_refused(after_start("\xe7\x85\xa7", 1, "found '\\xe7\\x85\\xa7'"));
}

TEST(SceneRefusals, ControlCharactersAnywhere) {
  for (const char byte : {'\0', '\1', '\x1b', '\x7f', '\v', '\f', '\r'}) {
    const std::string c(1, byte);
    char hex[8];
    std::snprintf(hex, sizeof hex, "'\\x%02x'", static_cast<unsigned>(byte));
    const std::string found = "found the control character " + std::string(hex);
    expect_refused(after_start(c + "object p", 1, found));
    expect_refused(after_start("object" + c + "p", 7, found));
    expect_refused(after_start("object " + c + "p", 8, found));
    expect_refused(after_start("object p" + c + " # x", 9, found));
    expect_refused(after_start("object p # a" + c + "b", 13, found));
    expect_refused(after_start("camera c eye 1 2" + c + "3", 17, found));
  }
}

TEST(SceneRefusals, WhatIsNoNumber) {
  for (const char* word : {"abc", "nan", "NaN", "-nan", "inf", "-inf", "infinity", "0x10", "0x1p3", "1,5", "1.5.2",
                           "--1", "1e", ".", "1_000", "1f", "\xef\xbc\x91"}) {
    const std::string text = word;
    expect_refused(after_start("tri m 0 " + text + " 0 0 0 1 1 0 0", 9, "expected a number (y of corner 1), found '"));
    expect_refused(after_start("display " + text + " 2", 9, "expected a number (display minimum, cd/m2), found"));
  }
  for (const char* word : {"1e999", "-1e999", "1e31", "-1.0001e30", "1e308"}) {
    expect_refused(after_start("tri m 0 " + std::string(word) + " 0 0 0 1 1 0 0", 9,
                               "expected a number from -1e+30 to 1e+30 (y of corner 1), found '" + std::string(word)));
  }
  expect_refused(
      after_start("tri m 0 " + std::string(400, '9') + " 0 0 0 1 1 0 0", 9, "expected a number from -1e+30"));
}

TEST(SceneRefusals, TooFewAndTooManyNumbers) {
  expect_refused(
      after_start("tri m 0 0 0 0 0 1 1 0", 22, "expected a number (z of corner 3), found the end of the line"));
  expect_refused(
      after_start("tri m 0 0 0 0 0 1 1 0 0 7", 25, "expected patches, sub, or the end of the line, found '7'"));
  expect_refused(after_start("quad m 0 0 0  0 0 1  1 0 1  1 0", 32, "z of corner 4"));
  expect_refused(after_start("grid m 2 2 0 0 0  0 0 1  1 0 1  1 0", 36, "z of vertex 4"));
  expect_refused(after_start("display 1", 10, "display maximum"));
  expect_refused(after_start("display 1 2 3", 13, "expected clip, roll or the end of the line, found '3'"));
  expect_refused(after_start("display 1 2 roll 3", 18, "expected the end of the line, found '3'"));
  expect_refused(after_start("unit m m", 8, "expected the end of the line"));
  expect_refused(
      after_start("material n diffuse 0.5 0.5", 27, "expected a number (blue of diffuse), found the end of the"));
  expect_refused(after_start("material n diffuse 0.5 0.5 0.5 0.5", 32, "expected diffuse, texture,"));
  expect_refused({"shodo 1\ndisplay 1", 2, 10, "found the end of the file"});
}

TEST(SceneRefusals, UnitAndDisplay) {
  expect_refused(after_start("unit", 5, "expected m, cm, mm, in or ft, found the end of the line"));
  expect_refused(after_start("unit km", 6, "found 'km'"));
  expect_refused({"shodo 1\nunit m\nunit m", 3, 1, "'unit' once only"});
  expect_refused({"shodo 1\ndisplay 1 2\ndisplay 1 2", 3, 1, "'display' once only"});
  expect_refused(after_start("display -1 2", 9, "from 0 to 1e+30"));
  expect_refused(after_start("display 2 2", 11, "above the minimum, found '2'"));
  expect_refused(after_start("display 2 1", 11, "above the minimum, found '1'"));
}

TEST(SceneRefusals, Cameras) {
  const std::string eye = "eye 0 1 0 ", look = "look 1 1 0 ", up = "up 0 1 0 ", fov = "fov 60 ";
  expect_refused(after_start("camera", 7, "expected the name of a camera, found the end of the line"));
  expect_refused(after_start("camera c " + look + up + fov, 37, "expected eye, found the end of the line"));
  expect_refused(after_start("camera c " + eye + up + fov, 36, "expected look"));
  expect_refused(after_start("camera c " + eye + look + fov, 38, "expected up"));
  expect_refused(after_start("camera c " + eye + look + up, 40, "expected fov"));
  expect_refused(after_start("camera c " + eye + eye, 20, "expected this word once only, found 'eye'"));
  expect_refused(
      after_start("camera c " + eye + "roll 3", 20, "expected eye, look, up, fov, or the end of the line, found"));
  for (const char* bad : {"0.999", "170.001", "-60", "0", "180"}) {
    expect_refused(after_start("camera c fov " + std::string(bad), 14, "from 1 to 170 (fov), found"));
  }
  expect_refused(after_start("camera c eye 1 2 3 look 1 2 3 up 0 1 0 fov 60", 8, "looks at another point"));
  expect_refused(after_start("camera c eye 1 2 3 look 1 2 4 up 0 0 -7 fov 60", 8, "'up' is not parallel"));
  expect_refused(after_start("camera c eye 0 0 0 look 0.1 0.2 0.3 up 0.3 0.6 0.9 fov 60", 8, "'up' is not parallel"));
  expect_refused(after_start("camera c up 0 0 0", 13, "expected a direction other than 0 0 0 (up)"));
  expect_refused({"shodo 1\ncamera c " + eye + look + up + fov + "\ncamera c " + eye + look + up + fov, 3, 8,
                  "expected the name of a camera not used before, found 'c'"});
  // Here eye and look become one point when the scene is centred.
  expect_refused({"shodo 1\ncamera a eye 1e20 0 0 look 0 0 0 up 0 1 0 fov 9\ncamera b " + eye + look + up + fov, 3, 8,
                  "in a scene of this size"});
}

TEST(SceneRefusals, Materials) {
  for (const char* bad : {"-0.1", "0.99991", "1", "1.5", "-1e-300"}) {
    const std::string rho = bad;
    expect_refused(after_start("material n diffuse " + rho, 20, "from 0 to 0.9999 (diffuse), found '" + rho));
    expect_refused(after_start("material n diffuse 0 0 " + rho, 24, "from 0 to 0.9999 (blue of diffuse)"));
  }
  expect_refused(after_start("material n", 11, "expected diffuse, found the end of the line"));
  expect_refused(
      after_start("material n shiny 1", 12, "expected diffuse, texture, reflect, transmit, highlight, or the end"));
  expect_refused(after_start("material n diffuse 0.5 diffuse 0.5", 24, "once only"));
  expect_refused(after_start("material m diffuse 0.5", 10, "not used before, found 'm'"));
}

TEST(SceneRefusals, Names) {
  const std::string long_name(64, 'n');
  for (const std::string& name : {std::string("a.b"), std::string("a/b"), std::string("\xc3\xa9"), std::string("a*"),
                                  std::string("\"a\""), long_name}) {
    expect_refused(after_start("object " + name, 8, "the name of an object (letters, digits, '_', '-', at most 63)"));
    expect_refused(after_start("tri " + name + " 0 0 0 0 0 1 1 0 0", 5, "the name of a material (letters"));
  }
  expect_refused(after_start("object o", 8, "expected the name of an object not used before, found 'o'"));
  expect_refused(after_start("tri n 0 0 0 0 0 1 1 0 0", 5, "expected the name of a material defined above, found 'n'"));
  expect_refused(after_start("tri n 0 0 0 0 0 1 1 0 0\nmaterial n diffuse 0", 5, "defined above"));
  expect_refused(after_start("sub p 3", 5, "expected the name of an object defined above, found 'p'"));
  expect_refused(after_start("sub p 3\nobject p", 5, "defined above"));
  expect_refused(after_start("light l polyhedron object p luminance 1", 27, "the name of an object defined above"));
  const std::string sun = "light l sun towards 0 1 0 illuminance 1";
  expect_refused({"shodo 1\n" + sun + "\n" + sun, 3, 7, "expected the name of a light not used before, found 'l'"});
}

TEST(SceneRefusals, ObjectsAndTheirFlags) {
  expect_refused({"shodo 1\nmaterial m diffuse 0\nquad m 0 0 0 0 0 1 1 0 1 1 0 0", 3, 1, "an 'object' before"});
  expect_refused(
      after_start("object p blocks", 10, "expected direct, ambient, or the end of the line, found 'blocks'"));
  expect_refused(after_start("object p +blocks", 10, "expected direct, ambient, or the end of the line"));
  expect_refused(
      after_start("object p direct", 16, "expected + or - before blocks, shadowed_towards or shadowed_leaving"));
  expect_refused(after_start("object p direct blocks", 17, "expected + or - before"));
  expect_refused(after_start("object p direct +blocks -shadows", 25, "expected + or - before"));
  expect_refused(after_start("object p direct +", 17, "expected + or - before"));
  expect_refused(after_start("object p direct +blocks -blocks", 25, "each flag once only"));
  expect_refused(after_start("object p direct +blocks direct +shadowed_leaving", 25, "once only"));
}

TEST(SceneRefusals, Counts) {
  const std::string quad = "quad m 0 0 0 0 0 1 1 0 1 1 0 0 ", tri = "tri m 0 0 0 0 0 1 1 0 0 ";
  for (const char* bad : {"0", "65536", "-1", "+1", "2.0", "1e1", "0x2", "4294967297", "x", "99999999999999999999"}) {
    const std::string n = bad;
    expect_refused(
        after_start(quad + "patches " + n + " 1", 40, "whole number from 1 to 65535 (patches along u), found"));
    expect_refused(after_start(quad + "patches 1 " + n, 42, "(patches along v), found '" + n));
    expect_refused(after_start(quad + "sub 1 " + n, 38, "(sub-patches along v), found"));
    expect_refused(after_start(tri + "patches " + n, 33, "(patches along an edge), found"));
    expect_refused(after_start(tri + "sub " + n, 29, "(sub-patches along an edge), found"));
    expect_refused(after_start("sub o " + n, 7, "(sub-patches along u), found"));
    expect_refused(after_start("sub o 2 " + n, 9, "(sub-patches along v), found"));
  }
  for (const char* bad : {"0", "1", "65536", "4294967295"}) {
    expect_refused(after_start("grid m " + std::string(bad) + " 2", 8, "from 2 to 65535 (columns of vertices), found"));
    expect_refused(after_start("grid m 2 " + std::string(bad), 10, "from 2 to 65535 (rows of vertices), found"));
  }
  expect_refused(after_start("grid m 65535 65535 0 0 0", 25, "x of vertex 2"));
  expect_refused(after_start(quad + "patches 3", 41, "patches along v"));
  expect_refused(after_start(quad + "patches 3 3 patches 3 3", 44, "once only"));
  expect_refused(after_start(tri + "patches 3 3", 35, "expected patches, sub, or the end of the line, found '3'"));
  expect_refused(
      after_start("grid m 2 2 0 0 0 1 0 0 0 0 1 1 0 1 patches 2 2", 36, "expected sub, or the end of the line"));
  expect_refused(after_start("sub o 2 3", 9, "equal counts for an object with a triangle, found '3'"));
  expect_refused(
      {"shodo 1\nmaterial m diffuse 0\nobject p\nsub p 2 3\n" + tri, 5, 1, "equal counts in the 'sub' of an"});
}

TEST(SceneRefusals, MoreSubPatchesThan32BitsCanCount) {
  const std::string quad = "quad m 0 0 0 0 0 1 1 0 1 1 0 0 ";
  expect_refused(
      after_start(quad + "patches 65535 65535 sub 2 1", 1, "2^32 - 2 sub-patches in all, found 65535 x 65535"));
  expect_refused(after_start(quad + "patches 65535 65535", 1, "found 65535 x 65535 patches of 3 x 3"));
  expect_refused(after_start(quad + "patches 65535 1 sub 65535 2", 1, "2^32 - 2"));
  // Each fits, both together don't; and the place is that of the second.
  const std::string half = quad + "patches 1 46341 sub 46341 1\n";
  const std::string start = "shodo 1\nmaterial m diffuse 0\nobject o\n";
  EXPECT_TRUE(TestScene(start + half).status.done());
  expect_refused({start + half + "  " + half, 5, 3, "2^32 - 2"});
  Options fine;
  fine.patch_size = 1e-5;
  expect_refused({start + "  " + quad, 4, 3, "found 65536 x 65536"}, fine);
  fine.patch_size = 0;
  fine.refine = 1e9;
  expect_refused({start + "\t" + quad, 4, 2, "found 65536 x 65536"}, fine);
  expect_refused({start + "\tgrid m 3 2 0 0 0 1 0 0 2 0 0 0 0 1 1 0 1 2 0 1", 4, 2, "found 65536 x 65536"}, fine);
  fine.refine = 40000;
  expect_refused({start + "\tgrid m 3 2 0 0 0 1 0 0 2 0 0 0 0 1 1 0 1 2 0 1", 4, 2, "found 65536 x 40000"}, fine);
}

TEST(SceneRefusals, QuadsThatCrossThemselves) {
  const std::string message = "expected a quad that does not cross itself or fold over";
  expect_refused(after_start("quad m 0 0 0  1 0 1  1 0 0  0 0 1", 1, message));
  expect_refused(after_start("   quad m 0 0 0  1 0 1  2 0 0  0 0 1", 4, message));
  expect_refused(after_start("grid m 3 2  0 0 0  1 0 0  2 0 0  0 0 1  2 0 1  1 0 1", 48,
                             "cells that do not cross themselves or fold over, found the cell of column 2, row 1"));
}

TEST(SceneRefusals, Lights) {
  const std::string point = "light l point at 0 0 0 intensity 1 ";
  const std::string area = "light l area quad 0 0 0  0 0 1  1 0 1  1 0 0 luminance 1 ";
  expect_refused(after_start("light", 6, "expected the name of a light, found the end of the line"));
  expect_refused(after_start("light l", 8, "expected point, area, polyhedron or sun, found the end of the line"));
  expect_refused(after_start("light l laser", 9, "expected point, area, polyhedron or sun, found 'laser'"));
  expect_refused(after_start("light l sun illuminance 1", 26, "expected towards, found the end of the line"));
  expect_refused(after_start("light l sun towards 0 -1 0", 27, "expected illuminance, found"));
  expect_refused(after_start("light l point intensity 3", 26, "expected at, found"));
  expect_refused(after_start("light l point at 0 0 0", 23, "expected intensity or ies, found"));
  const std::string ies = "light l point at 0 0 0 ies a.ies";
  expect_refused(after_start(ies, 33, "expected 'towards', since there is an 'ies'"));
  expect_refused(after_start(ies + " towards 0 1 0 intensity 1", 59, "an intensity or an IES file, not both"));
  expect_refused(after_start(ies + " towards 0 1 0 cosine 2", 56, "expected an IES file without a 'cosine'"));
  expect_refused(after_start("light l point at 0 0 0 intensity 1 turn 3", 36, "an IES file to turn, found 'turn'"));
  expect_refused(after_start("light l point at 0 0 0 ies", 27, "expected the path of an IES file, found the end of"));
  expect_refused(after_start("light l point at 0 0 0 ies /a", 28, "a path relative to this file"));
  expect_refused(after_start(ies + " turn x", 39, "expected a number (degrees of the turn), found 'x'"));
  expect_refused(after_start("light l sun towards 0 1 0 illuminance 1 ies a", 41, "towards, illuminance, colour"));
  expect_refused(after_start("light l area luminance 3", 25, "expected quad, found"));
  expect_refused(after_start("light l area quad 0 0 0 0 0 1 1 0 1 1 0 0", 42, "expected luminance, found"));
  expect_refused(after_start("light l polyhedron luminance 3", 31, "expected object, found"));
  expect_refused(after_start("light l polyhedron object o", 28, "expected luminance, found"));
  expect_refused(after_start("light l sun towards 0 0 -0 illuminance 1", 21, "a direction other than 0 0 0 (towards)"));
  expect_refused(after_start(point + "towards 0 0 0 cosine 1", 44, "a direction other than 0 0 0 (towards)"));
  expect_refused(after_start(point + "cosine 1", 44, "expected 'towards', since there is a 'cosine'"));
  expect_refused(after_start(point + "cosine -1", 43, "from 0 to 1e+06 (exponent of the cosine)"));
  expect_refused(
      after_start(point + "luminance 1", 36,
                  "expected at, towards, intensity, cosine, ies, turn, colour, attenuation, direct, ambient, or"));
  expect_refused(after_start(point + "open", 36, "found 'open'"));
  expect_refused(after_start("light l point at 0 0 0 intensity -1", 34, "from 0 to 1e+30 (intensity), found '-1'"));
  expect_refused(after_start("light l sun illuminance -1", 25, "(illuminance), found '-1'"));
  expect_refused(after_start("light l area luminance -1", 24, "(luminance), found '-1'"));
  expect_refused(after_start(point + "colour 1 1", 46, "blue of colour"));
  expect_refused(after_start(point + "colour 1 -1 1", 45, "from 0 to 1e+30 (green of colour)"));
  expect_refused(after_start(point + "attenuation 0 0 0", 48, "an attenuation that is not 0 0 0"));
  expect_refused(after_start(point + "attenuation 1 -1 1", 50, "(L of attenuation)"));
  expect_refused(after_start("light l sun towards 0 1 0 illuminance 1 attenuation 1 0 0", 41, "found 'attenuation'"));
  expect_refused(after_start(point + "direct blocks", 43, "expected + or - before"));
  expect_refused(after_start(area + "open open", 63, "once only"));
  const std::string plane = "expected the four corners of a plane convex quad with an area";
  for (const char* bad : {"0 0 0  1 0 1  1 0 0  0 0 1", "0 0 0  4 0 0  1 0 1  0 0 4", "0 0 0  0 0 0  1 0 0  0 0 1",
                          "0 0 0  1 0 0  2 0 0  3 0 0", "0 0 0  1 0 0  1 0.01 1  0 0 1", "0 0 0 0 0 0 0 0 0 0 0 0"}) {
    expect_refused(after_start("light l area luminance 1 quad " + std::string(bad), 31, plane));
  }
  expect_refused(
      {"shodo 1\nobject p\nlight l polyhedron object p luminance 1", 3, 27, "that has surfaces above this line"});
  expect_refused(
      {"shodo 1\nmaterial m diffuse 0\nobject o\ntri m 0 0 0 0 0 1 1 0 0\n"
       "light l polyhedron object o luminance 1\nlight k polyhedron object o luminance 1",
       6, 27, "an object that isn't a light already, found 'o'"});
}

TEST(SceneRefusals, OptionsThatNoSceneCanHave) {
  for (const double bad : {-1.0, 1e31, 1 / 0.0, 0 / 0.0}) {
    for (double Options::*option : {&Options::patch_size, &Options::sub_patch_size, &Options::refine}) {
      Options options;
      options.*option = bad;
      EXPECT_EQ(TestScene("shodo 1", options).status.code, StatusCode::kUsage) << bad;
    }
  }
  Options options;
  options.refine = 0;
  EXPECT_EQ(TestScene("shodo 1", options).status.code, StatusCode::kUsage);
}

TEST(SceneRefusals, LinesAndColumnsCountAlikeWithAnyLineEnd) {
  expect_refused({"shodo 1\r\n\r\n# x\r\n bad\r\n", 4, 2, "found 'bad'"});
  expect_refused({"\xef\xbb\xbfshodo 1\n\r\n\n bad", 4, 2, "found 'bad'"});
  expect_refused({"shodo 1\r\ndisplay 1\r\n", 2, 10, "found the end of the line"});
}

TEST(SceneRefusals, ALongFileNameKeepsItsEnd) {
  const std::string name = std::string(200, 'd') + "/top.scn";
  std::byte memory[64];
  Arena arena(memory, sizeof memory);
  Scene scene;
  const Status status = load_scene(name, "", {}, {}, arena, scene);
  EXPECT_EQ(std::string(status.file), name.substr(name.size() - 127));
}

}  // namespace
}  // namespace shodo
