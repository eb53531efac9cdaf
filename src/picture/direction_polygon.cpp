#include "picture/direction_polygon.h"

namespace shodo {

bool beyond(const DirectionPolygon& polygon, const Vec3& side) {
  for (std::uint32_t k = 0; k < polygon.count; ++k) {
    if (dot(side, polygon.corner[k]) > 0) return false;
  }
  return true;
}

bool split(DirectionPolygon& polygon, const Vec3& side, DirectionPolygon& outside) {
  outside.count = 0;
  double height[kMostCorners];
  std::uint32_t above = 0;
  for (std::uint32_t k = 0; k < polygon.count; ++k) {
    height[k] = dot(side, polygon.corner[k]);
    above += height[k] >= 0 ? 1 : 0;
  }
  if (above == polygon.count) return true;
  // In place: what is kept never overtakes what is read by more than one corner, which waits in `next`.
  const std::uint32_t count = polygon.count;
  const Vec3 first = polygon.corner[0];
  Vec3 here = first;
  polygon.count = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t k_next = k + 1 < count ? k + 1 : 0;
    const Vec3 next = k_next == 0 ? first : polygon.corner[k_next];
    const double a = height[k], b = height[k_next];
    if (!(a >= 0 ? polygon : outside).push(here)) return false;
    if ((a >= 0) != (b >= 0)) {
      const double low = a < b ? a : b, high = a < b ? b : a;
      const double share = high / (high - low);  // within 0 .. 1, so that corners keep their size
      const Vec3 crossing = share * (a < b ? here : next) + (1 - share) * (a < b ? next : here);
      // Corners nearly in the plane may lie before and behind it by turns, by rounding: a crossing between such is left
      // out where it would take the place of a corner that is still to be read.
      const bool overtakes = polygon.count == k + 2 && k + 2 < count;
      if (!outside.push(crossing) || (!overtakes && !polygon.push(crossing))) return false;
    }
    here = next;
  }
  return true;
}

}  // namespace shodo
