// The statements that make surfaces: object, quad, tri, grid, sub (obj: obj_statement.cpp); and plane, which measures.
//
// Faces without area are left out and counted; a quad with two equal neighbouring corners becomes the triangle that it
// is, divided by the larger of its two counts (a quad that is not convex takes the larger for both, see mesh.h). A grid
// is kept whole: its cells without area stay in the mesh, are counted here, and their patches are dropped by whoever
// builds patches.
#include "scene/faces.h"
#include "scene/quad_shape.h"
#include "scene/statements.h"
#include "scene/values.h"

namespace shodo {

namespace {

constexpr std::uint32_t kQuad = 1, kTri = 2, kGrid = 4;

bool read_patches(SceneReading& reading) {
  GivenCounts& counts = value_of<GivenCounts>(reading);
  return read_count(reading.words, {"patches along u"}, 1, kMostPieces, counts.nu) &&
         read_count(reading.words, {"patches along v"}, 1, kMostPieces, counts.nv);
}

bool read_subs(SceneReading& reading) {
  GivenCounts& counts = value_of<GivenCounts>(reading);
  return read_count(reading.words, {"sub-patches along u"}, 1, kMostPieces, counts.su) &&
         read_count(reading.words, {"sub-patches along v"}, 1, kMostPieces, counts.sv);
}

bool read_tri_patches(SceneReading& reading) {
  GivenCounts& counts = value_of<GivenCounts>(reading);
  const bool read = read_count(reading.words, {"patches along an edge"}, 1, kMostPieces, counts.nu);
  counts.nv = counts.nu;
  return read;
}

bool read_tri_subs(SceneReading& reading) {
  GivenCounts& counts = value_of<GivenCounts>(reading);
  const bool read = read_count(reading.words, {"sub-patches along an edge"}, 1, kMostPieces, counts.su);
  counts.sv = counts.su;
  return read;
}

constexpr Key kCountKeys[] = {{"patches", kQuad, 0, read_patches},
                              {"sub", kQuad | kGrid, 0, read_subs},
                              {"patches", kTri, 0, read_tri_patches},
                              {"sub", kTri, 0, read_tri_subs}};

bool read_direct_flags(SceneReading& reading) {
  return read_flags(reading, value_of<Object>(reading).direct);
}
bool read_ambient_flags(SceneReading& reading) { return read_flags(reading, value_of<Object>(reading).ambient); }

constexpr Key kObjectKeys[] = {{"direct", 1, 0, read_direct_flags}, {"ambient", 1, 0, read_ambient_flags}};

std::uint32_t larger(std::uint32_t a, std::uint32_t b) { return a > b ? a : b; }

/// A mesh's object and its material.
bool begin_surface(SceneReading& reading, Mesh& mesh) {
  return begin_mesh(reading, mesh) &&
         read_reference(reading, "the name of a material", &SceneStore::find_material, mesh.material);
}

bool only_convex_quads(SceneReading& reading) {
  reading.words.mistake(reading.statement).add("this library is built without quads that are not convex");
  return false;
}

bool read_corners(SceneReading& reading, Vec3* corner, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k) {
    if (!read_point(reading.words, {"corner", k + 1}, corner[k])) return false;
  }
  return true;
}

/// The cell that ends at vertex (c, r), the last one stored.
bool check_cell(SceneReading& reading, Mesh& mesh, std::uint32_t c, std::uint32_t r, const Token& at) {
  const std::uint64_t columns = mesh.cells_u + 1, last = mesh.first_vertex + r * columns + c;
  const SceneStore& store = reading.store;
  const Vec3 corner[4] = {store.vertex(last - columns - 1), store.vertex(last - 1), store.vertex(last),
                          store.vertex(last - columns)};
  const QuadShape shape = quad_shape(corner);
  if (shape == QuadShape::kCrossing) {
    MessageText message = reading.words.mistake(at);
    message.add("expected cells that do not cross themselves or fold over, found the cell of column ");
    message.add(c).add(", row ").add(r);
    return false;
  }
  if (shape == QuadShape::kNoArea) ++reading.store.scene().polygons_dropped;
  if (shape == QuadShape::kCut02 || shape == QuadShape::kCut13) mesh.cut = true;
  return true;
}

/// Is the last column of vertices the first?
bool wraps(const SceneStore& store, const Mesh& mesh) {
  const std::uint64_t columns = mesh.cells_u + 1;
  for (std::uint32_t r = 0; r <= mesh.cells_v; ++r) {
    const std::uint64_t first = mesh.first_vertex + r * columns;
    if (store.vertex(first) != store.vertex(first + columns - 1)) return false;
  }
  return mesh.cells_u > 1;
}

}  // namespace

/// object NAME [direct FLAGS] [ambient FLAGS]
bool read_object(SceneReading& reading) {
  Token name;
  if (!read_new_name(reading, "the name of an object", &SceneStore::find_object, name)) return false;
  Object object;
  if (!read_keys(reading, kObjectKeys, 1, &object)) return false;
  object.name = reading.store.add_name(name.text);
  object.first_mesh = static_cast<std::uint32_t>(reading.store.counts().meshes);
  reading.store.add(object);
  reading.sub_u = reading.sub_v = 0;
  return true;
}

