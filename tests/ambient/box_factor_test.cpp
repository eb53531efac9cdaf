// Closed forms of rectangles along the axes, against the contour integral, which shares no code with them.
#include "ambient/box_factor.h"

#include "ambient/near_factor.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

/// A unit square of the floor and rectangles around it: opposed, shifted, at a common edge, and crossing its plane.
TEST(BoxFactor, IsTheContourIntegral) {
  const char* const others[] = {"0 0 1 0 1 1 1 1 1 1 0 1",     "0.3 0.7 0.25 0.3 2 0.25 1.9 2 0.25 1.9 0.7 0.25",
                                "1 0 0 1 0 1 1 1 1 1 1 0",     "1.5 0.2 -0.5 1.5 0.2 1 1.5 0.9 1 1.5 0.9 -0.5",
                                "-1 2 0.1 2 2 0.1 2 2 3 -1 2 3"};
  for (const char* const other : others) {
    AmbientScene scene(grey(0.5) + "object a\nquad white 0 0 0 1 0 0 1 1 0 0 1 0 patches 1 1 sub 1 1\n" +
                       "object b\nquad white " + other + " patches 1 1 sub 1 1\n");
    const double flat = 1e-9;
    NearPatch patch[2];
    AxisRectangle box[2];
    for (std::uint32_t k = 0; k < 2; ++k) {
      patch[k].piece = patch_piece(scene.loaded.scene, scene.loaded.scene.meshes[k], 0);
      patch[k].normal = scene.patches[k].normal;
      patch[k].area = scene.patches[k].area;
      box[k] = axis_rectangle(scene.patches[k].centre, scene.patches[k].normal, shape_of(patch[k].piece), flat);
      EXPECT_GE(box[k].axis, 0);
    }
    const NearFactor contour = near_factor(patch[0], patch[1], 1e-7, true, flat);
    EXPECT_GT(contour.exchange, 1e-3) << other;
    EXPECT_NEAR(box_exchange(box[0], box[1]), contour.exchange, contour.error + 1e-7) << other;
    EXPECT_NEAR(box_exchange(box[1], box[0]), box_exchange(box[0], box[1]), 1e-14);
  }
}

TEST(BoxFactor, RefusesWhatIsNoRectangleAlongTheAxesOrTooFar) {
  AmbientScene scene(grey(0.5) + "object a\nquad white 0 0 0 1 0 0.1 1 1 0.1 0 1 0 patches 1 1 sub 1 1\n" +
                     "quad white 0 0 0 1 0 0 1 1 0 0 1 0 patches 1 1 sub 1 1\n" +
                     "quad white 0 0 200 0 1 200 1 1 200 1 0 200 patches 1 1 sub 1 1\n");
  AxisRectangle box[3];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Piece piece = patch_piece(scene.loaded.scene, scene.loaded.scene.meshes[k], 0);
    box[k] = axis_rectangle(scene.patches[k].centre, scene.patches[k].normal, shape_of(piece), 1e-9);
  }
  EXPECT_LT(box[0].axis, 0);
  EXPECT_LT(box_exchange(box[0], box[1]), 0);
  EXPECT_LT(box_exchange(box[1], box[2]), 0);
}

}  // namespace
}  // namespace shodo
