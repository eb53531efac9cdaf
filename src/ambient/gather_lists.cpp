#include "ambient/gather_lists.h"

namespace shodo {

namespace {

/// Samples lie in the box of the corners, grown by that along axes to which their mesh isn't square.
constexpr std::int32_t kRounding = 8;
constexpr std::uint32_t kShort = 16;  // a list so short isn't narrowed for parts

bool holds(const LatticeBox& whole, const LatticeBox& part) {
  for (int k = 0; k < 3; ++k) {
    if (part.low[k] < whole.low[k] || part.high[k] > whole.high[k]) return false;
  }
  return true;
}

void include_piece(const Scene& scene, const Geometry& geometry, std::uint32_t m, std::uint32_t cell,
                   const Piece& piece, LatticeBox& box) {
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    box.include(sample_point(scene, geometry, m, cell, piece.corner[k]));
  }
}

LatticeBox grown(LatticeBox box) {
  for (int k = 0; k < 3; ++k) {
    if (box.low[k] >= box.high[k]) continue;
    box.low[k] -= kRounding;
    box.high[k] += kRounding;
  }
  return box;
}

LatticeBox box_of_mesh(const Scene& scene, const Geometry& geometry, std::uint32_t m) {
  const Mesh& mesh = scene.meshes[m];
  LatticeBox box;
  for (std::uint32_t cell = 0; cell < cell_count(mesh); ++cell) {
    include_piece(scene, geometry, m, cell, cell_piece(scene, mesh, cell), box);
  }
  return grown(box);
}

}  // namespace

std::uint64_t GatherLists::bytes(const Scene& scene, const Geometry& geometry, FlagMode flags) {
  const std::uint64_t objects = scene.objects.size(), facets = Blockers::facet_count(geometry);
  return 2 * std::uint64_t{kListedFacets} + (4 * facets + 7) / 8 * 8 +
         objects * sizeof(LatticeBox) + 2 * ((objects * sizeof(List) + 7) / 8 * 8) +
         (flags == FlagMode::kOff ? Blockers::bytes(geometry) : 0);
}

Status GatherLists::take(Arena& arena, const Surfaces& surfaces) {
  surfaces_ = &surfaces;
  const Scene& scene = *surfaces.scene;
  const std::size_t objects = scene.objects.size();
  const bool taken = arena.take("blockers of patches", kListedFacets, words_) &&
                     arena.take("blockers of a node", Blockers::facet_count(*surfaces.geometry), pair_) &&
                     arena.take("boxes of objects", objects, object_box_) &&
                     arena.take("blockers of objects", objects, of_region_) &&
                     arena.take("blockers of objects", objects, of_group_);
  if (!taken || (!intersector_.seeking() && !own_.build(*surfaces.geometry, arena))) return arena.refused();
  for (LatticeBox& box : object_box_) box = {};
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    object_box_[scene.meshes[m].object].include(box_of_mesh(scene, *surfaces.geometry, m));
  }
  return {};
}

std::span<const Facet> GatherLists::facets() {
  return intersector_.seeking() ? intersector_.facets() : own_.facets();
}

void GatherLists::start_region(std::uint32_t place, std::uint32_t node) {
  const Surfaces& s = *surfaces_;
  const std::uint32_t m = s.mesh_at[place];
  if (s.is_block(node)) {
    LatticeBox box;
    include_piece(*s.scene, *s.geometry, m, 0, s.piece(node), box);
    region_box_ = grown(box);
  } else {
    region_box_ = box_of_mesh(*s.scene, *s.geometry, m);
  }
  link_ = {surfaces_->scene->meshes[m].object, kNone, LightSet::kAmbient};
  for (List& list : of_region_) list = {};
  region_used_ = 0;
}

void GatherLists::start_group(const LatticeBox& box) {
  group_box_ = box;
  inside_ = holds(region_box_, box);
  if (!inside_) region_box_.include(box);  // other groups' lists stay good: they are longer than need be
  for (List& list : of_group_) list = {};
  group_used_ = 0;
  if (inside_) return;
  for (List& list : of_region_) list = {};
  region_used_ = 0;
}

void GatherLists::start_object(std::uint32_t object) {
  object_ = object;
  link_.to = object;
  parts_ = 0;
}

/// Everything between the region and the object.
template <class Visit>
void GatherLists::visit_all(Visit visit) {
  if (!intersector_.seeking()) {
    own_.visit(Shaft(region_box_, object_box_[object_]), visit);
    return;
  }
  for (const std::uint32_t f : intersector_.aim(region_box_, object_box_[object_], link_).facets) visit(f);
}

void GatherLists::find_region_list() {
  List& list = of_region_[object_];
  list.first = region_used_;
  list.count = 0;
  bool fits = listable();
  visit_all([&](std::uint32_t f) {
    if (region_used_ + list.count >= kOfRegion) {
      fits = false;
    } else {
      words_[region_used_ + list.count++] = static_cast<std::uint16_t>(f);
    }
  });
  if (!fits) list.count = kTooLong;
  if (fits) region_used_ += list.count;
}

