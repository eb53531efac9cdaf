// Every sweep keeps within what doc/stability.md says. With SHODO_STABILITY=FOLDER plots and tables go there.
#include "hard/stability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "cli/report_document.h"
#include "hard/hard_case.h"

namespace shodo::hard {
namespace {

/// What is exact stands at the foot of a logarithmic axis.
constexpr double kFoot = 1e-17;

void write(const Sweep& sweep, const std::vector<SweepPoint>& points, const std::string& folder) {
  Plot plot;
  plot.title = sweep.title;
  plot.x_title = sweep.x_title;
  plot.y_title = sweep.y_title;
  plot.groups = {"shodo", sweep.textbook};
  std::ofstream csv(folder + "/stability-" + sweep.name + ".csv");
  csv << "x,shodo,textbook\n";
  for (const SweepPoint& point : points) {
    plot.points.push_back({point.x, std::max(point.ours, kFoot), 0, 0, false, say("%.3g", point.ours)});
    plot.points.push_back({point.x, std::max(point.textbook, kFoot), 0, 1, false, say("%.3g", point.textbook)});
    csv << say("%.4g,%.3g,%.3g\n", point.x, point.ours, point.textbook);
  }
  std::ofstream(folder + "/stability-" + sweep.name + ".svg") << svg_text(plot);
}

class Stability : public testing::Test {
 protected:
  static void expect(const std::string& name) {
    for (const Sweep& sweep : sweeps()) {
      if (name != sweep.name) continue;
      const std::vector<SweepPoint> points = sweep.run();
      ASSERT_GE(points.size(), 7u);
      double textbook = 0;
      for (const SweepPoint& point : points) {
        textbook = std::max(textbook, point.textbook);
        if (point.x < sweep.from || point.x > sweep.to) continue;
        EXPECT_LE(point.ours, sweep.allowed) << point.x;
      }
      // Else the sweep doesn't go where it is hard.
      EXPECT_GT(textbook, 5 * sweep.allowed);
      if (const char* const folder = std::getenv("SHODO_STABILITY")) write(sweep, points, folder);
      return;
    }
    FAIL() << "no such sweep";
  }
};

TEST_F(Stability, OverReflectancesFrom0To9999) { expect("reflectance"); }
TEST_F(Stability, OverDistancesOfPlates) { expect("plates"); }
TEST_F(Stability, OverThicknessesOfAWall) { expect("walls"); }
TEST_F(Stability, OverScales) { expect("scales"); }
TEST_F(Stability, OverOffsets) { expect("offsets"); }
TEST_F(Stability, OverSlivers) { expect("slivers"); }

}  // namespace
}  // namespace shodo::hard
