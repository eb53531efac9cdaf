#include "hard/run.h"

#include <bit>
#include <cmath>

#include "shodo/shodo.h"
#include "support/collected_lines.h"

namespace shodo::hard {

FullRun::FullRun(const std::string& text, const Options& options, std::size_t bytes) : memory_(new std::byte[bytes]) {
  status = load("hard.scn", text, {}, options, memory_.get(), bytes, model_);
  if (status.done()) status = solve(*model_, {});
}

bool FullRun::sound() const {
  const auto good = [](double x) { return std::isfinite(x) && x >= 0; };
  for (const double x : model_->direct.patch_lx) {
    if (!good(x)) return false;
  }
  for (const double x : model_->ambient.patch_lx) {
    if (!good(x)) return false;
  }
  for (const float x : model_->maps.direct_lx) {
    if (!good(x)) return false;
  }
  for (const float x : model_->maps.ambient_lx) {
    if (!good(x)) return false;
  }
  return true;
}

double FullRun::mean(std::uint32_t m) const {
  double sum = 0, area = 0;
  for (std::uint32_t k = 0; k < mesh(m).patch_count(); ++k) {
    const Patch& patch = model_->patches[mesh(m).first_patch + k];
    if (patch.dropped != 0) continue;
    sum += patch.area * total(mesh(m).first_patch + k);
    area += patch.area;
  }
  return area > 0 ? sum / area : 0;
}

double FullRun::largest() const {
  double most = 0;
  for (std::uint32_t i = 0; i < patches(); ++i) most = std::fmax(most, total(i));
  return most;
}

double FullRun::sum(std::uint32_t first, std::uint32_t end) const {
  const std::uint32_t channels = model_->scene.channels;
  double all = 0;
  for (std::uint32_t m = first; m < end; ++m) {
    for (std::uint32_t k = 0; k < mesh(m).patch_count(); ++k) all += total(mesh(m).first_patch + k);
    for (std::uint32_t k = 0; k < mesh(m).sub_patch_count() * channels; ++k) {
      const std::size_t at = std::size_t{mesh(m).first_sub_patch} * channels + k;
      all += static_cast<double>(model_->maps.direct_lx[at]) + static_cast<double>(model_->maps.ambient_lx[at]);
    }
  }
  return all;
}

std::vector<std::uint64_t> FullRun::bits() const {
  std::vector<std::uint64_t> all;
  for (const double x : model_->direct.patch_lx) all.push_back(std::bit_cast<std::uint64_t>(x));
  for (const double x : model_->ambient.patch_lx) all.push_back(std::bit_cast<std::uint64_t>(x));
  for (const float x : model_->maps.direct_lx) all.push_back(std::bit_cast<std::uint32_t>(x));
  for (const float x : model_->maps.ambient_lx) all.push_back(std::bit_cast<std::uint32_t>(x));
  return all;
}

std::vector<std::uint8_t> FullRun::picture() {
  std::vector<std::uint8_t> all;
  const LineSink sink = collected_in(all);
  status = draw(*model_, {}, sink);
  if (!status.done()) all.clear();
  return all;
}

Options small_picture(std::uint32_t width, std::uint32_t height) {
  Options options;
  options.width = width;
  options.height = height;
  options.antialias = 1;
  return options;
}

Options to_the_last_digits() {
  Options options = small_picture();
  options.tolerance = 1e-13;
  options.row_value_bits = 64;
  return options;
}

double relative(double a, double b) {
  const double d = std::fabs(a - b);
  return d == 0 ? 0 : d / std::fabs(b);
}

double difference(const FullRun& a, const FullRun& b) {
  if (!a.done() || !b.done() || a.patches() != b.patches()) return -1;
  double worst = 0;
  for (std::uint32_t i = 0; i < a.patches(); ++i) worst = std::fmax(worst, std::fabs(a.total(i) - b.total(i)));
  return worst == 0 ? 0 : worst / a.largest();
}

}  // namespace shodo::hard
