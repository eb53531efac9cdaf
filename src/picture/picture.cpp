#include "picture/picture.h"

#include "base/text.h"
#include "picture/display.h"
#include "picture/optics.h"
#include "picture/shade.h"
#include "picture/view.h"
#include "picture/visible_lines.h"

namespace shodo {

const Camera* find_camera(const Scene& scene, std::string_view name) {
  if (name.empty()) return scene.cameras.empty() ? nullptr : &scene.cameras[0];
  for (const Camera& camera : scene.cameras) {
    if (camera.name == name) return &camera;
  }
  return nullptr;
}

Status no_camera(const Scene& scene, std::string_view name) {
  Status status;
  status.code = StatusCode::kUsage;
  MessageText text(status.message, sizeof status.message);
  if (scene.cameras.empty()) {
    text.add("expected a camera in the scene, found none");
  } else {
    text.add("expected the name of a camera of the scene (the first is ").add(scene.cameras[0].name);
    text.add("), found ").add(name);
  }
  return status;
}

namespace {

SampleGrid grid_of(const Camera& camera, const Lattice& lattice, const Options& options) {
  const View view = view_of(camera, lattice, options.width, options.height);
  return sample_grid(view, options.width, options.height, options.antialias);
}

/// Everything that lines are made of.
struct Picture {
  const Scene* scene = nullptr;
  const Geometry* geometry = nullptr;
  SampleGrid grid;
  DisplayMaps maps;
  VisibleLines lines;
  bool with_optics = false;
  double black = 0;                // with optics: the display's MIN
  PictureOptics optics;
  Scene shown;                     // with optics: the scene on their display
  std::span<std::uint8_t> level;   // sRGB of display steps
  std::span<std::uint32_t> sums;   // [pixel * channels + channel]: display steps of a pixel's samples
  std::span<std::uint8_t> rgb;
};

bool prepare(Picture& picture, const IlluminanceMaps& maps, const Options& options, Arena& arena) {
  const Scene& scene = *picture.scene;
  if (!build_display_maps(scene, maps, arena, picture.maps)) return false;
  if (!arena.take("display table", kWhite + 1, picture.level)) return false;
  if (!arena.take("line of samples", std::size_t{options.width} * scene.channels, picture.sums)) return false;
  if (!arena.take("line of pixels", std::size_t{3} * options.width, picture.rgb)) return false;
  const Display& display = scene.display;
  fill_display_table(picture.level, picture.with_optics ? picture.black / display.max_cd_m2 : 0);
  if (!picture.lines.start(scene, *picture.geometry, picture.grid, arena)) return false;
  return !picture.with_optics || picture.optics.start(scene, *picture.geometry, picture.maps, picture.grid, arena);
}

MapTexels texels_of(const Picture& picture, const Mesh& mesh) {
  const Scene& scene = *picture.scene;
  MapTexels texels;
  texels.texel = &picture.maps.texel[std::size_t{mesh.first_sub_patch} * scene.channels];
  texels.width = static_cast<std::int32_t>(mesh.map_width());
  texels.height = static_cast<std::int32_t>(mesh.map_height());
  texels.channels = scene.channels;
  texels.wraps_u = mesh.wraps_u;
  return texels;
}

void add_light(Picture& picture, const Light& light, const VisibleSpan& span) {
  const std::uint32_t channels = picture.scene->channels;
  for (std::uint32_t c = 0; c < channels; ++c) {
    const std::uint32_t steps = luminance_steps(picture.scene->display, light.strength * light.colour.c[c]);
    const std::uint32_t shown = steps < kWhite ? steps : kWhite;
    for (std::int32_t x = span.x0; x < span.x1; ++x) {
      picture.sums[(static_cast<std::uint32_t>(x) >> picture.grid.shift) * channels + c] += shown;
    }
  }
}

/// Backs are black.
void add_span(Picture& picture, const VisibleSpan& span, std::uint32_t row) {
  if (!span.front) return;
  const DrawnTriangle& drawn = picture.geometry->drawn[span.triangle];
  if (drawn.light != kNone) {
    add_light(picture, picture.scene->lights[drawn.light], span);
    return;
  }
  const MapTexels texels = texels_of(picture, picture.scene->meshes[drawn.mesh]);
  MapWalk walk(picture.lines.active(span.active), drawn, picture.grid, static_cast<std::int32_t>(row), span.x0,
               span.x1);
  for (MapPiece piece; walk.next(piece);) add_piece(texels, piece, picture.grid.shift, picture.sums);
}

/// Adds one row of samples to the sums of its pixels.
void add_row(Picture& picture, std::uint32_t row) {
  picture.lines.begin_row(row);
  for (VisibleSpan span; picture.lines.next(span);) add_span(picture, span, row);
}

/// The same with mirrors, glass, highlights and a background.
void add_row_with_optics(Picture& picture, std::uint32_t row) {
  picture.lines.begin_row(row);
  std::int32_t end = 0;
  for (VisibleSpan span; picture.lines.next(span); end = span.x1) {
    picture.optics.add(kNone, end, span.x0, row, picture.sums);
    if (picture.optics.takes(picture.geometry->drawn[span.triangle], span.front)) {
      picture.optics.add(span.triangle, span.x0, span.x1, row, picture.sums);
    } else {
      add_span(picture, span, row);
    }
  }
  picture.optics.add(kNone, end, static_cast<std::int32_t>(picture.grid.columns), row, picture.sums);
}

/// The mean over each pixel's samples in sRGB; a grey scene's one channel three times.
void finish_line(Picture& picture, std::uint32_t width) {
  const std::uint32_t channels = picture.scene->channels, bits = 2 * picture.grid.shift;
  const std::uint32_t half = bits == 0 ? 0 : 1u << (bits - 1);
  for (std::uint32_t x = 0; x < width; ++x) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t sum = picture.sums[x * channels + (channels == 1 ? 0 : c)];
      picture.rgb[3 * x + c] = picture.level[(sum + half) >> bits];
    }
  }
}