/// quad MATERIAL, 4 corners [patches NU NV] [sub SU SV]
bool read_quad(SceneReading& reading) {
  Mesh mesh;
  Vec3 corner[4];
  GivenCounts given;
  if (!begin_surface(reading, mesh) || !read_corners(reading, corner, 4)) return false;
  if (!read_keys(reading, kCountKeys, kQuad, &given)) return false;
  Vec3 different[4];
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (corner[k] != corner[(k + 3) % 4]) different[count++] = corner[k];
  }
  if (!features::kMeshes && count == 3) return only_convex_quads(reading);
  if (count != 3) {
    const QuadShape shape = quad_shape(corner);
    if (shape == QuadShape::kCrossing) {
      reading.words.mistake(reading.statement).add("expected a quad that does not cross itself or fold over");
      return false;
    }
    if (!features::kMeshes && shape != QuadShape::kConvex && shape != QuadShape::kNoArea) {
      return only_convex_quads(reading);
    }
    return add_quad(reading, mesh, corner, shape, given);
  }
  given.nu = given.nv = larger(given.nu, given.nv);
  given.su = given.sv = larger(given.su, given.sv);
  return add_triangle(reading, mesh, different, given);
}

/// tri MATERIAL, 3 corners [patches N] [sub N]
bool read_tri(SceneReading& reading) {
  if constexpr (!features::kMeshes) return left_out(reading, reading.statement);
  Mesh mesh;
  Vec3 corner[3];
  GivenCounts given;
  if (!begin_surface(reading, mesh) || !read_corners(reading, corner, 3)) return false;
  if (!read_keys(reading, kCountKeys, kTri, &given)) return false;
  return add_triangle(reading, mesh, corner, given);
}

/// grid MATERIAL COLUMNS ROWS, the vertices row by row [sub SU SV]
bool read_grid(SceneReading& reading) {
  if constexpr (!features::kMeshes) return left_out(reading, reading.statement);
  Words& words = reading.words;
  Mesh mesh;
  mesh.kind = MeshKind::kGrid;
  std::uint32_t columns = 0, rows = 0;
  if (!begin_surface(reading, mesh) || !read_count(words, {"columns of vertices"}, 2, kMostPieces, columns) ||
      !read_count(words, {"rows of vertices"}, 2, kMostPieces, rows)) {
    return false;
  }
  mesh.cells_u = columns - 1;
  mesh.cells_v = rows - 1;
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const Token at = words.peek();
      Vec3 vertex;
      if (!read_point(words, {"vertex", r * columns + c + 1}, vertex)) return false;
      reading.store.add(vertex);
      if (c > 0 && r > 0 && reading.store.storing() && !check_cell(reading, mesh, c, r, at)) return false;
    }
  }
  mesh.wraps_u = reading.store.storing() && wraps(reading.store, mesh);
  GivenCounts given;
  return read_keys(reading, kCountKeys, kGrid, &given) && add_mesh(reading, mesh, given);
}

/// plane NAME, 4 corners [patches NU NV] [sub SU SV]; like a light it doesn't end an object.
bool read_plane(SceneReading& reading) {
  if constexpr (!features::kPlanes) return left_out(reading, reading.statement);
  Token name;
  Plane plane;
  GivenCounts given;
  if (!read_new_name(reading, "the name of a plane", &SceneStore::find_plane, name)) return false;
  if (!read_plane_quad(reading, plane.corners)) return false;
  if (!read_keys(reading, kCountKeys, kQuad, &given)) return false;
  if (reading.wanted.kind == Wanted::Kind::kPlane && reading.wanted.index == reading.store.counts().planes) {
    reading.words.place(reading.statement);
    return false;
  }
  plane.nu = given.nu;
  plane.nv = given.nv;
  plane.su = given.su;
  plane.sv = given.sv;
  plane.name = reading.store.add_name(name.text);
  reading.store.add(plane);
  return true;
}

/// sub OBJECT SU [SV]: for all meshes of the object, also those still to come; without SV it is SU. The last one
/// counts.
bool read_sub(SceneReading& reading) {
  Words& words = reading.words;
  std::uint32_t index = 0, su = 0, sv = 0;
  if (!read_reference(reading, "the name of an object", &SceneStore::find_object, index)) return false;
  if (!read_count(words, {"sub-patches along u"}, 1, kMostPieces, su)) return false;
  sv = su;
  const Token at = words.peek();
  if (words.at_word() && !read_count(words, {"sub-patches along v"}, 1, kMostPieces, sv)) return false;
  if (!reading.store.storing()) return true;
  Scene& scene = reading.store.scene();
  const Object& object = scene.objects[index];
  for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
    if (scene.meshes[m].kind == MeshKind::kTriangle && su != sv) {
      return words.expected(at, "equal counts for an object with a triangle");
    }
    scene.meshes[m].su = su;
    scene.meshes[m].sv = sv;
  }
  if (index + 1 == reading.store.counts().objects) {
    reading.sub_u = su;
    reading.sub_v = sv;
  }
  return true;
}

}  // namespace shodo
