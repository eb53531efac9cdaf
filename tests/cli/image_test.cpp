// Pictures that scenes name: what stb_image makes of them, and what the program says of bad ones.
#include "cli/image_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

#include "cli/png.h"
#include "cli/program.h"

namespace shodo {
namespace {

std::string texels(std::uint32_t count) {
  std::string bytes;
  for (std::uint32_t k = 0; k < 3 * count; ++k) bytes += static_cast<char>(100 + k * 37 % 60);
  return bytes;
}

std::string png_of(const std::string& rgb, std::uint32_t width, std::uint32_t height) {
  const std::vector<std::uint8_t> bytes(rgb.begin(), rgb.end());
  std::string file;
  const auto write = [](void* to, std::string_view part) { *static_cast<std::string*>(to) += part; };
  EXPECT_TRUE(encode_png(width, height, bytes, write, &file));
  return file;
}

/// Uncompressed, from the lower left, blue first.
std::string tga_of(const std::string& rgb, char width, char height) {
  std::string file("\0\0\2\0\0\0\0\0\0\0\0\0", 12);
  file += {width, '\0', height, '\0', '\x18', '\0'};
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at = 3 * static_cast<std::size_t>(y * width + x);
      file += {rgb[at + 2], rgb[at + 1], rgb[at]};
    }
  }
  return file;
}

TEST(ImageFile, PngAndTgaBecomeThePpmOfTheirTexels) {
  const std::string rgb = texels(7 * 5), expected = "P6 7 5 255\n" + rgb;
  for (const std::string& file : {png_of(rgb, 7, 5), tga_of(rgb, 7, 5)}) {
    std::string ppm;
    EXPECT_TRUE(decode_image(file, ppm));
    EXPECT_EQ(ppm, expected);
  }
}

// The texels take a thousand times the bytes of the file.
TEST(ImageFile, WhatIsEvenIsSmallAndStillReadWhole) {
  for (const std::uint32_t side : {1u, 40u, 1500u}) {
    const std::string rgb(std::size_t{3} * side * (side + 1), 'g');
    std::string ppm;
    ASSERT_TRUE(decode_image(png_of(rgb, side, side + 1), ppm)) << side;
    EXPECT_TRUE(ppm.ends_with(rgb));
  }
}

// A chunk of a gigabyte in a file of 57 bytes: nothing is asked for that the file can't fill.
TEST(ImageFile, AChunkLongerThanItsFileTakesNoMemory) {
  std::string file = png_of(texels(7 * 5), 7, 5);
  const std::size_t length = file.find("IDAT") - 4;
  file[length] = '\x3f';
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  std::string ppm;
  EXPECT_FALSE(decode_image(file, ppm));
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100'000);  // KiB
}

TEST(ImageFile, CutAndForeignFilesAreRefused) {
  const std::string file = png_of(texels(7 * 5), 7, 5);
  std::string ppm;
  for (const std::string& bad : {std::string(), std::string("P6 1 1 255\nabc"), file.substr(0, 20)}) {
    EXPECT_FALSE(decode_image(bad, ppm));
  }
}

TEST(ImageFile, GoesByTheNamesEnding) {
  for (const char* const name : {"a.png", "b/c.jpg", "d.jpeg", "e.tga", "F.JPG"}) EXPECT_TRUE(is_image_name(name));
  for (const char* const name : {"a.ppm", "b.scn", "png", "c.png.pgm", ""}) EXPECT_FALSE(is_image_name(name));
}

std::string scene_with(const std::string& texture) {
  return "shodo 1\nmaterial m diffuse 0.5 texture " + texture +
         "\nobject o\nquad m 0 0 0  3 0 0  3 2 0  0 2 0 patches 2 2\nlight l point at 1 1 1 intensity 100\n"
         "camera a eye 1.5 1 2 look 1.5 1 0 up 0 1 0 fov 60\n";
}

TEST(Program, DrawsATextureFromPngAsFromPpm) {
  const TestFolder folder;
  const std::string rgb = texels(16);
  folder.write("t.ppm", "P6 4 4 255\n" + rgb);
  folder.write("t.png", png_of(rgb, 4, 4));
  for (const std::string name : {"ppm", "png"}) {
    folder.write(name + ".scn", scene_with("t." + name));
    EXPECT_EQ(run({"render", name + ".scn", "-o", name + "-out.ppm", "--size", "40x30"}, folder.path()).status, 0);
  }
  EXPECT_EQ(file_text(folder / "ppm-out.ppm"), file_text(folder / "png-out.ppm"));
}

TEST(Program, SaysWhereATextureIsNamedThatCantBeUsed) {
  const TestFolder folder;
  folder.write("bad.png", "no picture");
  folder.write("bad.scn", scene_with("bad.png"));
  folder.write("missing.scn", scene_with("missing.png"));
  const Outcome bad = run({"check", "bad.scn"}, folder.path());
  const Outcome missing = run({"check", "missing.scn"}, folder.path());
  EXPECT_EQ(bad.status, 3);
  EXPECT_NE(bad.err.find("bad.scn:2:32: expected a PNG, JPEG or TGA that can be decoded, of 1 to 8192 texels each"),
            std::string::npos)
      << bad.err;
  EXPECT_NE(bad.err.find("found bad.png\n"), std::string::npos) << bad.err;
  EXPECT_EQ(missing.status, 1);
  const char* const expected = "missing.scn:2:32: expected a picture that can be read";
  EXPECT_NE(missing.err.find(expected), std::string::npos) << missing.err;
}

}  // namespace
}  // namespace shodo
