#include "picture/picture.h"

#include "base/interrupted.h"
#include "base/text.h"
#include "picture/display.h"
#include "picture/optics.h"
#include "picture/shade.h"
#include "picture/texels.h"
#include "picture/textured.h"
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

Status wrong_size() {
  Status status;
  status.code = StatusCode::kUsage;
  MessageText(status.message, sizeof status.message).add("expected a picture of 1 to 16384 pixels each way");
  return status;
}

SampleGrid grid_of(const Camera& camera, const Lattice& lattice, const Options& options) {
  const View view = view_of(camera, lattice, options.width, options.height);
  return picture_grid(view, options.width, options.height, options.antialias);
}

}  // namespace

struct Picture {
  const Scene* scene = nullptr;
  const Geometry* geometry = nullptr;
  SampleGrid grid;
  DisplayMaps maps;
  VisibleLines lines;
  bool with_optics = false;
  Display display;                 // as the scene has it
  PictureOptics optics;
  Scene shown;                     // with optics: the scene on their display
  RollOff roll;                    // of what isn't rolled off in the maps
  std::span<MeshTexture> textures;  // by mesh; empty in scenes without
  std::span<std::uint8_t> level;   // sRGB of display steps
  std::span<std::uint32_t> sums;   // [pixel * channels + channel]: display steps times columns, if pixels mix; mostly 0
  std::span<std::uint8_t> rgb;
};

