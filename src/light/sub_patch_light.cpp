#include "light/sub_patch_light.h"

#include "light/piece_grid.h"
#include "light/point_source.h"

namespace shodo {

namespace {

constexpr std::uint32_t kCuts = 4;
constexpr std::uint32_t kSamples = kCuts * kCuts;
constexpr std::uint32_t kMostProbes = 5;

/// Probes that see parts of a light at most this far apart, and none of them nothing, agree.
constexpr double kAgree = 0.25;
/// Illuminance is nearly linear if the mean of opposite corners is off the centre's by less than this part of the
/// largest. The rule's own error is about the square of it.
constexpr double kNearlyLinear = 1.0 / 16;

/// The samples of the first look: the centre, then the corners of the 4 x 4 grid.
struct Probes {
  Sample sample[kMostProbes];
  double weight[kMostProbes];  // sum 1
  std::uint32_t grid_index[kMostProbes];
  std::uint32_t count = 0;
};

/// What the lights that need all samples send to each.
struct Fine {
  double lux[kSamples][3] = {};
  double factor[kSamples] = {};
  std::uint32_t lit = 0;  // bit k: sample k
  bool used = false;
};

class SubPatch {
 public:
  SubPatch(Sources& sources, const Receiver& receiver, const Piece& piece, bool thin)
      : sources_(sources), receiver_(receiver), piece_(piece), grid_(piece, kCuts, thin), thin_(thin) {
    place_probes();
  }

  SubPatchLight light() {
    for (std::uint32_t l = 0; l < sources_.count(); ++l) add_light(l);
    add_fine();
    if (!lit_ && !fine_.used) sum_.hidden = all_hidden();
    return sum_;
  }

 private:
  Sample sample_at(const Vec3& point) const;
  void place_probes();
  void add_light(std::uint32_t l);
  void add_uniform(std::uint32_t l, const Received* received);
  void sample_finely(std::uint32_t l, const Received* probed, bool near, double mean);
  void add_fine();
  bool disagree(const Received* received, bool near) const;
  bool bent(const Received* received) const;
  bool all_hidden() const;
  bool hidden(const Sample& sample) const {
    return is_hidden(sources_.intersector(), sample.lattice, receiver_.normal);
  }
  double colour(std::uint32_t l, std::uint32_t channel) const { return sources_.light(l).colour.c[channel]; }
  std::uint32_t channels() const { return sources_.scene().channels; }

