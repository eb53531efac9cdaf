#include "light/sub_patch_light.h"

#include "light/piece_grid.h"
#include "light/point_source.h"
#include "light/sample_shift.h"
#include "visibility/hidden.h"

namespace shodo {

namespace {

constexpr std::uint32_t kMostProbes = 5;
constexpr std::uint32_t kAllSamples = (std::uint32_t{1} << kGridSamples) - 1;

/// Values of the visible part at most so far apart, and none of them nothing, agree.
constexpr double kAgree = 0.5;
/// Illuminance is nearly linear if the mean of opposite corners is off the centre's by less than this part of the
/// largest. The rule's own error is about the square of it.
constexpr double kNearlyLinear = 1.0 / 16;

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
bool disagree(const Received* received, std::uint32_t count, bool all_traced) {
  double least = 1, most = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (!all_traced && !(received[k].lux > 0)) continue;
    const double visible = received[k].visible;
    if (visible < least) least = visible;
    if (visible > most) most = visible;
  }
  return most - least > kAgree || (least == 0 && most > 0);
}

bool any_arrives(const Received* received, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k) {
    if (received[k].visible > 0) return true;
  }
  return false;
}

class SubPatch {
 public:
  SubPatch(Sources& sources, const Receiver& receiver, const Piece& piece, bool thin)
      : sources_(sources), receiver_(receiver), piece_(piece), grid_(piece, kGridCuts, thin), thin_(thin) {
    sources.start_sub_patch();
    view_.receiver = &receiver;
    view_.centre = piece.centre();
    for (std::uint32_t k = 0; k < piece.corners; ++k) {
      const double reach = length(piece.corner[k] - view_.centre);
      if (reach > view_.radius) view_.radius = reach;
    }
  }

  SubPatchLight light() {
    for (std::uint32_t l = 0; l < sources_.count(); ++l) {
      const LightKind kind = sources_.light(l).kind;
      if (kind == LightKind::kPoint || kind == LightKind::kSun) {
        add_point(l);
      } else {
        add_faces(l);
      }
    }
    add_fine();
    if (!reached_ && !fine_.used) sum_.hidden = all_hidden();
    return sum_;
  }

 private:
  Sample at(const Vec3& point) const { return sample_at(sources_.scene(), sources_.geometry(), receiver_, point); }
  void place_probes();
  void add_point(std::uint32_t l);
  // Not inlined: the stack of one is needed while the others' isn't.
  [[gnu::noinline]] void add_faces(std::uint32_t l);
  void add_uniform(std::uint32_t l, const Received* received, const double* weight, std::uint32_t count);
  [[gnu::noinline]] void sample_finely(std::uint32_t l, const Received* probed, bool near, double mean);
  Sample fine_sample(std::uint32_t k) const;
  double centre_sees(std::uint32_t l, double shared);
  [[gnu::noinline]] Received near_mean(std::uint32_t l) const;
  [[gnu::noinline]] void look_finely(std::uint32_t l, const Received& mean, double shared);
  double fine_weight(std::uint32_t k) const { return grid_.fine(k).weight * grid_.weight_at(grid_.fine(k).at); }
  void add_to_fine(std::uint32_t l, std::uint32_t k, const Received& received, double correction);
  [[gnu::noinline]] void add_fine();
  bool bent(const Received* received) const;
  bool faint(std::uint32_t l, const Received* received) const;
  [[gnu::noinline]] bool all_hidden();
  std::uint32_t hidden_of(std::uint32_t samples) const;
  double colour(std::uint32_t l, std::uint32_t channel) const { return sources_.light(l).colour.c[channel]; }
  std::uint32_t channels() const { return sources_.scene().channels; }

  Sources& sources_;
  const Receiver& receiver_;
  const Piece& piece_;
  PieceGrid grid_;
  bool thin_;
  SubPatchView view_;
  Probes probes_;        // count 0: not placed yet
  ReceiverGroup gauss_, centre_;  // likewise
  SampleShift shift_;
  bool shifted_ = false;  // the fine samples have looked at the sun, which they do from other places in their cells
  Fine fine_;
  SubPatchLight sum_;
  bool reached_ = false;  // some light was found the same all over
  bool lit_ = false;      // and nothing was in its way: no sample is hidden
};

