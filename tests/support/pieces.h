// Pieces of surfaces by their corners.
#pragma once

#include "scene/mesh.h"

namespace shodo {

inline Piece quad_piece(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Piece piece;
  piece.corner[0] = a;
  piece.corner[1] = b;
  piece.corner[2] = c;
  piece.corner[3] = d;
  return piece;
}

}  // namespace shodo
