// Panes: polygons of a material that transmits. They block nothing; light that passes them is weakened (doc/optics.md).
//
// A pane is thin and doesn't bend light. It passes light both ways; what it reflects diffusely it gets on its front and
// sends from there, as any surface. Panes stand in no list of blockers, flag or aim: a segment that nothing blocks is
// tested against all panes, ascending as in the file, and the product of what they transmit is taken in this order, so
// that it has the same bits whatever was known before.
// Exact: which panes a segment passes; a seam counts once (visibility/half_open.h). Bytes: 56 a pane.
#pragma once

#include <cstdint>
#include <span>

#include "base/vector.h"
#include "visibility/geometry.h"
#include "visibility/lattice_box.h"

namespace shodo {

/// The panes as one channel of light sees them.
class Panes {
 public:
  explicit Panes(const Geometry& geometry) : geometry_(&geometry) {}

  /// False in most scenes.
  bool any() const { return !geometry_->panes.empty(); }
  /// Whether channels differ, so that each has to be found by itself.
  bool coloured() const;
  void set_channel(std::uint32_t channel) { channel_ = channel; }
  std::uint32_t channel() const { return channel_; }

  /// False if no segment between points of the boxes passes a pane; the same whatever finds blockers.
  bool between(const LatticeBox& a, const LatticeBox& b) const;

  /// The part of light that panes let through from p to q, from p along a direction; 1 without any.
  double pass(const LatticePoint& p, const LatticePoint& q) const;
  double pass_along(const LatticePoint& p, const LatticeVector& direction) const;

 private:
  template <class Passes>
  double product(const LatticeBox& around, Passes passes) const;

  const Geometry* geometry_;
  std::uint32_t channel_ = 0;
};

}  // namespace shodo