/// Weights: corner samples lie at 3/4 of the way from the centre, and the second moment of the piece has to come out:
/// 16/27 for the corners together, on a triangle 4/9. Thin pieces have all samples in the middle: each counts the same.
void SubPatch::place_probes() {
  if (probes_.count > 0) return;
  const std::uint32_t corners = grid_.corner_count();
  const double at_corners = thin_ ? corners / (corners + 1.0) : corners == 3 ? 4.0 / 9 : 16.0 / 27;
  probes_.sample[0] = at(piece_.centre());
  probes_.weight[0] = (1 - at_corners) * grid_.centre_weight();
  probes_.grid_index[0] = kGridSamples;
  double total = probes_.weight[0];
  for (std::uint32_t k = 1; k <= corners; ++k) {
    const std::uint32_t index = grid_.corner(k - 1);
    probes_.sample[k] = at(grid_.point(index));
    probes_.weight[k] = at_corners / corners * grid_.weight(index);
    probes_.grid_index[k] = index;
    total += probes_.weight[k];
  }
  probes_.count = corners + 1;
  LatticeBox box;
  for (std::uint32_t k = 0; k <= corners; ++k) {
    probes_.weight[k] /= total;
    box.include(probes_.sample[k].lattice);
  }
  sources_.expect(box);
}

void SubPatch::add_point(std::uint32_t l) {
  const Light& light = sources_.light(l);
  if (!sources_.may_shine_on(l, receiver_) || sources_.shown(l, receiver_) == Shown::kNothing) return;
  const double step = sources_.geometry().lattice.step();
  const bool near = light.kind == LightKind::kPoint && near_point(light, receiver_, piece_, step);
  const double mean = near ? near_point_mean(sources_.scene(), light, piece_, step) : 0;
  if (near && !(mean > 0)) return;
  place_probes();
  Received received[kMostProbes];
  for (std::uint32_t k = 0; k < probes_.count; ++k) {
    received[k] = sources_.receive(l, receiver_, probes_.sample[k], near);
  }
  if (!any_arrives(received, probes_.count)) return;
  if (disagree(received, probes_.count, near) || (!near && bent(received) && !faint(l, received))) {
    sample_finely(l, received, near, mean);
    return;
  }
  for (std::uint32_t k = 0; near && k < probes_.count; ++k) received[k].lux = mean;
  add_uniform(l, received, probes_.weight, probes_.count);
}

void SubPatch::add_faces(std::uint32_t l) {
  const double shared = sources_.shared_factor(l, receiver_);
  if (shared == 0) return;
  const Shown shown = sources_.shown(l, receiver_);
  if (shown == Shown::kNothing) return;
  if (shown == Shown::kAll && shared > 0) {
    const Received all = sources_.all_of(l, shared);
    const double one = 1;
    add_uniform(l, &all, &one, 1);
    return;
  }
  if (gauss_.count == 0) {
    gauss_ = gauss_group(sources_.scene(), sources_.geometry(), receiver_, grid_);
    centre_ = centre_group(sources_.scene(), sources_.geometry(), receiver_, piece_);
    gauss_.box.include(centre_.box);  // what is clear for the ones is for the other
  }
  const FaceLook look = sources_.look(l, view_, gauss_, shared);
  Received received[kGaussSamples], mean;
  double weight[kGaussSamples], total = kGaussSamples;
  if (grid_.affine()) {
    for (double& w : weight) w = 1;
  } else {
    total = 0;
    for (std::uint32_t k = 0; k < kGaussSamples; ++k) total += weight[k] = grid_.weight_at(grid_.gauss(k));
  }
  double arrives = 0;
  for (std::uint32_t k = 0; k < kGaussSamples; ++k) {
    received[k] = sources_.received(l, gauss_, look, k);
    mean.lux += weight[k] / total * received[k].lux;
    mean.factor += weight[k] / total * received[k].factor;
    arrives += weight[k] / total * received[k].lux * received[k].visible;
  }
  const bool unseen = !(mean.lux > 0);  // though a part of the sub-patch may be in front
  double visible = unseen ? 0 : arrives / mean.lux;
  if (shared > 0) {
    mean = sources_.all_of(l, shared);
    visible = 0.25 * ((received[0].visible + received[1].visible) + (received[2].visible + received[3].visible));
  }
  if (shared < 0 && look.reach != FaceReach::kFar) mean = near_mean(l);
  if (!(mean.lux > 0)) return;
  mean.visible = visible;
  const bool area = sources_.light(l).kind == LightKind::kArea;
  if (unseen || disagree(received, kGaussSamples, false)) {
    look_finely(l, mean, shared);
    return;
  }
  const bool all_free = look.clear && visible == 1;  // the centre would see the same
  if (area && !all_free && !look.split) {
    // Both sets count by the number of places that they look at.
    const double from_centre = centre_sees(l, shared);
    if (from_centre >= 0) mean.visible = (kFewEnds * visible + kAreaEnds * from_centre) / (kFewEnds + kAreaEnds);
  }
  const double one = 1;
  add_uniform(l, &mean, &one, 1);
}

