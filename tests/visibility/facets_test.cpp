// Facets that fill their box, square to an axis, are decided without their triangles: against the triangles, tried one
// by one in 128 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "scenes.h"
#include "slow_twin.h"

namespace shodo {
namespace {

Triangle make(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  Triangle t;
  t.a = a;
  t.b = b;
  t.c = c;
  t.object = 0;
  t.n = cross(b - a, c - a);
  t.d = t.n.x * a.x + t.n.y * a.y + t.n.z * a.z;
  return t;
}

/// One polygon of two triangles, and an intersector that tries it in every aim.
class OneFacet {
 public:
  OneFacet(const Triangle& first, const Triangle& second)
      : triangles_{first, second}, arena_(memory_, sizeof memory_), intersector_(geometry_, scene_, FlagMode::kAuto) {
    geometry_.triangles = triangles_;
    geometry_.cells = cells_;
    scene_.objects = objects_;
    EXPECT_TRUE(intersector_.start(arena_));
    cube_.include(LatticePoint{-kLatticeHalf, -kLatticeHalf, -kLatticeHalf});
    cube_.include(LatticePoint{kLatticeHalf, kLatticeHalf, kLatticeHalf});
  }
  OneFacet(const OneFacet&) = delete;
  bool blocks(const LatticePoint& p, const LatticePoint& q) {
    return intersector_.blocked(p, q, {}, intersector_.aim(cube_, cube_, {}));
  }
  bool blocks_along(const LatticePoint& p, const LatticeVector& d) {
    return intersector_.ray_blocked(p, d, {}, intersector_.aim(cube_, cube_, {}));
  }
  bool rectangle() { return intersector_.facets()[0].rectangle != 0; }

 private:
  std::array<Triangle, 2> triangles_;
  std::array<PolygonTriangles, 1> cells_{PolygonTriangles{0, 2}};
  std::array<Object, 1> objects_;
  alignas(8) std::byte memory_[4096];
  Arena arena_;
  Scene scene_;
  Geometry geometry_;
  Intersector intersector_;
  LatticeBox cube_;
};

enum Kind { kRectangle, kBent, kSameHalfTwice, kBow, kBetween, kLine, kKinds };

struct Case {
  Triangle first, second;
  std::int32_t plane, u[2], v[2];
  std::uint32_t axis;

  LatticePoint at(std::int32_t w, std::int32_t a, std::int32_t b) const {
    return axis == 0 ? LatticePoint{w, a, b} : axis == 1 ? LatticePoint{b, w, a} : LatticePoint{a, b, w};
  }
};

/// Square to an axis. Corners counted from any of them, either way round.
Case make_case(Random& random, Kind kind) {
  const std::int32_t reach = random.below(2) == 0 ? 20 : kLatticeHalf / 2 - 8;
  const auto even = [&] { return 2 * random.between(-reach, reach); };
  Case c{};
  c.axis = random.below(3);
  c.plane = even();
  for (std::int32_t(*side)[2] : {&c.u, &c.v}) {
    (*side)[0] = even();
    do (*side)[1] = even();
    while ((*side)[1] == (*side)[0]);
    std::sort(*side, *side + 2);
  }
  if (kind == kLine) c.v[1] = c.v[0];
  LatticePoint corner[4];
  const std::uint32_t start = random.below(4);
  const bool back = random.below(2) != 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t n = (back ? start + 4 - k : start + k) % 4;
    corner[k] = c.at(c.plane, c.u[n == 1 || n == 2 ? 1 : 0], c.v[n >= 2 ? 1 : 0]);
  }
  if (kind == kBent) corner[2] = c.at(c.plane, c.u[0] + (c.u[1] - c.u[0]) / 4 * 2, c.v[0] + (c.v[1] - c.v[0]) / 4 * 2);
  c.first = make(corner[0], corner[1], corner[2]);
  c.second = kind == kSameHalfTwice ? make(corner[1], corner[2], corner[0])
             : kind == kBow         ? make(corner[0], corner[1], corner[3])
             : kind == kBetween     ? make(corner[2], corner[2], corner[0])
                                    : make(corner[0], corner[2], corner[3]);
  return c;
}

/// Through a place on the border, on the diagonals, a step beside it, or anywhere; sometimes starting in the plane.
void aim(Random& random, const Case& c, LatticePoint& p, LatticePoint& q) {
  const auto on = [&](const std::int32_t(&side)[2]) {
    const std::uint32_t kind = random.below(4);
    return kind < 2 ? side[kind] + random.between(-1, 1) : random.between(side[0] - 2, side[1] + 2);
  };
  std::int32_t u = on(c.u), v = on(c.v);
  if (random.below(4) == 0) {
    u = (c.u[0] + c.u[1]) / 2;
    v = (c.v[0] + c.v[1]) / 2;
  }
  for (int attempt = 0; attempt < 50; ++attempt) {
    const std::int32_t reach = attempt < 25 && random.below(2) == 0 ? 5000 : 7;
    const std::int32_t du = random.between(-reach, reach), dv = random.between(-reach, reach),
                       dw = random.below(12) == 0 ? 0 : random.between(-reach, reach);
    const std::int32_t m = random.between(1, 3), n = random.between(0, 3);
    p = c.at(c.plane - m * dw, u - m * du, v - m * dv);
    q = c.at(c.plane + n * dw, u + n * du, v + n * dv);
    const auto inside = [](const LatticePoint& x) {
      return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) <= kLatticeHalf;
    };
    if (inside(p) && inside(q)) return;
  }
  p = q = c.at(c.plane, u, v);
}

TEST(Facets, SquareToAnAxisBlockWhatTheirTrianglesBlock) {
  Random random(1);
  std::uint64_t mismatches = 0, blocked[kKinds] = {};
  for (int k = 0; k < 6000; ++k) {
    const Kind kind = static_cast<Kind>(k % kKinds);
    const Case c = make_case(random, kind);
    OneFacet facet(c.first, c.second);
    EXPECT_EQ(facet.rectangle(), kind == kRectangle);
    for (int s = 0; s < 60; ++s) {
      LatticePoint p, q;
      aim(random, c, p, q);
      const bool expected = twin::blocks_segment(c.first, p, q) || twin::blocks_segment(c.second, p, q);
      mismatches += facet.blocks(p, q) != expected ? 1 : 0;
      blocked[kind] += expected ? 1 : 0;
      const Vec3 way{static_cast<double>(q.x) - p.x, static_cast<double>(q.y) - p.y, static_cast<double>(q.z) - p.z};
      if (way == Vec3{}) continue;
      const LatticeVector direction = lattice_direction(way);
      const bool along = twin::blocks_ray(c.first, p, direction) || twin::blocks_ray(c.second, p, direction);
      mismatches += facet.blocks_along(p, direction) != along ? 1 : 0;
    }
  }
  EXPECT_EQ(mismatches, 0u);
  // The cases are not all easy ones: 60 000 segments of each kind.
  for (const Kind kind : {kRectangle, kBent, kSameHalfTwice, kBow, kBetween}) EXPECT_GT(blocked[kind], 3000u) << kind;
  EXPECT_EQ(blocked[kLine], 0u);
}

}  // namespace
}  // namespace shodo
