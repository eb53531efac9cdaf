// How far pictures are from the truth with each antialiasing (doc/optics.md, Antialiasing).
//
//   antialias SCENE WIDTH HEIGHT
//
// The truth is the mean, in linear light, of 16 x 16 samples a pixel: a picture of one sample a pixel and 16 times the
// size. Printed: root mean square in levels of 255, over all pixels and over those that more than one surface shows,
// and the share of values off by more than 8 levels.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "model.h"
#include "picture/visible_lines.h"
#include "support/antialias_truth.h"
#include "support/files.h"

namespace {

using namespace shodo;

struct Error {
  double squares = 0, edge_squares = 0;
  std::uint64_t values = 0, edge_values = 0, far = 0;

  void add(double off, bool edge) {
    squares += off * off;
    ++values;
    if (edge) edge_squares += off * off, ++edge_values;
    if (off > 8 || off < -8) ++far;
  }
  void print(std::uint32_t antialias) const {
    std::printf("--antialias %-2u  rms at edges %6.3f  overall %6.3f  off by more than 8: %.3f %%\n", antialias,
                std::sqrt(edge_squares / static_cast<double>(edge_values)),
                std::sqrt(squares / static_cast<double>(values)),
                100 * static_cast<double>(far) / static_cast<double>(values));
  }
};

/// Which pixels show more than one surface, by 16 x 16 samples each.
std::vector<bool> edges_of(const Model& model, std::uint32_t width, std::uint32_t height, Arena& arena) {
  const SampleGrid grid = sample_grid(view_of(model.scene.cameras[0], model.geometry.lattice, width * kTruthSamples,
                                              height * kTruthSamples),
                                      width * kTruthSamples, height * kTruthSamples, 1);
  std::vector<bool> edge(std::size_t{width} * height);
  std::vector<std::uint32_t> first(width);
  VisibleLines lines;
  if (!lines.start(model.scene, model.geometry, grid, arena)) std::exit(1);
  for (std::uint32_t y = 0; y < grid.rows; ++y) {
    std::vector<std::uint32_t> surface(grid.columns, kNone);
    lines.begin_row(y);
    for (VisibleSpan span; lines.next(span);) {
      for (std::int32_t x = span.x0; x < span.x1; ++x) {
        surface[static_cast<std::size_t>(x)] = lines.map_of(span.triangle) * 2 + span.front;
      }
    }
    for (std::uint32_t x = 0; x < grid.columns; ++x) {
      const std::uint32_t pixel = x / kTruthSamples;
      if (y % kTruthSamples == 0 && x % kTruthSamples == 0) first[pixel] = surface[x];
      if (surface[x] != first[pixel]) edge[std::size_t{y / kTruthSamples} * width + pixel] = true;
    }
  }
  return edge;
}

}  // namespace

int main(int count, char** words) {
  if (count != 4) return std::fprintf(stderr, "antialias SCENE WIDTH HEIGHT\n"), 2;
  const std::string path = words[1];
  const std::size_t slash = path.rfind('/');
  shodo::FolderReader files(slash == std::string::npos ? "." : path.substr(0, slash));
  std::string_view text;
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  if (!files.read(name, text)) return 1;
  Options options;
  options.rules.blocks = true;
  options.width = static_cast<std::uint32_t>(std::atoi(words[2]));
  options.height = static_cast<std::uint32_t>(std::atoi(words[3]));
  std::vector<std::uint64_t> memory(std::size_t{8} << 20), scratch(std::size_t{8} << 20);
  Model* model = nullptr;
  if (!load(name, text, files.reader(), options, memory.data(), 8 * memory.size(), model).done()) return 1;
  if (!solve(*model, {}).done()) return 1;

  const std::vector<double> truth = antialias_truth(*model);
  Arena arena(scratch.data(), 8 * scratch.size());
  const std::vector<bool> edge = edges_of(*model, options.width, options.height, arena);
  std::size_t edges = 0;
  for (const bool at : edge) edges += at ? 1 : 0;
  std::printf("pixels at edges: %.1f %%\n", 100 * static_cast<double>(edges) / static_cast<double>(edge.size()));
  for (const std::uint32_t antialias : {1u, 4u, 16u}) {
    const std::vector<std::uint8_t> picture = antialiased(*model, antialias);
    Error error;
    for (std::size_t k = 0; k < picture.size(); ++k) error.add(picture[k] - srgb_level(truth[k]), edge[k / 3]);
    error.print(antialias);
  }
  return 0;
}
