// A prototype that judges antialiasing (doc/optics.md, Antialiasing): samples against coverage of edges.
//
//   antialias SCENE WIDTH HEIGHT
//
// The picture is drawn with 16 x 16 samples a pixel; their mean is the truth. Of the same samples are made: plain means
// of 1, 2 x 2 and 4 x 4 of them; and coverage, where a pixel's surfaces count by the samples that see them, all 16 of a
// row as if edges were known exactly along it, in 1 to 16 rows, but each surface shows the one value that it has
// nearest to the pixel's middle. Printed: root mean square, over all pixels and over those that more than one surface
// shows, and the share of pixels off by more than 8 of 255 levels.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "model.h"
#include "picture/picture.h"
#include "picture/visible_lines.h"
#include "support/files.h"

namespace {

using namespace shodo;

constexpr std::uint32_t kSub = 16;

double linear(int level) {
  const double s = level / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
double srgb(double v) { return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055); }

struct Error {
  double squares = 0, edge_squares = 0;
  std::uint64_t values = 0, edge_values = 0, far = 0;

  void add(double off, bool edge) {
    squares += off * off;
    ++values;
    if (edge) edge_squares += off * off, ++edge_values;
    if (off > 8 || off < -8) ++far;
  }
  void print(const std::string& name) const {
    std::printf("%-34s rms %6.3f  at edges %6.3f  off by more than 8: %.3f %%\n", name.c_str(),
                std::sqrt(squares / static_cast<double>(values)),
                std::sqrt(edge_squares / static_cast<double>(edge_values)),
                100 * static_cast<double>(far) / static_cast<double>(values));
  }
};

struct Lines {
  std::vector<std::vector<std::uint8_t>> rgb;
  std::vector<std::vector<std::uint32_t>> surface;
};

/// Mean over `rows` x `columns` of the samples, evenly spread.
double samples(const Lines& lines, std::uint32_t px, std::uint32_t count, std::uint32_t c) {
  double sum = 0;
  for (std::uint32_t j = 0; j < count; ++j) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t y = (2 * j + 1) * kSub / (2 * count), x = px * kSub + (2 * i + 1) * kSub / (2 * count);
      sum += linear(lines.rgb[y][3 * x + c]);
    }
  }
  return sum / (count * count);
}

/// Surfaces by what they cover along `rows` rows; each by one value.
double coverage(const Lines& lines, std::uint32_t px, std::uint32_t rows, std::uint32_t c) {
  double sum = 0;
  for (std::uint32_t j = 0; j < rows; ++j) {
    const std::uint32_t y = (2 * j + 1) * kSub / (2 * rows);
    for (std::uint32_t i = 0; i < kSub; ++i) {
      const std::uint32_t at = lines.surface[y][px * kSub + i];
      double best = 1e9, value = 0;
      for (std::uint32_t b = 0; b < rows; ++b) {
        const std::uint32_t row = (2 * b + 1) * kSub / (2 * rows);
        for (std::uint32_t a = 0; a < kSub; ++a) {
          if (lines.surface[row][px * kSub + a] != at) continue;
          const double dx = a - 7.5, dy = row - 7.5, far = dx * dx + dy * dy;
          if (far < best) best = far, value = linear(lines.rgb[row][3 * (px * kSub + a) + c]);
        }
      }
      sum += value;
    }
  }
  return sum / (rows * kSub);
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
  const std::uint32_t width = static_cast<std::uint32_t>(std::atoi(words[2])),
                      height = static_cast<std::uint32_t>(std::atoi(words[3]));
  options.width = width * kSub;
  options.height = height * kSub;
  options.antialias = 1;
  std::vector<std::uint64_t> memory(std::size_t{8} << 20), scratch(std::size_t{8} << 20);
  Model* model = nullptr;
  if (!load(name, text, files.reader(), options, memory.data(), 8 * memory.size(), model).done()) return 1;
  if (!solve(*model, {}).done()) return 1;

  Arena arena(scratch.data(), 8 * scratch.size());
  const Camera& camera = model->scene.cameras[0];
  const SampleGrid grid = sample_grid(view_of(camera, model->geometry.lattice, options.width, options.height),
                                      options.width, options.height, 1);
  struct Work {
    VisibleLines visible;
    Lines lines;
    Error error[16];
    std::uint32_t row = 0, width = 0;
  } work;
  work.width = width;
  if (!work.visible.start(model->scene, model->geometry, grid, arena)) return 1;
  static const char* const kNames[] = {"1 sample", "2 x 2 samples", "4 x 4 samples", "coverage along 1 row",
                                       "coverage along 2 rows", "coverage along 4 rows", "coverage along 16 rows"};
  const LineSink sink{[](void* context, std::uint32_t, std::span<const std::uint8_t> line) {
                        Work& w = *static_cast<Work*>(context);
                        w.visible.begin_row(w.row++);
                        w.lines.rgb.emplace_back(line.begin(), line.end());
                        std::vector<std::uint32_t> surface(line.size() / 3, 0xffffffff);
                        for (VisibleSpan span; w.visible.next(span);) {
                          for (std::int32_t x = span.x0; x < span.x1; ++x) {
                            surface[static_cast<std::size_t>(x)] = w.visible.map_of(span.triangle) * 2 + span.front;
                          }
                        }
                        w.lines.surface.push_back(std::move(surface));
                        if (w.lines.rgb.size() < kSub) return true;
                        for (std::uint32_t px = 0; px < w.width; ++px) {
                          bool edge = false;
                          for (const auto& row : w.lines.surface) {
                            for (std::uint32_t i = 0; i < kSub; ++i) {
                              edge = edge || row[px * kSub + i] != w.lines.surface[0][px * kSub];
                            }
                          }
                          for (std::uint32_t c = 0; c < 3; ++c) {
                            const double truth = srgb(samples(w.lines, px, kSub, c));
                            std::uint32_t k = 0;
                            for (const std::uint32_t n : {1u, 2u, 4u}) {
                              w.error[k++].add(srgb(samples(w.lines, px, n, c)) - truth, edge);
                            }
                            for (const std::uint32_t n : {1u, 2u, 4u, 16u}) {
                              const double here = edge ? coverage(w.lines, px, n, c) : samples(w.lines, px, 1, c);
                              w.error[k++].add(srgb(here) - truth, edge);
                            }
                          }
                        }
                        w.lines = {};
                        return true;
                      },
                      &work};
  if (!draw(*model, {}, sink).done()) return 1;
  for (int k = 0; k < 7; ++k) work.error[k].print(kNames[k]);
  std::printf("pixels at edges: %.1f %%\n",
              100 * static_cast<double>(work.error[0].edge_values) / static_cast<double>(work.error[0].values));
  return 0;
}
