// Loading takes exactly what it keeps, and whatever text is given it ends with a scene or a reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "scene/mesh.h"
#include "support/scene_from_text.h"

namespace shodo {
namespace {

/// Every statement there is, with everything that may follow it.
const std::string kEverything =
    "\xef\xbb\xbfshodo 1 # version\r\nunit cm\n"
    "display 1 250\ncamera main eye 0.6 1.5 0.6 look 5 1 3.2 up 0 1 0 fov 65\n"
    "include room.scn\nmaterial oak diffuse 0.45 0.30 1.8e-1\n"
    "object floor direct +blocks ambient -blocks -shadowed_towards -shadowed_leaving\n"
    "\tquad oak 0 0 0  0 0 4.5  6.5 0 4.5  6.5 0 0 patches 18 26 sub 2 2\n"
    "  quad oak 0 0 0  0 0 4.5  6.5 0 4.5  1 0 1\n  quad oak 0 1 0  0 1 1  1 1 1  1 1 1\n"
    "  tri plaster 0 0 0  0 0 1  1 0 0 patches 4 sub 2\n  tri plaster 0 0 0  1 1 1  2 2 2\n"
    "  grid plaster 3 2  0 0 0  1 0 0  2 0 0   0 0 1  1 0.2 1  2 0 1 sub 1 2\n"
    "sub floor 3 3\n"
    "light sun sun towards 0.5 -0.8 0.2 illuminance 60000 direct -blocks\n"
    "light sky area quad 0 1 1  0 2.2 1  0 2.2 3  0 1 3 luminance 3000 open\n"
    "light spot point at 1 2.4 1 towards 0 -1 0 intensity 300 cosine 3 colour 1 0.9 0.8 attenuation 1 0.5 0.25\n"
    "light lamp polyhedron object shade luminance 2500";
const TestFiles kRoom = {
    {"room.scn", "material plaster diffuse 0.75\nobject shade\ntri plaster 3 2 3  3 2 4  4 2 3\n"}};

Status load_in(std::size_t bytes, std::size_t before, Arena::Mark* used = nullptr) {
  // The memory ends where the arena does, so that a sanitizer sees every byte beyond.
  const std::unique_ptr<std::byte[]> memory(new std::byte[bytes]);
  Arena arena(memory.get(), bytes);
  std::span<std::byte> block;
  if (!arena.take("before", before, block)) return arena.refused();
  TestFiles files = kRoom;
  Scene scene;
  const Status status = load_scene("top.scn", kEverything, reader_of(files), {}, arena, scene);
  if (used != nullptr) *used = arena.used();
  if (!status.done()) {
    EXPECT_EQ(arena.used(), before);
  }
  return status;
}

TEST(SceneMemory, WorksWithExactlyWhatItNeedsAndSaysWhatThatIs) {
  Arena::Mark used = 0;
  ASSERT_TRUE(load_in(100000, 0, &used).done());
  // One quad is a triangle, and one triangle has no area.
  const std::size_t letters = std::strlen(
      "main"
      "plaster"
      "shade"
      "oak"
      "floor"
      "sun"
      "sky"
      "spot"
      "lamp");
  EXPECT_EQ(used, 2 * sizeof(Material) + 2 * sizeof(Object) + 6 * sizeof(Mesh) +
                      (3 + 4 + 4 + 3 + 3 + 6) * sizeof(Vec3) + 4 * sizeof(Light) + sizeof(Camera) +
                      (letters + 7) / 8 * 8);
  EXPECT_TRUE(load_in(used, 0).done());
  EXPECT_TRUE(load_in(used + 64, 64).done());
  for (std::size_t bytes = 0; bytes < used; bytes += 8) {
    const Status status = load_in(bytes, 0);
    ASSERT_EQ(status.code, StatusCode::kMemory) << bytes;
    ASSERT_EQ(status.bytes_needed, used) << bytes;
  }
  EXPECT_EQ(load_in(used + 56, 64).bytes_needed, used + 64);
}

// Hard case: a file that ends in the middle.
TEST(SceneMemory, AFileCutAnywhereIsASceneOrIsRefused) {
  std::size_t scenes = 0;
  for (std::size_t length = 0; length < kEverything.size(); ++length) {
    // A copy of its own, so that a sanitizer sees every read beyond its end.
    const std::vector<char> text(kEverything.begin(), kEverything.begin() + static_cast<std::ptrdiff_t>(length));
    const TestScene s({text.data(), text.size()}, {}, kRoom, 10000);
    if (s.status.done()) {
      ++scenes;
      continue;
    }
    // "include room.sc" names a file that isn't there.
    ASSERT_TRUE(s.status.code == StatusCode::kScene || s.status.code == StatusCode::kFile) << length;
    ASSERT_GT(s.status.line, 0u);
    ASSERT_GT(s.status.column, 0u);
    ASSERT_NE(s.status.message[0], '\0') << length;
  }
  EXPECT_GT(scenes, 20u);  // at least once after each line
  const TestScene whole(kEverything, {}, kRoom);
  EXPECT_TRUE(whole.status.done()) << to_text(whole.status);
}

TEST(SceneMemory, DamagedFilesAreScenesOrAreRefused) {
  std::mt19937_64 random(3);
  const std::string bytes = std::string("0123456789.+-eE #\n\r\t,xn_") + '\0' + "\xff";
  std::uint32_t scenes = 0;
  for (int n = 0; n < 20000; ++n) {
    std::string text = kEverything;
    for (std::uint64_t k = random() % 3 + 1; k > 0; --k) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = bytes[random() % bytes.size()];
          break;
        case 1:
          text.erase(at, random() % 20);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 40));
          break;
      }
    }
    const std::vector<char> exact(text.begin(), text.end());
    const TestScene s({exact.data(), exact.size()}, {}, kRoom, 20000);
    scenes += s.status.done() ? 1 : 0;
    if (!s.status.done()) {
      ASSERT_NE(s.status.message[0], '\0');
      continue;
    }
    // What was accepted must be sound.
    for (const Mesh& mesh : s.scene.meshes) {
      ASSERT_GE(mesh.patch_count(), 1u);
      ASSERT_LE(std::uint64_t{mesh.first_sub_patch} + mesh.sub_patch_count(), s.scene.sub_patch_count);
      ASSERT_LT(mesh.object, s.scene.objects.size());
      ASSERT_LT(mesh.material, s.scene.materials.size());
    }
    for (const Vec3& v : s.scene.vertices) ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
  }
  EXPECT_GT(scenes, 500u);
}

