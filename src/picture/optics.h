// Mirrors, glass, highlights and the background along a row of samples (paper 2.4: "reflection, transmission and
// highlights are processed"; deviation D18, doc/optics.md).
//
// What one sample shows, its ray finds (light_path.h). Neighbours mostly see the same things, and so not each of them
// is traced: where two samples of a span, up to kLongestReach apart, met the same surfaces one after the other, and no
// triangle comes between in any of the spaces that their rays bound (beam.h), all samples between see these
// surfaces too, and show what lies between by perspective. Map coordinates and inverse depths of a row on one plane
// are as in shade.h: a mirror changes the eye, not that. Where two samples differ, the one in the middle is traced.
// Highlights are taken linearly between samples if nothing can shade them there, the mirrored directions are within a
// quarter of a lobe's width, and the sample in the middle, which is traced, agrees.
//
// Exact: which surfaces traced samples see, and that no others do between, to the two lattice steps to which the
// points of mirrors are rounded. Approximate: map coordinates between to 1/32 sub-patch, as everywhere; a plain
// background as lines over at most 16 samples and an eighth of a radian, where the middle one agrees to 1/256, its
// picture in a mirror over 2; seen past glass alone, a picture is looked up for each. Only for scenes with such
// materials or a background. Bytes: light_path.h's; 9,760 for traced samples, 1,024 a channel, 1 a mesh.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "picture/display.h"
#include "picture/light_path.h"
#include "picture/sample_run.h"
#include "picture/view.h"
#include "scene/scene.h"
#include "visibility/geometry.h"

namespace shodo {

class PictureOptics {
 public:
  /// Whether the scene asks for any of this.
  static bool used(const Scene& scene) {
    return scene.effects && !(scene.optics.empty() && scene.background.empty() && scene.glass.empty());
  }
  /// Luminances are added here before they are shown, so black must be 0: such a scene's maps are made for a display
  /// from 0 to MAX, and MIN is taken off by the table (fill_display_table). Where brightness rolls off, each sample's
  /// sum does.
  static Display display_of(const Scene& scene) {
    return used(scene) ? Display{0, scene.display.max_cd_m2} : scene.display;
  }

  /// What is drawn, and how; `carriers`: of map_plane.h.
  struct Shown {
    const Scene& scene;  // on the display of display_of()
    const Geometry& geometry;
    const DisplayMaps& maps;
    const SampleGrid& grid;
    std::span<const MeshTexture> textures;
    std::span<const std::uint32_t> carriers;
  };
  /// `display`: the scene file's.
  [[nodiscard]] bool start(const Shown& shown, const Display& display, Arena& arena);
  static std::uint64_t bytes(const Scene& scene, const Geometry& geometry);

  /// Whether samples that see this side of it first are for add().
  bool takes(const DrawnTriangle& drawn, bool front) const { return paths_.goes_on(drawn, front); }
  /// Adds columns x0 .. x1 - 1 of a row, which see a triangle first, or nothing (kNone), to their pixels' sums.
  void add(std::uint32_t triangle, std::int32_t x0, std::int32_t x1, std::uint32_t row, std::span<std::uint32_t> sums);

 private:
  static constexpr std::int32_t kLongestReach = 128;
  static constexpr std::int32_t kBackgroundReach = 16;
  static constexpr double kBackgroundAngle = 1.0 / 8;
  static constexpr std::uint32_t kRecords = 10;  // kLongestReach is halved 7 times

  enum class Join : std::uint8_t { kNo, kIfMiddleAgrees, kYes };

  std::int32_t background_reach(const PathRecord& record, std::uint32_t k) const;
  void add_run();
  void trace(std::int32_t x, PathRecord* record);
  std::uint64_t rolled(std::uint64_t fine) const;
  bool join_up_to(std::int32_t x, std::uint32_t& left);
  Join join(const PathRecord& a, const PathRecord& b) const;
  bool may_bend(const PathHit& hit) const;
  bool same_surface(const PathHit& a, const PathHit& b) const;
  bool nothing_between(const PathRecord& a, const PathRecord& b, std::uint32_t k) const;
  bool agrees(const PathRecord& a, const PathRecord& middle, const PathRecord& b) const;
  void fill(const PathRecord& a, const PathRecord& b);
  bool add_outdoors(const PathRecord& a, std::uint32_t hit, const std::uint32_t (&part)[3], std::int32_t n);
  void add_line(const std::uint32_t (&from)[3], const std::uint32_t (&to)[3], const std::uint32_t (&part)[3],
                std::int32_t n);
  void add_map(const PathHit& a, const PathHit& b, const std::uint32_t (&part)[3], std::int32_t n);
  void add_textured(const PathHit& a, const PathHit& b, const std::uint32_t (&part)[3], std::int32_t n);

  const Scene* scene_ = nullptr;
  const Geometry* geometry_ = nullptr;
  const SampleGrid* grid_ = nullptr;
  LightPaths paths_;
  std::span<std::uint8_t> whole_;       // by mesh: one convex polygon with one map
  std::span<PathRecord> records_;
  std::span<std::uint32_t> fine_;       // [sample * channels + channel]: fine steps between two traced samples
  std::span<std::uint32_t> steps_;      // display steps of one surface there
  bool roll_ = false;
  std::uint64_t black_ = 0;             // fine steps of the display's MIN
  std::int32_t background_reach_ = 0;   // samples whose directions differ by kBackgroundAngle at most
  // The run of samples at work.
  SampleRun run_;
  std::uint32_t triangle_ = kNone, row_ = 0;
  std::span<std::uint32_t> sums_;
};

}  // namespace shodo
