// Lights that send a sub-patch next to nothing of their flux: how they are told, and what is asked of them.
#include <gtest/gtest.h>

#include <cmath>

#include "light/lit_scene.h"
#include "light/sources.h"

namespace shodo {
namespace {

/// Sums of the shares of light 0 over all sub-patches, as if all were far.
struct Shares {
  double points = 0, faces = 0;
};

Shares shares_of(LitScene& scene) {
  Intersector intersector(scene.geometry);
  Sources sources(scene.scene, scene.geometry, intersector, scene.options.tiers);
  EXPECT_TRUE(sources.prepare(scene.arena).done());
  Shares sum;
  for (const Mesh& mesh : scene.scene.meshes) {
    if (mesh.object == scene.scene.lights[0].object && scene.scene.lights[0].kind == LightKind::kPolyhedron) continue;
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const Piece piece = sub_patch_piece(scene.scene, mesh, k);
      Receiver receiver;
      receiver.normal = normalised(piece.vector_area());
      receiver.anchor = piece.corner[0];
      const SubPatchView view{&receiver, piece.centre(), length(piece.corner[0] - piece.centre())};
      const double area = length(piece.vector_area());
      if (scene.scene.lights[0].kind == LightKind::kPoint) {
        sum.points += sources.point_share(0, view.centre, sources.point_lux_at(0, receiver, view.centre), area);
      } else {
        const double squared = sources.share_squared(0, view, area, 1);
        EXPECT_LT(squared, 1);
        sum.faces += std::sqrt(squared);
      }
    }
  }
  return sum;
}

TEST(WeakLight, SharesOfAPointLightAddUpToItsFluxWhateverItsDistributionLawAndUnit) {
  for (const double exponent : {-1.0, 0.0, 1.0, 7.0}) {
    for (const bool linear : {false, true}) {
      LitScene scene;
      scene.room({0, 0, 0}, {4, 5, 3}, 8, 3);
      scene.add_point({2.1, 2.4, 1.7}, 70, [=](Light& light) {
        light.aimed = exponent >= 0;
        light.towards = normalised(Vec3{1, 2, -1});
        light.cosine_exponent = exponent;
        if (linear) light.attenuation[1] = 0.7;
      });
      scene.light();
      EXPECT_NEAR(shares_of(scene).points, 1, 0.01) << exponent;
    }
  }
}

/// Not much too little, and at most twice too much.
TEST(WeakLight, SharesOfAreaLightsAndPolyhedraAreRoughlyTheirFlux) {
  LitScene area;
  area.room({0, 0, 0}, {4, 5, 3}, 8, 3);
  area.add_area({2, 2, 1.5}, {2, 2.2, 1.5}, {2.2, 2.2, 1.5}, {2.2, 2, 1.5}, 900);
  area.light();
  const double of_area = shares_of(area).faces;
  EXPECT_GT(of_area, 0.97);
  EXPECT_LT(of_area, 2);
  LitScene solid;
  solid.room({0, 0, 0}, {4, 5, 3}, 8, 3);
  const std::uint32_t lamp = solid.object();
  solid.box({2, 2, 1.4}, {2.2, 2.2, 1.6});
  solid.add_polyhedron(lamp, {2.1, 2.1, 1.5}, 900);
  solid.light();
  const double of_solid = shares_of(solid).faces;
  EXPECT_GT(of_solid, 0.97);
  EXPECT_LT(of_solid, 2);
}

/// A box stands on the middle of a sub-patch; the rest of it is lit.
TEST(WeakLight, WhereTheCentreIsCoveredOtherSamplesAreAsked) {
  for (const int kind : {0, 1, 2}) {
    double lux[2] = {0, 0};
    for (const bool covered : {false, true}) {
      LitScene scene;
      const std::uint32_t floor = scene.quad({-6, -6, 0}, {6, -6, 0}, {6, 6, 0}, {-6, 6, 0}, 15, 15, 3, 3);
      if (covered) scene.box({-0.04, -0.04, 0}, {0.04, 0.04, 0.05});
      if (kind == 0) scene.add_point({0.3, 0, 6}, 500);
      if (kind == 1) scene.add_area({0, -0.2, 6}, {0, 0.2, 6}, {0.4, 0.2, 6}, {0.4, -0.2, 6}, 900);
      if (kind == 2) {
        const std::uint32_t lamp = scene.object();
        scene.box({0, -0.2, 6}, {0.4, 0.2, 6.3});
        scene.add_polyhedron(lamp, {0.2, 0, 6.15}, 900);
      }
      scene.light();
      lux[covered ? 1 : 0] = scene.lux(floor, 22, 22);
    }
    EXPECT_GT(lux[0], 1);
    EXPECT_GT(lux[1], 0.8 * lux[0]) << kind;
    EXPECT_LT(lux[1], 1.01 * lux[0]) << kind;
  }
}

}  // namespace
}  // namespace shodo
