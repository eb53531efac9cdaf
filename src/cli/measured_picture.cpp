#include "cli/measured_picture.h"

#include <algorithm>
#include <map>

#include "cli/surface_lux.h"

namespace shodo {

namespace {

constexpr std::uint32_t kBack = 0x40000000, kLamp = 0x80000000;
constexpr Rgb8 kBlack{0, 0, 0}, kWhiteInk{255, 255, 255};
constexpr Rgb8 kNoSurface{48, 48, 48};   // what receives no light: backs, nothing
constexpr Rgb8 kPanel{24, 24, 24};       // under the legend
constexpr std::uint32_t kInk[3] = {0, 96, 176};  // of 256: nothing, sub-patches, patches
constexpr std::uint32_t kLeastLine = 12;         // pixels of a line that gets a label, a letter's point being one

bool front(std::uint32_t surface) { return surface != 0 && surface < kBack; }

/// Black on light grounds, white on dark ones.
Rgb8 ink_on(const Rgb8& ground) {
  return 2 * ground[0] + 5 * ground[1] + ground[2] > 8 * 80 ? kBlack : kWhiteInk;
}

Rgb8 mixed(const Rgb8& ground, const Rgb8& ink, std::uint32_t part) {
  Rgb8 colour;
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = static_cast<std::uint8_t>((ground[c] * (256 - part) + ink[c] * part + 128) / 256);
  }
  return colour;
}

}  // namespace

MeasuredPicture::MeasuredPicture(const Model& model, const MeasuredOptions& options)
    : model_(model),
      options_(options),
      per_pixel_(model.options.antialias == 1 ? 1 : model.options.antialias == 4 ? 2 : 4),
      columns_(model.options.width * per_pixel_),
      rows_(model.options.height * per_pixel_),
      letter_(std::max<std::uint32_t>(1, model.options.width / 640)),
      samples_(std::size_t{columns_} * rows_) {}

SeenSink MeasuredPicture::sink() {
  return {[](void* self, const SeenPoint& seen) { static_cast<MeasuredPicture*>(self)->take(seen); }, this};
}

void MeasuredPicture::take(const SeenPoint& seen) {
  Sample& sample = at(seen.x, seen.y);
  if (seen.mesh == kNone) {
    sample.surface = seen.front ? kLamp : kBack;
    return;
  }
  sample.surface = seen.mesh + 1 + (seen.front ? 0 : kBack);
  if (!seen.front) return;
  sample.lux = static_cast<float>(surface_lux(model_, seen.mesh, seen.u, seen.v));
  sample.sub_patch = sub_patch_at(model_.scene.meshes[seen.mesh], seen.u, seen.v);
}

/// The scale asked for, or one for what is seen; and its levels.
void MeasuredPicture::decide_scale() {
  scale_ = options_.scale;
  if (!(scale_.high > 0)) {
    std::vector<float> lux;
    lux.reserve(samples_.size());
    for (const Sample& sample : samples_) {
      if (front(sample.surface)) lux.push_back(sample.lux);
    }
    scale_ = scale_for(std::move(lux));
  }
  levels_ = options_.levels.empty() ? round_levels(scale_.low, scale_.high) : options_.levels;
}

/// How many levels it reaches.
std::uint32_t MeasuredPicture::level_of(float lux) const {
  const auto above = std::upper_bound(levels_.begin(), levels_.end(), static_cast<double>(lux));
  return static_cast<std::uint32_t>(above - levels_.begin());
}

void MeasuredPicture::mark(Sample& here, const Sample& other) const {
  if (options_.show != MeasuredOptions::Show::kNothing && here.surface != other.surface) here.mesh_line = 2;
  if (!front(here.surface) || here.surface != other.surface) return;
  if (options_.isolux) {
    const std::uint32_t a = level_of(here.lux), b = level_of(other.lux);
    if (a != b) here.line = static_cast<std::uint8_t>(std::max(a, b));
  }
  if (options_.show == MeasuredOptions::Show::kNothing || here.sub_patch == other.sub_patch) return;
  const Mesh& mesh = model_.scene.meshes[here.surface - 1];
  const bool patches = patch_of_sub_patch(mesh, here.sub_patch) != patch_of_sub_patch(mesh, other.sub_patch);
  const std::uint8_t line = patches ? 2 : options_.show == MeasuredOptions::Show::kSubPatches ? 1 : 0;
  here.mesh_line = std::max(here.mesh_line, line);
}

void MeasuredPicture::find_lines() {
  for (std::uint32_t y = 0; y < rows_; ++y) {
    for (std::uint32_t x = 0; x < columns_; ++x) {
      if (x + 1 < columns_) mark(at(x, y), at(x + 1, y));
      if (y + 1 < rows_) mark(at(x, y), at(x, y + 1));
    }
  }
}

Rgb8 MeasuredPicture::ground(const Sample& sample) const {
  if (sample.surface == kLamp) return kWhiteInk;
  return front(sample.surface) ? scale_.colour(static_cast<double>(sample.lux)) : kNoSurface;
}

