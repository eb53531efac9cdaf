// What stands in the files: pictures, maps, tables and statistics, on a scene whose illuminance is known.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>

#include "cli/program.h"
#include "support/decoded_picture.h"

namespace shodo {
namespace {

std::vector<std::string> columns_of(const std::string& line) {
  std::vector<std::string> columns(1);
  for (const char c : line) {
    if (c == ',')
      columns.emplace_back();
    else
      columns.back() += c;
  }
  return columns;
}

/// A file of floats as the PFM description has it.
struct Pfm {
  int channels = 0, width = 0, height = 0;
  std::string scale;
  std::vector<float> values;  // bottom row first
};

Pfm read_pfm(const std::string& path) {
  const std::string bytes = file_text(path);
  std::istringstream in(bytes);
  Pfm pfm;
  std::string kind;
  in >> kind >> pfm.width >> pfm.height >> pfm.scale;
  pfm.channels = kind == "Pf" ? 1 : kind == "PF" ? 3 : 0;
  for (std::size_t at = static_cast<std::size_t>(in.tellg()) + 1; at + 4 <= bytes.size(); at += 4) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 4; ++k)
      bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
    pfm.values.push_back(std::bit_cast<float>(bits));
  }
  return pfm;
}

TEST(Picture, PngHasThePixelsOfPpm) {
  const TestFolder folder;
  for (const char* name : {"x.ppm", "x.png"}) {
    const Outcome outcome = run({"render", test_scene("box.scn"), "-o", name, "--size", "37x21"}, folder.path());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  const std::string ppm = file_text(folder / "x.ppm");
  EXPECT_EQ(ppm.substr(0, 13), "P6\n37 21\n255\n");
  EXPECT_EQ(ppm.size(), 13u + 3u * 37u * 21u);
  const DecodedPicture png = decoded_picture(file_text(folder / "x.png"));
  EXPECT_EQ(png.width, 37u);
  EXPECT_EQ(png.height, 21u);
  const std::string pixels(png.rgb.begin(), png.rgb.end());
  EXPECT_TRUE(pixels == ppm.substr(13));
  EXPECT_NE(pixels, std::string(pixels.size(), pixels[0])) << "there is something to see";
}

TEST(Picture, TheCameraNamedIsTheOneDrawn) {
  const TestFolder folder;
  const auto picture = [&](const Running::Words& more) {
    Running::Words words{"render", test_scene("shapes.scn"), "-o", "x.ppm", "--size", "24x20"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words, folder.path()).status, 0);
    return file_text(folder / "x.ppm");
  };
  EXPECT_TRUE(picture({}) == picture({"--camera", "main"}));
  EXPECT_FALSE(picture({}) == picture({"--antialias", "16"}));
}

TEST(Maps, AreInLuxLittleEndianWithTrianglesAsSquares) {
  const TestFolder folder;
  ASSERT_EQ(run({"map", test_scene("sun.scn"), "-o", "maps"}, folder.path()).status, 0);
  // NU SU = 1 x 2 wide, NV SV = 2 x 2 high; the sun gives its 1000 lx to a surface square to it.
  const Pfm floor = read_pfm(folder / "maps/0000.pfm");
  EXPECT_EQ(floor.channels, 1) << "a grey scene";
  EXPECT_EQ(floor.scale, "-1.0");
  EXPECT_EQ(floor.width, 2);
  EXPECT_EQ(floor.height, 4);
  EXPECT_EQ(floor.values, std::vector<float>(8, 1000.0f));
  const Pfm sail = read_pfm(folder / "maps/0001.pfm");
  EXPECT_EQ(sail.values, (std::vector<float>{1000, 1000, 1000, 0})) << "two rows of two, the last cell outside";
  EXPECT_EQ(file_text(folder / "maps/index.csv"),
            "file,object,mesh,kind,material,width,height,patches_u,patches_v,sub_u,sub_v\n"
            "0000.pfm,floor,0,quad,black,2,4,1,2,2,2\n"
            "0001.pfm,sail,1,tri,black,2,2,1,1,2,2\n");
}

