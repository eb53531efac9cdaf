#include "picture/background_picture.h"

#include <bit>

#include "base/elementary.h"

namespace shodo {

namespace {

constexpr double kUnit = 32768;
constexpr int kUnitBits = 15;
constexpr std::uint32_t kMostFolds = 360;  // a picture is a degree wide at least

std::int64_t rounded(double x) { return static_cast<std::int64_t>(x < 0 ? x - 0.5 : x + 0.5); }
LatticeVector rounded(const Vec3& a) { return {rounded(a.x), rounded(a.y), rounded(a.z)}; }

double size_of(const LatticeVector& a) {
  return length(Vec3{static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)});
}

/// part / whole in 2^-32, for 0 <= part < whole < 2^38.
std::uint32_t fraction(std::int64_t part, std::int64_t whole) {
  const int width = 64 - std::countl_zero(static_cast<std::uint64_t>(whole));
  const int right = width > 32 ? width - 32 : 0;
  const std::uint64_t quotient =
      (static_cast<std::uint64_t>(part >> right) << 32) / static_cast<std::uint64_t>(whole >> right);
  return quotient > 0xffffffffu ? 0xffffffffu : static_cast<std::uint32_t>(quotient);
}

}  // namespace

void BackgroundPicture::start(const Scene& scene, const SampleGrid& grid, std::uint32_t white) {
  any_ = !scene.background.empty() && scene.background[0].picture != kNone;
  if (!any_) return;
  const Background& background = scene.background[0];
  const Texture& texture = scene.textures[background.picture];
  lookup_ = TextureLookup(scene, texture, false);
  white_ = white;
  const double half_width = tangent_degrees(0.5 * background.width_degrees);
  const double half_height = half_width * texture.height / texture.width;
  const Vec3 right = normalised(cross(background.towards, background.up));
  right_ = rounded((kUnit / half_width) * right);
  up_ = rounded((kUnit / half_height) * cross(right, background.towards));
  towards_ = rounded(kUnit * background.towards);
  around_ = background.around;
  border_[0] = rounded(kUnit * normalised((-1 / half_width) * right - background.towards));
  border_[1] = rounded(kUnit * normalised((1 / half_width) * right - background.towards));
  const LatticeVector middle = grid.direction(grid.columns / 2, grid.rows / 2);
  const double texels = size_of(grid.across()) / size_of(middle) * texture.width / (2 * half_width);
  step_ = texels < 32767 ? static_cast<std::uint32_t>(65536 * texels) : 0x7fffffffu;
}

/// The direction, mirrored in the border beyond which it lies as long as it lies beyond one.
LatticeVector BackgroundPicture::before(LatticeVector d) const {
  for (std::uint32_t k = 0; k < kMostFolds; ++k) {
    const LatticeVector& n = border_[dot(d, right_) > 0 ? 1 : 0];
    const std::int64_t beyond = dot(d, n);
    if (beyond <= 0) break;
    const auto mirrored = [&](std::int64_t at, std::int64_t normal) {
      return at - ((beyond * normal + (std::int64_t{1} << (2 * kUnitBits - 2))) >> (2 * kUnitBits - 1));
    };
    d = {mirrored(d.x, n.x), mirrored(d.y, n.y), mirrored(d.z, n.z)};
  }
  return d;
}

bool BackgroundPicture::look_up(const LatticeVector& direction, std::uint32_t (&value)[3]) const {
  if (!any_) return false;
  const LatticeVector d = around_ ? before(direction) : direction;
  const std::int64_t ahead = dot(d, towards_);
  if (ahead <= 0) return false;
  const std::int64_t up = dot(d, up_);
  std::int64_t right = dot(d, right_);
  // On a border, by rounding.
  if (around_ && right >= ahead) right = ahead - 1;
  if (around_ && right <= -ahead) right = 1 - ahead;
  if (right <= -ahead || right >= ahead || up <= -ahead || up >= ahead) return false;
  lookup_.look_up(fraction(right + ahead, 2 * ahead), fraction(ahead - up, 2 * ahead), step_, value);
  if (lookup_.channels() == 1) value[1] = value[2] = value[0];
  for (std::uint32_t& v : value) v = static_cast<std::uint32_t>(std::uint64_t{v} * white_ / 65535);
  return true;
}

}  // namespace shodo
