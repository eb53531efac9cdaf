// What stands in a scene as the tracer of tests/truth meets it: polygons as the file has them, each cut into two
// triangles on the scene's own diagonal, and blocking area lights. Fronts reflect diffusely, backs are black.
//
// Shared with shodo: the scene as it was loaded, the geometry of its pieces (scene/mesh.h), and what a patch of a
// textured mesh reflects (scene/patch_reflectance.h). Everything else is the tracer's own, in doubles.
#pragma once

#include <cmath>
#include <vector>

#include "scene/mesh.h"
#include "scene/patch_reflectance.h"
#include "truth/tree.h"

namespace shodo::truth {

/// A point of a surface and its front.
struct Place {
  Vec3 point, normal;
};

class World {
 public:
  /// `reflecting`: the same scene, perhaps with more patches; theirs are the reflectances where there are textures.
  World(const Scene& scene, const Scene& reflecting) : scene_(scene), reflecting_(reflecting) {
    std::vector<Facet> facets;
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
      const Mesh& mesh = scene.meshes[m];
      reflectance_.emplace_back(reflecting, m);
      const Optics* const optics = scene.optics_of(mesh.material);
      const bool pane = optics != nullptr && optics->transmits();
      for (std::uint32_t cell = 0; cell < cell_count(mesh); ++cell) {
        add(cell_piece(scene, mesh, cell), m, cell, pane, facets);
      }
    }
    textured_.resize(scene.meshes.size());
    for (const TexturedMesh& found : reflecting.textured) textured_[found.mesh] = true;
    for (const Light& light : scene.lights) {
      if (light.kind == LightKind::kArea && !light.open) add(piece_of(light), kNone, 0, false, facets);
    }
    small_ = 1e-6 * scene.largest_half_extent();
    tree_.build(std::move(facets), scene.largest_half_extent());
  }

  const Scene& scene() const { return scene_; }
  const Tree& tree() const { return tree_; }
  /// Rays start so far in front of surfaces: some micrometres in a room.
  double small() const { return small_; }

  static Piece piece_of(const Light& light) {
    Piece piece;
    for (int k = 0; k < 4; ++k) piece.corner[k] = light.corners[k];
    return piece;
  }

  /// visit(a, b, c) for the triangles of a piece.
  template <class Visit>
  static void cut(const Piece& piece, Visit visit) {
    const Vec3* c = piece.corner;
    if (piece.corners == 3) return visit(c[0], c[1], c[2]);
    const bool from_1 = piece.concave;
    visit(c[0], c[1], from_1 ? c[3] : c[2]);
    if (from_1) {
      visit(c[1], c[2], c[3]);
    } else {
      visit(c[0], c[2], c[3]);
    }
  }

  /// What a facet of a mesh reflects at a point of it, by channel.
  void reflectance(const Facet& facet, const Vec3& point, double (&rho)[3]) const {
    double room[3];
    const Mesh& mesh = reflecting_.meshes[facet.mesh];
    const double* of = reflectance_[facet.mesh].of(textured_[facet.mesh] ? patch_at(mesh, facet.cell, point) : 0, room);
    for (std::uint32_t c = 0; c < 3; ++c) rho[c] = of[c < scene_.channels ? c : 0];
  }
  /// The sub-patch of the scene at a point of a facet, by its number.
  std::uint32_t sub_patch_at(const Facet& facet, const Vec3& point) const {
    const Mesh& mesh = scene_.meshes[facet.mesh];
    const std::uint32_t width = mesh.map_width();
    const PieceIndex at = piece_at(mesh, width, mesh.map_height(), facet.cell, point);
    const bool triangle = mesh.kind == MeshKind::kTriangle;
    return mesh.first_sub_patch + (triangle ? triangle_piece_order(width, at) : at.v * width + at.u);
  }
  /// What a pane lets through.
  Rgb transmit(const Facet& facet) const { return scene_.optics_of(scene_.meshes[facet.mesh].material)->transmit; }