TEST(Maps, OfAColouredSceneHaveThreeChannels) {
  const TestFolder folder;
  ASSERT_EQ(run({"map", test_scene("box.scn"), "-o", "maps", "--csv", "box.csv"}, folder.path()).status, 0);
  const Pfm floor = read_pfm(folder / "maps/0000.pfm");
  EXPECT_EQ(floor.channels, 3);
  ASSERT_EQ(floor.values.size(), 3u * 8 * 8);
  // The table has the same numbers, direct and ambient apart, in the same order.
  const std::vector<std::string> lines = lines_of(file_text(folder / "box.csv"));
  for (std::size_t k = 0; k < 64; ++k) {
    const std::vector<std::string> line = columns_of(lines[1 + k]);
    ASSERT_EQ(line[0] + line[1], "floor0");
    for (std::size_t c = 0; c < 3; ++c) {
      const float total = std::stof(line[11 + c]) + std::stof(line[14 + c]);
      EXPECT_FLOAT_EQ(floor.values[3 * k + c], total) << "sub-patch " << k;
    }
  }
}

TEST(Table, HasALineASubPatchInSceneUnits) {
  const TestFolder folder;
  const Outcome outcome = run({"map", test_scene("sun.scn"), "-o", "maps", "--csv", "-"}, folder.path());
  ASSERT_EQ(outcome.status, 0);
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 1u + 8u + 4u);
  EXPECT_EQ(lines[0], "object,mesh,u,v,x,y,z,nx,ny,nz,area,direct_r,direct_g,direct_b,ambient_r,ambient_g,ambient_b");
  // The floor runs from (10, 0, 20): u along z in steps of 1/2, v along x in steps of 1/2.
  EXPECT_EQ(lines[1], "floor,0,0,0,10.25,0,20.25,0,1,0,0.25,1000,1000,1000,0,0,0");
  EXPECT_EQ(lines[2], "floor,0,1,0,10.25,0,20.75,0,1,0,0.25,1000,1000,1000,0,0,0");
  EXPECT_EQ(lines[8], "floor,0,1,3,11.75,0,20.75,0,1,0,0.25,1000,1000,1000,0,0,0");
  // A triangle's row 0: upright, inverted, upright; row 1: upright.
  const char* const places[] = {"0,0", "1,0", "2,0", "0,1"};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::vector<std::string> line = columns_of(lines[9 + k]);
    EXPECT_EQ(line[0] + "," + line[1], "sail,1");
    EXPECT_EQ(line[2] + "," + line[3], places[k]);
    EXPECT_EQ(line[8] + "," + line[10] + "," + line[11], "1,0.125,1000");
  }
}

TEST(Table, AreasSumToThoseOfTheMeshes) {
  const TestFolder folder;
  ASSERT_EQ(run({"map", test_scene("box.scn"), "-o", "maps", "--csv", "x.csv"}, folder.path()).status, 0);
  std::map<std::string, double> area;
  const std::vector<std::string> lines = lines_of(file_text(folder / "x.csv"));
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const std::vector<std::string> line = columns_of(lines[k]);
    ASSERT_EQ(line.size(), 17u);
    area[line[0]] += std::stod(line[10]);
  }
  // Nine digits a line, up to 64 lines.
  for (const char* wall : {"floor", "ceiling", "left", "right", "back", "front"})
    EXPECT_NEAR(area[wall], 1, 1e-7) << wall;
  EXPECT_NEAR(area["block"], 5 * 0.09, 1e-7);
}

/// Reads JSON as its grammar says and keeps "a.b" -> the value's text; no arrays, which the statistics don't have.
class Json {
 public:
  explicit Json(const std::string& text) : text_(text) {
    object("");
    space();
    valid_ = valid_ && at_ == text_.size();
  }

  bool valid() const { return valid_; }
  std::string at(const std::string& key) const { return values_.count(key) != 0 ? values_.at(key) : "missing"; }
  double number(const std::string& key) const { return values_.count(key) != 0 ? std::stod(values_.at(key)) : NAN; }
  const std::vector<std::string>& keys() const { return keys_; }

