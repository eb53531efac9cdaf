// For tests of the gather: scenes that are solved, and gathered for.
#pragma once

#include "ambient/gather.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {

/// A solved scene, its patches' light spread evenly over their sub-patches, and what those gather.
struct Gathered {
  using TakesNoPart = std::function<bool(const AmbientScene&, std::size_t patch)>;

  Gathered(const std::string& text, const Options& options, const std::function<double(const Vec3&, std::uint32_t)>& e0,
           const TakesNoPart& hidden_patch = {})
      : scene(text, options) {
    scene.light(e0);
    for (std::size_t k = 0; hidden_patch && k < scene.patches.size(); ++k) {
      if (hidden_patch(scene, k)) scene.visible[k] = 0;
    }
    EXPECT_TRUE(scene.solve().done());
    const Scene& s = scene.loaded.scene;
    direct.resize(s.sub_patch_count * s.channels);
    lx.resize(direct.size());
    hidden.resize(s.sub_patch_count);
    factors.resize(s.sub_patch_count);
    start();
    scene.direct.sub_patch_lx = direct;
    scene.direct.hidden = hidden;
    scene.direct.sub_patch_factor = factors;
    memory.resize(1 << 21);
  }

  /// Every sub-patch has what its patch has.
  void start() {
    const Scene& s = scene.loaded.scene;
    for (const Mesh& mesh : s.meshes) {
      for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
        const std::size_t patch = mesh.first_patch + patch_of_sub_patch(mesh, k);
        for (std::uint32_t c = 0; c < s.channels; ++c) {
          const std::size_t at = (mesh.first_sub_patch + k) * std::size_t{s.channels} + c;
          direct[at] = static_cast<float>(scene.lux[patch * s.channels + c]);
          lx[at] = static_cast<float>(scene.ambient.patch_lx[patch * s.channels + c]);
        }
      }
    }
  }

  Status gather(FlagMode flags = FlagMode::kAuto) {
    Arena arena(memory.data(), memory.size() * 8);
    Options options = scene.options;
    options.flags = flags;
    Intersector intersector(scene.geometry, scene.loaded.scene, flags);
    EXPECT_TRUE(intersector.take_flags(arena));
    const std::size_t before = arena.used();
    const Status status = gather_illuminance(scene.loaded.scene, scene.geometry, scene.patches, scene.direct,
                                             scene.ambient, intersector, options, {}, arena, lx, scene.statistics);
    EXPECT_EQ(arena.used(), before);
    const std::uint64_t bytes =
        gather_bytes(scene.loaded.scene, scene.geometry, options, SurfacesKeep::kGeometry);
    EXPECT_EQ(arena.peak(), before + bytes);
    return status;
  }

  AmbientScene scene;
  std::vector<float> direct, lx;
  std::vector<std::uint8_t> hidden;
  std::vector<std::uint16_t> factors;
  std::vector<std::uint64_t> memory;
};

inline std::string with_sub_patches(std::string text, const std::string& counts) {
  for (std::size_t at = text.find("sub 1 1"); at != std::string::npos; at = text.find("sub 1 1", at + 1)) {
    text.replace(at, 7, "sub " + counts);
  }
  return text;
}

inline Options precise() {
  Options options;
  options.tolerance = 1e-10;
  options.gather_error = 2e-4;
  return options;
}

inline std::string patchy(const std::string& material, std::initializer_list<double> c, int u, int v) {
  std::string line = "quad " + material;
  for (const double value : c) line += " " + std::to_string(value);
  return line + " patches " + std::to_string(u) + " " + std::to_string(v) + " sub 1 1\n";
}

}  // namespace shodo