Status interrupted() {
  Status status;
  status.code = StatusCode::kInterrupted;
  return status;
}

constexpr std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

Status draw_picture(const Scene& scene, const Geometry& geometry, const IlluminanceMaps& maps, const Options& options,
                    const Progress& progress, Arena& arena, const LineSink& sink) {
  const Camera* camera = find_camera(scene, options.camera);
  if (camera == nullptr) return no_camera(scene, options.camera);
  const ArenaScratch scratch(arena);
  Picture picture;
  picture.scene = &scene;
  picture.geometry = &geometry;
  if (PictureOptics::used(scene)) {
    picture.with_optics = true;
    picture.shown = scene;
    picture.shown.display = PictureOptics::display_of(scene);
    picture.black = scene.display.min_cd_m2;
    picture.scene = &picture.shown;
  }
  picture.grid = grid_of(*camera, geometry.lattice, options);
  if (!prepare(picture, maps, options, arena)) return arena.refused();
  const std::uint32_t rows = 1u << picture.grid.shift;
  for (std::uint32_t y = 0; y < options.height; ++y) {
    if (!progress.go_on(Stage::kPicture, y, options.height)) return interrupted();
    for (std::uint32_t& sum : picture.sums) sum = 0;
    for (std::uint32_t row = y * rows; row < (y + 1) * rows; ++row) {
      picture.with_optics ? add_row_with_optics(picture, row) : add_row(picture, row);
    }
    finish_line(picture, options.width);
    if (sink.line != nullptr && !sink.line(sink.context, y, picture.rgb)) return interrupted();
  }
  if (!progress.go_on(Stage::kPicture, options.height, options.height)) return interrupted();
  return {};
}

std::uint64_t picture_bytes(const Scene& scene, const Geometry& geometry, const Options& options) {
  const Camera* camera = find_camera(scene, options.camera);
  if (camera == nullptr) return 0;
  const SampleGrid grid = grid_of(*camera, geometry.lattice, options);
  std::uint64_t filling = 0;
  for (const Mesh& mesh : scene.meshes) filling = mesh.sub_patch_count() > filling ? mesh.sub_patch_count() : filling;
  const std::uint64_t lines = rounded_up(kWhite + 1) + rounded_up(4 * std::uint64_t{options.width} * scene.channels) +
                              rounded_up(3 * std::uint64_t{options.width}) + VisibleLines::bytes(scene, geometry, grid) +
                              PictureOptics::bytes(scene, geometry);
  return rounded_up(2 * std::uint64_t{scene.sub_patch_count} * scene.channels) +
         (rounded_up(filling) > lines ? rounded_up(filling) : lines);
}

}  // namespace shodo
