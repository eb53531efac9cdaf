// Reads the faces of a Wavefront OBJ file into an object of the scene.
//
// Source: Wavefront Technologies, the Advanced Visualizer, appendix B1, Object Files (.obj). Every face becomes a mesh
// of one patch: 3 corners a triangle, 4 a quad, more the triangles that it is cut into (scene/polygon_cut.h). Fronts
// are as a quad's, (v2 - v1) x (v3 - v1); normals, texture coordinates, groups, lines and points are skipped, and so is
// how a face is to be shown. Free-form curves and surfaces are refused, and so is what can't be in an OBJ file.
//
// Materials are those of the files that `mtllib` names, and are a namespace of the model's own: they become materials
// of the scene that have no name there, only those that a face has, ascending by their names.
//
// Scratch of the arena, given back at the end: 24 bytes a vertex, 64 a `usemtl` that faces follow (64-bit pointers), 46
// a corner of the largest face. All are counted before they are taken. Time: n log m for n bytes and m materials,
// besides cutting polygons.
#pragma once

#include <string_view>

#include "base/vector.h"
#include "scene/statements.h"

namespace shodo {

/// Where a model goes: p -> turned(scale p) + at, about x, then y, then z.
struct ModelPlace {
  double scale = 1;
  Vec3 turn;  // degrees, right-handed
  Vec3 at;
};

/// Hands all faces to reading.store, for the object that is open. `path` and `text` as Words::read() gave them;
/// `material`: of the scene, for all faces, and then no MTL file is asked for; kNone: those of the MTL files.
///
/// False, with file:line:column of the OBJ or MTL file in the status, for what is refused above, an index that is no
/// vertex's, fewer than 3 or more than kMostCorners corners, a face that crosses itself, coordinates beyond 1e30, a
/// material that no file has; kFile for an MTL file that can't be read, kMemory if the scratch doesn't fit.
bool read_obj_file(SceneReading& reading, std::string_view path, std::string_view text, const ModelPlace& place,
                   std::uint32_t material);

}  // namespace shodo
