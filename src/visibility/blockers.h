// The triangles that block, in a tree of boxes, so that the few which can come between two places are found fast
// (paper 3.1; design: the table of possible blockers, refined from mesh to patch to segment; deviation D11).
//
// A facet is one triangle of a polygon or two that follow each other; where it suits, all of one that fill a rectangle
// square to an axis, as walls do at whose edges others end. Facets are sorted by median cuts; a node of the
// implicit tree (children 2 k + 1 and 2 k + 2) holds an even share of them.
//
// A triangle blocks a segment only if the ends lie strictly on opposite sides of its plane. For a facet square to an
// axis, as walls are, this costs nothing: its box is made one step thinner than flat, low > high, so that boxes which
// touch the plane from one side only don't meet it. All walls of a room drop out so. For others misses_side() looks.
// Bytes: 32 a facet, 24 a node (one for each 1 to 4 facets), and 4 a facet and list.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "visibility/geometry.h"
#include "visibility/lattice_box.h"
#include "visibility/median_boxes.h"
#include "visibility/shaft.h"

namespace shodo {

struct Facet {
  LatticeBox box;            // facet_box()
  std::uint32_t first = 0;   // triangle
  std::uint8_t count = 1;    // 1 or 2, more of a whole rectangle
  std::uint8_t blocks = 3;   // bit s: in LightSet s
  std::uint8_t tilted = 0;   // 1: not square to an axis; 2: and its two triangles a b c, c d a are a parallelogram
  std::uint8_t rectangle = 0;  // 1: its triangles fill its box, square to an axis
};
static_assert(sizeof(Facet) == 32);

/// The box around a facet; flat ones get low = plane + 1, high = plane - 1 along the axis to which they are square.
LatticeBox facet_box(std::span<const Triangle> triangles, bool& tilted);
/// Whether two triangles fill their flat box: every corner of theirs is one of the box, and they leave out opposite
/// ones.
bool fill_box(std::span<const Triangle> triangles, const LatticeBox& box);
/// Whether all triangles of a polygon do: they face one way, so none lies on another, and have its area together.
bool cover_box(std::span<const Triangle> polygon, const LatticeBox& box);

/// What becomes one facet: two triangles at most, or all of a polygon that fill a rectangle.
enum class Rectangles : std::uint8_t { kCut, kWhole };

/// The ends of segments: lattice points and the box around them.
struct Ends {
  std::span<const LatticePoint> points;
  LatticeBox box;
};

class Blockers {
 public:
  /// False: the arena is too small.
  bool build(const Geometry& geometry, Arena& arena, Rectangles rectangles = Rectangles::kCut);
  /// Of pairs; of whole rectangles there are fewer.
  static std::uint32_t facet_count(const Geometry& geometry);
  static std::uint64_t bytes(const Geometry& geometry);

  bool built() const { return !nodes_.empty(); }
  std::span<Facet> facets() { return facets_; }
  std::span<const Facet> facets() const { return facets_; }

  /// Calls visit(facet number) for all in the shaft, in an order that the geometry fixes.
  template <class Visit>
  void visit(Shaft shaft, Visit visit) const {
    walk_medians(
        nodes_.size(), facets_.size(), [&](std::uint32_t node) { return !shaft.misses(nodes_[node]); },
        [&](std::uint32_t k) {
          if (!shaft.misses(facets_[k].box)) visit(k);
          return true;
        });
  }

 private:
  std::uint32_t add_facets(const Geometry& geometry, const PolygonTriangles& polygon, Rectangles rectangles,
                           std::uint32_t next);
  void split(const ItemRange& range);

  std::span<Facet> facets_;
  std::span<LatticeBox> nodes_;
};

/// Whether a facet that fills its box, square to an axis, blocks every segment between the boxes; exact.
bool hides_all(const LatticeBox& rectangle, const LatticeBox& a, const LatticeBox& b);

/// True if no segment between the points of a and those of b passes the plane of any triangle of the facet.
bool misses_side(std::span<const Triangle> triangles, std::span<const LatticePoint> a, std::span<const LatticePoint> b);

}  // namespace shodo
