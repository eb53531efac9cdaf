#include "cli/summary.h"

#include <cstdio>

namespace shodo {

namespace {

/// Sums over sub-patches, in their order.
class Sums {
 public:
  void add(double area, double lux) {
    if (!(area > 0)) return;
    if (seen_ == 0 || lux < result_.least) result_.least = lux;
    if (seen_ == 0 || lux > result_.greatest) result_.greatest = lux;
    result_.area += area;
    weighted_ += area * lux;
    ++seen_;
  }
  void add_hidden(double area) { result_.hidden_area += area; }

  IlluminanceStatistics result(const Scene& scene) {
    const double square_metres = scene.metres_per_unit * scene.metres_per_unit;
    if (result_.area > 0) result_.mean = weighted_ / result_.area;
    // All alike: the mean of equal values is off by a rounding or two.
    if (result_.mean < result_.least) result_.mean = result_.least;
    if (result_.mean > result_.greatest) result_.mean = result_.greatest;
    result_.area *= square_metres;
    result_.hidden_area *= square_metres;
    return result_;
  }

 private:
  IlluminanceStatistics result_;
  double weighted_ = 0;
  std::uint64_t seen_ = 0;
};

std::string line(const char* kind, std::string_view name, const IlluminanceStatistics& s) {
  std::string text = kind;
  text.append(1, ',').append(name);
  for (const double value :
       {s.area, s.hidden_area, s.mean, s.least, s.greatest, s.overall_uniformity(), s.diversity()}) {
    char number[32];
    std::snprintf(number, sizeof number, ",%.9g", value);
    text += number;
  }
  return text.append(1, '\n');
}

}  // namespace

double illuminance(std::span<const float> direct_lx, std::span<const float> ambient_lx, std::size_t index,
                   std::uint32_t channels) {
  constexpr double kWeight[3] = {0.2126, 0.7152, 0.0722};
  const auto total = [&](std::size_t at) {
    return static_cast<double>(direct_lx[at]) + static_cast<double>(ambient_lx[at]);
  };
  if (channels == 1) return total(index);
  double lux = 0;
  for (std::uint32_t c = 0; c < 3; ++c) lux += kWeight[c] * total(3 * index + c);
  return lux;
}

IlluminanceStatistics object_statistics(const Model& model, std::uint32_t object) {
  const Scene& scene = model.scene;
  const Object& o = scene.objects[object];
  Sums sums;
  for (std::uint32_t m = o.first_mesh; m < o.first_mesh + o.mesh_count; ++m) {
    const Mesh& mesh = scene.meshes[m];
    for (std::uint32_t local = 0; local < mesh.sub_patch_count(); ++local) {
      const std::size_t index = std::size_t{mesh.first_sub_patch} + local;
      const double area = length(sub_patch_piece(scene, mesh, local).vector_area());
      const bool hidden = !model.maps.hidden.empty() && model.maps.hidden[index] != 0;
      if (hidden || make_patch(scene, model.geometry, m, patch_of_sub_patch(mesh, local)).dropped != 0) {
        sums.add_hidden(area);
      } else {
        sums.add(area, illuminance(model.maps.direct_lx, model.maps.ambient_lx, index, scene.channels));
      }
    }
  }
  return sums.result(scene);
}

IlluminanceStatistics plane_statistics(const Model& model, std::uint32_t p) {
  const Plane& plane = model.scene.planes[p];
  Sums sums;
  for (std::uint32_t local = 0; local < plane.sub_patch_count(); ++local) {
    const std::size_t index = std::size_t{plane.first_sub_patch} + local;
    const double area = length(plane_sub_patch(plane, local).vector_area());
    if (model.planes.hidden[index] != 0) {
      sums.add_hidden(area);
    } else {
      sums.add(area, illuminance(model.planes.direct_lx, model.planes.ambient_lx, index, model.scene.channels));
    }
  }
  return sums.result(model.scene);
}

std::string summary_table(const Model& model) {
  std::string text = "kind,name,area_m2,hidden_m2,mean_lx,least_lx,greatest_lx,uo,ud\n";
  for (std::uint32_t o = 0; o < model.scene.objects.size(); ++o) {
    if (model.scene.objects[o].mesh_count == 0) continue;
    text += line("object", model.scene.objects[o].name, object_statistics(model, o));
  }
  for (std::uint32_t p = 0; p < model.scene.planes.size(); ++p) {
    text += line("plane", model.scene.planes[p].name, plane_statistics(model, p));
  }
  return text;
}

}  // namespace shodo