 private:
  void space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }

  bool take(char c) {
    space();
    if (at_ < text_.size() && text_[at_] == c) return ++at_, true;
    return false;
  }

  void expect(char c) { valid_ = take(c) && valid_; }

  std::string string() {
    expect('"');
    std::string value;
    while (valid_ && at_ < text_.size() && text_[at_] != '"') {
      if (static_cast<unsigned char>(text_[at_]) < 0x20) valid_ = false;
      if (text_[at_] != '\\') {
        value += text_[at_++];
        continue;
      }
      const char escape = text_[++at_];
      if (escape == 'u') {
        value += static_cast<char>(std::stoi(text_.substr(at_ + 1, 4), nullptr, 16));
        at_ += 5;
      } else {
        valid_ = valid_ && (escape == '"' || escape == '\\');
        value += escape;
        ++at_;
      }
    }
    expect('"');
    return value;
  }

  void object(const std::string& prefix) {
    expect('{');
    do {
      const std::string key = prefix + string();
      keys_.push_back(key);
      expect(':');
      value(key);
    } while (valid_ && take(','));
    expect('}');
  }

  void value(const std::string& key) {
    space();
    if (text_[at_] == '{') return object(key + ".");
    if (text_[at_] == '"') {
      values_[key] = string();
      return;
    }
    const std::size_t end = text_.find_first_not_of("0123456789+-.e", at_);
    values_[key] = text_.substr(at_, end - at_);
    valid_ = valid_ && end != at_ && end != std::string::npos;
    at_ = end;
  }

  std::string text_;
  std::size_t at_ = 0;
  bool valid_ = true;
  std::map<std::string, std::string> values_;
  std::vector<std::string> keys_;
};