  Sources& sources_;
  const Receiver& receiver_;
  const Piece& piece_;
  PieceGrid grid_;
  bool thin_;
  Probes probes_;
  Fine fine_;
  SubPatchLight sum_;
  bool lit_ = false;  // some light reaches all probes
};

Sample SubPatch::sample_at(const Vec3& point) const {
  return {point, sample_point(sources_.scene(), sources_.geometry(), receiver_.mesh, receiver_.cell, point)};
}

/// Weights: corner samples lie at 3/4 of the way from the centre, and the second moment of the piece has to come out:
/// 16/27 for the corners together, on a triangle 4/9. Thin pieces have all samples in the middle: each counts the same.
void SubPatch::place_probes() {
  const std::uint32_t corners = grid_.corner_count();
  const double at_corners = thin_ ? corners / (corners + 1.0) : corners == 3 ? 4.0 / 9 : 16.0 / 27;
  probes_.sample[0] = sample_at(piece_.centre());
  probes_.weight[0] = (1 - at_corners) * grid_.centre_weight();
  probes_.grid_index[0] = kSamples;
  double total = probes_.weight[0];
  for (std::uint32_t k = 1; k <= corners; ++k) {
    const std::uint32_t index = grid_.corner(k - 1);
    probes_.sample[k] = sample_at(grid_.point(index));
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

void SubPatch::add_light(std::uint32_t l) {
  const Light& light = sources_.light(l);
  const double step = sources_.geometry().lattice.step();
  const bool near = light.kind == LightKind::kPoint && near_point(light, receiver_, piece_, step);
  const double mean = near ? near_point_mean(sources_.scene(), light, piece_, step) : 0;
  if (near && !(mean > 0)) return;
  Received received[kMostProbes];
  bool any = false;
  for (std::uint32_t k = 0; k < probes_.count; ++k) {
    received[k] = sources_.receive(l, receiver_, probes_.sample[k], near);
    any = any || received[k].visible > 0;
  }
  if (!any) return;
  if (disagree(received, near) || (!near && bent(received))) {
    sample_finely(l, received, near, mean);
    return;
  }
  for (std::uint32_t k = 0; near && k < probes_.count; ++k) received[k].lux = mean;
  add_uniform(l, received);
}

/// Probes that a light doesn't shine on (outside its distribution, behind it) say nothing about what is in the way,
/// unless segments were sent all the same.
bool SubPatch::disagree(const Received* received, bool near) const {
  double least = 1, most = 0;
  for (std::uint32_t k = 0; k < probes_.count; ++k) {
    if (!near && !(received[k].lux > 0)) continue;
    const double visible = received[k].visible;
    if (visible < least) least = visible;
    if (visible > most) most = visible;
  }
  return most - least > kAgree || (least == 0 && most > 0);
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

void SubPatch::add_uniform(std::uint32_t l, const Received* received) {
  double lux = 0, factor = 0;
  for (std::uint32_t k = 0; k < probes_.count; ++k) {
    lux += probes_.weight[k] * received[k].lux * received[k].visible;
    factor += probes_.weight[k] * received[k].factor * received[k].visible;
  }
  for (std::uint32_t c = 0; c < channels(); ++c) sum_.lux[c] += colour(l, c) * lux;
  sum_.light_factor += factor;
  lit_ = lit_ || lux > 0;
}

/// Asks for all samples; those next to the corners have answered already. Near a point light the values at the samples
/// only share out the mean.
void SubPatch::sample_finely(std::uint32_t l, const Received* probed, bool near, double mean) {
  Received received[kSamples];
  double weight = 0, lux = 0;
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    std::uint32_t probe = 1;
    while (probe < probes_.count && probes_.grid_index[probe] != k) ++probe;
    received[k] =
        probe < probes_.count ? probed[probe] : sources_.receive(l, receiver_, sample_at(grid_.point(k)), near);
    weight += grid_.weight(k);
    lux += grid_.weight(k) * received[k].lux;
  }
  const double correction = !near ? 1 : lux > 0 ? mean * weight / lux : 0;
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    const double arrives = correction * received[k].lux * received[k].visible;
    for (std::uint32_t c = 0; c < channels(); ++c) fine_.lux[k][c] += colour(l, c) * arrives;
    fine_.factor[k] += received[k].factor * received[k].visible;
    if (received[k].visible > 0) fine_.lit |= std::uint32_t{1} << k;
  }
  fine_.used = true;
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
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    add(k, all, all_weight);
    const bool lit = lit_ || (fine_.lit >> k & 1) == 1;
    if (lit || !hidden(sample_at(grid_.point(k)))) add(k, visible, visible_weight);
  }
  const bool any = visible_weight > 0;
  const double weight = any ? visible_weight : all_weight;
  if (!(weight > 0)) return;
  for (std::uint32_t c = 0; c < channels(); ++c) sum_.lux[c] += (any ? visible : all).lux[c] / weight;
  sum_.light_factor += (any ? visible : all).light_factor / weight;
}

bool SubPatch::all_hidden() const {
  for (std::uint32_t k = 0; k < probes_.count; ++k) {
    if (!hidden(probes_.sample[k])) return false;
  }
  return true;
}

}  // namespace

SubPatchLight light_sub_patch(Sources& sources, const Receiver& receiver, const Piece& piece, bool thin) {
  return SubPatch(sources, receiver, piece, thin).light();
}

}  // namespace shodo
