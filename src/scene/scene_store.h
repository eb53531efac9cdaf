// Counts what a scene holds, and then puts it into the arena.
//
// A scene file is read twice: the first time everything is only counted, then all blocks are taken at their exact
// sizes, and the second time they are filled. So nothing is moved and nothing is left over. Bytes: 40 materials + 40
// objects + 48 meshes + 24 vertices + 248 lights + 96 cameras + 136 planes + 72 optics + 144 backgrounds + 104 glass +
// 96 textures + 128 luminaires + the lengths of names and of files' paths, each block rounded up to 8 (64-bit
// pointers). Names are looked up in file order, in the second reading only.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/arena.h"
#include "scene/scene.h"

namespace shodo {

class SceneStore {
 public:
  struct Counts {
    std::uint64_t materials = 0, objects = 0, meshes = 0, vertices = 0, lights = 0, cameras = 0, planes = 0;
    std::uint64_t optics = 0, backgrounds = 0, glass = 0, textures = 0, luminaires = 0, name_bytes = 0;
    bool operator==(const Counts&) const = default;
  };

  explicit SceneStore(Scene& scene) : scene_(scene) {}

  /// Takes the blocks for what was counted and starts again; false, and the reason in `status`, if they don't fit: then
  /// the arena is as before and bytes_needed the size at which all of them would.
  [[nodiscard]] bool begin_storing(Arena& arena, Status& status);
  bool storing() const { return storing_; }
  /// Back to the start of a reading that only counts.
  void begin_counting() { counts_ = {}, storing_ = false; }
  /// While storing: there was more than had been counted, so the files are no longer what they were.
  bool overflowed() const { return overflowed_; }
  /// After storing: everything that was counted has come.
  bool complete() const { return !overflowed_ && counts_ == counted_; }

  const Counts& counts() const { return counts_; }
  Scene& scene() { return scene_; }

  void add(const Material& material) { put(scene_.materials, counts_.materials, material); }
  void add(const Object& object) { put(scene_.objects, counts_.objects, object); }
  void add(const Mesh& mesh) { put(scene_.meshes, counts_.meshes, mesh); }
  void add(const Vec3& vertex) { put(scene_.vertices, counts_.vertices, vertex); }
  void add(const Light& light) { put(scene_.lights, counts_.lights, light); }
  void add(const Camera& camera) { put(scene_.cameras, counts_.cameras, camera); }
  void add(const Plane& plane) { put(scene_.planes, counts_.planes, plane); }
  void add(const Optics& optics) { put(scene_.optics, counts_.optics, optics); }
  void add(const Background& background) { put(scene_.background, counts_.backgrounds, background); }
  void add(const Glass& glass) { put(scene_.glass, counts_.glass, glass); }
  void add(const Luminaire& luminaire) { put(scene_.luminaires, counts_.luminaires, luminaire); }
  void add(const Texture& texture) { put(scene_.textures, counts_.textures, texture); }
  /// A copy in the arena; while counting the name itself.
  std::string_view add_name(std::string_view name);

  /// Indices of what has been stored so far, kNone if there is none; while counting always kNone.
  std::uint32_t find_material(std::string_view name) const { return find(scene_.materials, counts_.materials, name); }
  std::uint32_t find_object(std::string_view name) const { return find(scene_.objects, counts_.objects, name); }
  std::uint32_t find_light(std::string_view name) const { return find(scene_.lights, counts_.lights, name); }
  std::uint32_t find_camera(std::string_view name) const { return find(scene_.cameras, counts_.cameras, name); }
  std::uint32_t find_plane(std::string_view name) const { return find(scene_.planes, counts_.planes, name); }
  /// While storing; the zero vector beyond the block.
  Vec3 vertex(std::uint64_t index) const {
    return index < scene_.vertices.size() ? scene_.vertices[static_cast<std::size_t>(index)] : Vec3{};
  }

 private:
  template <class T>
  void put(std::span<T> block, std::uint64_t& count, const T& value) {
    if (storing_) {
      if (count >= block.size()) {
        overflowed_ = true;
        return;
      }
      block[static_cast<std::size_t>(count)] = value;
    }
    ++count;
  }

  template <class T>
  std::uint32_t find(std::span<T> block, std::uint64_t count, std::string_view name) const {
    if (!storing_) return kNone;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (block[k].name == name) return k;
    }
    return kNone;
  }

  bool take_blocks(Arena& arena);

  Scene& scene_;
  Counts counts_, counted_;
  std::span<char> names_;
  bool storing_ = false;
  bool overflowed_ = false;
};

}  // namespace shodo
