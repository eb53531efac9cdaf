// difference: how far two pictures or two maps are apart, and where (contract 1).
//
// At a pixel it is the largest over the channels, in display levels of 0 .. 255 or in lux; the mean, and the root mean
// square, are over all values. The picture of it is linear in the scale of false colours, from 0 to the largest.
#include <cstdio>
#include <string>

#include "base/elementary.h"
#include "cli/commands.h"
#include "cli/lux_scale.h"
#include "cli/picture_file.h"
#include "cli/scene_files.h"
#include "cli/value_grid.h"
#include "shodo/status.h"

namespace shodo {

namespace {

struct Difference {
  double mean = 0, root_mean_square = 0, largest = 0;
  std::uint32_t x = 0, y = 0;      // of the largest, the first from above and from the left
  std::uint64_t different = 0;     // pixels
  std::vector<double> pixel;
};

Difference difference_of(const ValueGrid& a, const ValueGrid& b) {
  Difference result;
  const std::size_t pixels = std::size_t{a.width} * a.height;
  result.pixel.resize(pixels);
  double sum = 0, squares = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    for (std::size_t k = p * a.channels; k < (p + 1) * a.channels; ++k) {
      const double d = static_cast<double>(a.value[k]) - static_cast<double>(b.value[k]), off = d < 0 ? -d : d;
      sum += off;
      squares += off * off;
      if (off > result.pixel[p]) result.pixel[p] = off;
    }
    if (result.pixel[p] > 0) ++result.different;
    if (!(result.pixel[p] > result.largest)) continue;
    result.largest = result.pixel[p];
    result.x = static_cast<std::uint32_t>(p % a.width);
    result.y = static_cast<std::uint32_t>(p / a.width);
  }
  const double values = static_cast<double>(a.value.size());
  result.mean = sum / values;
  result.root_mean_square = square_root(squares / values);
  return result;
}

std::string text_of(const Difference& d, const ValueGrid& grid) {
  const char* unit = grid.map ? "lx" : "levels";
  char text[400];
  std::snprintf(text, sizeof text,
                "size:      %u x %u, %u channel%s\n"
                "mean:      %.9g %s\n"
                "rms:       %.9g %s\n"
                "largest:   %.9g %s, at column %u, row %u from above\n"
                "different: %llu of %llu pixels\n",
                grid.width, grid.height, grid.channels, grid.channels == 1 ? "" : "s", d.mean, unit,
                d.root_mean_square, unit, d.largest, unit, d.x, d.y, static_cast<unsigned long long>(d.different),
                static_cast<unsigned long long>(d.pixel.size()));
  return text;
}

bool draw(const Difference& d, const ValueGrid& grid, const LineSink& sink) {
  std::vector<std::uint8_t> line(std::size_t{3} * grid.width);
  for (std::uint32_t y = 0; y < grid.height; ++y) {
    for (std::uint32_t x = 0; x < grid.width; ++x) {
      const double off = d.pixel[std::size_t{y} * grid.width + x];
      const Rgb8 colour = scale_colour(d.largest > 0 ? off / d.largest : 0);
      for (std::size_t c = 0; c < 3; ++c) line[3 * x + c] = colour[c];
    }
    if (!sink.line(sink.context, y, line)) return false;
  }
  return true;
}

int tell(const FileError& error) {
  std::fprintf(stderr, "shodo: %s\n", error.text.c_str());
  return static_cast<int>(StatusCode::kFile);
}

/// 0, or the exit status.
int read(const std::string& name, ValueGrid& grid) {
  SceneFiles files(name);
  std::string_view bytes;
  FileError error;
  if (!files.read_top(bytes, error)) return tell(error);
  std::string mistake;
  if (read_grid(bytes, grid, mistake)) return 0;
  error.text = name + ": " + mistake;
  return tell(error);
}

}  // namespace

int difference(const Arguments& arguments) {
  ValueGrid a, b;
  if (const int status = read(arguments.scenes[0], a); status != 0) return status;
  if (const int status = read(arguments.scenes[1], b); status != 0) return status;
  if (a.map != b.map || a.width != b.width || a.height != b.height || a.channels != b.channels) {
    const auto kind = [](const ValueGrid& grid) { return grid.map ? "map" : "picture"; };
    std::fprintf(stderr,
                 "shodo: difference: expected two of one kind and size, found a %s of %u x %u x %u and a %s of "
                 "%u x %u x %u\n",
                 kind(a), a.width, a.height, a.channels, kind(b), b.width, b.height, b.channels);
    return static_cast<int>(StatusCode::kUsage);
  }
  const Difference d = difference_of(a, b);
  FileError error;
  PictureFile picture(arguments.output, a.width, a.height);
  const bool draws = !arguments.output.empty();
  if (draws && (!picture.open(error) || !draw(d, a, picture.sink(error)) || !picture.close(error))) return tell(error);
  OutputFile out("-");
  if (!out.open(error) || !out.write(text_of(d, a), error) || !out.close(error)) return tell(error);
  return !draws || picture.commit(error) ? 0 : tell(error);
}

}  // namespace shodo