/// The part of an area light that is visible from the centre; -1 if the light is below its horizon.
double SubPatch::centre_sees(std::uint32_t l, double shared) {
  const FaceLook look = sources_.look(l, view_, centre_, shared < 0 ? 1 : shared);  // any: only the part is asked for
  return look.tested[0] > 0 ? look.visible(0) : -1;
}

/// Nothing in the way; each face by the rule that suits its reach.
Received SubPatch::near_mean(std::uint32_t l) const {
  Received mean;
  const auto add = [&](const ReceiverGroup& group, FaceReach reach, auto weight_of) {
    const FaceLook look = sources_.factors(l, view_, group, reach);
    for (std::uint32_t k = 0; k < group.count; ++k) {
      const Received received = sources_.received(l, group, look, k);
      mean.lux += weight_of(k) * received.lux;
      mean.factor += weight_of(k) * received.factor;
    }
  };
  double gauss = 0, fine = 0, grid = 0;
  for (std::uint32_t k = 0; k < kGaussSamples; ++k) gauss += grid_.weight_at(grid_.gauss(k));
  for (std::uint32_t k = 0; k < grid_.fine_count(); ++k) fine += fine_weight(k);
  for (std::uint32_t k = 0; k < kGridSamples; ++k) grid += grid_.weight(k);
  add(gauss_, FaceReach::kFar, [&](std::uint32_t k) { return grid_.weight_at(grid_.gauss(k)) / gauss; });
  add(fine_group(grid_), FaceReach::kNear, [&](std::uint32_t k) { return fine_weight(k) / fine; });
  for (std::uint32_t half = 0; half < 2; ++half) {
    const ReceiverGroup group = grid_half(grid_, half);
    add(group, FaceReach::kVeryNear, [&](std::uint32_t k) { return grid_.weight(group.grid_index[k]) / grid; });
  }
  return mean;
}

bool SubPatch::faint(std::uint32_t l, const Received* received) const {
  if (sources_.light(l).kind != LightKind::kPoint) return false;
  double largest = 0;
  for (std::uint32_t k = 0; k < probes_.count; ++k) {
    if (received[k].lux > largest) largest = received[k].lux;
  }
  return is_faint(sources_.scene(), sources_.light(l), view_.centre, largest);
}

bool SubPatch::bent(const Received* received) const {
  const double centre = received[0].lux;
  double largest = centre, corners = 0, worst = 0;
  for (std::uint32_t k = 1; k < probes_.count; ++k) {
    if (received[k].lux > largest) largest = received[k].lux;
    corners += received[k].lux;
  }
  const auto off_centre = [&](double mean) {
    const double off = mean < centre ? centre - mean : mean - centre;
    if (off > worst) worst = off;
  };
  off_centre(corners / (probes_.count - 1));
  if (probes_.count == 5) {
    off_centre(0.5 * (received[1].lux + received[4].lux));
    off_centre(0.5 * (received[2].lux + received[3].lux));
  }
  return worst > kNearlyLinear * largest;
}

void SubPatch::add_uniform(std::uint32_t l, const Received* received, const double* weight, std::uint32_t count) {
  double lux = 0, factor = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    lux += weight[k] * received[k].lux * received[k].visible;
    factor += weight[k] * received[k].factor * received[k].visible;
  }
  for (std::uint32_t c = 0; c < channels(); ++c) sum_.lux[c] += colour(l, c) * lux;
  sum_.light_factor += factor;
  bool whole = lux > 0;
  for (std::uint32_t k = 0; k < count; ++k) whole = whole && received[k].visible == 1;
  reached_ = reached_ || lux > 0;
  lit_ = lit_ || whole;
}

void SubPatch::add_to_fine(std::uint32_t l, std::uint32_t k, const Received& received, double correction) {
  const double arrives = correction * received.lux * received.visible;
  for (std::uint32_t c = 0; c < channels(); ++c) fine_.lux[k][c] += colour(l, c) * arrives;
  fine_.factor[k] += correction * received.factor * received.visible;
  if (!(received.visible > 0)) return;
  fine_.lit |= std::uint32_t{1} << k;
  fine_.used = true;
}

/// A place of sample k to start segments from.
Sample SubPatch::fine_sample(std::uint32_t k) const {
  return at(shifted_ ? grid_.point(k, shift_.in_cell(k)) : grid_.point(k));
}

