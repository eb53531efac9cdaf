// A cell of a quadtree over the unit square, and the way to the next leaf without a stack.
#pragma once

#include <cstdint>

namespace shodo {

/// Cell (x, y) of 2^depth by 2^depth.
struct QuadCell {
  std::uint32_t x = 0, y = 0, depth = 0;

  /// Of its side.
  double size() const { return 1.0 / static_cast<double>(std::uint32_t{1} << depth); }
  /// To its first quarter.
  void descend() {
    x *= 2;
    y *= 2;
    ++depth;
  }
  /// To the next cell in Z order that no leaf before it holds; false after the last.
  bool advance() {
    while (depth > 0 && (x & y & 1) == 1) {
      x /= 2;
      y /= 2;
      --depth;
    }
    if (depth == 0) return false;
    if ((x & 1) == 1) ++y;
    x ^= 1;
    return true;
  }
};

}  // namespace shodo
