#include "hard/scene_text.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "visibility/scenes.h"

namespace shodo::hard {

namespace {

template <class T>
void shuffle_all(std::vector<T>& items, Random& random) {
  for (std::size_t k = items.size(); k > 1; --k)
    std::swap(items[k - 1], items[random.below(static_cast<std::uint32_t>(k))]);
}

}  // namespace

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

Map turn(const Vec3& axis, double angle) {
  return [=](const Vec3& v) { return turned(v, axis, angle); };
}

SceneText::SceneText(Map map, bool mirrored) : map_(std::move(map)), mirrored_(mirrored) { head_ = "shodo 1\n"; }

void SceneText::material(const std::string& name, double reflectance) {
  head_ += "material " + name + " diffuse " + number(reflectance) + "\n";
}

void SceneText::object(const std::string& name, const std::string& flags) {
  objects_.push_back({"object " + name + (flags.empty() ? "" : " " + flags), {}});
}

std::string SceneText::point(const Vec3& p) const {
  const Vec3 q = at(p);
  return " " + number(q.x) + " " + number(q.y) + " " + number(q.z);
}

std::string SceneText::direction(const Vec3& d) const {
  const Vec3 q = at(d) - at({0, 0, 0});
  return " " + number(q.x) + " " + number(q.y) + " " + number(q.z);
}

std::uint32_t SceneText::add(const std::string& line) {
  objects_.back().faces.push_back({line, faces_});
  exchanged_.push_back(mirrored_);
  return faces_++;
}

std::uint32_t SceneText::quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int nu, int nv, int sub) {
  const std::string counts = " sub " + std::to_string(sub) + " " + std::to_string(sub);
  if (mirrored_) {
    return add("quad " + material_ + point(a) + point(d) + point(c) + point(b) + " patches " + std::to_string(nv) +
               " " + std::to_string(nu) + counts);
  }
  return add("quad " + material_ + point(a) + point(b) + point(c) + point(d) + " patches " + std::to_string(nu) + " " +
             std::to_string(nv) + counts);
}

std::uint32_t SceneText::triangle(const Vec3& a, const Vec3& b, const Vec3& c, int n, int sub) {
  return add("tri " + material_ + point(a) + point(mirrored_ ? c : b) + point(mirrored_ ? b : c) + " patches " +
             std::to_string(n) + " sub " + std::to_string(sub));
}

void SceneText::sides(const Vec3& a, const Vec3& b, int n, int sub, bool inwards) {
  const Vec3 v[8] = {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z},
                     {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}};
  // Fronts inwards.
  const int face[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {3, 2, 6, 7}, {0, 3, 7, 4}, {1, 5, 6, 2}};
  for (const auto& f : face) {
    if (inwards) {
      quad(v[f[0]], v[f[1]], v[f[2]], v[f[3]], n, n, sub);
    } else {
      quad(v[f[0]], v[f[3]], v[f[2]], v[f[1]], n, n, sub);
    }
  }
}

void SceneText::point_light(const Vec3& at, double intensity) {
  tail_ += "light l" + std::to_string(lights_++) + " point at" + point(at) + " intensity " + number(intensity) + "\n";
}

void SceneText::sun(const Vec3& towards, double illuminance) {
  tail_ += "light l" + std::to_string(lights_++) + " sun towards" + direction(towards) + " illuminance " +
           number(illuminance) + "\n";
}

void SceneText::area_light(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double luminance, bool open) {
  tail_ += "light l" + std::to_string(lights_++) + " area quad" + point(a) + point(mirrored_ ? d : b) + point(c) +
           point(mirrored_ ? b : d) + " luminance " + number(luminance) + (open ? " open" : "") + "\n";
}

void SceneText::polyhedron(const std::string& object, double luminance) {
  tail_ +=
      "light l" + std::to_string(lights_++) + " polyhedron object " + object + " luminance " + number(luminance) + "\n";
}

void SceneText::camera(const std::string& name, const Vec3& eye, const Vec3& look, const Vec3& up, double fov) {
  tail_ += "camera " + name + " eye" + point(eye) + " look" + point(look) + " up" + direction(up) + " fov " +
           number(fov) + "\n";
}

std::string SceneText::text(std::uint64_t shuffle) {
  std::vector<Block> objects = objects_;
  if (shuffle != 0) {
    Random random(shuffle);
    shuffle_all(objects, random);
    for (Block& object : objects) shuffle_all(object.faces, random);
  }
  std::string all = head_;
  keys_.clear();
  for (const Block& object : objects) {
    all += object.line + "\n";
    for (const Face& face : object.faces) {
      all += face.line + "\n";
      keys_.push_back(face.key);
    }
  }
  return all + tail_;
}

std::string bare_room_moved(double far) {
  SceneText scene([=](const Vec3& v) { return (1.0 / 3) * v + Vec3{far, -far, far}; });
  scene.material("white", 0.7);
  scene.object("room");
  scene.room({0, 0, 0}, {1, 2, 3}, 3, 2);
  scene.point_light({0.5, 0.25, 2.5}, 100);
  return scene.text();
}

void cube_with_strips(SceneText& scene, int strips, double width, bool uncut) {
  scene.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 3, 3);
  scene.quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, 3, 3);
  scene.quad({0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, 3, 3);
  scene.quad({0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, 3, 3);
  scene.quad({0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, 3, 3);
  const double top = strips * width;
  for (int k = 0; k < (uncut ? 1 : strips); ++k) {
    const double z0 = uncut ? 0 : k * width, z1 = uncut ? top : (k + 1) * width;
    scene.quad({1, 0, z0}, {1, 0, z1}, {1, 1, z1}, {1, 1, z0});
  }
  scene.quad({1, 0, top}, {1, 0, 1}, {1, 1, 1}, {1, 1, top}, 3, 3);
}

}  // namespace shodo::hard
