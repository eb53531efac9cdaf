#include "picture/face_shadow.h"

#include "base/check.h"

namespace shodo {

/// scale (normal.(Q - P) + offset) over the face.
FaceShadow::Linear FaceShadow::over_face(const Vec3& normal, double scale, double offset) const {
  return {scale * (dot(normal, corner_) + offset), scale * dot(normal, a_), scale * dot(normal, b_)};
}

void FaceShadow::add(const Vec3 (&v)[3]) {
  SHODO_CHECK(count_ < kMost);
  const Vec3 normal = cross(v[1] - v[0], v[2] - v[0]);
  const double height = dot(normal, v[0]), side = height > 0 ? 1 : -1;
  Linear* const inside = inside_[count_++];
  for (int k = 0; k < 3; ++k) inside[k] = over_face(cross(v[k], v[(k + 1) % 3]), side, 0);
  inside[3] = over_face(normal, side, -height);
}

/// The s between which the triangle hides the line t + slant s.
FaceShadow::Interval FaceShadow::hidden(std::uint32_t triangle, double t, double slant) const {
  Interval hides{0, 1};
  for (const Linear& linear : inside_[triangle]) {
    const double from = linear.c + t * linear.t, slope = linear.s + slant * linear.t;
    if (slope > 0) {
      const double s = -from / slope;
      if (s > hides.low) hides.low = s;
    } else if (slope < 0) {
      const double s = -from / slope;
      if (s < hides.high) hides.high = s;
    } else if (!(from > 0)) {
      return {1, 0};
    }
  }
  return hides;
}

void FaceShadow::add_seen(std::uint32_t k, std::uint32_t lines, std::span<double> seen) const {
  const double slant = 1.0 / lines, t = k * slant, columns = static_cast<double>(seen.size());
  Interval hides[kMost];
  std::uint32_t count = 0;
  for (std::uint32_t triangle = 0; triangle < count_; ++triangle) {
    const Interval here = hidden(triangle, t, slant);
    if (!(here.low < here.high)) continue;
    std::uint32_t at = count++;
    for (; at > 0 && hides[at - 1].low > here.low; --at) hides[at] = hides[at - 1];
    hides[at] = here;
  }
  double from = 0;
  for (std::uint32_t next = 0; next <= count && from < 1; ++next) {
    const double to = next < count ? hides[next].low : 1;
    // Seen from `from` to `to`.
    if (to > from) {
      const double first = from * columns, last = to * columns;
      for (std::size_t j = static_cast<std::size_t>(first); j < seen.size() && static_cast<double>(j) < last; ++j) {
        const double low = static_cast<double>(j), high = low + 1;
        seen[j] += (high < last ? high : last) - (low > first ? low : first);
      }
    }
    if (next < count && hides[next].high > from) from = hides[next].high;
  }
}

}  // namespace shodo
