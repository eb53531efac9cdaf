#include "cli/map_files.h"

#include <bit>
#include <cstdio>

#include "cli/watch.h"

namespace shodo {

namespace {

/// Total illuminance of a sub-patch of the whole scene.
float total(const Model& model, std::size_t sub_patch, std::uint32_t channel) {
  const std::size_t at = sub_patch * model.scene.channels + channel;
  return model.maps.direct_lx[at] + model.maps.ambient_lx[at];
}

/// The value of cell (a, b) of a triangle's square.
float triangle_cell(const Model& model, const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t channel) {
  const std::uint32_t k = mesh.map_width();
  if (a + b >= k) return 0;
  const std::size_t upright = mesh.first_sub_patch + triangle_piece_order(k, {a, b, false});
  const float value = total(model, upright, channel);
  if (a + b == k - 1) return value;
  const std::size_t inverted = mesh.first_sub_patch + triangle_piece_order(k, {a, b, true});
  return 0.5f * (value + total(model, inverted, channel));
}

void add_little_endian(std::string& bytes, float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xff);
}

const char* kind_name(MeshKind kind) {
  switch (kind) {
    case MeshKind::kQuad: return "quad";
    case MeshKind::kTriangle: return "tri";
    case MeshKind::kGrid: return "grid";
  }
  return "";
}

std::string pfm_header(const Model& model, std::uint32_t width, std::uint32_t height) {
  return std::string(model.scene.channels == 1 ? "Pf\n" : "PF\n") + std::to_string(width) + " " +
         std::to_string(height) + "\n-1.0\n";
}

/// A measuring plane's map.
std::string plane_pfm(const Model& model, const Plane& plane) {
  const std::uint32_t channels = model.scene.channels;
  std::string bytes = pfm_header(model, plane.width(), plane.height());
  const std::size_t first = std::size_t{plane.first_sub_patch} * channels;
  for (std::size_t k = first; k < first + std::size_t{plane.sub_patch_count()} * channels; ++k) {
    add_little_endian(bytes, model.planes.direct_lx[k] + model.planes.ambient_lx[k]);
  }
  return bytes;
}

}  // namespace

std::string pfm(const Model& model, std::uint32_t m) {
  const Mesh& mesh = model.scene.meshes[m];
  const std::uint32_t channels = model.scene.channels, width = mesh.map_width(), height = mesh.map_height();
  std::string bytes = pfm_header(model, width, height);
  bytes.reserve(bytes.size() + std::size_t{4} * channels * width * height);
  for (std::uint32_t v = 0; v < height; ++v) {
    for (std::uint32_t u = 0; u < width; ++u) {
      for (std::uint32_t c = 0; c < channels; ++c) {
        const bool triangle = mesh.kind == MeshKind::kTriangle;
        const std::size_t at = mesh.first_sub_patch + std::size_t{v} * width + u;
        add_little_endian(bytes, triangle ? triangle_cell(model, mesh, u, v, c) : total(model, at, c));
      }
    }
  }
  return bytes;
}

std::string map_name(std::uint32_t mesh) {
  char name[24];
  std::snprintf(name, sizeof name, "%04u.pfm", mesh);
  return name;
}

std::string map_index(const Model& model) {
  std::string text = "file,object,mesh,kind,material,width,height,patches_u,patches_v,sub_u,sub_v\n";
  const Scene& scene = model.scene;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    text += map_name(m) + "," + std::string(scene.objects[mesh.object].name) + "," + std::to_string(m) + ",";
    text += kind_name(mesh.kind) + std::string(",") + std::string(scene.materials[mesh.material].name);
    for (const std::uint32_t n : {mesh.map_width(), mesh.map_height(), mesh.nu, mesh.nv, mesh.su, mesh.sv}) {
      text.append(1, ',').append(std::to_string(n));
    }
    text += "\n";
  }
  for (std::uint32_t p = 0; p < scene.planes.size(); ++p) {
    const Plane& plane = scene.planes[p];
    const std::uint32_t number = static_cast<std::uint32_t>(scene.meshes.size()) + p;
    text += map_name(number) + "," + std::string(plane.name) + "," + std::to_string(number) + ",plane,";
    for (const std::uint32_t n : {plane.width(), plane.height(), plane.nu, plane.nv, plane.su, plane.sv}) {
      text.append(1, ',').append(std::to_string(n));
    }
    text += "\n";
  }
  return text;
}

bool write_maps(const Model& model, OutputFolder& folder, FileError& error) {
  for (std::uint32_t m = 0; m < model.scene.meshes.size(); ++m) {
    if (interrupt_asked()) return false;
    if (!folder.write_file(map_name(m), pfm(model, m), error)) return false;
  }
  for (std::uint32_t p = 0; p < model.scene.planes.size(); ++p) {
    if (interrupt_asked()) return false;
    const std::string name = map_name(static_cast<std::uint32_t>(model.scene.meshes.size()) + p);
    if (!folder.write_file(name, plane_pfm(model, model.scene.planes[p]), error)) return false;
  }
  return folder.write_file("index.csv", map_index(model), error);
}

}  // namespace shodo
