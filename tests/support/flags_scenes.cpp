#include <cmath>

#include "support/flags_scenes.h"

namespace shodo {

SceneText::SceneText(double angle) : angle_(angle) {
  text_.precision(17);
  line("shodo 1");
  line("material white diffuse 0.7");
}

/// Rodrigues.
std::string SceneText::at(const Vec3& point) const {
  Vec3 p = point;
  if (angle_ != 0) {
    const Vec3 axis = normalised({1, 2, 3});
    p = std::cos(angle_) * point + std::sin(angle_) * cross(axis, point) +
        (1 - std::cos(angle_)) * dot(axis, point) * axis;
  }
  std::ostringstream text;
  text.precision(17);
  text << " " << p.x << " " << p.y << " " << p.z;
  return text.str();
}

void SceneText::quad(const std::vector<Vec3>& corners, const std::string& tail, const char* keyword) {
  text_ << keyword;
  for (const Vec3& corner : corners) text_ << at(corner);
  line(" " + tail);
}

void SceneText::grid(int columns, int rows, const std::vector<Vec3>& corners) {
  text_ << "grid white " << columns << " " << rows;
  for (const Vec3& corner : corners) text_ << at(corner);
  line("");
}

void SceneText::box(const Vec3& low, const Vec3& high, bool inwards, const std::string& tail) {
  const auto corner = [&](int k) {
    return Vec3{(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y, (k & 4) != 0 ? high.z : low.z};
  };
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {1, 3, 7, 5}, {0, 4, 6, 2}};
  for (const auto& f : faces) {
    if (inwards) {
      quad({corner(f[3]), corner(f[2]), corner(f[1]), corner(f[0])}, tail);
    } else {
      quad({corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])}, tail);
    }
  }
}

namespace {

class Maker {
 public:
  explicit Maker(std::uint32_t seed) : random_(seed), scene_(chance(0.5) ? 0 : 0.1 + 0.7 * unit()) {}

  std::string make() {
    one_object_ = chance(0.3);
    scene_.object();
    room();
    const int things = 2 + static_cast<int>(4 * unit());
    for (int k = 0; k < things; ++k) thing();
    lights();
    return scene_.text();
  }

 private:
  double unit() { return static_cast<double>(random_() >> 5) * 0x1p-27; }
  bool chance(double p) { return unit() < p; }
  /// Multiples of 0.25 often, so that things touch and are flush.
  double along(double low, double high) {
    const double x = low + (high - low) * unit();
    return chance(0.5) ? 0.25 * std::round(4 * x) : x;
  }
  Vec3 inside() { return {along(0.2, 3.8), along(0.2, 2.3), along(0.2, 2.8)}; }

  /// 4 x 2.5 x 3; the wall x = 0 may have an opening with a light in it, or none at all.
  void room() {
    const char* tail = "patches 2 2 sub 1 1";
    opening_ = chance(0.4);
    if (!opening_) {
      scene_.box({0, 0, 0}, {4, 2.5, 3}, true, tail);
      return;
    }
    const Vec3 v[8] = {{0, 0, 0}, {4, 0, 0}, {4, 2.5, 0}, {0, 2.5, 0}, {0, 0, 3}, {4, 0, 3}, {4, 2.5, 3}, {0, 2.5, 3}};
    scene_.quad({v[0], v[1], v[2], v[3]}, tail);
    scene_.quad({v[4], v[7], v[6], v[5]}, tail);
    scene_.quad({v[0], v[4], v[5], v[1]}, tail);
    scene_.quad({v[3], v[2], v[6], v[7]}, tail);
    scene_.quad({v[1], v[5], v[6], v[2]}, tail);
    // Below, above and on both sides of an opening from (0.75, 1) to (2, 2).
    wall(0, 0.75, 0, 3);
    wall(2, 2.5, 0, 3);
    wall(0.75, 2, 0, 1);
    wall(0.75, 2, 2, 3);
  }
  void wall(double y0, double y1, double z0, double z1) {
    scene_.quad({{0, y0, z0}, {0, y1, z0}, {0, y1, z1}, {0, y0, z1}}, "patches 1 1 sub 2 1");
  }

