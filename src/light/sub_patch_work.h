// One sub-patch at work: what light/sub_patch_light.cpp (area and polyhedral lights, samples that are hidden) and
// light/sub_patch_points.cpp (point lights and suns) share.
#pragma once

#include <cstdint>

#include "light/piece_grid.h"
#include "light/sample_shift.h"
#include "light/sub_patch_light.h"

namespace shodo {

inline constexpr std::uint32_t kMostProbes = 5;

/// From which a sun is looked at in each cell of the grid.
inline constexpr std::uint32_t kPlacesInCell = 4;

/// The samples of the first look at a point light or sun: the centre, then the corners of the 4 x 4 grid.
struct Probes {
  Sample sample[kMostProbes];
  double weight[kMostProbes];  // sum 1
  std::uint32_t grid_index[kMostProbes];
  std::uint32_t count = 0;
};

/// What the lights that need all samples send to each.
struct Fine {
  double lux[kGridSamples][3] = {};
  double factor[kGridSamples] = {};
  std::uint32_t lit = 0;  // bit k: sample k
  bool used = false;
};

/// Whether the visible parts disagree. Values that a light doesn't shine on (outside its distribution, behind it) say
/// nothing about what is in the way, unless segments were sent all the same.
bool disagree(const Received* received, std::uint32_t count, bool all_traced);

class SubPatch {
 public:
  SubPatch(Sources& sources, const Receiver& receiver, const Piece& piece, bool thin)
      : sources_(sources), receiver_(receiver), piece_(piece), grid_(piece, kGridCuts, thin), thin_(thin) {
    sources.forget_aims();
    view_.receiver = &receiver;
    view_.centre = piece.centre();
    area_ = sources.usual_area(length(piece.vector_area()));
    for (std::uint32_t k = 0; k < piece.corners; ++k) {
      const double reach = length(piece.corner[k] - view_.centre);
      if (reach > view_.radius) view_.radius = reach;
    }
  }

  SubPatchLight light() {
    for (std::uint32_t l = 0; l < sources_.count() && !done_; ++l) {
      const LightKind kind = sources_.light(l).kind;
      if (kind == LightKind::kPoint || kind == LightKind::kSun) {
        add_point(l);
      } else {
        add_faces(l);
      }
    }
    add_fine();
    if (!any_light()) sum_.hidden = above() == Above::kHidden;
    return sum_;
  }

 private:
  Sample at(const Vec3& point) const { return sample_at(sources_.scene(), sources_.geometry(), receiver_, point); }
  void place_centre();
  void place_probes();
  void add_point(std::uint32_t l);
  // Not inlined: the stack of one is needed while the others' isn't.
  [[gnu::noinline]] void add_faces(std::uint32_t l);
  [[gnu::noinline]] bool add_from_centre(std::uint32_t l, double shared, EndSet ends);
  void add_uniform(std::uint32_t l, const Received* received, const double* weight, std::uint32_t count);
  [[gnu::noinline]] void sample_finely(std::uint32_t l, const Received* probed, bool near, double mean);
  Received receive_in_cell(std::uint32_t l, std::uint32_t k);
  Sample place_in_cell(std::uint32_t k, std::uint32_t place) const;
  Sample fine_sample(std::uint32_t k) const;
  bool weak_point(std::uint32_t l, Received* received);
  bool add_at_centre(std::uint32_t l, const Received& received);
  /// What lies above the centre: nothing, something on a part of the sub-patch, or on all of it.
  enum class Above : std::uint8_t { kUnknown, kOpen, kCovered, kHidden };
  Above above();
  bool any_light() const { return lit_ || centre_lit_ || reached_ || fine_.used; }
  /// Then the centre can't speak for the rest.
  bool covered() { return !lit_ && !centre_lit_ && above() == Above::kCovered; }
  /// A light of some size is dark everywhere. Where all is hidden no other light is asked for.
  void note_dark() { done_ = done_ || (!any_light() && above() == Above::kHidden); }
  double centre_sees(std::uint32_t l, double shared);
  [[gnu::noinline]] Received near_mean(std::uint32_t l, FaceLook& at_gauss) const;
  [[gnu::noinline]] void look_finely(std::uint32_t l, const Received& mean, double shared);
  double fine_weight(std::uint32_t k) const { return grid_.fine(k).weight * grid_.weight_at(grid_.fine(k).at); }
  void add_to_fine(std::uint32_t l, std::uint32_t k, const Received& received, double correction);
  [[gnu::noinline]] void add_fine();
  bool bent(const Received* received) const;
  bool faint(std::uint32_t l, const Received* received) const;
  [[gnu::noinline]] bool all_hidden();
  std::uint32_t hidden_of(std::uint32_t samples) const;
  double part_of(std::uint32_t samples) const;
  double colour(std::uint32_t l, std::uint32_t channel) const { return sources_.light(l).colour.c[channel]; }
  std::uint32_t channels() const { return sources_.scene().channels; }

  Sources& sources_;
  const Receiver& receiver_;
  const Piece& piece_;
  PieceGrid grid_;
  bool thin_;
  SubPatchView view_;
  double area_ = 0;  // Sources::usual_area()
  Probes probes_;        // count 0: not placed yet
  ReceiverGroup gauss_, centre_group_;  // likewise
  SampleShift shift_;
  bool shifted_ = false;  // the fine samples have looked at the sun, which they do from other places in their cells
  Fine fine_;
  SubPatchLight sum_;
  LatticeBox probed_;  // around the probes
  Above above_ = Above::kUnknown;
  bool centre_lit_ = false;  // by a light that was asked for there only
  bool done_ = false;        // hidden
  bool reached_ = false;  // some light was found the same all over
  bool lit_ = false;      // and nothing was in its way: no sample is hidden
};

}  // namespace shodo
