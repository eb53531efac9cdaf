// A scene on the lattice: what blocks segments, what is drawn, where samples lie (design: exact visibility).
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "base/lattice.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "shodo/statistics.h"
#include "shodo/status.h"
#include "visibility/lattice_box.h"

namespace shodo {

/// A triangle that blocks: vertices on even lattice points, counter-clockwise seen from its front.
struct Triangle {
  LatticePoint a, b, c;
  std::uint32_t object = 0;  // objects first, then lights: objects.size() + light
  LatticeVector n;           // (b - a) x (c - a), components within 2^41
  std::int64_t d = 0;        // n . a

  /// Positive in front, negative behind, zero in the plane; exact.
  std::int64_t side(const LatticePoint& p) const { return n.x * p.x + n.y * p.y + n.z * p.z - d; }
};

/// A triangle of the picture, with map coordinates (u, v) at a, b, c in sub-patches of its mesh, 24.8 fixed point.
/// The plane and the vertices are its own, since a quad that is no parallelogram is drawn patch by patch.
struct DrawnTriangle {
  LatticePoint vertex[3];
  std::int32_t u[3] = {0, 0, 0};
  std::int32_t v[3] = {0, 0, 0};
  std::uint32_t mesh = kNone;   // kNone: a face of an area light, or glass
  std::uint32_t light = kNone;  // the area light; from lights.size() on glass (glass_of)
};

/// The glass that a drawn triangle is of, kNone if it is something else.
inline std::uint32_t glass_of(const Scene& scene, const DrawnTriangle& drawn) {
  const std::size_t lights = scene.lights.size();
  return drawn.light == kNone || drawn.light < lights ? kNone : drawn.light - static_cast<std::uint32_t>(lights);
}

/// A polygon of the file (a cell of a mesh or an area light) and its triangles, contiguous in Geometry::triangles.
struct PolygonTriangles {
  std::uint32_t first = 0;
  std::uint32_t count : 27 = 0;
  std::uint32_t raise : 5 = 0;  // steps along its normal by which samples stand higher: another polygon touches it
};

/// Samples, moved in front of their surface, stand less than so many steps off their points, in each coordinate.
inline constexpr std::int32_t kMostMoved = 24;
/// A polygon that light passes (visibility/panes.h): its triangles stand with all others but block nothing.
struct Pane {
  LatticeBox box;
  std::uint32_t first = 0, count = 0;
  Rgb transmit;
};

struct Geometry {
  /// Whether a polygon blocks nothing.
  bool is_pane(const PolygonTriangles& polygon) const {
    for (const Pane& pane : panes) {
      if (pane.first == polygon.first && polygon.count > 0) return true;
    }
    return false;
  }

  Lattice lattice;
  std::span<Triangle> triangles;      // file order: objects' meshes ascending, then area lights; open lights have none
  std::span<PolygonTriangles> cells;  // per cell of each mesh: Geometry::first_cell[mesh] + cell
  std::span<std::uint32_t> first_cell;          // per mesh
  std::span<PolygonTriangles> light_triangles;  // per light; none for all but area lights that block
  std::span<Pane> panes;  // ascending triangles; mostly none
  // Meshes ascending, then area lights (open ones too), then glass; a spare block of the arena, so that what comes
  // before the picture may have the memory: place_drawn() then.
  std::span<DrawnTriangle> drawn;
  std::uint32_t drawn_count = 0;
  std::span<LatticePoint> light_points;  // per light: where a point light stands, odd, in front of what it lies on
  std::uint32_t inserted = 0;            // T-junction vertices
  std::uint32_t moved = 0;               // vertices moved off a polygon's interior
  std::uint64_t placing_bytes = 0;       // scratch of placing the scene
  Arena::Mark before_triangles = 0;      // what place_scene() leaves from here on only light needs
};

/// Places the scene on the lattice, mends T-junctions and near-touching vertices, cuts polygons into triangles.
/// Geometry::drawn is then a pinned spare block.
Status place_scene(const Scene& scene, Arena& arena, Geometry& geometry);

/// Finds Geometry::drawn again, in a block that isn't spare. False: the arena is too small.
bool place_drawn(const Scene& scene, Arena& arena, Geometry& geometry);

/// The patches of the whole scene, dropped ones marked; counts dropped and thin ones.
Status build_patches(const Scene& scene, const Geometry& geometry, Arena& arena, std::span<Patch>& patches,
                     Statistics& statistics);

/// One of them, counted from its mesh's first; the same bits.
Patch make_patch(const Scene& scene, const Geometry& geometry, std::uint32_t mesh, std::uint32_t local);

/// Whether a piece is under 32 lattice steps wide, so that rounding moves its samples noticeably.
bool is_thin(const Lattice& lattice, const Piece& piece);

/// How far in from a patch's borders its samples keep, of its sides: 0, or 1/4 for a thin one, whose lattice positions
/// would leave it otherwise. A sample at parameter s of 0 .. 1 goes to inset + (1 - 2 inset) s.
double sample_inset(const Patch& patch);

/// Of a polygon all triangles of which lie in one plane square to an axis: where in front of it is.
struct FlatFront {
  std::uint32_t axis = 3;  // 3: it is none
  std::int32_t plane = 0;  // even
  std::int32_t way = 1;    // 1 or -1: in front is up or down the axis

  bool flat() const { return axis < 3; }
  /// In front of it, as sample_point() would move an odd point: the first beyond the plane, if it isn't there yet.
  LatticePoint move(LatticePoint p) const {
    std::int32_t& at = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    if (way > 0 ? at <= plane : at >= plane) at = plane + way;
    return p;
  }
};
FlatFront flat_front(const Geometry& geometry, std::uint32_t mesh, std::uint32_t cell);
/// Of an area light, open or not.
FlatFront flat_front(const Scene& scene, const Geometry& geometry, std::uint32_t light);

/// Triangles of a plane quadrilateral for which none block: an opening's, a measuring plane's; how many have an area.
std::uint32_t lattice_quad(const Lattice& lattice, const Vec3* corners, Triangle (&triangles)[2]);
FlatFront flat_front(std::span<const Triangle> triangles);
/// As below, in front of these triangles.
LatticePoint sample_point(const Lattice& lattice, std::span<const Triangle> own, const Vec3& point);

/// The odd lattice point of a point on cell `cell` of `mesh`, moved by steps of 2 along the dominant axis of the
/// polygon's normal until strictly in front of the polygon's own triangles there.
LatticePoint sample_point(const Scene& scene, const Geometry& geometry, std::uint32_t mesh, std::uint32_t cell,
                          const Vec3& point);

/// The odd point of a point on an area light, strictly in front of the light's polygon.
LatticePoint light_sample_point(const Scene& scene, const Geometry& geometry, std::uint32_t light, const Vec3& point);

}  // namespace shodo
