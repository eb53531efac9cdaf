#include "cli/surface_lux.h"

#include <algorithm>

#include "cli/summary.h"

namespace shodo {

namespace {

/// One cell's illuminance; false if it has none.
bool cell_lux(const Model& model, const Mesh& mesh, std::uint32_t a, std::uint32_t b, double& lux) {
  double sum = 0, count = 0;
  const auto add = [&](std::uint32_t local) {
    const std::size_t index = std::size_t{mesh.first_sub_patch} + local;
    if (!model.maps.hidden.empty() && model.maps.hidden[index] != 0) return;
    sum += illuminance(model.maps.direct_lx, model.maps.ambient_lx, index, model.scene.channels);
    count += 1;
  };
  if (mesh.kind != MeshKind::kTriangle) {
    add(b * mesh.map_width() + a);
  } else if (const std::uint32_t k = mesh.map_width(); a + b < k) {
    add(triangle_piece_order(k, {a, b, false}));
    if (a + b + 1 < k) add(triangle_piece_order(k, {a, b, true}));
  }
  lux = count > 0 ? sum / count : 0;
  return count > 0;
}

/// Two cells between whose centres a coordinate lies.
struct Between {
  std::uint32_t low = 0, high = 0;
  double part = 0;  // of `high`
};

Between between(std::int32_t coordinate, std::uint32_t count, bool wraps) {
  const std::int32_t from_centre = coordinate - 2048, n = static_cast<std::int32_t>(count);
  const std::int32_t low = from_centre >> 12;
  const auto cell = [&](std::int32_t k) {
    return static_cast<std::uint32_t>(wraps ? (k % n + n) % n : std::clamp(k, 0, n - 1));
  };
  return {cell(low), cell(low + 1), static_cast<double>(from_centre & 4095) / 4096};
}

}  // namespace

double surface_lux(const Model& model, std::uint32_t m, std::int32_t u, std::int32_t v) {
  const Mesh& mesh = model.scene.meshes[m];
  const Between a = between(u, mesh.map_width(), mesh.wraps_u), b = between(v, mesh.map_height(), false);
  double sum = 0, weight = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const bool high_u = corner % 2 == 1, high_v = corner / 2 == 1;
    const double w = (high_u ? a.part : 1 - a.part) * (high_v ? b.part : 1 - b.part);
    double lux = 0;
    if (!(w > 0) || !cell_lux(model, mesh, high_u ? a.high : a.low, high_v ? b.high : b.low, lux)) continue;
    sum += w * lux;
    weight += w;
  }
  return weight > 0 ? sum / weight : 0;
}

std::uint32_t sub_patch_at(const Mesh& mesh, std::int32_t u, std::int32_t v) {
  const auto cell = [](std::int32_t coordinate, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(coordinate >> 12, 0, static_cast<std::int32_t>(count) - 1));
  };
  std::uint32_t a = cell(u, mesh.map_width()), b = cell(v, mesh.map_height());
  if (mesh.kind != MeshKind::kTriangle) return b * mesh.map_width() + a;
  const std::uint32_t k = mesh.map_width();
  if (a + b >= k) a = k - 1 - std::min(b, k - 1);  // rounding, on the hypotenuse
  const bool beyond = (u & 4095) + (v & 4095) > 4096;
  return triangle_piece_order(k, {a, b, beyond && a + b + 1 < k});
}

}  // namespace shodo
