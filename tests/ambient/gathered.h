// For tests of the gather: scenes that are lit and gathered for, and what contour integrals say of them.
#pragma once

#include <cmath>

#include "ambient/gather.h"
#include "ambient/sent_light.h"
#include "tests/ambient/ambient_scene.h"

namespace shodo {

/// A scene whose patches' light is spread evenly over their sub-patches, and what those gather.
struct Gathered {
  using Light = std::function<double(const Vec3&, std::uint32_t mesh)>;

  Gathered(const std::string& text, std::uint32_t lines, const Light& e0, TestFiles files = {})
      : scene(text, precise(lines), std::move(files)) {
    scene.light(e0);
    EXPECT_TRUE(scene.solve().done());
    const Scene& s = scene.loaded.scene;
    direct.resize(s.sub_patch_count * s.channels);
    lx.resize(direct.size());
    hidden.resize(s.sub_patch_count);
    start();
    scene.direct.sub_patch_lx = direct;
    scene.direct.hidden = hidden;
    memory.resize(1 << 20);
  }

  static Options precise(std::uint32_t lines) {
    Options options;
    options.tolerance = 1e-10;
    options.gather_lines = lines;
    return options;
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

  Status gather(FlagMode flags = FlagMode::kAuto, const Progress& progress = {}) {
    Arena arena(memory.data(), memory.size() * 8);
    Options options = scene.options;
    options.flags = flags;
    Intersector intersector(scene.geometry, scene.loaded.scene, flags);
    EXPECT_TRUE(intersector.take_flags(arena));
    const std::size_t before = arena.used();
    const std::uint32_t near = SentLight::uneven_count(scene.loaded.scene, scene.geometry.lattice.step());
    const Status status = gather_illuminance(scene.loaded.scene, scene.geometry, scene.direct, near, intersector,
                                             options, progress, arena, room(), lx, scene.statistics);
    EXPECT_EQ(arena.used(), before);
    return status;
  }

  /// Once for each gather, since values of patches may be lost.
  GatherRoom room() {
    patches_ambient = std::vector<double>(scene.ambient.patch_lx.size());
    patches_direct = patches_ambient;
    return {patches_ambient, patches_direct};
  }

  double gathered(std::uint32_t m, std::uint32_t local, std::uint32_t c = 0) const {
    const Scene& s = scene.loaded.scene;
    return static_cast<double>(lx[(s.meshes[m].first_sub_patch + local) * std::size_t{s.channels} + c]);
  }
  /// The mean over a mesh whose sub-patches are of one size.
  double mean(std::uint32_t m, std::uint32_t c = 0) const {
    const std::uint32_t count = scene.loaded.scene.meshes[m].sub_patch_count();
    double sum = 0;
    for (std::uint32_t k = 0; k < count; ++k) sum += gathered(m, k, c);
    return sum / count;
  }

  AmbientScene scene;
  std::vector<float> direct, lx;
  std::vector<double> patches_ambient, patches_direct;
  std::vector<std::uint8_t> hidden;
  std::vector<std::uint64_t> memory;
};

inline std::string black_and_white() { return grey(0.5) + "material black diffuse 0\n"; }

/// The material that a mesh's line names; meshes in the text's order.
inline std::string material_of(const AmbientScene& scene, std::uint32_t m) {
  const Scene& s = scene.loaded.scene;
  return std::string(s.materials[s.meshes[m].material].name);
}

inline std::string with_sub_patches(std::string text, const std::string& counts) {
  for (std::size_t at = text.find("sub 1 1"); at != std::string::npos; at = text.find("sub 1 1", at + 1)) {
    text.replace(at, 7, "sub " + counts);
  }
  return text;
}

inline std::string patchy(const std::string& material, std::initializer_list<double> c, int u, int v) {
  std::string line = "quad " + material;
  for (const double value : c) line += " " + std::to_string(value);
  return line + " patches " + std::to_string(u) + " " + std::to_string(v) + " sub 1 1\n";
}

/// A rectangle from a to b that faces along an axis: "+z", "-x" and so on.
inline std::string facing(const char* way, const std::string& material, const Vec3& a, const Vec3& b,
                          const std::string& rest = "patches 1 1 sub 1 1") {
  const int axis = way[1] - 'x', u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double low[3] = {a.x, a.y, a.z}, high[3] = {b.x, b.y, b.z};
  std::string line = "quad " + material;
  for (int k = 0; k < 4; ++k) {
    const int turn = way[0] == '+' ? k : (4 - k) % 4;
    double at[3] = {low[0], low[1], low[2]};
    if (turn == 1 || turn == 2) at[u] = high[u];
    if (turn == 2 || turn == 3) at[v] = high[v];
    for (const double value : at) line += " " + std::to_string(value);
  }
  return line + " " + rest + "\n";
}

/// Lambert 1760: what a polygon that stands in front of a point, and shows its front, fills of its cosine-weighted
/// hemisphere; 0 if it shows its back.
inline double filled(const Vec3& at, const Vec3& normal, const Piece& piece) {
  if (!(dot(piece.vector_area(), at - piece.centre()) > 0)) return 0;
  double sum = 0;
  for (std::uint32_t k = 0; k < piece.corners; ++k) {
    const Vec3 a = piece.corner[k] - at, b = piece.corner[(k + 1) % piece.corners] - at, n = cross(b, a);
    sum += std::atan2(length(n), dot(a, b)) * dot(normal, n) / length(n);
  }
  return sum / (2 * M_PI);
}

/// What a sub-patch should gather where nothing stands between: the mean over its points of sums over sub-patches.
/// All of them stand in front of it.
class Unhidden {
 public:
  /// `reflects`: rho of a sub-patch's patch, channel c.
  using Reflects = std::function<double(const Mesh& mesh, std::uint32_t patch, std::uint32_t c)>;