/// Asks for all samples; those next to the corners have answered already. Near a point light the values at the samples
/// only share out the mean. The sun is looked at from elsewhere in their cells (light/sample_shift.h).
void SubPatch::sample_finely(std::uint32_t l, const Received* probed, bool near, double mean) {
  const bool elsewhere = sources_.light(l).kind == LightKind::kSun && grid_.corner_count() == 4;
  if (elsewhere && !shifted_) {
    shift_ = SampleShift(sources_.geometry().lattice, probes_.sample[0].lattice, piece_);
    shifted_ = true;
  }
  Received received[kGridSamples];
  double weight = 0, lux = 0;
  for (std::uint32_t k = 0; k < kGridSamples; ++k) {
    std::uint32_t probe = elsewhere ? probes_.count : 1;
    while (probe < probes_.count && probes_.grid_index[probe] != k) ++probe;
    received[k] = probe < probes_.count ? probed[probe]
                  : elsewhere           ? sources_.receive(l, receiver_, fine_sample(k), near)
                                        : sources_.receive(l, receiver_, at(grid_.point(k)), near);
    weight += grid_.weight(k);
    lux += grid_.weight(k) * received[k].lux;
  }
  const double correction = !near ? 1 : lux > 0 ? mean * weight / lux : 0;
  for (std::uint32_t k = 0; k < kGridSamples; ++k) add_to_fine(l, k, received[k], correction);
}

/// Each half of the samples looks at ends of its own. Their values only share out the mean, which is known better.
void SubPatch::look_finely(std::uint32_t l, const Received& mean, double shared) {
  Received received[kGridSamples];
  double weight = 0, lux = 0;
  for (std::uint32_t half = 0; half < 2; ++half) {
    const ReceiverGroup group = grid_group(sources_.scene(), sources_.geometry(), receiver_, grid_, half);
    const FaceLook look = sources_.look(l, view_, group, shared);
    for (std::uint32_t k = 0; k < group.count; ++k) {
      const std::uint32_t sample = group.grid_index[k];
      received[sample] = sources_.received(l, group, look, k);
      weight += grid_.weight(sample);
      lux += grid_.weight(sample) * received[sample].lux;
    }
  }
  const double correction = lux > 0 ? mean.lux * weight / lux : 0;
  for (std::uint32_t k = 0; k < kGridSamples; ++k) add_to_fine(l, k, received[k], correction);
}

/// The mean over the samples that are not hidden; over all if only the centre is not.
void SubPatch::add_fine() {
  if (!fine_.used) return;
  SubPatchLight visible, all;
  double visible_weight = 0, all_weight = 0;
  const auto add = [&](std::uint32_t k, SubPatchLight& to, double& weight) {
    for (std::uint32_t c = 0; c < channels(); ++c) to.lux[c] += grid_.weight(k) * fine_.lux[k][c];
    to.light_factor += grid_.weight(k) * fine_.factor[k];
    weight += grid_.weight(k);
  };
  const std::uint32_t dark = lit_ ? 0 : ~fine_.lit & kAllSamples;
  const std::uint32_t hidden = dark == 0 ? 0 : hidden_of(dark);
  for (std::uint32_t k = 0; k < kGridSamples; ++k) {
    add(k, all, all_weight);
    if ((hidden >> k & 1) == 0) add(k, visible, visible_weight);
  }
  const bool any = visible_weight > 0;
  const double weight = any ? visible_weight : all_weight;
  if (!(weight > 0)) return;
  for (std::uint32_t c = 0; c < channels(); ++c) sum_.lux[c] += (any ? visible : all).lux[c] / weight;
  sum_.light_factor += (any ? visible : all).light_factor / weight;
}

/// Those of the samples (a bit each) that are hidden.
std::uint32_t SubPatch::hidden_of(std::uint32_t samples) const {
  LatticePoint lattice[kGridSamples];
  std::uint32_t index[kGridSamples], count = 0;
  for (std::uint32_t k = 0; k < kGridSamples; ++k) {
    if ((samples >> k & 1) == 0) continue;
    index[count] = k;
    lattice[count++] = fine_sample(k).lattice;
  }
  const std::uint32_t found = hidden_samples(sources_.intersector(), {lattice, count}, receiver_.normal, false);
  std::uint32_t hidden = 0;
  for (std::uint32_t k = 0; k < count; ++k) hidden |= (found >> k & 1) << index[k];
  return hidden;
}

bool SubPatch::all_hidden() {
  place_probes();
  LatticePoint lattice[kMostProbes];
  for (std::uint32_t k = 0; k < probes_.count; ++k) lattice[k] = probes_.sample[k].lattice;
  const std::uint32_t all = (std::uint32_t{1} << probes_.count) - 1;
  return hidden_samples(sources_.intersector(), {lattice, probes_.count}, receiver_.normal, true) == all;
}

}  // namespace

SubPatchLight light_sub_patch(Sources& sources, const Receiver& receiver, const Piece& piece, bool thin) {
  return SubPatch(sources, receiver, piece, thin).light();
}

}  // namespace shodo
