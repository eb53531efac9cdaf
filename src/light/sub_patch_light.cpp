#include "light/sub_patch_light.h"

#include "light/sub_patch_work.h"
#include "visibility/hidden.h"

namespace shodo {

namespace {

/// A light of whose flux a sub-patch gets a smaller part than this is looked at from its centre alone; an area light
/// below kFaint with as few ends as other samples have. So work goes where the light goes. In a room of 10,000
/// sub-patches the mean part is 1/10,000; with more than kUsualSubPatches all parts are weighed as if it had so many.
constexpr double kFaint = 1e-4;
constexpr double kWeakArea = 1e-3;
constexpr double kWeakPolyhedron = 1.5e-4;

constexpr std::uint32_t kAllSamples = (std::uint32_t{1} << kGridSamples) - 1;
/// Values of the visible part at most so far apart, and none of them nothing, agree.
constexpr double kAgree = 0.5;

/// Cuts off what of a quadrilateral is behind an area light, if the light's plane passes between two of its edges.
void keep_front(const Emitter& light, Piece& piece) {
  if (piece.corners == 3 || piece.cut) return;
  double height[4];
  std::uint32_t behind = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    height[k] = light.height(piece.corner[k]);
    if (height[k] < 0) behind |= std::uint32_t{1} << k;
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4, over = (k + 2) % 4, last = (k + 3) % 4;
    if (behind != (std::uint32_t{1} << over | std::uint32_t{1} << last)) continue;
    const auto cut = [&](std::uint32_t from, std::uint32_t to) {
      const double at = height[from] / (height[from] - height[to]);
      piece.corner[to] = piece.corner[from] + at * (piece.corner[to] - piece.corner[from]);
    };
    cut(next, over);
    cut(k, last);
    return;
  }
}

}  // namespace

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

void SubPatch::place_centre() {
  if (centre_group_.count == 0) centre_group_ = centre_group(sources_.scene(), sources_.geometry(), receiver_, piece_);
}

/// Asked for once.
SubPatch::Above SubPatch::above() {
  if (above_ == Above::kUnknown) {
    place_centre();
    const bool under = under_backs(sources_.intersector(), {centre_group_.lattice, 1}, receiver_.normal);
    above_ = !under ? Above::kOpen : all_hidden() ? Above::kHidden : Above::kCovered;
    sources_.forget_aims();
  }
  return above_;
}

/// What the centre alone receives stands for the sub-patch. It says nothing about other samples: that they aren't
/// hidden, say. False: it is dark, and covered.
bool SubPatch::add_at_centre(std::uint32_t l, const Received& received) {
  if (!(received.visible > 0)) return !covered();
  centre_lit_ = true;
  const bool reached = reached_, lit = lit_;
  const double one = 1;
  add_uniform(l, &received, &one, 1);
  reached_ = reached;
  lit_ = lit;
  return true;
}

bool SubPatch::add_from_centre(std::uint32_t l, double shared, EndSet ends) {
  place_centre();
  centre_group_.ends_of_area = ends;
  const FaceLook look = sources_.look(l, view_, centre_group_, shared);
  Received received = sources_.received(l, centre_group_, look, 0);
  if (shared > 0) {
    received = sources_.all_of(l, shared);
    received.visible = look.visible(0);
  }
  if (!(received.lux > 0)) return true;
  if (!add_at_centre(l, received)) return false;
  if (!(received.visible > 0)) note_dark();
  return true;
}

void SubPatch::add_faces(std::uint32_t l) {
  const double shared = sources_.shared_factor(l, receiver_);
  if (shared == 0) return;
  const Shown shown = sources_.shown(l, receiver_);
  const bool area = sources_.light(l).kind == LightKind::kArea;
  const Received all = shared > 0 ? sources_.all_of(l, shared) : Received{};
  const double share = sources_.share_squared(l, view_, area_, shared), least = area ? kWeakArea : kWeakPolyhedron;
  const bool weak = share < least * least;
  if (shown == Shown::kNothing && shared > 0) {  // what all would ask that look, and find it dark
    if (!covered()) note_dark();
    if (area && !weak) above();
    return;
  }
  if (shown == Shown::kAll && shared > 0) {
    const double one = 1;
    if (weak) {
      add_at_centre(l, all);
    } else {
      add_uniform(l, &all, &one, 1);
    }
    return;
  }
  if (weak) {
    if (add_from_centre(l, shared, share < kFaint * kFaint ? kFirstEnds : kAllEnds)) return;
  }
  place_centre();
  if (gauss_.count == 0) {
    gauss_ = gauss_group(sources_.scene(), sources_.geometry(), receiver_, grid_);
    gauss_.box.include(centre_group_.box);  // what is clear for the ones is for the other
  }
  FaceLook look = sources_.look(l, view_, gauss_, shared);
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
    mean = all;
    visible = 0.25 * ((received[0].visible + received[1].visible) + (received[2].visible + received[3].visible));
  }
  if (shared < 0 && look.reach != FaceReach::kFar) mean = near_mean(l, look);
  if (!(mean.lux > 0)) return;
  mean.visible = visible;
  if (unseen || disagree(received, kGaussSamples, false) || (visible == 0 && covered())) {
    look_finely(l, mean, shared);
    return;
  }
  if (visible == 0) note_dark();
  const bool all_free = look.clear && visible == 1;  // the centre would see the same
  if (area && !all_free && !look.split) {
    // Both sets count by the number of places that they look at.
    const double from_centre = centre_sees(l, shared);
    const bool speaks = from_centre > 0 || (from_centre == 0 && above() != Above::kCovered);
    if (speaks) mean.visible = (kFewEnds * visible + kAreaEnds * from_centre) / (kFewEnds + kAreaEnds);
  }
  const double one = 1;
  add_uniform(l, &mean, &one, 1);
}

