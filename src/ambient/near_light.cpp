#include "ambient/near_light.h"

#include "light/point_source.h"
#include "scene/mesh.h"

namespace shodo {

namespace {

Receiver plane_through(const Vec3& normal, const Vec3& anchor) {
  Receiver receiver;
  receiver.normal = normal;
  receiver.anchor = anchor;
  return receiver;
}

}  // namespace

bool NearLight::reaches(const Light& light, const Piece& piece, std::uint32_t in_u, std::uint32_t in_v) {
  const Vec3 centre = piece.centre(), off = light.position - centre;
  if (!(dot(piece.vector_area(), off) > 0)) return false;
  double radius = 0;
  bool lit = !light.aimed;
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    const double here = length_squared(piece.corner[k] - centre);
    radius = here > radius ? here : radius;
    lit = lit || dot(light.towards, piece.corner[k] - light.position) > 0;
  }
  const double side = piece.longest_side() / (in_u < in_v ? in_u : in_v);
  return lit && length(off) < square_root(radius) + kNear * side;
}

bool NearLight::find(const Scene& scene, const Light& light, const Mesh& mesh, std::uint32_t local, double step) {
  const Piece piece = sub_patch_piece(scene, mesh, local);
  anchor_ = piece.centre();
  const Vec3 across = piece.vector_area(), off = light.position - anchor_;
  const double side = piece.longest_side();
  if (!(dot(across, off) > 0) || !(length_squared(off) < kNear * kNear * side * side)) return false;
  normal_ = normalised(across);
  double least = lux(scene, light, anchor_, step), most = least;
  const auto look = [&](const Vec3& point) {
    const double here = lux(scene, light, point, step);
    least = here < least ? here : least;
    most = here > most ? here : most;
  };
  for (std::uint32_t k = 0; k < piece.corners; ++k) look(piece.corner[k]);
  const Vec3 foot = off - dot(normal_, off) * normal_;
  if (2 * length(foot) < side) look(anchor_ + foot);
  return most > kUneven * least && most < kSpot * least;
}

double NearLight::lux(const Scene& scene, const Light& light, const Vec3& point, double step) const {
  return point_lux(scene, light, plane_through(normal_, anchor_), point, step).lux;
}

}  // namespace shodo
