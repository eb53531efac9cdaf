// A scene from text through the whole library, as a caller of shodo.h runs it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "model.h"

namespace shodo::hard {

class FullRun {
 public:
  static constexpr std::size_t kPlenty = std::size_t{512} << 20;  // untouched pages cost nothing

  /// Loads and, if that is done, solves. `options.flags` and all else as given.
  explicit FullRun(const std::string& text, const Options& options = {}, std::size_t bytes = kPlenty);

  bool done() const { return status.done(); }
  /// All is finite, nothing negative, in patches and maps.
  bool sound() const;

  const Model& model() const { return *model_; }
  std::uint32_t patches() const { return static_cast<std::uint32_t>(model_->direct.patch_lx.size()); }
  const Mesh& mesh(std::uint32_t m) const { return model_->scene.meshes[m]; }
  /// First channel.
  double e0(std::uint32_t patch) const { return model_->direct.patch_lx[patch * model_->scene.channels]; }
  double ambient(std::uint32_t patch) const { return model_->ambient.patch_lx[patch * model_->scene.channels]; }
  double total(std::uint32_t patch) const { return e0(patch) + ambient(patch); }
  /// Of all patches of a mesh, by area; and the largest total.
  double mean(std::uint32_t m) const;
  double largest() const;
  /// Sum of what meshes [first, end) have, direct and ambient, maps included: 0 only if all is dark.
  double sum(std::uint32_t first, std::uint32_t end) const;
  /// E0 and ambient of every patch, then both maps, as bits.
  std::vector<std::uint64_t> bits() const;

  /// Of the options' size; empty if it was refused.
  std::vector<std::uint8_t> picture();

  Status status;  // of the call that failed, or of the last

 private:
  std::unique_ptr<std::byte[]> memory_;
  Model* model_ = nullptr;
};

/// Small, one sample a pixel.
Options small_picture(std::uint32_t width = 64, std::uint32_t height = 48);

/// Solver and rows to the last digits: --tolerance 1e-13 --row-values 64.
Options to_the_last_digits();

/// |a - b| / |b|; 0 if both are 0.
double relative(double a, double b);

/// The largest difference of two runs' patches, of the largest total of the first; -1 if they don't match.
double difference(const FullRun& a, const FullRun& b);

}  // namespace shodo::hard
