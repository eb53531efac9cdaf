#include "picture/textured.h"

#include "picture/display.h"

namespace shodo {

namespace {

double larger(double a, double b) { return a > b ? a : b; }

TexturePlace place_at(const TexturedSpan& span, const TextureShade& shade, std::int32_t column) {
  const ActiveTriangle& active = span.active;
  TexturePlace at;
  if (active.wide_map) {
    const MapPoint exact = exact_map_point(span.carrier, span.grid, column, span.row);
    at.u = exact.u / 4096.0;
    at.v = exact.v / 4096.0;
    return at;
  }
  constexpr double kScale = 1 << (kInverseDepthBits - kMapBits);
  const double z = static_cast<double>(active.inverse_depth.at(column));
  const double u = static_cast<double>(active.map_u.at(column)) * kScale / z,
               v = static_cast<double>(active.map_v.at(column)) * kScale / z;
  at.inverse_depth = z;
  at.u = span.carrier.u[0] / 256.0 + u;
  at.v = span.carrier.v[0] / 256.0 + v;
  shade.set_texture_place(at);
  // d(U / z) = (dU - U / z dz) / z
  const auto slope = [&](std::int64_t du, double value, std::int64_t dz) {
    return magnitude(static_cast<double>(du) * kScale - value * static_cast<double>(dz)) / z;
  };
  const LinearValue &depth = active.inverse_depth, &map_u = active.map_u, &map_v = active.map_v;
  const double apart = 1 << (span.grid.split - span.grid.parts);  // columns from sample to sample
  const double across = larger(apart * slope(map_u.cx, u, depth.cx), slope(map_u.cy, u, depth.cy));
  const double up = larger(apart * slope(map_v.cx, v, depth.cx), slope(map_v.cy, v, depth.cy));
  at.step = shade.texels(across, up);
  return at;
}

void show_run(const TexturedSpan& span, const TextureShade& shade, const SampleRun& run, const SampleRow& samples) {
  const auto place = [&](std::int32_t x) { return place_at(span, shade, run.column_of(x)); };
  TexturePlace start = place(run.x0);
  for (std::int32_t x = run.x0; x < run.x1;) {
    std::int32_t reach = run.x1 - x <= TextureShade::kReach ? run.x1 - x - 1 : TextureShade::kReach;
    TexturePlace end = start;
    for (; reach > 0; reach /= 2) {
      end = place(x + reach);
      if (reach == 1 || shade.straight(start, end)) break;
    }
    const std::int32_t length = reach == 0 || x + reach + 1 == run.x1 ? reach + 1 : reach;
    shade.show_piece(length, reach, start, end, 65535, [&](std::int32_t k, const std::uint32_t (&steps)[3]) {
      std::uint32_t shown[3] = {0, 0, 0};
      for (std::uint32_t c = 0; c < samples.channels; ++c) shown[c] = samples.roll.shown(steps[c]);
      if (!samples.to_sums) return show_plain(samples, x + k, x + k + 1, shown);
      const std::uint32_t pixel = static_cast<std::uint32_t>(x + k) >> span.grid.parts;
      std::uint32_t* const sum = samples.sums + pixel * samples.channels;
      for (std::uint32_t c = 0; c < samples.channels; ++c) sum[c] += run.first * shown[c];
    });
    x += length;
    start = end;
  }
}

}  // namespace

void show_textured(const TexturedSpan& span, const SampleRow& samples) {
  const TextureShade shade(span.scene, span.mesh, span.texture, span.map);
  RunWalk walk(span.x0, span.x1, span.grid.split - span.grid.parts);
  for (SampleRun run; walk.next(run);) {
    show_run(span, shade, run, samples);
  }
}

}  // namespace shodo
