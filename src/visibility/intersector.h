// Which segments reach their end: the only door to visibility for the stages below (paper 3.1).
//
// For now every triangle of every object is tried in file order until the first blocker, without any spatial structure
// (`--flags off`): the yardstick for whatever is faster. Answers are exact and don't depend on the order.
#pragma once

#include <cstdint>

#include "visibility/geometry.h"

namespace shodo {

/// The paper's two sets of flags.
enum class LightSet : std::uint8_t { kDirect, kAmbient };

/// The objects at the two ends (lights: objects.size() + light), and for which purpose; flags will look here.
struct Link {
  std::uint32_t from = kNone;
  std::uint32_t to = kNone;
  LightSet set = LightSet::kDirect;
};

/// What a ray meets first.
struct Hit {
  std::uint32_t triangle = kNone;
  bool front = false;  // seen from its front
};

class Intersector {
 public:
  explicit Intersector(const Geometry& geometry) : geometry_(&geometry) {}

  /// True if any triangle blocks the open segment from p to q. Counts a segment and its tests.
  bool blocked(const LatticePoint& p, const LatticePoint& q, const Link& link);
  /// The same towards a sun: a ray from p along `direction` (lattice_direction, the way from p to the sun).
  bool ray_blocked(const LatticePoint& p, const LatticeVector& direction, const Link& link);
  /// The nearest triangle along a ray, exactly; ties: front before back, then the lower index. Not counted.
  Hit nearest(const LatticePoint& p, const LatticeVector& direction) const;

  std::uint64_t segments(LightSet set) const { return segments_[index(set)]; }
  std::uint64_t tests(LightSet set) const { return tests_[index(set)]; }

 private:
  static constexpr std::uint32_t index(LightSet set) { return static_cast<std::uint32_t>(set); }

  const Geometry* geometry_;
  std::uint64_t segments_[2] = {0, 0};
  std::uint64_t tests_[2] = {0, 0};
};

/// Whether a sample is inside or under something: what it sees first, in every one of a fixed set of directions over
/// the hemisphere of `normal`, are backs (design: direct light).
bool is_hidden(const Intersector& intersector, const LatticePoint& sample, const Vec3& normal);

}  // namespace shodo
