// Where segments to lights end.
#include "light/emitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "visibility/scenes.h"
#include "visibility/slow_twin.h"

namespace shodo {
namespace {

/// The emitters of a placed scene, one by one.
class Ends {
 public:
  Ends(const HandMadeScene& scene, const Emitter& emitter) : face_{emitter}, ends_(kAreaEnds), lattice_(kAreaEnds) {
    emitters_.faces = face_;
    emitters_.ends = ends_;
    emitters_.lattice_ends = lattice_;
    place_ends(scene.scene, scene.geometry, emitters_, 0, 0);
  }
  const Emitter& face() const { return face_[0]; }
  const Vec3& point(std::uint32_t k) const { return ends_[k].point; }
  std::span<const LatticePoint> lattice() const { return {lattice_.data(), face_[0].end_count}; }

 private:
  std::vector<Emitter> face_;
  std::vector<EmitterEnd> ends_;
  std::vector<LatticePoint> lattice_;
  Emitters emitters_;
};

/// The ends of a light of 2 w x 2 h about the middle of a cube; `turn`: its first corner.
struct Rectangle {
  Rectangle(double w, double h, std::uint32_t turn) {
    const Vec3 corner[4] = {{-w, -h, 0.5}, {-w, h, 0.5}, {w, h, 0.5}, {w, -h, 0.5}};
    scene.area_light(corner[turn % 4], corner[(turn + 1) % 4], corner[(turn + 2) % 4], corner[(turn + 3) % 4]);
    scene.place(20);
  }
  HandMadeScene scene;
};

using Places = std::vector<std::pair<double, double>>;

/// Whether both hold the same places but for rounding, in any order.
bool same(const Places& a, Places b) {
  for (const auto& at : a) {
    const auto found = std::find_if(b.begin(), b.end(), [&](const auto& other) {
      return std::fabs(at.first - other.first) < 1e-12 && std::fabs(at.second - other.second) < 1e-12;
    });
    if (found == b.end()) return false;
    b.erase(found);
  }
  return b.empty();
}

Places mirrored(const Places& places, int x, int y, bool swapped) {
  Places mirror;
  for (const auto& [u, v] : places) mirror.push_back(swapped ? std::pair{y * v, x * u} : std::pair{x * u, y * v});
  return mirror;
}

TEST(Emitter, EachSetOfEndsIsMappedOnItselfByMirrorImagesOfItsLight) {
  for (const double ratio : {1.0, 2.0, 3.5, 7.9, 8.5, 0.4, 0.2, 0.05}) {
    for (std::uint32_t turn = 0; turn < 4; ++turn) {
      Rectangle light(ratio, 1, turn);
      ASSERT_TRUE(light.scene.status.done());
      const Ends ends(light.scene, area_emitter(light.scene.scene, 0));
      Places first, second, all;
      for (std::uint32_t k = 0; k < kAreaEnds; ++k) {
        const std::pair<double, double> at{ends.point(k).x, ends.point(k).y};
        EXPECT_LT(std::fabs(at.first), ratio);
        EXPECT_LT(std::fabs(at.second), 1);
        all.push_back(at);
        if ((kFirstEnds >> k & 1) != 0) first.push_back(at);
        if ((kSecondEnds >> k & 1) != 0) second.push_back(at);
      }
      EXPECT_EQ(first.size(), 8u);
      EXPECT_EQ(second.size(), 8u);
      for (const Places& set : {first, second, all}) {
        for (const bool swapped : {false, true}) {
          if (swapped && ratio != 1) continue;
          EXPECT_TRUE(same(set, mirrored(set, -1, 1, swapped))) << ratio << ", " << turn;
          EXPECT_TRUE(same(set, mirrored(set, 1, -1, swapped))) << ratio << ", " << turn;
          EXPECT_TRUE(same(set, mirrored(set, 1, 1, swapped))) << ratio << ", " << turn;
        }
      }
    }
  }
}

TEST(Emitter, NoTwoOfASquaresEndsShareAColumnButMirrorImages) {
  Rectangle light(1, 1, 0);
  const Ends ends(light.scene, area_emitter(light.scene.scene, 0));
  std::vector<double> x;
  for (std::uint32_t k = 0; k < kAreaEnds; ++k) x.push_back(ends.point(k).x);
  std::sort(x.begin(), x.end());
  for (std::uint32_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], (2 * (k / 2) + 1.0) / 16 - 1, 1e-12);
}

TEST(Emitter, AnyPointOfAnAreaLightEndsInItsBox) {
  Random random(3);
  for (int k = 0; k < 400; ++k) {
    HandMadeScene scene;
    // Turned any way, or with level sides on a steep plane: there rounding moves ends most, of some but not of others.
    const double size = random.below(8) != 0 ? 1 : 1e-4;
    const auto any = [&] { return Vec3{random.signed_unit(), random.signed_unit(), random.signed_unit()}; };
    const bool level = k % 8 != 0;
    const double slope_x = 0.5 + 0.5 * random.unit(), slope_y = 0.5 + 0.5 * random.unit();
    const Vec3 a = any(), b = size * (level ? Vec3{slope_y, -slope_x, 0} : any()),
               d = size * (level ? Vec3{0.5, 0.5, -0.5 * (slope_x + slope_y)} : any());
    const std::uint32_t light = scene.area_light(a, a + b, a + b + d, a + d, random.below(2) == 0);
    scene.place(3.5 + 4 * random.unit());
    ASSERT_TRUE(scene.status.done());
    const Ends ends(scene, area_emitter(scene.scene, light));
    const Piece piece = emitter_piece(scene.scene, ends.face());
    for (int s = 0; s < 500; ++s) {
      const double s_at = random.unit(), t_at = random.below(8) != 0 ? random.below(2) : random.unit();
      const Vec3 at = piece.point(s_at, t_at);
      const LatticePoint end = segment_end(scene.scene, scene.geometry, ends.face(), at);
      EXPECT_TRUE(ends.face().whole.contains(end, 0)) << k;
    }
  }
}

/// A closed body of one object: a box turned, two that overlap, or a tetrahedron.
void body(HandMadeScene& scene, Random& random, int kind) {
  const Vec3 axis{random.signed_unit(), random.signed_unit(), 1.1};
  const double angle = kind == 0 ? 0 : 3 * random.signed_unit();
  if (kind < 3) {
    scene.box({-0.5, -0.5, -0.5}, {0.5, 0.1, 0.4});
    if (kind == 2) scene.box({-0.2, 0, 0}, {0.3, 0.7, 0.6});  // not convex
  } else {
    const Vec3 v[4] = {{0, 0, 0.8}, {0.8, 0, -0.3}, {-0.4, 0.7, -0.3}, {-0.4, -0.7, -0.3}};
    scene.triangle(v[0], v[1], v[2]);
    scene.triangle(v[0], v[2], v[3]);
    scene.triangle(v[0], v[3], v[1]);
    scene.triangle(v[1], v[3], v[2]);
  }
  if (kind > 0) scene.transform([&](const Vec3& p) { return turned(p, axis, angle); });
  scene.object();  // something beside it, before and behind
  scene.quad({-0.9, -0.9, 0.9}, {0.9, -0.9, 0.9}, {0.9, 0.9, 0.9}, {-0.9, 0.9, 0.9});
  scene.place(1);
}

TEST(Emitter, NoFacetOfItsOwnBlocksWhereAFaceSaysSo) {
  Random random(5);
  std::uint32_t said[4] = {}, blocked = 0;
  for (int k = 0; k < 200; ++k) {
    const int kind = k % 4;
    HandMadeScene scene;
    body(scene, random, kind);
    ASSERT_TRUE(scene.status.done());
    for (std::uint32_t m = 0; m + 1 < scene.scene.meshes.size(); ++m) {
      const Ends ends(scene, face_emitter(scene.scene, 0, m, 0));
      for (int s = 0; s < 40; ++s) {
        const double reach = random.below(2) == 0 ? 1 : 0.6;
        const LatticePoint sample = odd_point(
            scene.geometry.lattice, reach * Vec3{random.signed_unit(), random.signed_unit(), random.signed_unit()});
        bool any = false;
        for (const Triangle& t : scene.geometry.triangles) {
          if (t.object != 0) continue;
          for (const LatticePoint& end : ends.lattice()) any = any || twin::blocks_segment(t, sample, end);
        }
        LatticeBox box;
        box.include(sample);
        const bool miss = own_facets_miss(scene.geometry, ends.face(), box);
        EXPECT_FALSE(miss && any) << "kind " << kind << ", face " << m;
        said[kind] += miss ? 1 : 0;
        blocked += any ? 1 : 0;
      }
    }
  }
  for (const std::uint32_t times : said) EXPECT_GT(times, 500u);
  EXPECT_GT(blocked, 5000u);
}

}  // namespace
}  // namespace shodo
