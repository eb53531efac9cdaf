#include "picture/background_picture.h"

#include <bit>

#include "base/elementary.h"

namespace shodo {

namespace {

constexpr double kUnit = 32768;

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
  const LatticeVector middle = grid.direction(grid.columns / 2, grid.rows / 2);
  const double texels = size_of(grid.across()) / size_of(middle) * texture.width / (2 * half_width);
  step_ = texels < 32767 ? static_cast<std::uint32_t>(65536 * texels) : 0x7fffffffu;
}

bool BackgroundPicture::look_up(const LatticeVector& d, std::uint32_t (&value)[3]) const {
  if (!any_) return false;
  const std::int64_t ahead = dot(d, towards_);
  if (ahead <= 0) return false;
  const std::int64_t right = dot(d, right_), up = dot(d, up_);
  if (right <= -ahead || right >= ahead || up <= -ahead || up >= ahead) return false;
  lookup_.look_up(fraction(right + ahead, 2 * ahead), fraction(ahead - up, 2 * ahead), step_, value);
  if (lookup_.channels() == 1) value[1] = value[2] = value[0];
  for (std::uint32_t& v : value) v = static_cast<std::uint32_t>(std::uint64_t{v} * white_ / 65535);
  return true;
}

}  // namespace shodo