  /// The point of a polygon's triangles next to a point of its bilinear surface, which is the same unless it is
  /// twisted.
  Place on_surface(const Piece& cell, const Vec3& point) const {
    const Vec3 across = normalised(cell.vector_area());
    Place place{point, across};
    double best = -1e300;
    cut(cell, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const Vec3 n = cross(b - a, c - a);
      const double slope = dot(n, across);
      if (!(slope > 0)) return;
      const Vec3 on = point + (dot(n, a - point) / slope) * across;
      const double inside = std::min({dot(cross(b - a, on - a), n), dot(cross(c - b, on - b), n),
                                      dot(cross(a - c, on - c), n)}) / dot(n, n);
      if (inside <= best) return;
      best = inside;
      place = {on, normalised(n)};
    });
    return place;
  }

 private:
  void add(const Piece& piece, std::uint32_t mesh, std::uint32_t cell, bool pane, std::vector<Facet>& facets) const {
    cut(piece, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const Vec3 n = cross(b - a, c - a);
      if (!(length(n) > 0)) return;
      facets.push_back({a, b - a, c - a, normalised(n), mesh, cell, pane ? 1u : 0u});
    });
  }

  /// Parameters of a point on a cell: the bilinear map inverted by Newton's steps.
  static void invert(const Piece& cell, const Vec3& point, double& s, double& t) {
    s = t = cell.corners == 3 ? 1.0 / 3 : 0.5;
    for (int step = 0; step < 8; ++step) {
      constexpr double kStep = 1e-4;
      const Vec3 off = point - cell.point(s, t);
      const Vec3 ds = (0.5 / kStep) * (cell.point(s + kStep, t) - cell.point(s - kStep, t));
      const Vec3 dt = (0.5 / kStep) * (cell.point(s, t + kStep) - cell.point(s, t - kStep));
      const double ss = dot(ds, ds), st = dot(ds, dt), tt = dot(dt, dt), os = dot(off, ds), ot = dot(off, dt);
      const double det = ss * tt - st * st;
      if (!(det > 0)) return;
      s += (tt * os - st * ot) / det;
      t += (ss * ot - st * os) / det;
    }
  }

  static std::uint32_t part(double at, std::uint32_t count) {
    const double k = std::floor(at * count);
    return k < 0 ? 0 : k >= count ? count - 1 : static_cast<std::uint32_t>(k);
  }

  std::uint32_t patch_at(const Mesh& mesh, std::uint32_t cell, const Vec3& point) const {
    const PieceIndex at = piece_at(mesh, mesh.nu, mesh.nv, cell, point);
    return mesh.kind == MeshKind::kTriangle ? triangle_piece_order(mesh.nu, at) : at.v * mesh.nu + at.u;
  }

  /// Of a mesh's pieces, `nu` times `nv`, the one at a point of its cell.
  PieceIndex piece_at(const Mesh& mesh, std::uint32_t nu, std::uint32_t nv, std::uint32_t cell,
                      const Vec3& point) const {
    double s, t;
    invert(cell_piece(scene_, mesh, cell), point, s, t);
    if (mesh.kind == MeshKind::kTriangle) {
      const std::uint32_t u = part(s, nu);
      const std::uint32_t v = std::min(part(t, nu), nu - 1 - u);
      return {u, v, s * nu - u + t * nu - v > 1 && u + v + 1 < nu};
    }
    if (mesh.kind == MeshKind::kQuad) return {part(s, nu), part(t, nv), false};
    const std::uint32_t in_u = nu / mesh.cells_u, in_v = nv / mesh.cells_v;
    return {cell % mesh.cells_u * in_u + part(t, in_u), cell / mesh.cells_u * in_v + part(s, in_v), false};
  }

  const Scene& scene_;
  const Scene& reflecting_;
  Tree tree_;
  std::vector<MeshReflectance> reflectance_;
  std::vector<bool> textured_;
  double small_ = 0;
};

}  // namespace shodo::truth
