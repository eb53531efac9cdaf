// Point lights and suns on a sub-patch: light/sub_patch_light.h says what is asked for.
#include "light/point_source.h"
#include "light/sub_patch_work.h"
#include "visibility/hidden.h"

namespace shodo {

namespace {

/// As those of area lights and polyhedra (light/sub_patch_light.cpp); five segments more are not so dear.
constexpr double kWeakPoint = 1.5e-3;
/// Illuminance is nearly linear if the mean of opposite corners is off the centre's by less than this part of the
/// largest. The rule's own error is about the square of it.
constexpr double kNearlyLinear = 1.0 / 16;

bool any_arrives(const Received* received, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k) {
    if (received[k].visible > 0) return true;
  }
  return false;
}

}  // namespace

/// Weights: corner samples lie at 3/4 of the way from the centre, and the second moment of the piece has to come out:
/// 16/27 for the corners together, on a triangle 4/9. Thin pieces have all samples in the middle: each counts the same.
void SubPatch::place_probes() {
  if (probes_.count > 0) return;
  const std::uint32_t corners = grid_.corner_count();
  const double at_corners = thin_ ? corners / (corners + 1.0) : corners == 3 ? 4.0 / 9 : 16.0 / 27;
  place_centre();
  probes_.sample[0] = {centre_group_.point[0], centre_group_.lattice[0]};
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
  for (std::uint32_t k = 0; k <= corners; ++k) {
    probes_.weight[k] /= total;
    probed_.include(probes_.sample[k].lattice);
  }
}

void SubPatch::add_point(std::uint32_t l) {
  const Light& light = sources_.light(l);
  if (!sources_.may_shine_on(l, receiver_)) return;
  const bool nothing = sources_.shown(l, receiver_) == Shown::kNothing;  // as all would find that look
  const double step = sources_.geometry().lattice.step();
  const bool near = light.kind == LightKind::kPoint && near_point(light, receiver_, piece_, step);
  Received received[kMostProbes];
  std::uint32_t asked = 0;
  if (light.kind == LightKind::kPoint && !near) {
    place_centre();
    if (nothing) {
      received[asked++].lux = sources_.point_lux_at(l, receiver_, centre_group_.point[0]);
    } else {
      sources_.expect(centre_group_.box);
      received[asked++] = sources_.receive(l, receiver_, {centre_group_.point[0], centre_group_.lattice[0]});
    }
    if (weak_point(l, received)) return;
  }
  if (nothing) return;
  place_probes();
  sources_.expect(probed_);
  for (std::uint32_t k = asked; k < probes_.count; ++k) {
    received[k] = sources_.receive(l, receiver_, probes_.sample[k], near);
  }
  if (!any_arrives(received, probes_.count)) return;
  const double mean = near ? near_point_mean(sources_.scene(), light, piece_, step) : 0;
  if (near && !(mean > 0)) return;
  if (disagree(received, probes_.count, near) || (!near && bent(received) && !faint(l, received))) {
    sample_finely(l, received, near, mean);
    return;
  }
  for (std::uint32_t k = 0; near && k < probes_.count; ++k) received[k].lux = mean;
  add_uniform(l, received, probes_.weight, probes_.count);
}

/// Whether a light that is weak here has been added: by what the centre sees of it, its illuminance by the rule of all
/// probes if that is nearly linear. received[0] is the centre's.
bool SubPatch::weak_point(std::uint32_t l, Received* received) {
  const double lux = received[0].lux;
  if (!(lux > 0) || sources_.point_share(l, view_.centre, lux, area_) >= kWeakPoint) return false;
  if (!(received[0].visible > 0)) return !covered();
  place_probes();
  double mean = probes_.weight[0] * lux;
  for (std::uint32_t k = 1; k < probes_.count; ++k) {
    received[k].lux = sources_.point_lux_at(l, receiver_, probes_.sample[k].point);
    mean += probes_.weight[k] * received[k].lux;
  }
  if (bent(received) && !faint(l, received)) return false;
  Received all = received[0];
  all.lux = mean;
  return add_at_centre(l, all);
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

/// A place of sample k to start segments from.
Sample SubPatch::fine_sample(std::uint32_t k) const {
  return at(shifted_ ? grid_.point(k, shift_.in_cell(k)) : grid_.point(k));
}

/// One of the four places in sample k's cell from which a sun is looked at.
Sample SubPatch::place_in_cell(std::uint32_t k, std::uint32_t place) const {
  const PieceGrid::Parameter first = shift_.in_cell(k);
  return at(grid_.point(k, {(first.s + place % 2) / 2, (first.t + place / 2) / 2}));
}

/// What of a sun arrives at the cell's visible places: which are hidden is asked where some are dark and some lit.
Received SubPatch::receive_in_cell(std::uint32_t l, std::uint32_t k) {
  Received received;
  double lit = 0;
  LatticePoint dark[kPlacesInCell];
  std::uint32_t count = 0;
  for (std::uint32_t place = 0; place < kPlacesInCell; ++place) {
    const Sample sample = place_in_cell(k, place);
    received = sources_.receive(l, receiver_, sample);
    lit += received.visible;
    if (!(received.visible > 0)) dark[count++] = sample.lattice;
  }
  std::uint32_t places = kPlacesInCell;
  if (lit > 0 && count > 0) {
    std::uint32_t hidden = hidden_samples(sources_.intersector(), {dark, count}, receiver_.normal);
    for (; hidden != 0; hidden &= hidden - 1) --places;
    sources_.forget_aims();
  }
  received.visible = lit / places;
  return received;
}

/// Asks for all samples; those next to the corners have answered already. Near a point light the values at the samples
/// only share out the mean: evenly, if a luminaire's light falls between all of them. The sun is looked at from
/// elsewhere in their cells, four times (light/sample_shift.h).
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
                  : elsewhere           ? receive_in_cell(l, k)
                                        : sources_.receive(l, receiver_, at(grid_.point(k)), near);
    weight += grid_.weight(k);
    lux += grid_.weight(k) * received[k].lux;
  }
  double correction = !near ? 1 : lux > 0 ? mean * weight / lux : 0;
  if (features::kLuminaires && near && !(lux > 0)) {
    for (Received& one : received) one.lux = mean;
    correction = 1;
  }
  for (std::uint32_t k = 0; k < kGridSamples; ++k) add_to_fine(l, k, received[k], correction);
}

}  // namespace shodo
