#include "map/triangle_spread.h"

#include "scene/mesh.h"

namespace shodo {

namespace {

constexpr double kBubbleMean = 0.45;  // of 27 a b c

/// Where the corners of a piece (u, v) lie, upright and inverted, in the order of scene/mesh.h.
constexpr std::uint32_t kCornerAt[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {0, 1}, {1, 0}}};

/// Row by row: row v has k + 1 - v corners.
std::uint32_t corner_index(std::uint32_t k, std::uint32_t u, std::uint32_t v) { return v * (2 * k + 3 - v) / 2 + u; }

struct Corners {
  std::uint32_t at[3];
};

/// The corners of a patch, in the order of scene/mesh.h.
Corners corners_of(std::uint32_t k, const PieceIndex& piece) {
  Corners corners{};
  for (std::uint32_t n = 0; n < 3; ++n) {
    const std::uint32_t(&corner)[2] = kCornerAt[piece.inverted ? 1 : 0][n];
    corners.at[n] = corner_index(k, piece.u + corner[0], piece.v + corner[1]);
  }
  return corners;
}

double mean_of(std::span<const double> corner, const Corners& c) {
  return (corner[c.at[0]] + corner[c.at[1]] + corner[c.at[2]]) / 3;
}

/// The value at a corner that is right for linear light: the mean of six patches inside, on a side the two upright
/// patches less the inverted one between them, at a tip its patch continued away from the one beside.
double linear_value(std::span<const double> patch, std::uint32_t k, std::uint32_t u, std::uint32_t v) {
  const auto upright = [&](std::uint32_t pu, std::uint32_t pv) {
    return patch[triangle_piece_order(k, {pu, pv, false})];
  };
  const auto inverted = [&](std::uint32_t pu, std::uint32_t pv) {
    return patch[triangle_piece_order(k, {pu, pv, true})];
  };
  if (k == 1) return patch[0];
  if (u == k) return 2 * upright(k - 1, 0) - inverted(k - 2, 0);
  if (v == k) return 2 * upright(0, k - 1) - inverted(0, k - 2);
  if (u == 0 && v == 0) return 2 * upright(0, 0) - inverted(0, 0);
  if (v == 0) return upright(u - 1, 0) + upright(u, 0) - inverted(u - 1, 0);
  if (u == 0) return upright(0, v - 1) + upright(0, v) - inverted(0, v - 1);
  if (u + v == k) return upright(u - 1, v) + upright(u, v - 1) - inverted(u - 1, v - 1);
  return (upright(u, v) + upright(u - 1, v) + upright(u, v - 1) + inverted(u - 1, v) + inverted(u, v - 1) +
          inverted(u - 1, v - 1)) / 6;
}

/// Between 0 and 1.5 times the darkest patch of each corner.
void limit(std::span<const double> patch, std::uint32_t k, std::span<double> corner, std::span<double> least) {
  for (double& value : least) value = -1;
  for (std::uint32_t p = 0; p < k * k; ++p) {
    for (const std::uint32_t at : corners_of(k, triangle_piece(k, p)).at) {
      if (least[at] < 0 || patch[p] < least[at]) least[at] = patch[p];
    }
  }
  for (std::size_t at = 0; at < corner.size(); ++at) {
    if (corner[at] < 0) corner[at] = 0;
    if (corner[at] > 1.5 * least[at]) corner[at] = 1.5 * least[at];
  }
}

struct Barycentric {
  double a, b, c;
};

Barycentric mix(const Barycentric& p, const Barycentric& q) {
  return {0.5 * (p.a + q.a), 0.5 * (p.b + q.b), 0.5 * (p.c + q.c)};
}

double bubble(const Barycentric& p) { return 27 * p.a * p.b * p.c; }

/// Mean of the bubble over a triangle: exact for cubics (1/20 a corner, 2/15 a side, 9/20 the centre).
double mean_bubble(const Barycentric (&p)[3], const Barycentric& centre) {
  const double corners = bubble(p[0]) + bubble(p[1]) + bubble(p[2]);
  const double sides = bubble(mix(p[0], p[1])) + bubble(mix(p[1], p[2])) + bubble(mix(p[2], p[0]));
  return corners / 20 + sides * (2.0 / 15) + bubble(centre) * 0.45;
}

/// A sub-patch's corners in its patch, which is divided `parts` times.
void sub_corners(const PieceIndex& sub, const PieceIndex& patch, std::uint32_t parts, Barycentric (&p)[3]) {
  for (std::uint32_t n = 0; n < 3; ++n) {
    const std::uint32_t(&corner)[2] = kCornerAt[sub.inverted ? 1 : 0][n];
    const double s = static_cast<double>(sub.u + corner[0] - patch.u * parts) / parts;
    const double t = static_cast<double>(sub.v + corner[1] - patch.v * parts) / parts;
    if (patch.inverted) {
      p[n] = {s + t - 1, 1 - s, 1 - t};
    } else {
      p[n] = {1 - s - t, s, t};
    }
  }
}

}  // namespace

void spread_triangle(std::span<const double> patch, std::uint32_t k, std::uint32_t parts, std::span<double> scratch,
                     std::span<double> result) {
  const std::uint32_t corners = triangle_scratch(k) / 2;
  const std::span<double> corner = scratch.subspan(0, corners);
  for (std::uint32_t v = 0; v <= k; ++v) {
    for (std::uint32_t u = 0; u + v <= k; ++u) corner[corner_index(k, u, v)] = linear_value(patch, k, u, v);
  }
  limit(patch, k, corner, scratch.subspan(corners, corners));
  for (std::uint32_t s = 0; s < k * parts * k * parts; ++s) {
    const PieceIndex sub = triangle_piece(k * parts, s);
    const std::uint32_t u = sub.u / parts, v = sub.v / parts;
    const bool beyond = sub.u % parts + sub.v % parts + (sub.inverted ? 1 : 0) >= parts;
    const PieceIndex whole{u, v, beyond};
    const Corners c = corners_of(k, whole);
    Barycentric p[3];
    sub_corners(sub, whole, parts, p);
    const Barycentric centre{(p[0].a + p[1].a + p[2].a) / 3, (p[0].b + p[1].b + p[2].b) / 3,
                             (p[0].c + p[1].c + p[2].c) / 3};
    const double lacking = patch[triangle_piece_order(k, whole)] - mean_of(corner, c);
    const double linear = centre.a * corner[c.at[0]] + centre.b * corner[c.at[1]] + centre.c * corner[c.at[2]];
    const double value = linear + lacking / kBubbleMean * mean_bubble(p, centre);
    result[s] = value > 0 ? value : 0;
  }
}

}  // namespace shodo
