#include "ambient/ray_light.h"

#include "visibility/half_open.h"

namespace shodo {

/// Of the direction.
double RayLight::distance_to(const Triangle& triangle, const LatticePoint& from) const {
  return static_cast<double>(triangle.side(from)) / -static_cast<double>(dot(triangle.n, direction_));
}

/// By channel; none of an area light.
const std::uint16_t* RayLight::sent_at(std::uint32_t triangle, const LatticePoint& at) const {
  const SubPatchFinder::Found found = finder_.find(triangle, at);
  return found.mesh == kNone ? nullptr : sent_.of(scene_.meshes[found.mesh], found.sub_patch);
}

void RayLight::add_part(const double (&part)[3], std::uint32_t triangle, const LatticePoint& at,
                        std::uint64_t (&sum)[3]) const {
  const std::uint16_t* const sent = sent_at(triangle, at);
  for (std::uint32_t c = 0; c < scene_.channels && sent != nullptr; ++c) {
    sum[c] += static_cast<std::uint32_t>(part[c] * SentLight::unpacked(sent[c]));
  }
}

/// Multiplies by what panes before `end`, of the direction, let through.
void RayLight::weaken(const LatticePoint& from, double end, double (&part)[3]) const {
  for (const Pane& pane : geometry_.panes) {
    for (std::uint32_t t = pane.first; t < pane.first + pane.count; ++t) {
      const Triangle& triangle = geometry_.triangles[t];
      if (!passes(triangle, from, direction_) || !(distance_to(triangle, from) < end)) continue;
      for (std::uint32_t c = 0; c < scene_.channels; ++c) part[c] *= pane.transmit.c[c];
    }
  }
}

void RayLight::add_through_panes(const LatticePoint& from, const ParallelRays::First& first,
                                 std::uint64_t (&sum)[3]) const {
  const double end =
      first.triangle == kNone ? kInfinity : distance_to(geometry_.triangles[first.triangle], from);
  if (first.front) {
    double part[3] = {1, 1, 1};
    weaken(from, end, part);
    add_part(part, first.triangle, first.at, sum);
  }
  for (const Pane& pane : geometry_.panes) {
    for (std::uint32_t t = pane.first; t < pane.first + pane.count; ++t) {
      const Triangle& triangle = geometry_.triangles[t];
      if (!(triangle.side(from) > 0) || !passes(triangle, from, direction_)) continue;
      const double distance = distance_to(triangle, from);
      if (!(distance < end)) continue;
      double part[3] = {1, 1, 1};
      weaken(from, distance, part);
      const auto along = [&](std::int32_t at, std::int64_t way) {
        return static_cast<std::int32_t>(at + distance * static_cast<double>(way));
      };
      add_part(part, t, {along(from.x, direction_.x), along(from.y, direction_.y), along(from.z, direction_.z)}, sum);
    }
  }
}

void RayLight::add(const LatticePoint& from, std::uint64_t (&sum)[3]) const {
  const ParallelRays::First first = rays_.first(from);
  if (!geometry_.panes.empty()) return add_through_panes(from, first, sum);
  const std::uint16_t* const sent = first.front ? sent_at(first.triangle, first.at) : nullptr;
  for (std::uint32_t c = 0; c < scene_.channels && sent != nullptr; ++c) sum[c] += SentLight::unpacked(sent[c]);
}

}  // namespace shodo
