// The part of an exchange that is visible, where samples are few: across a plane, through panes.
#include "ambient/visible_fraction.h"

#include <string>

#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

const std::string kHead =
    "shodo 1\nmaterial white diffuse 0.5\nmaterial glass diffuse 0 transmit 0.6\n"
    "object floor\nquad white 0 0 0  1 0 0  1 1 0  0 1 0 patches 1 1 sub 1 1\n";

TEST(VisibleFraction, OfAPatchOfWhichNoSampleIsInFrontIsNothing) {
  // A wall that stands a hundredth above the floor and reaches a metre below: the contour integral has an exchange, but
  // no sample of the wall is over the floor, so nothing is known to be seen. With a pane, and whatever the segments.
  const std::string wall = "object wall\nquad white 0 0 -1  0 1 -1  0 1 0.01  0 0 0.01 patches 1 1 sub 1 1\n";
  const std::string pane = "object pane\nquad glass 0.2 0 -1  0.2 1 -1  0.2 1 1  0.2 0 1 patches 1 1 sub 1 1\n";
  for (const std::string& more : {std::string(), pane}) {
    for (const std::uint32_t segments : {1u, 4u, 8u, 16u, 64u}) {
      Options options;
      options.segments_first = options.segments_mixed = segments;
      options.scale_rows = false;
      AmbientScene scene(kHead + wall + more, options);
      const StoredMatrix stored(scene);
      EXPECT_EQ(stored.form_factor(0, 1), 0) << segments;
    }
  }
}

TEST(VisibleFraction, ThroughAPaneIsWhatItTransmitsWhateverTheSegments) {
  const std::string ceiling = "object ceiling\nquad white 0 0 1  0 1 1  1 1 1  1 0 1 patches 1 1 sub 1 1\n";
  const std::string pane = "object pane\nquad glass -3 -3 0.5  4 -3 0.5  4 4 0.5  -3 4 0.5 patches 1 1 sub 1 1\n";
  for (const std::uint32_t segments : {1u, 4u, 8u, 16u, 32u, 64u, 128u, 256u}) {
    Options options;
    options.segments_first = options.segments_mixed = segments;
    options.scale_rows = false;
    AmbientScene plain(kHead + ceiling, options), behind(kHead + ceiling + pane, options);
    const StoredMatrix free(plain), weakened(behind);
    EXPECT_GT(free.form_factor(0, 1), 0.19);
    // To the rounding of stored values, twice.
    EXPECT_NEAR(weakened.form_factor(0, 1), 0.6 * free.form_factor(0, 1), 2 * 0x1p-12 * 0.2) << segments;
  }
}

TEST(VisibleFraction, HalfBehindAPaneIsBetweenWhateverTheSegments) {
  const std::string ceiling = "object ceiling\nquad white 0 0 1  0 1 1  1 1 1  1 0 1 patches 1 1 sub 1 1\n";
  const std::string pane = "object pane\nquad glass -3 -3 0.5  0.5 -3 0.5  0.5 4 0.5  -3 4 0.5 patches 1 1 sub 1 1\n";
  for (const auto& [first, mixed] : {std::pair{4u, 4u}, {16u, 16u}, {16u, 64u}, {64u, 64u}}) {
    Options options;
    options.segments_first = first;
    options.segments_mixed = mixed;
    options.scale_rows = false;
    AmbientScene plain(kHead + ceiling, options), behind(kHead + ceiling + pane, options);
    const StoredMatrix free(plain), weakened(behind);
    // Half of the light passes it; segments that meet its edge are free.
    EXPECT_GT(weakened.form_factor(0, 1), 0.75 * free.form_factor(0, 1)) << first << ", " << mixed;
    EXPECT_LT(weakened.form_factor(0, 1), 0.9 * free.form_factor(0, 1)) << first << ", " << mixed;
  }
}

TEST(VisibleFraction, OfUnevenPatchesTheMiddleTierIsTheContourIntegral) {
  // A floor that narrows to a fifth: its Gauss points' weights follow. Far enough apart for the middle tier.
  const std::string narrowing = "shodo 1\nmaterial white diffuse 0.5\nobject floor\n"
                                "quad white 0 0 0  1 0 0  0.6 1 0  0.4 1 0 patches 1 1 sub 1 1\n"
                                "object wall\nquad white 0 3 0.2  1 3 0.2  1 3 1.2  0 3 1.2 patches 1 1 sub 1 1\n";
  Options near, middle;
  near.scale_rows = middle.scale_rows = false;
  near.row_value_bits = middle.row_value_bits = 64;
  near.tiers = 0;
  middle.tiers = 0.02;
  AmbientScene exact(narrowing, near), quick(narrowing, middle);
  const StoredMatrix truth(exact), found(quick);
  EXPECT_GT(truth.form_factor(0, 1), 1e-3);
  EXPECT_NEAR(found.form_factor(0, 1), truth.form_factor(0, 1), 0.01 * truth.form_factor(0, 1));
}

std::string quad_of(const std::string& name, std::initializer_list<Vec3> corners) {
  std::string text = "object " + name + "\nquad white";
  for (const Vec3& c : corners) {
    for (const double x : {c.x, c.y, c.z}) text += " " + std::to_string(x);
  }
  return text + " patches 1 1 sub 1 1\n";
}

TEST(VisibleFraction, OfAnUnevenPatchWhoseWideHalfIsHiddenIsThePartThatIsLeft) {
  // A patch that narrows to a fifth, its wide half, two thirds of its area, under a screen. Once it ends farther along
  // x than the other patch and once not, which is what their order goes by.
  const std::string floor = kHead.substr(0, kHead.find("object")) +
                            quad_of("narrowing", {{0, 0, 0}, {1, 0, 0}, {0.6, 1, 0}, {0.4, 1, 0}});
  const std::string screen = quad_of("screen", {{-1, -1, 0.02}, {2, -1, 0.02}, {2, 0.5, 0.02}, {-1, 0.5, 0.02}});
  for (const double x : {-0.05, 0.95}) {
    const std::string both = floor + quad_of("other", {{x, 0, 3}, {x, 0.1, 3}, {x + 0.1, 0.1, 3}, {x + 0.1, 0, 3}});
    Options options;
    options.scale_rows = false;
    AmbientScene open(both, options), hidden(both + screen, options);
    const double visible = StoredMatrix(hidden).form_factor(0, 1) / StoredMatrix(open).form_factor(0, 1);
    EXPECT_NEAR(visible, 1.0 / 3, 0.03) << x;
  }
}

}  // namespace
}  // namespace shodo