template <class Visit>
void GatherLists::visit_region_list(Visit visit) {
  if (of_region_[object_].count == kNotYet) find_region_list();
  const List& list = of_region_[object_];
  if (list.count == kTooLong) {
    visit_all(visit);
    return;
  }
  for (std::uint32_t k = 0; k < list.count; ++k) visit(words_[list.first + k]);
}

void GatherLists::find_group_list() {
  List& list = of_group_[object_];
  list.first = kOfRegion + group_used_;
  list.count = 0;
  bool fits = listable();
  LeanShaft shaft(group_box_, object_box_[object_]);
  const std::span<const Facet> all = facets();
  visit_region_list([&](std::uint32_t f) {
    if (shaft.misses(all[f].box)) return;
    if (group_used_ + list.count >= kOfGroup) {
      fits = false;
    } else {
      words_[list.first + list.count++] = static_cast<std::uint16_t>(f);
    }
  });
  if (!fits) list.count = kTooLong;
  if (fits) group_used_ += list.count;
}

template <class Visit>
void GatherLists::visit_group_list(Visit visit) {
  if (of_group_[object_].count == kNotYet) find_group_list();
  const List& list = of_group_[object_];
  if (list.count != kTooLong) {
    for (std::uint32_t k = 0; k < list.count; ++k) visit(words_[list.first + k]);
    return;
  }
  LeanShaft shaft(group_box_, object_box_[object_]);
  const std::span<const Facet> all = facets();
  visit_region_list([&](std::uint32_t f) {
    if (!shaft.misses(all[f].box)) visit(f);
  });
}

void GatherLists::split(const LatticeBox& box, std::uint32_t j, std::uint32_t end) {
  while (parts_ > 0 && j >= part_[parts_ - 1].end) --parts_;
  if (parts_ == kDeepest) return;
  if (of_group_[object_].count <= kShort) return;
  LeanShaft shaft(group_box_, box);
  const std::span<const Facet> all = facets();
  const std::uint32_t first = parts_ > 0 ? part_[parts_ - 1].first + part_[parts_ - 1].count : kOfRegion + kOfGroup;
  if (parts_ > 0) {
    const Part above = part_[parts_ - 1];
    if (above.count <= kShort || first + above.count > kListedFacets) return;
    std::uint32_t count = 0;
    for (std::uint32_t k = 0; k < above.count; ++k) {
      const std::uint16_t f = words_[above.first + k];
      if (!shaft.misses(all[f].box)) words_[first + count++] = f;
    }
    part_[parts_++] = {end, first, count};
    return;
  }
  std::uint32_t count = 0;
  bool fits = listable();
  visit_group_list([&](std::uint32_t f) {
    if (shaft.misses(all[f].box)) return;
    if (first + count == kListedFacets) {
      fits = false;
    } else {
      words_[first + count++] = static_cast<std::uint16_t>(f);
    }
  });
  if (fits) part_[parts_++] = {end, first, count};
}

double GatherLists::pass(const LatticePoint& p, const LatticePoint& q) {
  if (!intersector_.panes().any()) return 1;
  const std::uint32_t channels = surfaces_->scene->channels;
  double sum = 0;
  for (std::uint32_t c = 0; c < channels; ++c) {
    intersector_.set_channel(c);
    sum += intersector_.panes().pass(p, q);
  }
  intersector_.set_channel(0);
  return sum / channels;
}

bool GatherLists::clear(const LatticeBox& box, std::uint32_t j) {
  const bool nothing = narrow(box, j), panes = intersector_.panes().any();
  return nothing && !(panes && intersector_.panes().between(group_box_, box));
}

bool GatherLists::narrow(const LatticeBox& box, std::uint32_t j) {
  while (parts_ > 0 && j >= part_[parts_ - 1].end) --parts_;
  std::uint32_t count = 0;
  const auto keep = [&](const auto& each) {
    LeanShaft shaft(group_box_, box);
    const std::span<const Facet> all = facets();
    each([&](std::uint32_t f) {
      if (!shaft.misses(all[f].box)) pair_[count++] = f;
    });
  };
  if (parts_ > 0) {
    const Part part = part_[parts_ - 1];
    if (part.count > 0) {
      keep([&](auto visit) {
        for (std::uint32_t k = 0; k < part.count; ++k) visit(words_[part.first + k]);
      });
    }
  } else {
    if (of_group_[object_].count == kNotYet) find_group_list();
    if (of_group_[object_].count > 0) keep([&](auto visit) { visit_group_list(visit); });
  }
  aim_ = intersector_.seeking() ? Aim{pair_.first(count), false} : Aim{};
  return count == 0;
}

void GatherLists::aim(std::uint32_t j) {
  while (parts_ > 0 && j >= part_[parts_ - 1].end) --parts_;
  if (!intersector_.seeking()) {
    aim_ = {};
    return;
  }
  if (parts_ > 0) {
    const Part& part = part_[parts_ - 1];
    for (std::uint32_t k = 0; k < part.count; ++k) pair_[k] = words_[part.first + k];
    aim_ = {pair_.first(part.count), false};
    return;
  }
  std::uint32_t count = 0;
  visit_group_list([&](std::uint32_t f) { pair_[count++] = f; });
  aim_ = {pair_.first(count), false};
}

}  // namespace shodo
