// What mirrors, glass, highlights and the background show at a sample (paper 2.4: "reflection, transmission and
// highlights are processed"; deviation D18, doc/optics.md).
//
// The scanlines find what a sample sees first, exactly. Where that does more than reflect diffusely, the sample's ray
// goes on: through panes to what stands behind them, nearest first; off mirrors in the mirrored direction, up to
// kMostReflections times. What it meets counts by the product of the panes' and mirrors' parts on the way:
//
//     L = map + highlight + reflect L(mirrored) + transmit L(behind);  of a pane seen from behind transmit L(behind)
//
// Exact: what a ray meets, and in which order. Approximate: its direction, rounded to 2^-21 (1/1000 pixel), the point
// where a mirror sends it on (two lattice steps), parts to 1/65536. Luminances are sums of integers: display steps with
// 8 more bits. A ray whose part is below 1/65536 ends, and so does one after kMostReflections: black.
// Only for scenes with such materials or a background. Bytes: ray_tree.h's, highlight.h's, 24 an optics, 4 a light and
// channel, 2,816 for waiting rays.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/display.h"
#include "picture/highlight.h"
#include "picture/ray_tree.h"
#include "picture/view.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

inline constexpr std::uint32_t kMostReflections = 8;
inline constexpr std::uint32_t kMostWaiting = 64;  // reflections of one sample yet to be followed
inline constexpr std::uint32_t kFineBits = 8;      // of luminance, below a display step
inline constexpr std::uint32_t kBrightest = std::uint32_t{1} << 30;  // 512 times white

class PictureOptics {
 public:
  /// Whether the scene asks for any of this.
  static bool used(const Scene& scene) { return !scene.optics.empty() || !scene.background.empty(); }
  /// Luminances are added here before they are shown, so black must be 0: such a scene's maps are made for a display
  /// from 0 to MAX, and MIN is taken off by the table (fill_display_table). Where brightness rolls off, all samples are
  /// for add(), which bends the sum.
  static Display display_of(const Scene& scene) {
    return used(scene) ? Display{0, scene.display.max_cd_m2} : scene.display;
  }

  /// `display`: the scene file's.
  [[nodiscard]] bool start(const Scene& scene, const Geometry& geometry, const DisplayMaps& maps,
                           const SampleGrid& grid, const Display& display, Arena& arena);
  static std::uint64_t bytes(const Scene& scene, const Geometry& geometry);

  /// Whether samples that see this side of it first are for add().
  bool takes(const DrawnTriangle& drawn, bool front) const;
  /// Adds samples x0 .. x1 - 1 of a row, which see a triangle first, or nothing (kNone), to their pixels' sums.
  void add(std::uint32_t triangle, std::int32_t x0, std::int32_t x1, std::uint32_t row, std::span<std::uint32_t> sums);

 private:
  struct Parts {  // 65536: all of it
    std::uint32_t reflect[3] = {}, transmit[3] = {};
  };
  struct Path {
    Ray ray;
    std::uint32_t part[3];
    std::uint32_t reflections;
  };
  using Colour = std::uint64_t[3];

  std::uint64_t rolled(std::uint64_t fine) const;
  void follow(const Path& path, const RayHit& first, Colour& sum);
  bool pass(const RayHit& hit, Path& path, Colour& sum);
  void add_surface(const DrawnTriangle& drawn, const RayHit& hit, const Path& path, Colour& sum) const;
  void add_highlight(const DrawnTriangle& drawn, const RayHit& hit, const Path& path, std::uint32_t optics,
                     Colour& sum) const;
  void add_background(const Path& path, Colour& sum) const;
  std::uint32_t optics_at(const DrawnTriangle& drawn) const;
  std::uint32_t map_value(const DrawnTriangle& drawn, const MapPlace& at, std::uint32_t channel) const;
  std::uint32_t fine_steps(double luminance_cd_m2) const;

  const Scene* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  DisplayMaps maps_;
  SampleGrid grid_;
  RayTree tree_;
  Highlights highlights_;
  std::span<Parts> parts_;              // per optics
  std::span<std::uint32_t> light_;      // [light * channels + channel]: fine steps
  std::span<Path> waiting_;
  std::uint32_t waiting_count_ = 0;
  bool roll_ = false;
  std::uint64_t black_ = 0;             // fine steps of the display's MIN
  std::uint32_t horizon_[3] = {}, zenith_[3] = {}, ground_[3] = {};  // fine steps
  LatticeVector up_;                    // of the background, largest component 2^15
};

}  // namespace shodo
