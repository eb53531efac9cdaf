// The first four stages together: a scene file's light, the rooms of CIE 171.
#include <cmath>

#include "light/direct.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {
namespace {

/// Lights the scene directly, then ambiently.
void light_both(AmbientScene& scene) {
  Intersector intersector(scene.geometry);
  const Status status = light_directly(scene.loaded.scene, scene.geometry, scene.patches, {}, intersector, {},
                                       scene.loaded.arena, scene.direct, scene.statistics);
  ASSERT_TRUE(status.done()) << to_text(status);
  scene.lux.assign(scene.direct.patch_lx.begin(), scene.direct.patch_lx.end());
  ASSERT_TRUE(scene.solve().done());
}

/// CIE 171 5.8: 10,000 lm, isotropic, in the centre of a closed cube of 4 m: I = 10,000 / 4 pi cd.
TEST(Rooms, ACubeLitFromItsCentreHasTheDirectAndTheIndirectLightOfCie171Case58) {
  const double rho[] = {.1, .5, .9, .95}, indirect[] = {11.57, 104.17, 937.50, 1979.17};
  for (int k = 0; k < 4; ++k) {
    std::string text = grey(rho[k]) + box_walls(4, 4, 4, 5, 5, 5, "white");
    for (std::size_t at = text.find("sub 1 1"); at != std::string::npos; at = text.find("sub 1 1", at + 1)) {
      text.replace(at, 7, "sub 3 3");
    }
    AmbientScene scene(text + "light lamp point at 2 2 2 intensity 795.7747154594767\n");
    light_both(scene);
    // The mean of direct light is 10,000 lm / 96 m2; sub-patches of 0.27 m, taken at their centres, have it to 2e-3.
    EXPECT_NEAR(scene.mean(false) - scene.mean(true), 10000.0 / 96, 2e-3 * 10000 / 96);
    EXPECT_NEAR(scene.mean(true), indirect[k], 4e-3 * indirect[k]) << rho[k];
  }
}

/// An area light that fills part of the hemisphere: the rows leave room for it, energy is conserved.
TEST(Rooms, ARoomWithALightInItsCeilingKeepsItsEnergy) {
  const double rho = 0.8;
  std::string text = grey(rho) + box_walls(4, 4, 3, 5, 5, 4, "white");
  for (std::size_t at = text.find("sub 1 1"); at != std::string::npos; at = text.find("sub 1 1", at + 1)) {
    text.replace(at, 7, "sub 2 2");
  }
  // 1 x 1 m of 1000 cd/m2, just below the ceiling: pi 1000 lm; it reflects nothing.
  AmbientScene scene(text + "light panel area quad 1.5 1.5 2.99 1.5 2.5 2.99 2.5 2.5 2.99 2.5 1.5 2.99"
                            " luminance 1000\n");
  light_both(scene);
  double absorbed = 0;
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    const double to_panel = static_cast<double>(scene.direct.light_form_factor[i]);
    // What a patch reflects goes on, but for the part that the panel swallows.
    absorbed += scene.patches[i].area * static_cast<double>(scene.direct.visible_area[i]) * scene.total(i) *
                (1 - rho + rho * to_panel);
  }
  EXPECT_NEAR(absorbed / (M_PI * 1000), 1, 0.02);
}

}  // namespace
}  // namespace shodo