namespace {

/// Sums of a line of pixels: none where a pixel is one sample that shows one surface.
std::size_t sums_of(const SampleGrid& grid, std::uint32_t width, std::uint32_t channels, bool with_optics) {
  return grid.split == 0 && !with_optics ? 0 : std::size_t{width} * channels;
}

bool prepare(Picture& picture, const IlluminanceMaps& maps, const Options& options, Arena& arena) {
  const Scene& scene = *picture.scene;
  if (!build_display_maps(scene, maps, arena, picture.maps)) return false;
  if (!arena.take("display table", kWhite + 1, picture.level)) return false;
  if (!arena.take("sums of a line", sums_of(picture.grid, options.width, scene.channels, picture.with_optics),
                  picture.sums)) return false;
  for (std::uint32_t& sum : picture.sums) sum = 0;
  if (!arena.take("line of pixels", std::size_t{3} * options.width, picture.rgb)) return false;
  if (!find_mesh_textures(scene, arena, picture.textures)) return false;
  const Display& display = picture.display;
  fill_display_table(picture.level, picture.with_optics ? display.min_cd_m2 / display.max_cd_m2 : 0);
  if (!picture.lines.start(scene, *picture.geometry, picture.grid, arena)) return false;
  return !picture.with_optics ||
         picture.optics.start({scene, *picture.geometry, picture.maps, picture.grid, picture.textures,
                               picture.lines.carriers()}, display, arena);
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

void show_light(const Picture& picture, const Light& light, const VisibleSpan& span, const SampleRow& samples) {
  std::uint32_t shown[3] = {0, 0, 0};
  for (std::uint32_t c = 0; c < samples.channels; ++c) {
    shown[c] = samples.roll.shown(luminance_steps(picture.scene->display, light.strength * light.colour.c[c]));
  }
  if (!samples.to_sums) return show_plain(samples, span.x0, span.x1, shown);
  const SampleRun run = pixels_of(span.x0, span.x1, samples.split);
  const EndPixels ends(run, samples.channels, samples.sums);
  show_plain(samples, run.x0, run.x1, shown);
  ends.weigh();
}

/// Sums have nothing to add.
void show_black(const SampleRow& samples, std::int32_t x0, std::int32_t x1) {
  if (!samples.to_sums) show_plain(samples, x0, x1, {0, 0, 0});
}

/// Adjacent spans of one map; empty if x0 = x1.
struct MapSpan {
  std::int32_t x0 = 0, x1 = 0;
  std::uint32_t carrier = kNone;
  const ActiveTriangle* active = nullptr;
};

/// Whether the span's plane goes on to the middles of its first and last pixel, at more than half the inverse depth.
bool goes_on(const MapSpan& span, const SampleRun& pixels) {
  if (span.active->wide_map) return false;
  const LinearValue& depth = span.active->inverse_depth;
  return depth.at(pixels.column) > depth.at(span.x0) >> 1 &&
         depth.at(pixels.column_of(pixels.x1 - 1)) > depth.at(span.x1 - 1) >> 1;
}

void show_map(const MapTexels& texels, MapWalk walk, const SampleRow& samples) {
  for (MapPiece piece; walk.next(piece);) show_piece(texels, piece, samples);
}

void show_span(const Picture& picture, const MapSpan& span, std::uint32_t row, const SampleRow& samples) {
  const DrawnTriangle& carrier = picture.geometry->drawn[span.carrier];
  const Mesh& mesh = picture.scene->meshes[carrier.mesh];
  const MapTexels texels = texels_of(picture, mesh);
  if (!picture.textures.empty() && picture.textures[carrier.mesh].texture != kNone) {
    SampleRow textured = samples;
    textured.roll = picture.roll;
    return show_textured({*picture.scene, mesh, picture.textures[carrier.mesh], texels, *span.active, carrier,
                          picture.grid, static_cast<std::int32_t>(row), span.x0, span.x1}, textured);
  }
  const auto walk = [&](const SampleRun& run) {
    return MapWalk(*span.active, carrier, picture.grid, static_cast<std::int32_t>(row), run);
  };
  if (!samples.to_sums) return show_map(texels, walk({span.x0, span.x1, span.x0}), samples);
  const auto show = [&](const SampleRun& run) {
    const EndPixels ends(run, samples.channels, samples.sums);
    show_map(texels, walk(run), samples);
    ends.weigh();
  };
  SampleRun run = pixels_of(span.x0, span.x1, samples.split);
  if (goes_on(span, run)) return show(run);
  RunWalk runs(span.x0, span.x1, samples.split);
  while (runs.next(run)) show(run);
}

/// Shows pixels' means over their rows and columns in sRGB, a grey scene's one channel three times; empties the sums.
void show_sums(Picture& picture, std::uint32_t x0, std::uint32_t x1) {
  const std::uint32_t channels = picture.scene->channels, next = 4 - channels;
  const std::uint32_t bits = picture.grid.split + picture.grid.parts, half = (1u << bits) / 2;
  std::uint8_t* rgb = &picture.rgb[3 * std::size_t{x0}];
  for (std::uint32_t& sum : picture.sums.subspan(x0 * channels, (x1 - x0) * channels)) {
    rgb[0] = picture.level[(sum + half) >> bits];
    if (channels == 1) rgb[1] = rgb[2] = rgb[0];
    rgb += next;
    sum = 0;
  }
}

/// Columns x0 .. x1 - 1 see a triangle first that does more than reflect diffusely, or nothing (kNone).
void show_optics(Picture& picture, std::uint32_t triangle, std::int32_t x0, std::int32_t x1, std::uint32_t row,
                 const SampleRow& samples) {
  picture.optics.add(triangle, x0, x1, row, picture.sums);
  if (samples.to_sums) return;
  show_sums(picture, static_cast<std::uint32_t>(x0), static_cast<std::uint32_t>(x1));
}

/// Adds one row to the picture; nothing and backs are black.
template <bool kOptics>
void show_row(Picture& picture, std::uint32_t row) {
  const SampleRow samples{picture.level.data(), picture.rgb.data(), picture.sums.data(), picture.grid.split,
                          picture.scene->channels, picture.grid.split != 0, kOptics ? picture.roll : RollOff{}};
  VisibleLines& lines = picture.lines;
  lines.begin_row(row);
  MapSpan map;
  std::int32_t end = 0;
  const auto empty_until = [&](std::int32_t x) {
    if (map.x0 < map.x1) show_span(picture, map, row, samples);
    map = {};
    if (x <= end) return;
    if constexpr (kOptics) {
      show_optics(picture, kNone, end, x, row, samples);
    } else {
      show_black(samples, end, x);
    }
  };
  for (VisibleSpan span; lines.next(span);) {
    const DrawnTriangle& drawn = picture.geometry->drawn[span.triangle];
    if constexpr (kOptics) {
      const bool takes = picture.optics.takes(drawn, span.front);
      if (takes || !span.front) {
        empty_until(span.x0);
        end = span.x1;
        takes ? show_optics(picture, span.triangle, span.x0, span.x1, row, samples)
              : show_black(samples, span.x0, span.x1);
        continue;
      }
    }
    if (!span.front) continue;
    const bool is_light = drawn.light != kNone;
    if (!is_light && span.x0 == map.x1 && map.carrier == lines.map_of(span.triangle)) {
      end = map.x1 = span.x1;
      continue;
    }
    empty_until(span.x0);
    end = span.x1;
    if (is_light) {
      show_light(picture, picture.scene->lights[drawn.light], span, samples);
    } else {
      map = {span.x0, span.x1, lines.map_of(span.triangle), &lines.active(span.active)};
    }
  }
  empty_until(static_cast<std::int32_t>(picture.grid.columns));
}

constexpr std::uint64_t rounded_up(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

Status prepare_picture(const Scene& scene, const Geometry& geometry, const IlluminanceMaps& maps,
                       const Options& options, Arena& arena, Picture*& prepared) {
  const Camera* camera = find_camera(scene, options.camera);
  if (camera == nullptr) return no_camera(scene, options.camera);
  constexpr std::uint32_t kMost = 16384;  // four rows of samples a pixel: 16 bits number them
  if (options.width - 1 >= kMost || options.height - 1 >= kMost) return wrong_size();
  std::span<Picture> room;
  if (!arena.take("picture", 1, room)) return arena.refused();
  Picture& picture = *new (room.data()) Picture;
  picture.scene = &scene;
  picture.geometry = &geometry;
  picture.display = scene.display;
  if (PictureOptics::used(scene)) {
    picture.with_optics = true;
    picture.shown = scene;
    picture.shown.display = PictureOptics::display_of(scene);
    picture.scene = &picture.shown;
  }
  // With optics all is added up from luminance 0 first; without, only textured maps aren't rolled off themselves.
  picture.roll.on = scene.display.roll;
  picture.roll.black = picture.with_optics ? luminance_steps(picture.shown.display, scene.display.min_cd_m2) : 0;
  picture.grid = grid_of(*camera, geometry.lattice, options);
  if (!prepare(picture, maps, options, arena)) return arena.refused();
  prepared = &picture;
  return {};
}

Status draw_lines(Picture& picture, const Options& options, const Progress& progress, const LineSink& sink) {
  const std::uint32_t rows = 1u << picture.grid.parts;
  for (std::uint32_t y = 0; y < options.height; ++y) {
    if (!progress.go_on(Stage::kPicture, y, options.height)) return interrupted();
    for (std::uint32_t row = y * rows; row < (y + 1) * rows; ++row) {
      picture.with_optics ? show_row<true>(picture, row) : show_row<false>(picture, row);
    }
    if (picture.grid.split != 0) show_sums(picture, 0, options.width);
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
  const std::size_t sums = sums_of(grid, options.width, scene.channels, PictureOptics::used(scene));
  const std::uint64_t lines = rounded_up(kWhite + 1) + rounded_up(4 * std::uint64_t{sums}) +
                              rounded_up(3 * std::uint64_t{options.width}) + mesh_texture_bytes(scene) +
                              VisibleLines::bytes(scene, geometry, grid) + PictureOptics::bytes(scene, geometry);
  return rounded_up(sizeof(Picture)) + rounded_up(2 * std::uint64_t{scene.sub_patch_count} * scene.channels) +
         (rounded_up(filling) > lines ? rounded_up(filling) : lines);
}

}  // namespace shodo
