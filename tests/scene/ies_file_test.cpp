// IES files: versions, symmetries, flux, and what is refused (contract 2; formats of LM-63).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/scene_from_text.h"

namespace shodo {
namespace {

constexpr double kPiHere = 3.14159265358979323846;

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += std::to_string(value) + " ";
  return text + "\n";
}

/// A file whose candelas are given by V and C in degrees. `head`: up to the line of TILT, `photometric`: the factor.
std::string ies(const std::vector<double>& v, const std::vector<double>& h,
                const std::function<double(double, double)>& candela, const std::string& head = "IESNA:LM-63-2002\n",
                const std::string& scales = "1", const std::string& factors = "1 1") {
  std::string text = head + "TILT=NONE\n2 3400 " + scales + " " + std::to_string(v.size()) + " " +
                     std::to_string(h.size()) + " 1 2 0.6 -0.2 0\n" + factors + " 58\n" + numbers(v) + numbers(h);
  for (const double c : h) {
    std::vector<double> row;
    for (const double a : v) row.push_back(candela(a, c));
    text += numbers(row);
  }
  return text;
}

std::vector<double> steps(double first, double last, double step) {
  std::vector<double> all;
  for (int k = 0; first + k * step <= last; ++k) all.push_back(first + k * step);
  return all;
}

const std::string kLight = "shodo 1\nlight l point at 0 0 0 towards 0 -1 0 ies a.ies\n";

LoadedScene load(const std::string& file) { return LoadedScene(kLight, {}, {{"a.ies", file}}); }

double cosine(double degrees) { return std::cos(degrees * kPiHere / 180); }

TEST(IesFile, ALambertianLuminaireHasTheFluxOfOneWhateverItsPlanes) {
  // I0 cos V (1 + w(C)), w without a mean over the circle: pi I0.
  const auto even = [](double v, double) { return 1000 * cosine(v); };
  const auto wavy = [](double v, double c) { return 1000 * cosine(v) * (1 + 0.4 * cosine(2 * c)); };
  const auto along = [](double v, double c) { return 1000 * cosine(v) * (1 + 0.4 * cosine(c)); };
  const std::vector<double> v = steps(0, 90, 5);
  for (const auto& [planes, candela] :
       {std::pair{steps(0, 0, 1), std::function<double(double, double)>(even)},
        {steps(0, 90, 15), wavy},
        {steps(0, 180, 15), along},
        {steps(90, 270, 15), wavy},
        {steps(0, 360, 15), along},
        {steps(0, 345, 15), along}}) {
    const LoadedScene s(kLight, {}, {{"a.ies", ies(v, planes, candela)}});
    const Luminaire& luminaire = s.scene.luminaires[0];
    // Chords of a cosine at steps of 5 degrees: 0.06 % below it.
    EXPECT_NEAR(luminaire.lumens / (1000 * kPiHere), 1, 0.003) << planes.size();
    EXPECT_EQ(luminaire.horizontal.back(), planes.back() == 345 ? 360 : planes.back());
  }
}

TEST(IesFile, ALightHasItsLargestIntensityAndTheExponentOfItsFlux) {
  const LoadedScene s = load(ies(steps(0, 90, 1), {0}, [](double v, double) { return 70 * std::pow(cosine(v), 3); }));
  EXPECT_EQ(s.scene.lights[0].strength, 70);
  EXPECT_NEAR(s.scene.lights[0].cosine_exponent, 3, 0.001);  // chords
  EXPECT_EQ(s.scene.lights[0].luminaire, 0u);
  EXPECT_EQ(s.scene.luminaires[0].light, 0u);
  const LoadedScene dark = load(ies({0, 90}, {0}, [](double, double) { return 0; }));
  EXPECT_EQ(dark.scene.lights[0].strength, 0);
  EXPECT_EQ(dark.scene.lights[0].cosine_exponent, 0);
}

TEST(IesFile, ThePhotometricFactorCountsInFilesOf1986And1991Only) {
  const auto flat = [](double, double) { return 100; };
  for (const auto& [head, old] : {std::pair{"", true},
                                  {"A luminaire of 1995\nIESNA:LM-63-2002\n", true},
                                  {"IES of nothing\n", true},
                                  {"IESNA91\n", true},
                                  {"IESNA:LM-63-1986\n", true},
                                  {"IESNA:LM-63-1991\n", true},
                                  {"IESNA:LM-63-1995\n", false},
                                  {"iesna: LM-63- 2002 \r\n", false},
                                  {"IESNA:LM-63-02\n[TEST] 1\n", false},
                                  {"IES:LM-63-2019, revised\n", false},
                                  {"\xef\xbb\xbfIES:LM-63-2019\n", false}}) {
    const LoadedScene s = load(ies({0, 90}, {0}, flat, head, "3", "0.5 0.25"));
    EXPECT_FLOAT_EQ(s.scene.luminaires[0].candela[0], old ? 37.5f : 150.0f) << head;
  }
}

TEST(IesFile, NumbersRunOverLinesBetweenBlanksAndCommas) {
  const LoadedScene s = load(
      "[MANUFAC] M\xfcller \x01\r\nTILT = none\r\n1,1000 , 2\r\n\r\n 3\t2 1\r\n1 -1 -1 .1e0,1.,1\r\n50\r\n0 45\r\n90,0 "
      "180\r\n1 2 3 1\r\n5\r\n6\r\nand what follows\r\n");
  const Luminaire& luminaire = s.scene.luminaires[0];
  ASSERT_EQ(luminaire.candela.size(), 6u);
  EXPECT_EQ(luminaire.vertical[1], 45);
  EXPECT_EQ(luminaire.horizontal[1], 180);
  EXPECT_EQ(luminaire.candela[1], 4);
  EXPECT_EQ(luminaire.candela[5], 12);
  EXPECT_FALSE(luminaire.tilted || luminaire.poles_differ);
}

TEST(IesFile, ATiltIsPassedOverAndNoFileIsOpenedThatItNames) {
  const std::string rest = "1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n7 8\n";
  for (const std::string tilt : {"TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n", "TILT=lamp.tlt\n"}) {
    const LoadedScene s(kLight, {}, {{"a.ies", tilt + rest}});
    EXPECT_EQ(s.scene.luminaires[0].candela[1], 8);
    EXPECT_TRUE(s.scene.luminaires[0].tilted);
  }
}

TEST(IesFile, AlongTheAxisTheMeanOverTheHalfPlanesCounts) {
  // At 0, 90, 180, 270: 1, 2, 3, 6 cd below; the plane at 360 is the one at 0.
  const auto below = [](double v, double c) { return v == 0 ? (c == 270 ? 6 : 1 + c / 90) : 5; };
  const LoadedScene s = load(ies({0, 90}, {0, 90, 180, 270}, below));
  const Luminaire& luminaire = s.scene.luminaires[0];
  ASSERT_EQ(luminaire.candela.size(), 10u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_FLOAT_EQ(luminaire.candela[2 * k], 3) << k;
  EXPECT_TRUE(luminaire.poles_differ);
  // Above, of unequal steps: each counts for half of the angle between its neighbours.
  const auto above = [](double v, double c) { return v == 180 ? (c == 0 ? 10 : c == 45 ? 20 : 40) : 1; };
  const LoadedScene up = load(ies({90, 180}, {0, 45, 180}, above));
  EXPECT_FLOAT_EQ(up.scene.luminaires[0].candela[1], static_cast<float>((10 * 22.5 + 20 * 90 + 40 * 67.5) / 180));
  const LoadedScene close = load(ies({0, 90}, {0, 90}, [](double v, double c) { return v == 0 ? 100 + c / 100 : 0; }));
  EXPECT_FALSE(close.scene.luminaires[0].poles_differ);
  EXPECT_FLOAT_EQ(close.scene.luminaires[0].candela[2], 100.45f);
}

TEST(IesFile, LuminairesOfOneFileShareItsTable) {
  const std::string two = kLight + "light m point at 1 0 0 towards 1 0 0 turn 30 ies ./x/../a.ies\n";
  const LoadedScene s(two, {}, {{"a.ies", ies({0, 90}, {0, 90}, [](double, double c) { return 1 + c; })}});
  ASSERT_EQ(s.scene.luminaires.size(), 2u);
  EXPECT_EQ(s.scene.luminaires[0].candela.data(), s.scene.luminaires[1].candela.data());
  EXPECT_EQ(s.scene.luminaires[1].light, 1u);
  EXPECT_EQ(s.scene.lights[1].strength, 91);
  EXPECT_NE(s.scene.luminaires[0].along, s.scene.luminaires[1].along);
}

TEST(IesFile, TooSmallAnArenaIsToldWithWhatWouldDo) {
  const TestFiles files{{"a.ies", ies(steps(0, 90, 1), steps(0, 360, 2), [](double, double) { return 1; })}};
  const TestScene small(kLight, {}, files, 2000);
  EXPECT_EQ(small.status.code, StatusCode::kMemory);
  EXPECT_GT(small.status.bytes_needed, std::uint64_t{4 * 91 * 181});
  const TestScene enough(kLight, {}, files, small.status.bytes_needed);
  EXPECT_TRUE(enough.status.done()) << to_text(enough.status);
}

struct Refusal {
  std::string file;
  std::string place, message;
};

TEST(IesFile, WhatIsNotOneIsRefusedWithItsPlace) {
  const std::string head = "IESNA91\nTILT=NONE\n";
  const std::string good = head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n0 90\n1 2 3 4\n";
  ASSERT_TRUE(TestScene(kLight, {}, {{"a.ies", good}}).status.done());
  for (const auto& [file, place, message] : {
           Refusal{"", "1:1", "expected a line with TILT= in an IES file, found the end of the file"},
           {"IESNA91\n[TEST]\n", "3:1", "TILT="},
           {head, "3:1", "expected a number (lamps), found the end of the file"},
           {head + "one", "3:1", "expected a number (lamps), found 'one'"},
           {head + "1 1 -2", "3:5", "from 0 to 1e+30 (multiplier of candelas), found '-2'"},
           {head + "1 1 1 0", "3:7", "from 1 to 65535 (vertical angles), found '0'"},
           {head + "1 1 1 2.5", "3:7", "expected a whole number, found '2.5'"},
           {head + "1 1 1 2 1e9", "3:9", "from 1 to 65535 (horizontal angles)"},
           {head + "1 1 1 2 2 2", "3:11", "expected photometry of type 1 (C), as types 2 (B) and 3 (A) are not read"},
           {head + "1 1 1 2 2 3", "3:11", "photometry of type 1"},
           {head + "1 1 1 2 2 4", "3:11", "from 1 to 3 (photometric type)"},
           {head + "1 1 1 2 2 1 3", "3:13", "(units, 1 feet or 2 metres)"},
           {head + "1 1 1 2 2 1 1 0 0 nan", "3:19", "(height), found 'nan'"},
           {head + "1 1 1 2 2 1 1 0 0 0\n-1", "4:1", "(ballast factor)"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 -1", "4:3", "from 0 to 1e+30 (photometric factor), found '-1'"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n-90 90", "5:1", "from 0 to 180 (vertical angle)"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n5 90", "5:1", "expected a first vertical angle of 0 or 90, found '5'"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 80", "5:3", "expected a last vertical angle of 90 or 180"},
           {head + "1 1 1 1 2 1 1 0 0 0\n1 1 1\n90", "5:1", "expected a last vertical angle of 90 or 180"},
           {head + "1 1 1 3 2 1 1 0 0 0\n1 1 1\n0 45\n45", "6:1", "expected angles that ascend, found '45'"},
           {head + "1 1 1 3 2 1 1 0 0 0\n1 1 1\n0 89.9999999 90", "5:14", "angles that ascend, found '90'"},
           {head + "1 1 1 2 3 1 1 0 0 0\n1 1 1\n0 90\n0 60 60.0000001", "6:6", "expected angles that ascend"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n0 400", "6:3", "from 0 to 360 (horizontal angle)"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n0 0", "6:3", "angles that ascend"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n0 120", "6:3", "a last horizontal angle of 0, 90, 180 or 360"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n90 200", "6:4", "expected horizontal angles from 0, or from 90"},
           {head + "1 1 1 2 3 1 1 0 0 0\n1 1 1\n0 90\n0 90 200", "6:6", "a last horizontal angle of"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n10 90", "6:4", "expected horizontal angles from 0, or from 90"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n0 90\n1 2\n3", "8:2", "expected 4 candelas (2 x 2), found 3"},
           {head + "1 1 1 65535 65535 1 1 0 0 0\n1 1 1\n0 90", "5:5", "(vertical angle), found the end of the file"},
           {head + "1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n0 90\n1 2 -3 4", "7:5", "an intensity from 0 to 1e30 cd"},
           {head + "1 1 1e20 2 2 1 1 0 0 0\n1 1 1\n0 90\n0 90\n1 1e11 3 4", "7:3", "from 0 to 1e30 cd, found '1e11'"},
           {"TILT=INCLUDE\n4", "2:1", "(lamp's geometry, 1 to 3)"},
           {"TILT=INCLUDE\n1\n2\n0 90 1 x", "4:8", "(factor of a tilt), found 'x'"},
       }) {
    const TestScene s(kLight, {}, {{"a.ies", file}});
    EXPECT_EQ(s.status.code, StatusCode::kScene) << file;
    EXPECT_TRUE(to_text(s.status).starts_with("a.ies:" + place + ": ")) << to_text(s.status) << " for " << file;
    EXPECT_NE(std::string(s.status.message).find(message), std::string::npos) << to_text(s.status);
  }
}

TEST(IesFile, OneThatCannotBeReadIsToldWhereItIsNamed) {
  const TestScene s("shodo 1\ninclude sub/b.scn\n", {},
                    {{"a.ies", ies({0, 90}, {0}, [](double, double) { return 1; })},
                     {"sub/b.scn", "\nlight l point at 0 0 0 towards 1 0 0 ies ../a.ies\n"
                                   "light m point at 0 0 0 towards 1 0 0 ies none.ies\n"}});
  EXPECT_EQ(s.status.code, StatusCode::kFile);
  EXPECT_EQ(to_text(s.status), "sub/b.scn:3:42: expected an IES file that can be read, found sub/none.ies");
}

}  // namespace
}  // namespace shodo