/// The mean over each pixel's samples, each with the strongest line within a pixel's width right of and below it.
void MeasuredPicture::compose(Canvas& canvas) {
  const std::uint32_t n = per_pixel_;
  for (std::uint32_t y = 0; y < rows_ / n; ++y) {
    for (std::uint32_t x = 0; x < columns_ / n; ++x) {
      std::uint8_t* const pixel = &canvas.rgb[3 * (std::size_t{y} * canvas.width + x)];
      const Rgb8 shown{pixel[0], pixel[1], pixel[2]};
      std::uint32_t sum[3] = {0, 0, 0};
      for (std::uint32_t k = 0; k < n * n; ++k) {
        const std::uint32_t sx = x * n + k % n, sy = y * n + k / n;
        std::uint32_t ink = 0;
        for (std::uint32_t d = 0; d < n * n; ++d) {
          if (sx < d % n || sy < d / n) continue;
          const Sample& near = at(sx - d % n, sy - d / n);
          ink = std::max(ink, near.line != 0 ? 256 : kInk[near.mesh_line]);
        }
        const Rgb8 plain = options_.false_colour ? ground(at(sx, sy)) : shown;
        const Rgb8 colour = mixed(plain, ink_on(plain), ink);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
      }
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>((sum[c] + n * n / 2) / (n * n));
    }
  }
}

/// A strip of the scale at the right border, with its round values.
void MeasuredPicture::draw_legend(Canvas& canvas) {
  const std::vector<double> values = round_levels(scale_.low, scale_.high);
  std::uint32_t text = text_width("lx", letter_);
  for (const double value : values) text = std::max(text, text_width(lux_text(value), letter_));
  const std::int64_t unit = letter_, bar = 12 * unit, gap = 4 * unit;
  const std::int64_t w = 3 * gap + bar + text, h = std::int64_t{canvas.height} * 3 / 4;
  const Box box{canvas.width - w, (canvas.height - h) / 2, w, h};
  canvas.fill(box.x, box.y, box.w, box.h, kPanel);
  const std::int64_t head = 4 * gap + kLetterHeight * unit;
  const std::int64_t top = box.y + head, length = box.h - head - 2 * gap;
  draw_text(canvas, box.x + 2 * gap + bar, box.y + gap, "lx", letter_, kWhiteInk);
  if (length < 2) return;
  for (std::int64_t k = 0; k < length; ++k) {
    const double place = static_cast<double>(length - 1 - k) / static_cast<double>(length - 1);
    canvas.fill(box.x + gap, top + k, bar, 1, scale_colour(place));
  }
  std::int64_t last = top + 2 * length;
  for (const double value : values) {
    const double from_below = scale_.place(value) * static_cast<double>(length - 1);
    const std::int64_t y = top + length - 1 - static_cast<std::int64_t>(from_below);
    canvas.fill(box.x + gap + bar, y, gap / 2, 1, kWhiteInk);
    if (last - y < (kLetterHeight + 2) * unit) continue;  // no room
    draw_text(canvas, box.x + 2 * gap + bar, y - kLetterHeight * unit / 2, lux_text(value), letter_, kWhiteInk);
    last = y;
  }
  taken_.push_back(box);
}

/// Whether a box lies in the picture, on one surface, beside all that is taken.
bool MeasuredPicture::room_for(const Box& box, std::uint32_t surface) {
  const std::int64_t width = columns_ / per_pixel_, height = rows_ / per_pixel_;
  if (box.x < 0 || box.y < 0 || box.x + box.w > width || box.y + box.h > height) return false;
  for (const Box& other : taken_) {
    if (box.x < other.x + other.w && other.x < box.x + box.w && box.y < other.y + other.h && other.y < box.y + box.h) {
      return false;
    }
  }
  for (std::int64_t y = box.y; y < box.y + box.h; ++y) {
    for (std::int64_t x = box.x; x < box.x + box.w; ++x) {
      if (at(static_cast<std::uint32_t>(x) * per_pixel_, static_cast<std::uint32_t>(y) * per_pixel_).surface != surface)
        return false;
    }
  }
  return true;
}

/// From the middle of the line outwards.
bool MeasuredPicture::place_label(Canvas& canvas, const std::vector<std::uint32_t>& pixels, std::uint32_t surface,
                                  double level) {
  const std::string text = lux_text(level);
  const std::int64_t w = text_width(text, letter_) + 4 * letter_, h = (kLetterHeight + 4) * letter_;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const std::size_t half = (k + 1) / 2, middle = pixels.size() / 2;
    const std::size_t index = k % 2 == 0 ? middle + half : middle - half;
    if (index >= pixels.size()) continue;
    const std::int64_t x = pixels[index] % canvas.width, y = pixels[index] / canvas.width;
    const Box box{x - w / 2, y - h / 2, w, h};
    if (!room_for(box, surface)) continue;
    canvas.fill(box.x, box.y, box.w, box.h, kWhiteInk);
    draw_text(canvas, box.x + 2 * letter_, box.y + 2 * letter_, text, letter_, kBlack);
    taken_.push_back(box);
    return true;
  }
  return false;
}

/// One a level and mesh, where the line is long enough.
void MeasuredPicture::draw_labels(Canvas& canvas) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> lines;  // level, surface
  for (std::uint32_t y = 0; y < canvas.height; ++y) {
    for (std::uint32_t x = 0; x < canvas.width; ++x) {
      for (std::uint32_t k = 0; k < per_pixel_ * per_pixel_; ++k) {
        const Sample& sample = at(x * per_pixel_ + k % per_pixel_, y * per_pixel_ + k / per_pixel_);
        if (sample.line == 0) continue;
        lines[{sample.line, sample.surface}].push_back(y * canvas.width + x);
        break;
      }
    }
  }
  for (const auto& [key, pixels] : lines) {
    if (pixels.size() < std::size_t{kLeastLine} * letter_) continue;
    place_label(canvas, pixels, key.second, levels_[key.first - 1]);
  }
}

void MeasuredPicture::finish(Canvas& canvas) {
  decide_scale();
  find_lines();
  compose(canvas);
  if (options_.false_colour) draw_legend(canvas);
  if (options_.isolux) draw_labels(canvas);
}

}  // namespace shodo
