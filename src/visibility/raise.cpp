// Samples on a face that another one touches.
//
// The two faces of a thin wall, or a wall and a picture on it, are rounded and mended each on its own: one may stick a
// few steps through the other, although the file says which is in front, and would shadow the samples there. So a
// polygon that has others at most kTouching steps behind it, or in its plane, has its samples raised along its normal
// over everything that sticks out of it: by what these others' vertices stand over its plane in the file. Which is
// behind is decided with the coordinates of the file, never with rounded ones: a sample between two plates that face
// each other isn't raised through the other. What is square to an axis stays in order when it is rounded and is not
// raised. Approximate: a vertex may stick out beside a sample and not at it; the height is rounded up.
#include "visibility/mending.h"
#include "visibility/surface.h"

namespace shodo {

namespace {

constexpr double kTouching = 12;   // lattice steps: more than rounding and mending do to two faces together
constexpr double kInPlane = 0.25;  // a face further in front than that isn't behind
constexpr double kRounding = 3.5;  // of a sample's own two roundings, along a normal
constexpr double kMostRaise = 12;

/// A polygon of the file, lattice steps, not rounded.
struct FilePolygon {
  Vec3 corner[4];
  std::uint32_t corners = 4;
  Vec3 normal;

  double height(const Vec3& p) const { return dot(normal, p - corner[0]); }
};

/// The polygons' order in Placement::rings: cells of the meshes, then area lights.
class FilePolygons {
 public:
  FilePolygons(const Scene& scene, const Geometry& geometry) : scene_(&scene), geometry_(&geometry) {}

  FilePolygon at(std::uint32_t polygon) const {
    FilePolygon found;
    const double k = geometry_->lattice.steps_per_unit;
    if (polygon < geometry_->cells.size()) {
      const std::uint32_t m = mesh_of(polygon);
      const Piece piece = cell_piece(*scene_, scene_->meshes[m], polygon - geometry_->first_cell[m]);
      found.corners = piece.corners;
      for (std::uint32_t c = 0; c < piece.corners; ++c) found.corner[c] = k * piece.corner[c];
    } else {
      const Light& light = scene_->lights[light_of(polygon)];
      for (std::uint32_t c = 0; c < 4; ++c) found.corner[c] = k * light.corners[c];
    }
    const Vec3* c = found.corner;
    found.normal = normalised(found.corners == 3 ? cross(c[1] - c[0], c[2] - c[0]) : cross(c[2] - c[0], c[3] - c[1]));
    return found;
  }

  PolygonTriangles& triangles(std::uint32_t polygon) const {
    if (polygon < geometry_->cells.size()) return geometry_->cells[polygon];
    return geometry_->light_triangles[light_of(polygon)];
  }

  bool is_flat(std::uint32_t polygon) const {
    if (polygon >= geometry_->cells.size()) return flat_front(*scene_, *geometry_, light_of(polygon)).flat();
    const std::uint32_t m = mesh_of(polygon);
    return flat_front(*geometry_, m, polygon - geometry_->first_cell[m]).flat();
  }

 private:
  std::uint32_t mesh_of(std::uint32_t polygon) const {
    std::uint32_t low = 0, high = static_cast<std::uint32_t>(geometry_->first_cell.size());
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (geometry_->first_cell[middle] <= polygon ? low : high) = middle;
    }
    return low;
  }
  std::uint32_t light_of(std::uint32_t polygon) const {
    std::uint32_t left = polygon - static_cast<std::uint32_t>(geometry_->cells.size()), light = 0;
    for (; left > 0 || scene_->lights[light].kind != LightKind::kArea; ++light) {
      left -= scene_->lights[light].kind == LightKind::kArea ? 1 : 0;
    }
    return light;
  }

  const Scene* scene_;
  const Geometry* geometry_;
};

bool overlap(const LatticeBox& a, const LatticeBox& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] + kTouching || b.low[k] > a.high[k] + kTouching) return false;
  }
  return true;
}

bool within(const FilePolygon& own, const FilePolygon& other, double most_below, double most_above) {
  for (std::uint32_t c = 0; c < other.corners; ++c) {
    const double height = own.height(other.corner[c]);
    if (!(height >= -most_below && height <= most_above)) return false;
  }
  return true;
}

/// Neighbours in one plane share an edge and hide nothing from each other.
bool are_neighbours(const Placement& placement, std::uint32_t a, std::uint32_t b) {
  std::uint32_t shared = 0;
  for (std::uint32_t k = 0; k < placement.rings[a].corners; ++k) {
    shared += in_ring(placement, b, placement.rings[a].site[k]) ? 1 : 0;
  }
  return shared >= 2;
}

double highest(const Placement& placement, const FilePolygon& own, std::uint32_t other) {
  double most = -kTouching;
  const auto look_at = [&](std::uint32_t site) {
    const LatticePoint& p = placement.sites[site];
    const double height = own.height({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    if (height > most) most = height;
  };
  const SiteRing& ring = placement.rings[other];
  for (std::uint32_t k = 0; k < ring.corners; ++k) look_at(ring.site[k]);
  for (std::uint32_t k = placement.first_insertion[other]; k < placement.first_insertion[other + 1]; ++k) {
    if (placement.insertions[k].drawn == 0) look_at(placement.insertions[k].site);
  }
  return most;
}

std::uint32_t raise_of(const Placement& placement, const PolygonTree& tree, const FilePolygons& polygons,
                       std::uint32_t polygon) {
  const FilePolygon own = polygons.at(polygon);
  if (!within(own, own, 1, 1)) return 0;  // bent: which side is in front depends on the place
  const LatticeBox box = polygon_box(placement, polygon);
  double most = 0;
  tree.visit([&](const LatticeBox& other) { return overlap(box, other); },
             [&](std::uint32_t b) {
               if (b == polygon || !placement.rings[b].blocks || !overlap(box, polygon_box(placement, b))) return;
               const FilePolygon other = polygons.at(b);
               if (!within(own, other, kTouching, kInPlane)) return;
               if (dot(own.normal, other.normal) > 0 && are_neighbours(placement, polygon, b)) return;
               const double wanted = highest(placement, own, b) + kRounding;
               if (wanted > most) most = wanted;
             });
  return static_cast<std::uint32_t>(most < kMostRaise ? most + 0.999 : kMostRaise);
}

}  // namespace

void find_raises(const Scene& scene, const Placement& placement, const PolygonTree& tree, Geometry& geometry) {
  const FilePolygons polygons(scene, geometry);
  for (std::uint32_t p = 0; p < placement.rings.size(); ++p) {
    if (!placement.rings[p].blocks || polygons.is_flat(p)) continue;
    polygons.triangles(p).raise = raise_of(placement, tree, polygons, p) & 31;
  }
}

}  // namespace shodo
