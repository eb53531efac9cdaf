#include "visibility/flags.h"

namespace shodo {

bool FlagTables::fill(const Scene& scene, bool given, Arena& arena) {
  const std::uint32_t objects = static_cast<std::uint32_t>(scene.objects.size());
  if (!arena.take("flags", 2 * (objects + scene.lights.size()), flags_)) return false;
  for (std::uint8_t& flags : flags_) flags = kBlocks | kTowards | kLeaving;
  if (!given) return true;
  // The faces of a polyhedral light are an object's: what the one statement doesn't give, the other may.
  for (std::uint32_t o = 0; o < objects; ++o) {
    const Object& object = scene.objects[o];
    const bool shines = object.light != kNone;
    take_given(o, LightSet::kDirect, object.direct, shines ? scene.lights[object.light].direct : GivenFlags{});
    take_given(o, LightSet::kAmbient, object.ambient, shines ? scene.lights[object.light].ambient : GivenFlags{});
  }
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    const bool polyhedral = light.kind == LightKind::kPolyhedron;
    take_given(objects + l, LightSet::kDirect, light.direct,
               polyhedral ? scene.objects[light.object].direct : GivenFlags{});
    take_given(objects + l, LightSet::kAmbient, light.ambient,
               polyhedral ? scene.objects[light.object].ambient : GivenFlags{});
  }
  return true;
}

std::uint64_t FlagTables::bytes(const Scene& scene) {
  return (2 * (scene.objects.size() + scene.lights.size()) + 7) / 8 * 8;
}

void FlagTables::take_given(std::uint32_t object, LightSet set, const GivenFlags& given, const GivenFlags& fallback) {
  const auto cleared = [](std::int8_t first, std::int8_t second) { return (first != 0 ? first : second) < 0; };
  std::uint8_t& flags = at(object, set);
  const auto clear = [&](std::uint8_t flag) { flags = static_cast<std::uint8_t>(flags & ~flag); };
  if (cleared(given.blocks, fallback.blocks)) clear(kBlocks);
  if (cleared(given.shadowed_towards, fallback.shadowed_towards)) clear(kTowards);
  if (cleared(given.shadowed_leaving, fallback.shadowed_leaving)) clear(kLeaving);
}

bool FlagTables::tested(const Link& link) const {
  if (link.from == kNone || link.to == kNone) return true;
  const bool there = shadowed_leaving(link.from, link.set) && shadowed_towards(link.to, link.set);
  if (link.set == LightSet::kDirect || there) return there;
  return shadowed_leaving(link.to, link.set) && shadowed_towards(link.from, link.set);
}

/// Between surfaces light goes both ways.
void FlagTables::note_blocked(const Link& link, std::uint32_t object) {
  const auto mark = [&](std::uint32_t o, std::uint8_t flag) {
    if (o != kNone) at(o, link.set) = static_cast<std::uint8_t>(at(o, link.set) | kFound * flag);
  };
  mark(object, kBlocks);
  mark(link.from, kLeaving);
  mark(link.to, kTowards);
  if (link.set == LightSet::kDirect) return;
  mark(link.from, kTowards);
  mark(link.to, kLeaving);
}

}  // namespace shodo