  void thing() {
    if (!one_object_) scene_.object();
    const Vec3 a = inside(), b = inside();
    const Vec3 low{std::fmin(a.x, b.x), chance(0.5) ? 0 : std::fmin(a.y, b.y), std::fmin(a.z, b.z)};
    const Vec3 size{0.1 + 0.8 * unit(), 0.1 + 0.8 * unit(), 0.1 + 0.8 * unit()};
    switch (random_() % 6) {
      case 0:
        return scene_.box(low, low + size, false, "patches 1 2 sub 2 1");
      case 1:  // a partition from wall to wall, both sides
        scene_.quad({{a.x, 0, 0}, {a.x, 2.5, 0}, {a.x, 2.5, a.z}, {a.x, 0, a.z}}, "patches 2 2 sub 1 1");
        return scene_.quad({{a.x, 0, 0}, {a.x, 0, a.z}, {a.x, 2.5, a.z}, {a.x, 2.5, 0}}, "patches 1 1 sub 2 2");
      case 2:
        return scene_.quad({a, b, inside()}, "patches 2 sub 2", "tri white");
      case 3:  // a saddle
        return scene_.quad(
            {low, low + Vec3{size.x, 0.03, 0}, low + Vec3{size.x, 0, size.z}, low + Vec3{0, 0.04, size.z}},
            "patches 2 2 sub 1 1");
      case 4:  // concave
        return scene_.quad(
            {low, low + Vec3{0.4 * size.x, 0, 0.4 * size.z}, low + Vec3{size.x, 0, 0}, low + Vec3{0, 0, size.z}},
            "patches 1 1 sub 2 2");
      default:  // folds that shadow each other
        return folds(low, size);
    }
  }
  void folds(const Vec3& low, const Vec3& size) {
    std::vector<Vec3> corners;
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 4; ++column) {
        corners.push_back(low + Vec3{column % 2 * 0.3 * size.x, row * size.y, 0.3 * column * size.z});
      }
    }
    scene_.grid(4, 2, corners);
  }

  void lights() {
    const std::string p = scene_.at(inside()), q = scene_.at({-1.5, 2, 1.5});
    if (chance(0.6)) scene_.line("light a point at" + p + " intensity 100");
    if (chance(0.4)) scene_.line("light b point at" + q + " intensity 900");  // outside
    if (opening_) {
      scene_.line("light c area quad" + scene_.at({0, 0.75, 1}) + scene_.at({0, 2, 1}) + scene_.at({0, 2, 2}) +
                  scene_.at({0, 0.75, 2}) + " luminance 500 open");
    }
    if (opening_ || chance(0.3)) {
      const Vec3 way{0.8, -0.5, 0.1 + 0.2 * unit()};
      scene_.line("light d sun towards" + scene_.at(way) + " illuminance 5000");
    }
    if (chance(0.5)) {
      scene_.line("light e area quad" + scene_.at({1, 2.4, 1}) + scene_.at({1.5, 2.4, 1}) + scene_.at({1.5, 2.4, 1.6}) +
                  scene_.at({1, 2.4, 1.6}) + " luminance 800");
    }
    if (!one_object_ && chance(0.5)) {
      scene_.object();
      scene_.line("# a lamp");
      const Vec3 low = inside();
      scene_.box(low, low + Vec3{0.2, 0.2, 0.2}, false, "patches 1 1 sub 1 1");
      scene_.line("light f polyhedron object o" + std::to_string(last_object()) + " luminance 1000");
    }
  }
  int last_object() const {
    const std::string text = scene_.text();
    const std::size_t at = text.rfind("object o");
    return std::stoi(text.substr(at + 8));
  }

  std::mt19937 random_;
  SceneText scene_;
  bool one_object_ = false, opening_ = false;
};

}  // namespace

std::string random_scene(std::uint32_t seed) { return Maker(seed).make(); }

}  // namespace shodo
