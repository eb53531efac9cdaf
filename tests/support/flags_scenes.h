// For tests of the flags: a scene from text, lit directly and ambiently with one mode of flags, and random scenes.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "light/direct.h"
#include "support/ambient_stage.h"
#include "support/scene_from_text.h"
#include "visibility/intersector.h"

namespace shodo {

/// All values of both stages, as bits.
struct LitBits {
  std::vector<std::uint32_t> sub_patch, area, factor;
  std::vector<std::uint64_t> patch, ambient;
  std::vector<std::uint8_t> hidden;
  std::vector<std::string> found;  // of every object and light: " direct +blocks -shadowed_towards ... ambient ..."
  Statistics statistics;

  bool operator==(const LitBits& other) const {
    return sub_patch == other.sub_patch && area == other.area && factor == other.factor && patch == other.patch &&
           ambient == other.ambient && hidden == other.hidden;
  }
};

inline std::string found_flags(const FlagTables& flags, std::uint32_t object) {
  std::string text;
  for (const LightSet set : {LightSet::kDirect, LightSet::kAmbient}) {
    const auto add = [&](bool is_set, const char* name) { text += (is_set ? " +" : " -") + std::string(name); };
    text += set == LightSet::kDirect ? " direct" : " ambient";
    add(flags.found_blocking(object, set), "blocks");
    add(flags.found_shadowed_towards(object, set), "shadowed_towards");
    add(flags.found_shadowed_leaving(object, set), "shadowed_leaving");
  }
  return text;
}

inline LitBits lit(const std::string& text, FlagMode mode, Options options = {}, TestFiles files = {}) {
  options.flags = mode;
  LitBits bits;
  LoadedScene loaded(text, options, std::move(files));
  if (!loaded.status.done()) return bits;
  Geometry geometry;
  std::span<Patch> patches;
  EXPECT_TRUE(place_scene(loaded.scene, loaded.arena, geometry).done());
  EXPECT_TRUE(build_patches(loaded.scene, geometry, loaded.arena, patches, bits.statistics).done());
  Intersector intersector(geometry, loaded.scene, mode);
  EXPECT_TRUE(intersector.take_flags(loaded.arena));
  DirectLight direct;
  AmbientLight ambient;
  Status status =
      light_directly(loaded.scene, geometry, patches, options, intersector, {}, loaded.arena, direct, bits.statistics);
  EXPECT_TRUE(status.done()) << to_text(status);
  status = light_ambiently(loaded.scene, geometry, patches, direct, intersector, options, {}, loaded.arena, ambient,
                           bits.statistics);
  EXPECT_TRUE(status.done()) << to_text(status);
  for (std::uint32_t o = 0; o < intersector.flags().size(); ++o) {
    bits.found.push_back(found_flags(intersector.flags(), o));
  }
  for (const float x : direct.sub_patch_lx) bits.sub_patch.push_back(std::bit_cast<std::uint32_t>(x));
  for (const float x : direct.visible_area) bits.area.push_back(std::bit_cast<std::uint32_t>(x));
  for (const float x : direct.light_form_factor) bits.factor.push_back(std::bit_cast<std::uint32_t>(x));
  for (const double x : direct.patch_lx) bits.patch.push_back(std::bit_cast<std::uint64_t>(x));
  for (const double x : ambient.patch_lx) bits.ambient.push_back(std::bit_cast<std::uint64_t>(x));
  bits.hidden.assign(direct.hidden.begin(), direct.hidden.end());
  return bits;
}

/// Off and auto must agree in every bit; both are handed back for what else a test asks of them.
struct Compared {
  LitBits off, on;
};
inline Compared expect_same(const std::string& text, const Options& options = {}, const TestFiles& files = {}) {
  Compared both{lit(text, FlagMode::kOff, options, files), lit(text, FlagMode::kAuto, options, files)};
  EXPECT_TRUE(both.off == both.on) << text.substr(0, 4000);
  return both;
}

/// The scene with `found` at its `object` and `light` lines, which end none of them in flags yet.
inline std::string with_flags(const std::string& text, const std::vector<std::string>& found) {
  std::istringstream lines(text);
  std::string result;
  std::size_t object_count = 0, object = 0, light = 0;
  for (std::size_t at = text.find("\nobject "); at != std::string::npos; at = text.find("\nobject ", at + 1)) {
    ++object_count;
  }
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("object ")) line += found[object++];
    if (line.starts_with("light ")) line += found[object_count + light++];
    result += line + "\n";
  }
  return result;
}

/// Statements of a scene, piece by piece; everything turned about (1, 2, 3) by `angle` if that isn't 0.
class SceneText {
 public:
  explicit SceneText(double angle = 0);

  void line(const std::string& text) { text_ << text << "\n"; }
  void object() { text_ << "object o" << objects_++ << "\n"; }
  /// Corners as written; `tail`: counts.
  void quad(const std::vector<Vec3>& corners, const std::string& tail, const char* keyword = "quad white");
  void grid(int columns, int rows, const std::vector<Vec3>& corners);
  /// The six faces, fronts outwards or, for a room, inwards; in the object that is open.
  void box(const Vec3& low, const Vec3& high, bool inwards, const std::string& tail);
  std::string at(const Vec3& point) const;
  std::string text() const { return text_.str(); }

 private:
  double angle_;
  int objects_ = 0;
  std::ostringstream text_;
};

/// A room of its own kind for every seed: turned or not, one object or many, a window or none, boxes that may stand
/// in each other, partitions, triangles, saddles, concave quads, folded grids, all kinds of light inside and outside.
std::string random_scene(std::uint32_t seed);

}  // namespace shodo