/// The part of an area light that is visible from the centre; -1 if the light is below its horizon.
double SubPatch::centre_sees(std::uint32_t l, double shared) {
  centre_group_.ends_of_area = kAllEnds;
  const double given = shared < 0 ? 1 : shared;  // any: only the part is asked for
  const FaceLook look = sources_.look(l, view_, centre_group_, given);
  return look.tested[0] > 0 ? look.visible(0) : -1;
}

/// Nothing in the way; each face by the rule that suits its reach. `at_gauss`: what the Gauss points found. The plane
/// of an area light is the edge of its light: a sub-patch very near, which it cuts, has the mean of the part in front,
/// times that part.
Received SubPatch::near_mean(std::uint32_t l, FaceLook& at_gauss) const {
  Received mean;
  const auto add = [&](const ReceiverGroup& group, const FaceLook& look, auto weight_of) {
    for (std::uint32_t k = 0; k < group.count; ++k) {
      const Received received = sources_.received(l, group, look, k);
      mean.lux += weight_of(k) * received.lux;
      mean.factor += weight_of(k) * received.factor;
    }
  };
  double gauss = 0, fine = 0, all = 0;
  for (std::uint32_t k = 0; k < kGaussSamples; ++k) {
    gauss += grid_.weight_at(grid_.gauss(k));
    at_gauss.factor[k] = at_gauss.far[k];
  }
  add(gauss_, at_gauss, [&](std::uint32_t k) { return grid_.weight_at(grid_.gauss(k)) / gauss; });
  if (at_gauss.reaches(FaceReach::kNear)) {
    for (std::uint32_t k = 0; k < grid_.fine_count(); ++k) fine += fine_weight(k);
    const ReceiverGroup group = fine_group(grid_);
    add(group, sources_.factors(l, view_, group, FaceReach::kNear),
        [&](std::uint32_t k) { return fine_weight(k) / fine; });
  }
  if (!at_gauss.reaches(FaceReach::kVeryNear)) return mean;
  Piece lit = piece_;
  if (sources_.light(l).kind == LightKind::kArea) keep_front(area_emitter(sources_.scene(), l), lit);
  const PieceGrid grid(lit, kGridCuts, thin_);
  for (std::uint32_t k = 0; k < kGridSamples; ++k) all += grid.weight(k);
  all *= length(piece_.vector_area()) / length(lit.vector_area());
  for (std::uint32_t half = 0; half < 2; ++half) {
    const ReceiverGroup group = grid_half(grid, half);
    add(group, sources_.factors(l, view_, group, FaceReach::kVeryNear),
        [&](std::uint32_t k) { return grid.weight(group.grid_index[k]) / all; });
  }
  return mean;
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
  if (!fine_.used) {
    if (above_ == Above::kCovered) sum_.visible = part_of(~hidden_of(kAllSamples));
    return;
  }
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
  if (any) sum_.visible = visible_weight / all_weight;
  const double weight = any ? visible_weight : all_weight;
  if (!(weight > 0)) return;
  for (std::uint32_t c = 0; c < channels(); ++c) sum_.lux[c] += (any ? visible : all).lux[c] / weight;
  sum_.light_factor += (any ? visible : all).light_factor / weight;
}

/// The part of the area for which these samples stand; 1 if it is none.
double SubPatch::part_of(std::uint32_t samples) const {
  double some = 0, all = 0;
  for (std::uint32_t k = 0; k < kGridSamples; ++k) {
    all += grid_.weight(k);
    if ((samples >> k & 1) != 0) some += grid_.weight(k);
  }
  return some > 0 && all > 0 ? some / all : 1;
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
  const std::uint32_t found = hidden_samples(sources_.intersector(), {lattice, count}, receiver_.normal);
  std::uint32_t hidden = 0;
  for (std::uint32_t k = 0; k < count; ++k) hidden |= (found >> k & 1) << index[k];
  return hidden;
}

/// The centre is, and above all corners there are backs.
bool SubPatch::all_hidden() {
  place_probes();
  LatticePoint lattice[kMostProbes];
  for (std::uint32_t k = 0; k < probes_.count; ++k) lattice[k] = probes_.sample[k].lattice;
  return under_backs(sources_.intersector(), {lattice, probes_.count}, receiver_.normal) &&
         hidden_samples(sources_.intersector(), {lattice, 1}, receiver_.normal) == 1;
}

SubPatchLight light_sub_patch(Sources& sources, const Receiver& receiver, const Piece& piece, bool thin) {
  return SubPatch(sources, receiver, piece, thin).light();
}

}  // namespace shodo
