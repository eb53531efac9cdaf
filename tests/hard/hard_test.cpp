// The hard cases, one test each. With SHODO_HARD_TABLE=FILE the table goes there as CSV, and to standard output.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "hard/hard_case.h"

namespace shodo::hard {
namespace {

const char* word(Outcome outcome) {
  return outcome == Outcome::kPass ? "pass" : outcome == Outcome::kRefused ? "refused" : "fail";
}

class HardTable : public testing::Test {
 protected:
  static void expect(int number) {
    for (const HardCase& hard : hard_cases()) {
      if (hard.number != number) continue;
      CaseResult& result = results()[static_cast<std::size_t>(number) - 1];
      result = hard.run();
      EXPECT_NE(result.outcome, Outcome::kFail) << hard.name << ": " << result.sentence;
      // What GoogleTest found wrong inside a case is a failure of the case.
      if (HasFailure() && result.outcome != Outcome::kFail) {
        result.outcome = Outcome::kFail;
        result.sentence = "an expectation failed within: " + result.sentence;
      }
      return;
    }
    FAIL() << "no such case";
  }

  static void TearDownTestSuite() {
    const char* const file = std::getenv("SHODO_HARD_TABLE");
    if (file == nullptr) return;
    std::ofstream csv(file);
    csv << "number,name,status,figure\n";
    for (const HardCase& hard : hard_cases()) {
      const CaseResult& result = results()[static_cast<std::size_t>(hard.number) - 1];
      std::printf("%2d  %-41s %-8s %10.3g  %s\n", hard.number, hard.name, word(result.outcome), result.figure,
                  result.sentence.c_str());
      csv << hard.number << ',' << hard.name << ',' << word(result.outcome) << ',' << say("%.6g", result.figure)
          << '\n';
    }
  }

  static std::array<CaseResult, 35>& results() {
    static std::array<CaseResult, 35> all = [] {
      std::array<CaseResult, 35> none;
      none.fill({Outcome::kFail, 0, "not run"});
      return none;
    }();
    return all;
  }
};

TEST_F(HardTable, TheTableHasAll35InOrder) {
  int number = 0;
  for (const HardCase& hard : hard_cases()) EXPECT_EQ(hard.number, ++number);
  EXPECT_EQ(number, 35);
}

TEST_F(HardTable, C01_ReflectanceNear1IsWithinTheRowsErrorAndTheBound) { expect(1); }
TEST_F(HardTable, C02_ReflectanceOf1IsRefused) { expect(2); }
TEST_F(HardTable, C03_SliversHaveTheRowSumsAndTheLightOfTheUncutWall) { expect(3); }
TEST_F(HardTable, C04_NothingLeaksThroughTJunctions) { expect(4); }
TEST_F(HardTable, C05_APictureInItsWallsPlaneIsLitAndSeenInAnyOrder) { expect(5); }
TEST_F(HardTable, C06_AQuadGivenTwiceIsLitTheSameOrFromItsOwnSide) { expect(6); }
TEST_F(HardTable, C07_BuriedPartsOfBoxesAreDarkAndLeakNothing) { expect(7); }
TEST_F(HardTable, C08_FarFromTheOriginNothingChanges) { expect(8); }
TEST_F(HardTable, C09_AtAnyScaleFormFactorsAreTheSame) { expect(9); }
TEST_F(HardTable, C10_PolygonsWithoutAreaAreCountedAndChangeNothing) { expect(10); }
TEST_F(HardTable, C11_AQuadWithARepeatedCornerIsTheTriangle) { expect(11); }
TEST_F(HardTable, C12_ALightOnASurfaceLightsItsOwnRoomOnly) { expect(12); }
TEST_F(HardTable, C13_ALightInAPatchsPlaneGivesItNothing) { expect(13); }
TEST_F(HardTable, C14_ALightOnASampleIsFiniteAndReported) { expect(14); }
TEST_F(HardTable, C15_APolygonSeenEdgeOnHasNoPixels) { expect(15); }
TEST_F(HardTable, C16_ADarkRoomAmidLightsIsExactlyDark) { expect(16); }
TEST_F(HardTable, C17_AThinWallKeepsDarkDarkAndLitLit) { expect(17); }
TEST_F(HardTable, C18_ACameraMayBeOnASurfaceOrInsideABox) { expect(18); }
TEST_F(HardTable, C19_PolygonsThroughTheEyesPlaneEqualTheTwin) { expect(19); }
TEST_F(HardTable, C20_SaddlesAndDartsHaveNoHolesAndBowTiesAreRefused) { expect(20); }
TEST_F(HardTable, C21_AHugePolygonCoversEveryPixelOnce) { expect(21); }
TEST_F(HardTable, C22_PolygonsBelowAPixelCoverEverySampleOnce) { expect(22); }
TEST_F(HardTable, C23_CornersBillionsOfPixelsAwayEqualTheTwin) { expect(23); }
TEST_F(HardTable, C24_ASheetOfTrianglesIsHitExactlyOnce) { expect(24); }
TEST_F(HardTable, C25_BadNumbersAreRefusedWithTheirLine) { expect(25); }
TEST_F(HardTable, C26_WithoutLightsAllIsBlackAndDone) { expect(26); }
TEST_F(HardTable, C27_BlackIsE0AndWhiteIsFinite) { expect(27); }
TEST_F(HardTable, C28_ClosedBoxesExchangeNothing) { expect(28); }
TEST_F(HardTable, C29_OnePatchHasItsE0) { expect(29); }
TEST_F(HardTable, C30_AHundredThousandPatchesFitOrAreRefusedBefore) { expect(30); }
TEST_F(HardTable, C31_MirroredHalvesHaveMirroredLight) { expect(31); }
TEST_F(HardTable, C32_TheOrderOfTheFileDoesNotMatter) { expect(32); }
TEST_F(HardTable, C33_ClosePlatesSeeEachOtherAndNeverMoreThanAll) { expect(33); }
TEST_F(HardTable, C34_ACorridorDarkensSteadily) { expect(34); }
TEST_F(HardTable, C35_SunThroughBarsLightsTheOpenPart) { expect(35); }

}  // namespace
}  // namespace shodo::hard
