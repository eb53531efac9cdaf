#include "cli/table.h"

#include <cstdio>
#include <string>

#include "cli/watch.h"

namespace shodo {

namespace {

void add_number(std::string& line, double value) {
  char text[32];
  std::snprintf(text, sizeof text, ",%.9g", value + 0.0);  // -0 becomes 0
  line += text;
}

void add_vector(std::string& line, const Vec3& v) {
  for (const double component : {v.x, v.y, v.z}) add_number(line, component);
}

void add_light(std::string& line, std::span<const float> lux, std::size_t sub_patch, std::uint32_t channels) {
  for (std::uint32_t c = 0; c < 3; ++c) {
    add_number(line, static_cast<double>(lux[sub_patch * channels + (channels == 1 ? 0 : c)]));
  }
}

/// What the lines of meshes and planes end with.
std::string place_and_light(const Model& model, const Piece& piece, std::span<const float> direct_lx,
                            std::span<const float> ambient_lx, std::size_t sub_patch) {
  const Vec3 area = piece.vector_area();
  std::string line;
  add_vector(line, model.scene.origin + piece.centre());
  add_vector(line, normalised(area));
  add_number(line, length(area));
  add_light(line, direct_lx, sub_patch, model.scene.channels);
  add_light(line, ambient_lx, sub_patch, model.scene.channels);
  return line + "\n";
}

std::string table_line(const Model& model, const std::string& mesh_columns, const Mesh& mesh, std::uint32_t local) {
  const PieceIndex index = sub_patch_index(mesh, local);
  const bool triangle = mesh.kind == MeshKind::kTriangle;
  const std::uint32_t u = triangle ? 2 * index.u + (index.inverted ? 1 : 0) : index.u;
  return mesh_columns + "," + std::to_string(u) + "," + std::to_string(index.v) +
         place_and_light(model, sub_patch_piece(model.scene, mesh, local), model.maps.direct_lx, model.maps.ambient_lx,
                         mesh.first_sub_patch + std::size_t{local});
}

/// A sub-patch of plane p, which is numbered after the meshes.
std::string plane_line(const Model& model, std::uint32_t p, std::uint32_t local) {
  const Plane& plane = model.scene.planes[p];
  return std::string(plane.name) + "," + std::to_string(model.scene.meshes.size() + p) + "," +
         std::to_string(local % plane.width()) + "," + std::to_string(local / plane.width()) +
         place_and_light(model, plane_sub_patch(plane, local), model.planes.direct_lx, model.planes.ambient_lx,
                         plane.first_sub_patch + std::size_t{local});
}

}  // namespace

bool write_table(const Model& model, OutputFile& file, FileError& error) {
  if (!file.write("object,mesh,u,v,x,y,z,nx,ny,nz,area,direct_r,direct_g,direct_b,ambient_r,ambient_g,ambient_b\n",
                  error))
    return false;
  for (std::uint32_t m = 0; m < model.scene.meshes.size(); ++m) {
    if (interrupt_asked()) return false;
    const Mesh& mesh = model.scene.meshes[m];
    const std::string columns = std::string(model.scene.objects[mesh.object].name) + "," + std::to_string(m);
    for (std::uint32_t local = 0; local < mesh.sub_patch_count(); ++local) {
      // Drawing may have taken the memory of the patches.
      const std::uint32_t patch = patch_of_sub_patch(mesh, local);
      if (make_patch(model.scene, model.geometry, m, patch).dropped != 0) continue;
      if (!file.write(table_line(model, columns, mesh, local), error)) return false;
    }
  }
  for (std::uint32_t p = 0; p < model.scene.planes.size(); ++p) {
    if (interrupt_asked()) return false;
    for (std::uint32_t local = 0; local < model.scene.planes[p].sub_patch_count(); ++local) {
      if (!file.write(plane_line(model, p, local), error)) return false;
    }
  }
  return true;
}

}  // namespace shodo
