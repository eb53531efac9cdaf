#include "light/patch_aims.h"

#include <utility>

namespace shodo {

namespace {

bool is_point(const LatticeBox& box) {
  return box.low[0] == box.high[0] && box.low[1] == box.high[1] && box.low[2] == box.high[2];
}

bool within(const LatticeBox& part, const LatticeBox& box) {
  for (int k = 0; k < 3; ++k) {
    if (part.low[k] < box.low[k] || part.high[k] > box.high[k]) return false;
  }
  return true;
}

}  // namespace

bool PatchAims::take(Arena& arena, std::uint32_t lights) {
  if (!arena.take("blockers by light", lights, lists_) || !arena.take("blockers of a patch", kListed, facets_)) {
    return false;
  }
  for (List& list : lists_) list = {};
  return true;
}

std::uint64_t PatchAims::bytes(std::uint32_t lights) {
  return (sizeof(List) * std::uint64_t{lights} + 7) / 8 * 8 + sizeof(std::uint32_t) * kListed;
}

void PatchAims::start(const LatticeBox& patch, bool surely) {
  patch_ = patch;
  surely_ = surely;
  used_ = 0;
  for (List& list : lists_) list.count = kNotYet;
}

bool PatchAims::usable(const LatticeBox& from) const { return within(from, patch_) && intersector_->seeking(); }

void PatchAims::keep(List& list, const Aim& aim) {
  if (aim.facets.size() > facets_.size() - used_) {
    list.count = kTooLong;
    return;
  }
  list.first = used_;
  list.count = static_cast<std::uint32_t>(aim.facets.size());
  for (const std::uint32_t facet : aim.facets) facets_[used_++] = facet;
  prefer(list);
}

bool PatchAims::hidden(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeBox& ends) const {
  const List& list = lists_[l];
  return list.blocker != kNone && intersector_->seeking() && intersector_->tested(link) &&
         intersector_->hides_all(list.blocker, from, ends, link);
}

void PatchAims::used(std::uint32_t l, const Aim& aim) {
  if (aim.facets.empty()) return;
  lists_[l].blocker = aim.facets[0];
  prefer(lists_[l]);
}

void PatchAims::prefer(List& list) {
  if (list.count >= kDark || list.blocker == kNone) return;
  for (std::uint32_t& facet : facets_.subspan(list.first, list.count)) {
    if (facet == list.blocker) std::swap(facet, facets_[list.first]);
  }
}

Shown PatchAims::shown(std::uint32_t l, const Link& link, const LatticeBox& whole) {
  if (!surely_ || !intersector_->seeking()) return Shown::kUnknown;
  List& list = lists_[l];
  if (list.count == kNotYet) {
    keep(list, intersector_->aim(patch_, whole, link));
    for (std::uint32_t k = 0; list.count <= kListed && k < list.count; ++k) {
      if (intersector_->hides_all(facets_[list.first + k], patch_, whole, link)) list.count = kDark;
    }
  }
  return list.count == 0 ? Shown::kAll : list.count == kDark ? Shown::kNothing : Shown::kUnknown;
}

Aim PatchAims::towards(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeBox& ends,
                       const LatticeBox& whole, const EndGrid* grid) {
  if (l == last_light_ && grid == last_grid_ && within(from, last_from_) && within(ends, last_ends_)) return last_;
  last_ = make(l, link, from, ends, whole, grid);
  last_light_ = l;
  last_grid_ = grid;
  last_from_ = from;
  last_ends_ = ends;
  return last_;
}

Aim PatchAims::make(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeBox& ends,
                    const LatticeBox& whole, const EndGrid* grid) {
  List& list = lists_[l];
  if (usable(from) && list.count == kNotYet) keep(list, intersector_->aim(patch_, whole, link));
  if (!usable(from) || list.count >= kDark) {
    const Aim aim = intersector_->aim(from, ends, link);
    return grid == nullptr ? aim : intersector_->sift(aim, from, *grid);
  }
  if (is_point(from)) return {facets_.subspan(list.first, list.count), false, {}, grid};
  if (grid != nullptr) return intersector_->aim_among(facets_of(list), from, ends, *grid);
  return intersector_->aim_among(facets_of(list), from, ends);
}

Aim PatchAims::along(std::uint32_t l, const Link& link, const LatticeBox& from, const LatticeVector& direction) {
  forget();
  List& list = lists_[l];
  if (!usable(from) || list.count == kTooLong) return intersector_->aim_along(from, direction, link);
  if (list.count == kNotYet) keep(list, intersector_->aim_along(patch_, direction, link));
  if (list.count == kTooLong) return intersector_->aim_along(from, direction, link);
  return intersector_->aim_along_among(facets_of(list), from, direction);
}

}  // namespace shodo
