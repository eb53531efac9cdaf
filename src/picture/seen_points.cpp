#include "picture/seen_points.h"

#include "base/interrupted.h"
#include "picture/picture.h"
#include "picture/view.h"
#include "picture/visible_lines.h"

namespace shodo {

namespace {

void tell_row(VisibleLines& lines, const Geometry& geometry, const SampleGrid& grid, std::uint32_t y,
              const SeenSink& sink) {
  lines.begin_row(y);
  for (VisibleSpan span; lines.next(span);) {
    const DrawnTriangle& drawn = geometry.drawn[span.triangle];
    SeenPoint seen;
    seen.y = y;
    seen.mesh = drawn.mesh;
    seen.light = drawn.light;
    seen.front = span.front;
    for (std::int32_t x = span.x0; x < span.x1; ++x) {
      seen.x = static_cast<std::uint32_t>(x);
      if (drawn.mesh != kNone) {
        const MapPoint at = exact_map_point(drawn, grid, x, static_cast<std::int32_t>(y));
        seen.u = at.u;
        seen.v = at.v;
      }
      sink.point(sink.context, seen);
    }
  }
}

}  // namespace

Status see_points(const Scene& scene, const Geometry& geometry, const Options& options, const Progress& progress,
                  Arena& arena, const SeenSink& sink) {
  const Camera* camera = find_camera(scene, options.camera);
  if (camera == nullptr) return no_camera(scene, options.camera);
  const ArenaScratch scratch(arena);
  const View view = view_of(*camera, geometry.lattice, options.width, options.height);
  const SampleGrid grid = sample_grid(view, options.width, options.height, options.antialias);
  VisibleLines lines;
  Scene seen = scene;
  seen.glass = {};  // what is behind it is asked for
  if (!lines.start(seen, geometry, grid, arena)) return arena.refused();
  for (std::uint32_t y = 0; y < grid.rows; ++y) {
    if (!progress.go_on(Stage::kPicture, y, grid.rows)) return interrupted();
    tell_row(lines, geometry, grid, y, sink);
  }
  return {};
}

}  // namespace shodo