  explicit Unhidden(const Gathered& of, Reflects reflects = {}) : g(of), rho(std::move(reflects)) {}

  double operator()(std::uint32_t m, std::uint32_t local, std::uint32_t c = 0, std::uint32_t only = kNone) const {
    const Scene& s = g.scene.loaded.scene;
    const Piece own = sub_patch_piece(s, s.meshes[m], local);
    const Vec3 normal = normalised(own.vector_area());
    constexpr int kSide = 6;
    double sum = 0, weights = 0;
    for (int k = 0; k < kSide * kSide; ++k) {
      double x = (k % kSide + 0.5) / kSide, y = (k / kSide + 0.5) / kSide;
      if (own.corners == 3 && x + y > 1) x = 1 - x, y = 1 - y;
      const Vec3 at = own.point(x, y);
      for (std::uint32_t other = 0; other < s.meshes.size(); ++other) {
        if (other != m && (only == kNone || only == other)) sum += of_mesh(other, at, normal, c);
      }
      ++weights;
    }
    return sum / weights;
  }

 private:
  double of_mesh(std::uint32_t other, const Vec3& at, const Vec3& normal, std::uint32_t c) const {
    const Scene& s = g.scene.loaded.scene;
    const Mesh& mesh = s.meshes[other];
    double sum = 0;
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      const std::uint32_t patch = patch_of_sub_patch(mesh, k);
      const double reflected = rho ? rho(mesh, patch, c) : s.materials[mesh.material].diffuse.c[c];
      if (!(reflected > 0)) continue;
      const std::size_t value = (mesh.first_sub_patch + k) * std::size_t{s.channels} + c;
      sum += reflected * (static_cast<double>(g.direct[value]) + static_cast<double>(g.lx[value])) *
             filled(at, normal, sub_patch_piece(s, mesh, k));
    }
    return sum;
  }

  const Gathered& g;
  Reflects rho;
};

/// Differences, found less expected, of the largest expected value.
class Errors {
 public:
  void add(double found, double expected) {
    ++count_;
    square_ += (found - expected) * (found - expected);
    worst_ = std::max(worst_, std::abs(found - expected));
    most_ = std::max(most_, expected);
  }
  double rms() const { return std::sqrt(square_ / count_) / most_; }
  double worst() const { return worst_ / most_; }

 private:
  double count_ = 0, square_ = 0, worst_ = 0, most_ = 0;
};

}  // namespace shodo
