#include "scene/scene_store.h"

#include "base/text.h"

namespace shodo {

namespace {

// src/memory_plan.cpp tells them.
static_assert(sizeof(void*) != 8 || !features::kMeshes ||
              (sizeof(Material) == 40 && sizeof(Object) == 40 && sizeof(Mesh) == 48 && sizeof(Vec3) == 24 &&
               sizeof(Light) == 248 && sizeof(Camera) == 96 && sizeof(Plane) == 136 && sizeof(Luminaire) == 128));

/// Bytes of a block as the arena rounds them; more than an arena has if there are too many.
template <class T>
std::size_t block_bytes(std::uint64_t count) {
  if (count > (SIZE_MAX / 16) / sizeof(T)) return SIZE_MAX / 16;
  return (static_cast<std::size_t>(count) * sizeof(T) + 7) / 8 * 8;
}

template <class T>
bool take(Arena& arena, const char* name, std::uint64_t count, std::span<T>& block) {
  return arena.take(name, static_cast<std::size_t>(count), block);
}

}  // namespace

bool SceneStore::take_blocks(Arena& arena) {
  return take(arena, "materials", counts_.materials, scene_.materials) &&
         take(arena, "objects", counts_.objects, scene_.objects) &&
         take(arena, "meshes", counts_.meshes, scene_.meshes) &&
         take(arena, "vertices", counts_.vertices, scene_.vertices) &&
         take(arena, "lights", counts_.lights, scene_.lights) &&
         take(arena, "cameras", counts_.cameras, scene_.cameras) &&
         take(arena, "planes", counts_.planes, scene_.planes) &&
         take(arena, "optics", counts_.optics, scene_.optics) &&
         take(arena, "background", counts_.backgrounds, scene_.background) &&
         take(arena, "glass", counts_.glass, scene_.glass) &&
         take(arena, "textures", counts_.textures, scene_.textures) &&
         take(arena, "luminaires", counts_.luminaires, scene_.luminaires) &&
         take(arena, "names", counts_.name_bytes, names_);
}

bool SceneStore::begin_storing(Arena& arena, Status& status) {
  const Counts& c = counts_;
  const auto shapes = c.meshes + c.vertices + c.planes + c.glass;
  const auto named = c.materials + c.objects + c.textures + c.luminaires;
  if (shapes + named + c.lights + c.cameras >= kNone) {
    status.code = StatusCode::kScene;
    MessageText(status.message, sizeof status.message).add("expected fewer than 2^32 vertices, meshes and lights");
    return false;
  }
  const std::size_t bytes = block_bytes<Material>(counts_.materials) + block_bytes<Object>(counts_.objects) +
                            block_bytes<Mesh>(counts_.meshes) + block_bytes<Vec3>(counts_.vertices) +
                            block_bytes<Light>(counts_.lights) + block_bytes<Camera>(counts_.cameras) +
                            block_bytes<Plane>(counts_.planes) + block_bytes<Texture>(counts_.textures) +
                            block_bytes<Optics>(counts_.optics) + block_bytes<Background>(counts_.backgrounds) +
                            block_bytes<Glass>(counts_.glass) + block_bytes<Luminaire>(counts_.luminaires) +
                            block_bytes<char>(counts_.name_bytes);
  // One block of everything first: if it is refused, the arena tells the size that would do.
  const Arena::Mark mark = arena.mark();
  std::span<std::byte> everything;
  if (!arena.take("the scene", bytes, everything)) {
    status = arena.refused();
    return false;
  }
  arena.release(mark);
  if (!take_blocks(arena)) {
    status = arena.refused();
    arena.release(mark);
    return false;
  }
  counted_ = counts_;
  counts_ = {};
  storing_ = true;
  scene_.polygons_dropped = 0;
  return true;
}

std::string_view SceneStore::add_name(std::string_view name) {
  if (!storing_) {
    counts_.name_bytes += name.size();
    return name;
  }
  if (name.size() > names_.size() - counts_.name_bytes) {
    overflowed_ = true;
    return {};
  }
  const std::span<char> copy = names_.subspan(static_cast<std::size_t>(counts_.name_bytes), name.size());
  for (std::size_t k = 0; k < name.size(); ++k) copy[k] = name[k];
  counts_.name_bytes += name.size();
  return {copy.data(), copy.size()};
}

}  // namespace shodo
