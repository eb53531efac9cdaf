// The rooms' pictures against a slow twin: every pixel by an exact ray, exact map coordinates and the bilinear formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model.h"
#include "picture/display.h"
#include "picture/view.h"
#include "support/collected_lines.h"
#include "support/files.h"
#include "support/picture_twin.h"

namespace shodo {
namespace {

struct SolvedRoom {
  explicit SolvedRoom(std::string_view name) : memory(std::size_t{1} << 20), scratch(std::size_t{1} << 20) {
    Options options;
    options.rules.blocks = true;
    options.width = 320;
    options.height = 256;
    options.antialias = 1;
    options.effects = false;  // the twin knows maps
    std::string_view text;
    EXPECT_TRUE(files.read(name, text));
    EXPECT_TRUE(load(name, text, files.reader(), options, memory.data(), 8 * memory.size(), model).done());
    EXPECT_TRUE(solve(*model, {}).done());
  }
  std::vector<std::uint8_t> picture() {
    std::vector<std::uint8_t> rgb;
    const LineSink sink = collected_in(rgb);
    EXPECT_TRUE(draw(*model, {}, sink).done());
    return rgb;
  }

  FolderReader files{source_folder() + "/data"};
  std::vector<std::uint64_t> memory, scratch;
  Model* model = nullptr;
};

/// Display steps of a mesh at (u, v).
double steps_at(const Scene& scene, const DisplayMaps& maps, const Mesh& mesh, double u, double v, std::uint32_t c) {
  const std::int64_t width = mesh.map_width(), height = mesh.map_height();
  const auto texel = [&](std::int64_t x, std::int64_t y) {
    x = mesh.wraps_u ? (x % width + width) % width : std::clamp<std::int64_t>(x, 0, width - 1);
    y = std::clamp<std::int64_t>(y, 0, height - 1);
    const std::size_t at = mesh.first_sub_patch + static_cast<std::size_t>(y * width + x);
    return double{1} * maps.texel[at * scene.channels + c];
  };
  const double x = std::floor(u - 0.5), y = std::floor(v - 0.5), s = u - 0.5 - x, t = v - 0.5 - y;
  const std::int64_t i = static_cast<std::int64_t>(x), j = static_cast<std::int64_t>(y);
  return (1 - t) * ((1 - s) * texel(i, j) + s * texel(i + 1, j)) +
         t * ((1 - s) * texel(i, j + 1) + s * texel(i + 1, j + 1));
}

/// How many values of the picture differ from the twin's by 0, 1 and more levels.
struct Apart {
  std::uint64_t none = 0, one = 0, more = 0;
};

Apart levels_apart(SolvedRoom& room) {
  Model& model = *room.model;
  const Options& options = model.options;
  // Before the picture may take their memory.
  Arena arena(room.scratch.data(), 8 * room.scratch.size());
  DisplayMaps maps;
  EXPECT_TRUE(build_display_maps(model.scene, model.maps, arena, maps));
  Geometry geometry = model.geometry;
  EXPECT_TRUE(place_drawn(model.scene, arena, geometry));
  const std::vector<std::uint8_t> rgb = room.picture();
  std::vector<std::uint8_t> level(kWhite + 1);
  fill_display_table(level);
  const SampleGrid grid =
      sample_grid(view_of(model.scene.cameras[0], geometry.lattice, options.width, options.height), options.width,
                  options.height, 1);
  const PictureTwin twin(model.scene, geometry, grid);
  Apart apart;
  for (std::uint32_t y = 0; y < options.height; ++y) {
    for (std::uint32_t x = 0; x < options.width; ++x) {
      const TwinHit hit = twin.hit(x, y);
      const auto at = hit.triangle == kNone ? std::array<long double, 2>{} : twin.map_point(hit.triangle, x, y);
      for (std::uint32_t c = 0; c < 3; ++c) {
        double steps = 0;
        if (hit.triangle != kNone && hit.front) {
          const DrawnTriangle& drawn = geometry.drawn[hit.triangle];
          const Light* const light = drawn.light == kNone ? nullptr : &model.scene.lights[drawn.light];
          steps = light != nullptr ? luminance_steps(model.scene.display, light->strength * light->colour.c[c])
                                   : steps_at(model.scene, maps, model.scene.meshes[drawn.mesh],
                                              static_cast<double>(at[0]), static_cast<double>(at[1]), c);
        }
        const int truth = level[static_cast<std::size_t>(std::lround(std::min(steps, double{kWhite})))];
        const int off = std::abs(truth - rgb[(std::size_t{y} * options.width + x) * 3 + c]);
        ++(off == 0 ? apart.none : off == 1 ? apart.one : apart.more);
      }
    }
  }
  return apart;
}

// Texels are 16 pixels wide at 1280 pixels and 4 here, so coordinates that are right to 1/16 matter as much. Beside the
// edges of sunlight levels change by 100 within a texel.
TEST(Rooms, PicturesAreTheTwinsToOneLevelAtNineHundredAndNinetyNineOfAThousandPixels) {
  for (const char* const name : {"day.scn", "evening.scn"}) {
    SolvedRoom room(name);
    const Apart apart = levels_apart(room);
    EXPECT_LT(apart.more * 1000, apart.none + apart.one + apart.more) << name << ' ' << apart.more;
    EXPECT_LT(apart.one * 20, apart.none) << name << ' ' << apart.one;
  }
}

}  // namespace
}  // namespace shodo
