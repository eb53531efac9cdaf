#include "scene/faces.h"

namespace shodo {

namespace {

bool sub_suits_triangle(const SceneReading& reading) {
  if (reading.sub_u == reading.sub_v) return true;
  MessageText message = reading.words.mistake(reading.statement);
  message.add("expected equal counts in the 'sub' of an object with a triangle, found ");
  message.add(reading.sub_u).add(' ').add(reading.sub_v);
  return false;
}

}  // namespace

bool begin_mesh(SceneReading& reading, Mesh& mesh) {
  if (reading.store.counts().objects == 0) {
    return reading.words.expected(reading.statement, "an 'object' before the first surface");
  }
  mesh.object = static_cast<std::uint32_t>(reading.store.counts().objects - 1);
  mesh.first_vertex = static_cast<std::uint32_t>(reading.store.counts().vertices);
  return true;
}

bool add_mesh(SceneReading& reading, Mesh& mesh, const GivenCounts& given) {
  if (mesh.kind == MeshKind::kTriangle && !sub_suits_triangle(reading)) return false;
  if (reading.wanted.kind == Wanted::Kind::kMesh && reading.wanted.index == reading.store.counts().meshes) {
    reading.words.place(reading.statement);
    return false;
  }
  mesh.nu = given.nu;
  mesh.nv = given.nv;
  mesh.su = reading.sub_u != 0 ? reading.sub_u : given.su;
  mesh.sv = reading.sub_v != 0 ? reading.sub_v : given.sv;
  reading.store.add(mesh);
  if (reading.store.storing()) ++reading.store.scene().objects[mesh.object].mesh_count;
  return true;
}

bool add_triangle(SceneReading& reading, Mesh& mesh, const Vec3* corner, const GivenCounts& given) {
  if (!triangle_has_area(corner[0], corner[1], corner[2])) {
    ++reading.store.scene().polygons_dropped;
    return true;
  }
  mesh.kind = MeshKind::kTriangle;
  for (std::uint32_t k = 0; k < 3; ++k) reading.store.add(corner[k]);
  return add_mesh(reading, mesh, given);
}

bool add_quad(SceneReading& reading, Mesh& mesh, const Vec3* corner, QuadShape shape, const GivenCounts& given) {
  if (shape == QuadShape::kNoArea) {
    ++reading.store.scene().polygons_dropped;
    return true;
  }
  SHODO_CHECK(features::kMeshes || shape == QuadShape::kConvex);
  mesh.kind = MeshKind::kQuad;
  mesh.cut = shape != QuadShape::kConvex;
  mesh.concave = shape == QuadShape::kCut13;
  for (std::uint32_t k = 0; k < 4; ++k) reading.store.add(corner[k]);
  return add_mesh(reading, mesh, given);
}

}  // namespace shodo
