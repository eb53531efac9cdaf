#include "light/point_source.h"

#include "light/distribution.h"
#include "light/quad_cell.h"

namespace shodo {

namespace {

/// A sub-patch is near if the light is within this many of its diagonals (more for a narrow distribution).
constexpr double kNear = 2.5;
/// A cell's diagonal over its distance, at most, for an isotropic light.
constexpr double kCellAngle = 0.5;
constexpr std::uint32_t kDepth = 16;
constexpr double kFaint = 1.0 / 1024;

/// Of the diagonals, and one side, since a triangle's last two corners are one.
double size_squared(const Vec3* corner) {
  double largest = length_squared(corner[1] - corner[0]);
  const double a = length_squared(corner[2] - corner[0]), b = length_squared(corner[3] - corner[1]);
  if (a > largest) largest = a;
  return b > largest ? b : largest;
}

/// Half the solid angle of a triangle given from the point; negative if it runs clockwise.
double half_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double product = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return arctangent2(dot(a, cross(b, c)), product);
}

/// Corners of cells seen from a light. A triangle is a quadrilateral two corners of which are one.
class CellCorners {
 public:
  CellCorners(const Piece& whole, const Vec3& eye) : whole_(whole), eye_(eye), from_(whole.corner[0] - eye) {
    side_s_ = whole.corner[1] - whole.corner[0];
    side_t_ = whole.corner[3] - whole.corner[0];
    const Vec3 rest = (whole.corner[2] - whole.corner[3]) - side_s_;
    affine_ = length_squared(rest) <= kParallel * kParallel * length_squared(side_s_);
  }
  void find(const QuadCell& cell, Vec3* corner) const {
    const double size = cell.size(), s = size * cell.x, t = size * cell.y;
    if (affine_) {
      const Vec3 along_s = size * side_s_, along_t = size * side_t_;
      corner[0] = from_ + (s * side_s_ + t * side_t_);
      corner[1] = corner[0] + along_s;
      corner[2] = corner[1] + along_t;
      corner[3] = corner[0] + along_t;
      return;
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
      corner[k] = whole_.point(s + (k == 1 || k == 2 ? size : 0), t + (k >= 2 ? size : 0)) - eye_;
    }
  }

 private:
  /// Sides that differ by less, of their length, do so by rounding.
  static constexpr double kParallel = 0x1p-40;

  const Piece& whole_;
  Vec3 eye_, from_, side_s_, side_t_;
  bool affine_ = false;
};

}  // namespace

PointLux point_lux(const Scene& scene, const Light& light, const Receiver& receiver, const Vec3& point, double step) {
  const double height = receiver.height(light.position);
  if (!(height > 0)) return {};
  const Vec3 away = point - light.position;
  double distance = length(away);
  // Straight below, d is the height but for rounding; on the sample itself it may come out as 0.
  const double cosine = height < distance ? height / distance : 1;
  const double candela = intensity(scene, light, away, distance);
  const bool clamped = distance < step;
  if (clamped) distance = step;
  return {candela * cosine * attenuation(light, distance * scene.metres_per_unit), clamped};
}

bool is_faint(const Scene& scene, const Light& light, const Vec3& point, double lux) {
  if (!light.aimed && light.luminaire == kNone) return false;
  const double metres = length(point - light.position) * scene.metres_per_unit;
  return lux < kFaint * (light.strength * attenuation(light, metres));
}

bool near_point(const Light& light, const Receiver& receiver, const Piece& piece, double step) {
  // A light within a step of the plane lies on the surface: half its flux would go into the point below it.
  if (receiver.height(light.position) < step) return false;
  const double reach = kNear + square_root(exponent_of(light));
  return length_squared(piece.centre() - light.position) < reach * reach * size_squared(piece.corner);
}

double near_point_mean(const Scene& scene, const Light& light, const Piece& piece, double step) {
  if (light.aimed) {
    bool any = false;
    for (std::uint32_t k = 0; k < piece.corners; ++k) {
      any = any || dot(light.towards, piece.corner[k] - light.position) > 0;
    }
    if (!any) return 0;
  }
  Piece whole = piece;
  whole.corners = 4;                  // corner[3] of a triangle is corner[2]
  whole.concave = whole.cut = false;  // where a bilinear surface folds, solid angles cancel
  const double limit = kCellAngle * kCellAngle / (1 + exponent_of(light));
  const double step_squared = step * step;
  double flux = 0;  // cd sr
  const CellCorners corners(whole, light.position);
  QuadCell cell;
  do {
    Vec3 corner[4], centre;
    for (;;) {
      corners.find(cell, corner);
      centre = 0.25 * ((corner[0] + corner[1]) + (corner[2] + corner[3]));
      if (cell.depth == kDepth || size_squared(corner) <= limit * length_squared(centre)) break;
      cell.descend();
    }
    const double solid_angle =
        -2 * (half_solid_angle(corner[0], corner[1], corner[2]) + half_solid_angle(corner[0], corner[2], corner[3]));
    const double squared = length_squared(centre) > step_squared ? length_squared(centre) : step_squared;
    const double law = relative_attenuation(light, square_root(squared) * scene.metres_per_unit);
    flux += intensity(scene, light, centre) * law * solid_angle;
  } while (cell.advance());
  const double metres = scene.metres_per_unit;
  const double area = length(piece.vector_area()) * metres * metres;
  return area > 0 && flux > 0 ? flux / area : 0;
}

}  // namespace shodo
