// What one sample sees beyond its first surface: through panes, off mirrors, with highlights and the background (paper
// 2.4; deviation D18, doc/optics.md).
//
// The scanlines find what a sample sees first, exactly. Where that does more than reflect diffusely, the sample's ray
// goes on: through panes to what stands behind them, nearest first; off mirrors in the mirrored direction, up to
// kMostReflections times. What it meets counts by the product of the panes' and mirrors' parts on the way:
//
//     L = map + highlight + reflect L(mirrored) + transmit L(behind);  of a pane seen from behind transmit L(behind)
//
// A textured surface shows its texture, at the level of detail that the sample's neighbours on the same way ask for: X
// = E + t D is seen from the eye E mirrored in all mirrors on the way, D mirrored likewise; a step d of D moves it by
// t (d - D (N.d) / (N.D)) on a plane with normal N.
//
// Exact: what a ray meets, and in which order. Approximate: its direction, rounded to 2^-20 (1/1000 pixel), the point
// where a mirror sends it on (two lattice steps), parts to 1/65536. Luminances are sums of integers: display steps with
// 8 more bits. A ray whose part is below 1/65536 ends, and so does one after kMostReflections: black.
// Bytes: ray_tree.h's, highlight.h's, 24 an optics, 4 a light and channel, 6,656 for waiting rays.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/background_picture.h"
#include "picture/display.h"
#include "picture/highlight.h"
#include "picture/ray_tree.h"
#include "picture/texture_shade.h"
#include "picture/view.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

inline constexpr std::uint32_t kMostReflections = 8;
inline constexpr std::uint32_t kMostWaiting = 64;  // reflections of one sample yet to be followed
inline constexpr std::uint32_t kFineBits = 8;      // of luminance, below a display step
inline constexpr std::uint32_t kBrightest = std::uint32_t{1} << 30;  // 512 times white
inline constexpr std::uint32_t kWholePart = 65536;
inline constexpr std::uint32_t kMostPathHits = 12;
inline constexpr std::uint8_t kNoHit = 255;

/// One surface on a sample's way.
struct PathHit {
  std::uint32_t triangle;      // kNone: the background
  bool front;                  // of the background: the sky
  bool reflected;              // how the ray came here from `parent`: off it, or through it
  std::uint8_t parent;         // index; kNoHit: from the eye
  bool shines;                 // has a highlight
  bool lamps;                  // a lamp would show in it if nothing stood between
  LatticePoint at;             // to a few lattice steps; of the background beyond the scene
  std::uint32_t shown[3];      // fine steps of the highlight, or of the background
  std::int32_t mirrored[3];    // direction, where it shines
  double u, v;                 // sub-patches
  double nearness;             // inverse depth along the way, in units of the sample's direction
  double step;                 // texels to its neighbours, if it is textured
};

/// All on the way of a sample, in the order in which they are met.
struct PathRecord {
  std::int32_t x;       // pixel
  std::uint32_t count;  // above kMostPathHits: not all are here
  bool sought;          // the first one was met by the ray, not known from the scanline
  PathHit hit[kMostPathHits];
};

using FineColour = std::uint64_t[3];  // display steps times 2^24

/// Parts of light that a material sends on, of 65536.
struct PathParts {
  std::uint32_t reflect[3] = {}, transmit[3] = {};
};
/// True if something is left.
bool weaken(std::uint32_t (&part)[3], const std::uint32_t (&by)[3], std::uint32_t channels);

class LightPaths {
 public:
  /// `display`: the scene file's; `textures`: by mesh, or none.
  [[nodiscard]] bool start(const Scene& scene, const Geometry& geometry, const DisplayMaps& maps,
                           const SampleGrid& grid, std::span<const MeshTexture> textures, Arena& arena);
  static std::uint64_t bytes(const Scene& scene, const Geometry& geometry);

  /// Whether a ray goes on from this side of it, or goes by.
  bool goes_on(const DrawnTriangle& drawn, bool front) const;
  /// Adds what a sample shows that sees a triangle first, or nothing (kNone). `record`, but for its x, may be null.
  void trace(std::int32_t column, std::uint32_t row, std::uint32_t triangle, FineColour& sum, PathRecord* record);

  const RayTree& tree() const { return tree_; }
  const Highlights& highlights() const { return highlights_; }
  /// The index of the material's optics; kNone.
  std::uint32_t optics_at(const DrawnTriangle& drawn) const;
  const PathParts& parts(std::uint32_t optics) const { return parts_[optics]; }
  /// Fine steps of a light that is seen.
  std::uint32_t light(std::uint32_t light, std::uint32_t channel) const {
    return light_[light * scene_->channels + channel];
  }
  std::uint32_t fine_steps(double luminance_cd_m2) const;
  /// Fine steps of the background in a ray's direction; false below the horizon.
  bool background(const LatticeVector& way, std::uint32_t (&shown)[3]) const;
  /// Whether there is a picture in it, so that it is no line along a row.
  bool has_picture() const { return !scene_->background.empty() && scene_->background[0].picture != kNone; }
  MapTexels texels_of(const Mesh& mesh) const;
  /// Null without.
  const MeshTexture* texture_of_mesh(std::uint32_t mesh) const {
    return textures_.empty() || textures_[mesh].texture == kNone ? nullptr : &textures_[mesh];
  }

 private:
  struct Path {
    Ray ray;
    std::uint32_t part[3];
    std::uint8_t reflections, parent;
    bool reflected;
    std::uint32_t mirror[kMostReflections];
    double length, speed;  // lattice steps: from the eye to the ray's origin; of the ray's direction
  };

  void follow(const Path& path, const RayHit& first, FineColour& sum, PathRecord* record);
  bool pass(const RayHit& hit, Path& path, FineColour& sum, PathRecord* record);
  void add_surface(const DrawnTriangle& drawn, const RayHit& hit, const Path& path, FineColour& sum,
                   PathHit* noted) const;
  void add_textured(const DrawnTriangle& drawn, const RayHit& hit, const Path& path, FineColour& sum,
                    PathHit* noted) const;
  void add_highlight(const DrawnTriangle& drawn, const LatticePoint& point, const LatticeVector& mirrored,
                     const Path& path, std::uint32_t optics, FineColour& sum, PathHit* noted) const;
  void add_background(const Path& path, FineColour& sum, PathRecord* record) const;
  PathHit* note(const RayHit& hit, const Path& path, PathRecord* record) const;
  double way_to(const RayHit& hit, const Path& path) const;
  double texture_step(const DrawnTriangle& drawn, const RayHit& hit, const Path& path, const TextureShade& shade) const;
  std::uint32_t map_value(const DrawnTriangle& drawn, const MapPlace& at, std::uint32_t channel) const;

  const Scene* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  DisplayMaps maps_;
  const SampleGrid* grid_ = nullptr;
  std::span<const MeshTexture> textures_;
  RayTree tree_;
  Highlights highlights_;
  std::span<PathParts> parts_;          // per optics
  std::span<std::uint32_t> light_;      // [light * channels + channel]: fine steps
  std::span<Path> waiting_;
  std::uint32_t waiting_count_ = 0;
  static constexpr std::uint32_t kHints = 8;
  std::uint32_t hint_[kHints] = {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};  // hits of the sample before
  std::uint32_t horizon_[3] = {}, zenith_[3] = {}, ground_[3] = {};  // fine steps
  LatticeVector up_;                    // of the background, largest component 2^15
  BackgroundPicture picture_;           // of the background
  LatticeVector direction_;             // of the sample at work
  double direction_length_ = 1;
};

}  // namespace shodo
