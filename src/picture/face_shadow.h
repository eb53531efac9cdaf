// What of a light's face is seen from a point past a few triangles, along lines over the face (picture/highlight.h).
//
// With P the point and Q(s, t) = c + s a + t b on a parallelogram, Q is behind a triangle V0 V1 V2 if (V_k - P) x
// (V_k+1 - P) . (Q - P) has the sign of the triangle's side for all three edges, and Q lies beyond its plane: four
// functions that are linear in s and t. So along a line over the face each triangle hides one interval, exactly; what
// several hide is the union. Lines are slanted, t = (k + s) / lines, so that an edge along a side of the face is met by
// each at another s: shadows have no steps.
// Doubles. Bytes: 600 on the stack.
#pragma once

#include <cstdint>
#include <span>

#include "base/vector.h"

namespace shodo {

class FaceShadow {
 public:
  static constexpr std::uint32_t kMost = 6;  // triangles

  /// The face's corner and sides. All places are from P.
  FaceShadow(const Vec3& corner, const Vec3& a, const Vec3& b) : corner_(corner), a_(a), b_(b) {}

  /// At most kMost.
  void add(const Vec3 (&triangle)[3]);

  /// Adds to seen[j] how much of columns j / count .. (j + 1) / count of line k of `lines` is seen, in columns.
  void add_seen(std::uint32_t k, std::uint32_t lines, std::span<double> seen) const;

 private:
  struct Linear {
    double c, s, t;
  };
  struct Interval {
    double low, high;
  };
  Linear over_face(const Vec3& normal, double scale, double offset) const;
  Interval hidden(std::uint32_t triangle, double t, double slant) const;

  Vec3 corner_, a_, b_;
  Linear inside_[kMost][4];      // hidden where all are positive
  std::uint32_t count_ = 0;
};

}  // namespace shodo
