// Scenes as text: polygons, lights and cameras by their corners, each through a map (turned, mirrored, moved, scaled),
// in the order of the calls or shuffled.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/vector.h"

namespace shodo::hard {

using Map = std::function<Vec3(const Vec3&)>;

/// About an axis through the origin; 0.1 about (1, 2, 3) is the turn of the table.
Map turn(const Vec3& axis, double angle);

class SceneText {
 public:
  /// `mirrored`: the map exchanges left and right, so corners run the other way round.
  explicit SceneText(Map map = {}, bool mirrored = false);
  /// For what follows.
  void through(Map map, bool mirrored) {
    map_ = std::move(map);
    mirrored_ = mirrored;
  }

  void line(const std::string& text) { head_ += text + "\n"; }
  void material(const std::string& name, double reflectance);
  /// What follows belongs to it. `flags` as in the file.
  void object(const std::string& name, const std::string& flags = "");

  /// `patches` along a-b and b-c, `sub` both ways. Returns the mesh's key: its number in the order of the calls.
  std::uint32_t quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int nu = 1, int nv = 1, int sub = 1);
  std::uint32_t triangle(const Vec3& a, const Vec3& b, const Vec3& c, int n = 1, int sub = 1);
  /// Six quads, n x n patches each, fronts inwards or outwards: z low, z high, y low, y high, x low, x high.
  void room(const Vec3& low, const Vec3& high, int n = 1, int sub = 1) { sides(low, high, n, sub, true); }
  void box(const Vec3& low, const Vec3& high, int n = 1, int sub = 1) { sides(low, high, n, sub, false); }
  /// All that follows is of this material.
  void use(const std::string& material) { material_ = material; }

  /// Lights are named by number.
  void point_light(const Vec3& at, double intensity);
  void sun(const Vec3& towards, double illuminance);
  void area_light(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double luminance, bool open = false);
  void polyhedron(const std::string& object, double luminance);
  void camera(const std::string& name, const Vec3& eye, const Vec3& look, const Vec3& up, double fov);

  /// The file. With `shuffle` objects, and the polygons in each, stand in another order.
  std::string text(std::uint64_t shuffle = 0);
  /// After text(): the keys of its meshes, in the file's order.
  const std::vector<std::uint32_t>& keys() const { return keys_; }
  /// By key: whether a quad's patches run along its mirrored edges, v first.
  const std::vector<bool>& exchanged() const { return exchanged_; }

  Vec3 at(const Vec3& p) const { return map_ ? map_(p) : p; }
  std::string point(const Vec3& p) const;
  /// A direction through the map.
  std::string direction(const Vec3& d) const;

 private:
  struct Face {
    std::string line;
    std::uint32_t key;
  };
  struct Block {
    std::string line;
    std::vector<Face> faces;
  };
  void sides(const Vec3& low, const Vec3& high, int n, int sub, bool inwards);
  std::uint32_t add(const std::string& line);

  Map map_;
  bool mirrored_;
  std::string head_, tail_, material_ = "white";
  std::vector<Block> objects_;
  std::vector<std::uint32_t> keys_;
  std::vector<bool> exchanged_;
  std::uint32_t faces_ = 0;
  int lights_ = 0;
};

/// A room of 1/3 x 2/3 x 1 with a lamp, moved by (far, -far, far): not exact, its corners are rounded.
std::string bare_room_moved(double far);

/// A cube of 1 whose wall x = 1 has strips of 1 x `width` at its foot, the meshes from 5 on. With `uncut` one quad
/// stands for them all.
void cube_with_strips(SceneText& scene, int strips, double width, bool uncut = false);

/// Exact: as many digits as it takes.
std::string number(double x);

}  // namespace shodo::hard