TEST(SceneMemory, TheTextMayGoAfterLoading) {
  auto text = std::make_unique<std::string>(kEverything);
  TestFiles files = kRoom;
  std::vector<std::byte> memory(100000);
  Arena arena(memory.data(), memory.size());
  Scene scene;
  ASSERT_TRUE(load_scene("top.scn", *text, reader_of(files), {}, arena, scene).done());
  std::fill(text->begin(), text->end(), 'X');
  files["room.scn"].assign(files["room.scn"].size(), 'X');
  EXPECT_EQ(scene.objects[0].name, "shade");
  EXPECT_EQ(scene.objects[1].name, "floor");
  EXPECT_EQ(scene.materials[1].name, "oak");
  EXPECT_EQ(scene.cameras[0].name, "main");
  EXPECT_EQ(scene.lights[3].name, "lamp");
}

TEST(SceneMemory, LoadingTwiceGivesTheSameBytes) {
  const LoadedScene a(kEverything, {}, kRoom), b(kEverything, {}, kRoom);
  ASSERT_EQ(a.arena.used(), b.arena.used());
  ASSERT_EQ(std::memcmp(a.scene.vertices.data(), b.scene.vertices.data(), a.scene.vertices.size_bytes()), 0);
  EXPECT_EQ(a.scene.sub_patch_count, b.scene.sub_patch_count);
  EXPECT_EQ(a.scene.origin, b.scene.origin);
}

// Hard case 32: objects in any order give the same objects.
TEST(SceneMemory, ObjectsInAnotherOrderAreTheSameObjects) {
  std::vector<std::string> parts = {
      "object a\nquad m 0.1 0 0  0.1 0 4.7  6.3 0 4.7  6.3 0 0\n", "object b\ntri m 1 1 1  1 1 2.3  2 1 1\n",
      "object c\ngrid m 2 3  0 0 0  1 0 0  0 0 1  1 0 1  0 1 2  1 1 2\n", "light l point at 3 0.7 2 intensity 1\n"};
  const auto load = [&] {
    std::string text = "shodo 1\nmaterial m diffuse 0.5\n";
    for (const std::string& part : parts) text += part;
    return std::make_unique<LoadedScene>(text);
  };
  const std::unique_ptr<LoadedScene> first = load();
  std::sort(parts.begin(), parts.end());
  do {
    const std::unique_ptr<LoadedScene> other = load();
    EXPECT_EQ(first->scene.origin, other->scene.origin);
    for (const Object& object : first->scene.objects) {
      const Object* same = nullptr;
      for (const Object& candidate : other->scene.objects) same = candidate.name == object.name ? &candidate : same;
      ASSERT_NE(same, nullptr);
      const Mesh &a = first->scene.meshes[object.first_mesh], &b = other->scene.meshes[same->first_mesh];
      ASSERT_TRUE(a.nu == b.nu && a.nv == b.nv && a.su == b.su && a.sv == b.sv);
      for (std::uint32_t p = 0; p < a.sub_patch_count(); ++p) {
        ASSERT_EQ(sub_patch_piece(first->scene, a, p).centre(), sub_patch_piece(other->scene, b, p).centre());
      }
    }
  } while (std::next_permutation(parts.begin(), parts.end()));
}

}  // namespace
}  // namespace shodo