TEST(StatisticsFile, HasTheKeysOfTheContractInItsOrder) {
  const TestFolder folder;
  const Outcome outcome =
      run({"render", test_scene("box.scn"), "-o", "x.ppm", "--size", "32x24", "--stats", "-"}, folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json json(outcome.out);
  ASSERT_TRUE(json.valid()) << outcome.out;
  const std::vector<std::string> keys = {"scene",
                                         "objects",
                                         "meshes",
                                         "patches",
                                         "sub_patches",
                                         "channels",
                                         "flags",
                                         "rules",
                                         "lattice",
                                         "lattice.step",
                                         "lattice.inserted",
                                         "lattice.moved",
                                         "lattice.merged_plates",
                                         "dropped",
                                         "dropped.patches",
                                         "dropped.polygons",
                                         "segments",
                                         "segments.direct",
                                         "segments.ambient",
                                         "tests",
                                         "tests.direct",
                                         "tests.ambient",
                                         "form_factors",
                                         "form_factors.computed",
                                         "form_factors.nonzeros",
                                         "form_factors.bytes",
                                         "links",
                                         "links.stored",
                                         "links.to_blocks",
                                         "links.blocks",
                                         "rules_dropped",
                                         "rules_dropped.rows",
                                         "rules_dropped.columns",
                                         "rules_dropped.columns_restored",
                                         "rules_dropped.rounds",
                                         "rules_dropped.loss_bound_lx",
                                         "rows",
                                         "rows.scaled",
                                         "rows.kept",
                                         "rows.recomputed",
                                         "solution",
                                         "solution.sweeps",
                                         "solution.bound",
                                         "memory",
                                         "memory.budget",
                                         "memory.peak",
                                         "memory.load",
                                         "memory.direct",
                                         "memory.ambient",
                                         "memory.map",
                                         "memory.picture",
                                         "memory.lit_again",
                                         "memory.geometry_again",
                                         "memory.placed_again",
                                         "seconds",
                                         "seconds.load",
                                         "seconds.direct",
                                         "seconds.form_factors",
                                         "seconds.solution",
                                         "seconds.map",
                                         "seconds.picture"};
  EXPECT_EQ(json.keys(), keys);
  EXPECT_EQ(json.at("scene"), test_scene("box.scn"));
  EXPECT_EQ(json.at("objects"), "7");
  EXPECT_EQ(json.at("meshes"), "11");
  EXPECT_EQ(json.at("patches"), "88");       // 2 x 16 + 4 x 9 + 5 x 4
  EXPECT_EQ(json.at("sub_patches"), "304");  // 64 + 16 + 4 x 36 + 5 x 16
  EXPECT_EQ(json.at("channels"), "3");
  EXPECT_EQ(json.at("flags"), "auto");
  EXPECT_EQ(json.at("rules"), "none");
  EXPECT_EQ(json.at("memory.budget"), "8388608");
  EXPECT_GT(json.number("memory.peak"), 10000);
  EXPECT_LE(json.number("memory.peak"), 8388608);
  EXPECT_GT(json.number("lattice.step"), 0);
  EXPECT_GT(json.number("segments.direct"), 0);
  EXPECT_GT(json.number("tests.direct"), json.number("segments.direct"));
  EXPECT_GT(json.number("tests.ambient"), json.number("segments.ambient"));
  EXPECT_GT(json.number("form_factors.computed"), 0);
  EXPECT_GT(json.number("form_factors.nonzeros"), 88);
  EXPECT_EQ(json.at("rows.kept"), "88");
  EXPECT_GE(json.number("solution.sweeps"), 1);
  EXPECT_LE(json.number("solution.bound"), 1e-4);
  for (const char* stage : {"load", "direct", "form_factors", "solution", "map", "picture"}) {
    EXPECT_GE(json.number(std::string("seconds.") + stage), 0) << stage;
  }
}

TEST(StatisticsFile, CountsPlatesNearerThanTheLatticeTells) {
  // A step of this scene is 2e-6. Plates that face each other 1e-6 apart and those 1e-5 apart; the two sides of a wall
  // 1e-6 thick don't face each other, nor do two plates that both face up. In the least budget of a wide picture the
  // triangles make room before the file is written.
  const TestFolder folder;
  folder.write("plates.scn", "shodo 1\nmaterial white diffuse 0.5\nobject all\n"
                             "quad white 0 0 0  1 0 0  1 1 0  0 1 0\n"
                             "quad white 0 0 1e-6  0 1 1e-6  1 1 1e-6  1 0 1e-6\n"
                             "quad white 0 0 0.5  1 0 0.5  1 1 0.5  0 1 0.5\n"
                             "quad white 0 0 0.50001  0 1 0.50001  1 1 0.50001  1 0 0.50001\n"
                             "quad white 0 0 0.8  0 1 0.8  1 1 0.8  1 0 0.8\n"
                             "quad white 0 0 0.800001  1 0 0.800001  1 1 0.800001  0 1 0.800001\n"
                             "quad white 0 0 0.9  1 0 0.9  1 1 0.9  0 1 0.9\n"
                             "quad white 0 0 0.900001  1 0 0.900001  1 1 0.900001  0 1 0.900001\n"
                             "camera c eye 0.5 0.5 0.7 look 0.5 0.6 0.2 up 0 1 0 fov 60\n");
  const Outcome check = run({"check", "plates.scn", "--size", "4096x8"}, folder.path());
  EXPECT_NE(check.out.find("warning:   1 pair of polygons that face each other, nearer than two lattice steps"),
            std::string::npos)
      << check.out;
  const std::size_t at = check.out.find("memory:    ");
  ASSERT_NE(at, std::string::npos);
  std::string least;
  for (std::size_t k = at + 11; check.out[k] != ' '; ++k) {
    if (check.out[k] != ',') least += check.out[k];
  }
  for (const std::string& memory : {std::string("8M"), least}) {
    const Outcome outcome = run({"render", "plates.scn", "-o", "x.ppm", "--size", "4096x8", "--stats", "-", "--memory",
                                 memory},
                                folder.path());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(Json(outcome.out).at("lattice.merged_plates"), "1") << memory;
  }
}

TEST(StatisticsFile, EscapesTheScenesName) {
  const TestFolder folder;
  const std::string name = "a \"quoted\"\\\n\tname.scn";
  folder.write(name, file_text(test_scene("sun.scn")));
  const Outcome outcome = run({"map", name, "-o", "m", "--stats", "-"}, folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json json(outcome.out);
  EXPECT_TRUE(json.valid()) << outcome.out;
  EXPECT_EQ(json.at("scene"), name);
  folder.write("\xff\xc3\xa9.scn", file_text(test_scene("sun.scn")));
  EXPECT_NE(
      run({"map", "\xff\xc3\xa9.scn", "-o", "n", "--stats", "-"}, folder.path()).out.find("\"\\ufffd\xc3\xa9.scn\""),
      std::string::npos);
}

TEST(Check, SaysWhatWillBeModelled) {
  const Outcome check = run({"check", test_scene("shapes.scn")});
  ASSERT_EQ(check.status, 0) << check.err;
  for (const char* part : {"3, red green blue", "7 objects, 10 meshes", "2 points, 1 area, 1 polyhedron, 1 sun", "main",
                           "lattice:   a step is", "vertices inserted", "are the smallest budget that works",
                           "in stage 6, picture", "sub-patches: (4 c + 1) s", "a PNG of 1280 x 1024"}) {
    EXPECT_NE(check.out.find(part), std::string::npos) << part << "\n" << check.out;
  }
  EXPECT_EQ(check.out.find("warning"), std::string::npos) << check.out;
}

TEST(Check, WarnsOfPlatesThatFaceEachOtherNearerThanTheLatticeTells) {
  const TestFolder folder;
  // A step is 3.8e-6 here.
  const auto warned = [&](const std::string& second) {
    folder.write("x.scn", "shodo 1\nunit m\ncamera c eye 0.5 -2 0.5 look 0.5 0 0 up 0 0 1 fov 60\n"
                          "material grey diffuse 0.5\n"
                          "object a\nquad grey 0 0 0  1 0 0  1 1 0  0 1 0 patches 2 2 sub 1 1\n"
                          "object b\n" + second + " patches 2 2 sub 1 1\n"
                          "light l point at 0.5 0.5 -1 intensity 100\n");
    const Outcome check = run({"check", "x.scn"}, folder.path());
    EXPECT_EQ(check.status, 0) << check.err;
    return check.out.find("1 pair of polygons that face each other") != std::string::npos;
  };
  EXPECT_TRUE(warned("quad grey 0 0 1e-6  0 1 1e-6  1 1 1e-6  1 0 1e-6"));
  EXPECT_TRUE(warned("quad grey 0.5 0 1e-7  0.5 2 1e-7  2 2 1e-7  2 0 1e-7")) << "in part";
  EXPECT_FALSE(warned("quad grey 0 0 1e-4  0 1 1e-4  1 1 1e-4  1 0 1e-4")) << "apart";
  EXPECT_FALSE(warned("quad grey 0 0 -1e-6  0 1 -1e-6  1 1 -1e-6  1 0 -1e-6")) << "back to back";
  EXPECT_FALSE(warned("quad grey 0 0 0  0 1 0  1 1 0  1 0 0")) << "two sides of one sheet";
  EXPECT_FALSE(warned("quad grey 2 0 1e-6  2 1 1e-6  3 1 1e-6  3 0 1e-6")) << "beside each other";
}

TEST(Check, CountsPolygonsInOnePlaneThatOverlap) {
  const TestFolder folder;
  const std::string head =
      "shodo 1\nunit m\ncamera main eye 0 5 0 look 0 0 0 up 0 0 1 fov 60\nmaterial grey diffuse 0.5\n"
      "object floor\n quad grey 0 0 0  0 0 4  4 0 4  4 0 0 patches 2 2 sub 1 1\n";
  const auto pairs = [&](const std::string& quads) {
    folder.write("x.scn", head + "object other\n" + quads + "light l sun towards 0 -1 0 illuminance 1\n");
    const Outcome check = run({"check", "x.scn"}, folder.path());
    EXPECT_EQ(check.status, 0) << check.err;
    const std::string before = "warning:   ";
    const std::size_t at = check.out.find(before);
    return at == std::string::npos ? 0 : std::stoi(check.out.substr(at + before.size()));
  };
  EXPECT_EQ(pairs(" quad grey 1 0 1  1 0 2  2 0 2  2 0 1 patches 1 1 sub 1 1\n"), 1) << "within";
  EXPECT_EQ(pairs(" quad grey 3 0 1  3 0 2  9 0 2  9 0 1 patches 1 1 sub 1 1\n"
                  " quad grey 4 0 1  4 0 2  9 0 3  9 0 1 patches 1 1 sub 1 1\n"),
            2)
      << "across the edge, and two that overlap outside";
  EXPECT_EQ(pairs(" quad grey 4 0 0  4 0 4  9 0 4  9 0 0 patches 1 1 sub 1 1\n"), 0) << "only an edge in common";
  EXPECT_EQ(pairs(" quad grey 1 0 1  2 0 1  2 0 2  1 0 2 patches 1 1 sub 1 1\n"), 0) << "back to back";
  EXPECT_EQ(pairs(" quad grey 1 1 1  1 1 2  2 1 2  2 1 1 patches 1 1 sub 1 1\n"), 0) << "another plane";
}

}  // namespace
}  // namespace shodo
