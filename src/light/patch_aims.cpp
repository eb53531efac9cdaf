#include "light/patch_aims.h"

namespace shodo {

bool PatchAims::take(Arena& arena, std::uint32_t lights) {
  return arena.take("blockers by light", lights, lists_) && arena.take("blockers of a patch", kListed, facets_);
}

std::uint64_t PatchAims::bytes(std::uint32_t lights) {
  return sizeof(List) * std::uint64_t{lights} + sizeof(std::uint32_t) * kListed;
}

void PatchAims::start(const LatticeBox& patch) {
  patch_ = patch;
  used_ = 0;
  for (List& list : lists_) list = {0, kNotYet};
}

bool PatchAims::usable(const LatticeBox& from) const {
  for (int k = 0; k < 3; ++k) {
    if (from.low[k] < patch_.low[k] || from.high[k] > patch_.high[k]) return false;
  }
  return intersector_->seeking();
}

void PatchAims::keep(List& list, const Aim& aim) {
  if (aim.facets.size() > facets_.size() - used_) {
    list.count = kTooLong;
    return;
  }
  list = {used_, static_cast<std::uint32_t>(aim.facets.size())};
  for (const std::uint32_t facet : aim.facets) facets_[used_++] = facet;
}

Aim PatchAims::towards(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeBox& ends,
                       const LatticeBox& whole) {
  List& list = lists_[l];
  if (!usable(from) || list.count == kTooLong) return intersector_->aim(from, ends, link);
  if (list.count == kNotYet) keep(list, intersector_->aim(patch_, whole, link));
  if (list.count == kTooLong) return intersector_->aim(from, ends, link);
  return intersector_->aim_among(facets_of(list), from, ends);
}

Aim PatchAims::along(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeVector& direction) {
  List& list = lists_[l];
  if (!usable(from) || list.count == kTooLong) return intersector_->aim_along(from, direction, link);
  if (list.count == kNotYet) keep(list, intersector_->aim_along(patch_, direction, link));
  if (list.count == kTooLong) return intersector_->aim_along(from, direction, link);
  return intersector_->aim_along_among(facets_of(list), from, direction);
}

}  // namespace shodo
