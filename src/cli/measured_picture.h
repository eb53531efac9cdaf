// Pictures for people who measure (contract 1: --false-colour, --isolux, --show): illuminance as colours, lines of
// equal illuminance with their values, and the lines of the mesh.
//
// The surfaces that the picture's samples see are told by the library (picture/seen_points.h). False colours take the
// place of the picture; lines are drawn over either. A line of equal illuminance runs between two neighbouring samples
// of one mesh that lie on both sides of the value, a line of the mesh between two that lie in different patches or
// sub-patches; it is a pixel wide, black or white, whichever the ground is further from. A label stands on a line where
// it has room on the line's own mesh.
//
// Memory, outside the library's budget: 13 bytes a sample and 11 a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "cli/lettering.h"
#include "cli/lux_scale.h"
#include "cli/measured_options.h"
#include "model.h"

namespace shodo {

class MeasuredPicture {
 public:
  MeasuredPicture(const Model& model, const MeasuredOptions& options);

  /// Takes what the samples see.
  SeenSink sink();
  /// Over `canvas`, which holds the picture; false colours don't look at what it holds.
  void finish(Canvas& canvas);

  /// After finish().
  const LuxScale& scale() const { return scale_; }
  const std::vector<double>& levels() const { return levels_; }

 private:
  struct Sample {
    std::uint32_t surface = 0;  // mesh + 1; kBack + mesh + 1; kLamp; 0: nothing
    float lux = 0;
    std::uint32_t sub_patch = 0;
    std::uint8_t line = 0;   // a level + 1
    std::uint8_t mesh_line = 0;  // 1: sub-patches, 2: patches
  };
  struct Box {
    std::int64_t x, y, w, h;
  };

  void take(const SeenPoint& seen);
  Sample& at(std::uint32_t x, std::uint32_t y) { return samples_[std::size_t{y} * columns_ + x]; }
  void decide_scale();
  void find_lines();
  void mark(Sample& here, const Sample& other) const;
  std::uint32_t level_of(float lux) const;
  void compose(Canvas& canvas);
  Rgb8 ground(const Sample& sample) const;
  void draw_legend(Canvas& canvas);
  void draw_labels(Canvas& canvas);
  bool place_label(Canvas& canvas, const std::vector<std::uint32_t>& pixels, std::uint32_t surface, double level);
  bool room_for(const Box& box, std::uint32_t surface);

  const Model& model_;
  const MeasuredOptions& options_;
  std::uint32_t per_pixel_;  // samples, each way
  std::uint32_t columns_, rows_;
  std::uint32_t letter_;     // size of a letter's point, pixels
  std::vector<Sample> samples_;
  LuxScale scale_;
  std::vector<double> levels_;
  std::vector<Box> taken_;  // by labels and legend
};

}  // namespace shodo
