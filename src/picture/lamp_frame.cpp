#include "picture/lamp_frame.h"

namespace shodo {

namespace {

constexpr double kAside = 0x1p-20;   // cosine of what counts as beside the eye
constexpr double kMargin = 1.0 / 16;  // cells

std::uint8_t cell(double place) {
  if (!(place > 0)) return 0;
  return place < 255 ? static_cast<std::uint8_t>(place) : 255;
}

/// Between the length and 1.8 times that.
double size_of(const Vec3& a) { return magnitude(a.x) + magnitude(a.y) + magnitude(a.z); }

}  // namespace

void LampFrame::start(const DirectionPolygon& polygon, const Vec3& across) {
  view_ = normalised(across);
  const double x = magnitude(view_.x), y = magnitude(view_.y), z = magnitude(view_.z);
  axis_[0] = cross(view_, x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  axis_[1] = cross(view_, axis_[0]);
  for (std::uint32_t k = 0; k < 2; ++k) {
    double low = 0, high = 0;
    for (std::uint32_t corner = 0; corner < polygon.count; ++corner) {
      const double place = dot(axis_[k], polygon.corner[corner]) / dot(view_, polygon.corner[corner]);
      if (corner == 0 || place < low) low = place;
      if (corner == 0 || place > high) high = place;
    }
    low_[k] = low;
    cells_[k] = high > low ? 256 / (high - low) : 0;
  }
}

CellBox LampFrame::box(std::span<const Vec3> corners) const {
  double low[2] = {256, 256}, high[2] = {0, 0};
  for (const Vec3& corner : corners) {
    const double away = dot(view_, corner);
    if (!(away > kAside * size_of(corner))) return CellBox::all();
    for (std::uint32_t k = 0; k < 2; ++k) {
      const double place = cells_[k] * (dot(axis_[k], corner) / away - low_[k]);
      if (place < low[k]) low[k] = place;
      if (place > high[k]) high[k] = place;
    }
  }
  CellBox box;
  for (std::uint32_t k = 0; k < 2; ++k) {
    if (!(low[k] <= high[k])) return CellBox::all();  // the lamp itself is beside the eye, by rounding
    box.low[k] = cell(low[k] - kMargin);
    box.high[k] = cell(high[k] + kMargin);
  }
  return box;
}

}  // namespace shodo
