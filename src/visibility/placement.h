// A scene on the lattice before it is cut into triangles: the distinct vertices ("sites") and the polygons over them.
//
// Inside this folder only. Everything here is scratch: it lies in the arena while a scene is placed, and goes
// afterwards. Bytes: 16 a vertex of the file, 12 a vertex inserted in an edge, 24 a polygon, besides polygon_tree.h's.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "base/lattice.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

/// A site that lies on (within 2 lattice steps of) an edge of a polygon, but is not one of the edge's ends.
struct Insertion {
  std::uint32_t polygon = 0;
  std::uint16_t edge = 0;   // from corner `edge` to the next
  std::uint16_t drawn = 0;  // 1: corner of a drawn patch only, no vertex of any polygon of the file
  std::uint32_t site = 0;
};

/// A polygon of the file: a cell of a mesh or an area light.
struct Polygon {
  std::uint32_t mesh = kNone;  // kNone: an area light
  std::uint32_t cell = 0;      // of the mesh
  std::uint32_t light = kNone;
  std::uint32_t corners = 4;  // 3 or 4
  bool cut_from_1 = false;    // two triangles on the diagonal from corner 1 to 3, else from 0 to 2
  bool blocks = true;         // false: an open area light
  std::uint32_t site[4] = {};
  // Drawn patch by patch: patches along its first and second edge, and where the inner patch corners on its edges
  // stand in Placement::site_of, in the order of the ring; else 0.
  std::uint32_t along[2] = {0, 0};
  std::uint32_t first_extra = 0;
};

/// A polygon as mending sees it: 20 bytes.
struct SiteRing {
  std::uint32_t site[4] = {};
  std::uint8_t corners = 4;  // 3 or 4
  bool cut_from_1 = false;
  bool blocks = true;
};

struct Placement {
  Lattice lattice;
  // [vertex of the scene], [vertices + 4 light + corner], then patch corners on edges of cells drawn patch by patch.
  std::span<std::uint32_t> site_of;
  std::span<LatticePoint> sites;    // distinct; moved ones where they went; vertices of the file first
  std::uint32_t vertex_sites = 0;   // so many are vertices of the file, the others corners of drawn patches only
  std::uint32_t file_sites = 0;     // the first that comes after both: vertices where edges cross
  std::span<Insertion> insertions;  // ascending polygon, edge, and along the edge
  std::span<std::uint32_t> first_insertion;  // per polygon, and one more
  std::span<SiteRing> rings;                 // per polygon
  std::uint32_t inserted = 0;                // sites that are inserted somewhere
  std::uint32_t moved = 0;                   // sites that were moved

  bool drawn_only(std::uint32_t site) const { return site >= vertex_sites && site < file_sites; }
};

/// Runs over the polygons of the file in order: cells of the meshes ascending, then area lights.
class PolygonWalk {
 public:
  PolygonWalk(const Scene& scene, const Placement& placement)
      : scene_(&scene),
        placement_(&placement),
        extra_(static_cast<std::uint32_t>(scene.vertices.size() + 4 * scene.lights.size())) {}
  /// After the last polygon: how many entries Placement::site_of has.
  std::uint32_t entries() const { return extra_; }
  /// The next polygon; false after the last.
  bool next(Polygon& polygon);

 private:
  const Scene* scene_;
  const Placement* placement_;
  std::uint32_t mesh_ = 0, cell_ = 0, light_ = 0;
  std::uint32_t extra_ = 0;
};

/// How many there are.
std::uint32_t polygon_count(const Scene& scene);

/// Rounds all vertices, makes sites of them, mends what should touch and doesn't. False: the arena is too small.
bool place(const Scene& scene, Arena& arena, Placement& placement);

/// Geometry::light_points, once the triangles are there. False: the arena is too small.
bool place_point_lights(const Scene& scene, Arena& arena, Geometry& geometry);

}  // namespace shodo
