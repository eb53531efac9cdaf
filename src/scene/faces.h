// Hands single faces to the SceneStore: what the statements quad and tri and the faces of an OBJ file come to.
//
// A face without area is left out and counted.
#pragma once

#include <cstdint>

#include "scene/quad_shape.h"
#include "scene/statements.h"

namespace shodo {

/// What follows the corners; 0: not given.
struct GivenCounts {
  std::uint32_t nu = 0, nv = 0, su = 0, sv = 0;
};

/// The object that a mesh belongs to, which must be there, and its first vertex.
bool begin_mesh(SceneReading& reading, Mesh& mesh);
/// Hands over a mesh whose vertices have been handed over.
bool add_mesh(SceneReading& reading, Mesh& mesh, const GivenCounts& given);
bool add_triangle(SceneReading& reading, Mesh& mesh, const Vec3* corner, const GivenCounts& given);
/// `shape`: as quad_shape() says; not kCrossing.
bool add_quad(SceneReading& reading, Mesh& mesh, const Vec3* corner, QuadShape shape, const GivenCounts& given);

}  // namespace shodo
