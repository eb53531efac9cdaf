// Sites within 2 lattice steps of each other in every coordinate become one.
//
// A corner that two polygons compute differently rounds to two places at most one even step apart; left alone they
// would leave a slit between polygons that ought to share an edge. Sites are taken in ascending order of position,
// vertices of the file first: each joins the earliest kept site that is near, else it is kept. So no site moves further
// than 2 steps, and kept ones are further apart than that. Nothing depends on the order of the file.
#include "visibility/mending.h"

namespace shodo {

namespace {

/// The first site of [first, end) that is not before (x, y, z); the sites are in ascending order.
std::uint32_t lower_bound(std::span<const LatticePoint> sites, std::uint32_t first, std::uint32_t end,
                          const LatticePoint& p) {
  while (first < end) {
    const std::uint32_t middle = first + (end - first) / 2;
    if (position_before(sites[middle], p)) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return first;
}

/// The earliest kept site of [first, end) within 2 steps of site s; kNone if there is none. `kept[k]` is k if k is
/// kept.
std::uint32_t near_kept(std::span<const LatticePoint> sites, std::span<const std::uint32_t> kept, std::uint32_t first,
                        std::uint32_t end, const LatticePoint& p) {
  // Coordinates are even: three columns of three lines of sites.
  for (std::int32_t x = p.x - 2; x <= p.x + 2; x += 2) {
    for (std::int32_t y = p.y - 2; y <= p.y + 2; y += 2) {
      std::uint32_t k = lower_bound(sites, first, end, {x, y, p.z - 2});
      for (; k < end && sites[k].x == x && sites[k].y == y && sites[k].z <= p.z + 2; ++k) {
        if (kept[k] == k) return k;
      }
    }
  }
  return kNone;
}

}  // namespace

bool weld_sites(Arena& arena, Placement& placement) {
  ArenaScratch scratch(arena);
  const std::uint32_t count = static_cast<std::uint32_t>(placement.sites.size());
  std::span<std::uint32_t> kept;
  if (!arena.take("welded sites", count, kept)) return false;
  for (std::uint32_t k = 0; k < count; ++k) {
    kept[k] = kNone;
    std::uint32_t found = near_kept(placement.sites, kept, 0, placement.vertex_sites, placement.sites[k]);
    if (found == kNone && k >= placement.vertex_sites) {
      found = near_kept(placement.sites, kept, placement.vertex_sites, count, placement.sites[k]);
    }
    kept[k] = found == kNone ? k : found;
    if (found != kNone && k < placement.vertex_sites) ++placement.moved;
  }
  // What is kept closes up; the order stays.
  std::uint32_t sites = 0, vertex_sites = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (kept[k] != k) {
      kept[k] = kept[kept[k]];
      continue;
    }
    placement.sites[sites] = placement.sites[k];
    kept[k] = sites++;
    if (k < placement.vertex_sites) vertex_sites = sites;
  }
  placement.sites = placement.sites.first(sites);
  placement.vertex_sites = vertex_sites;
  for (std::uint32_t& site : placement.site_of) {
    if (site < count) site = kept[site];  // a scene of lights alone has none
  }
  return true;
}

}  // namespace shodo
