#include "scene/finish.h"

#include "scene/mesh.h"

namespace shodo {

namespace {

struct Box {
  Vec3 low, high;
  bool empty = true;

  void add(const Vec3& p) {
    if (empty) low = high = p;
    empty = false;
    if (p.x < low.x) low.x = p.x;
    if (p.y < low.y) low.y = p.y;
    if (p.z < low.z) low.z = p.z;
    if (p.x > high.x) high.x = p.x;
    if (p.y > high.y) high.y = p.y;
    if (p.z > high.z) high.z = p.z;
  }

  Vec3 centred(const Vec3& p) const { return 0.5 * ((p - low) + (p - high)); }
};

std::uint32_t corner_count(const Light& light) { return light.kind == LightKind::kArea ? 4 : 0; }

Box box_of(const Scene& scene) {
  Box box;
  for (const Vec3& vertex : scene.vertices) box.add(vertex);
  for (const Light& light : scene.lights) {
    if (light.kind == LightKind::kPoint) box.add(light.position);
    for (std::uint32_t k = 0; k < corner_count(light); ++k) box.add(light.corners[k]);
  }
  for (const Camera& camera : scene.cameras) box.add(camera.eye);
  for (const Plane& plane : scene.planes) {
    for (const Vec3& corner : plane.corners) box.add(corner);
  }
  for (const Glass& glass : scene.glass) {
    for (const Vec3& corner : glass.corners) box.add(corner);
  }
  return box;
}

/// Sums area times centre over triangles.
struct Centroid {
  Vec3 weighted;
  double area = 0;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double twice = length(cross(b - a, c - a));
    weighted = weighted + (twice / 3) * (a + b + c);
    area += twice;
  }
  void add(const Piece& piece) {
    const std::uint32_t k = piece.concave ? 1 : 0;
    add(piece.corner[k], piece.corner[k + 1], piece.corner[k + 2]);
    add(piece.corner[k], piece.corner[k + 2], piece.corner[(k + 3) % 4]);
  }
  /// The zero vector if there was no area.
  Vec3 point() const { return area > 0 ? (1 / area) * weighted : weighted; }
};

}  // namespace

void centre_scene(Scene& scene) {
  const Box box = box_of(scene);
  scene.origin = 0.5 * box.low + 0.5 * box.high;
  scene.half_extent = 0.5 * (box.high - box.low);
  for (Vec3& vertex : scene.vertices) vertex = box.centred(vertex);
  for (Light& light : scene.lights) {
    if (light.kind == LightKind::kPoint) light.position = box.centred(light.position);
    for (std::uint32_t k = 0; k < corner_count(light); ++k) light.corners[k] = box.centred(light.corners[k]);
  }
  for (Camera& camera : scene.cameras) {
    camera.eye = box.centred(camera.eye);
    camera.look = box.centred(camera.look);
  }
  for (Plane& plane : scene.planes) {
    for (Vec3& corner : plane.corners) corner = box.centred(corner);
  }
  for (Glass& glass : scene.glass) {
    for (Vec3& corner : glass.corners) corner = box.centred(corner);
  }
}

void place_lights(Scene& scene) {
  for (Light& light : scene.lights) {
    Centroid centre;
    if (light.kind == LightKind::kArea) {
      Piece piece;
      for (std::uint32_t k = 0; k < 4; ++k) piece.corner[k] = light.corners[k];
      centre.add(piece);
    } else if (light.kind == LightKind::kPolyhedron) {
      const Object& object = scene.objects[light.object];
      for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
        const Mesh& mesh = scene.meshes[m];
        for (std::uint32_t cell = 0; cell < cell_count(mesh); ++cell) centre.add(cell_piece(scene, mesh, cell));
      }
    } else {
      continue;
    }
    light.position = centre.point();
  }
}

void decide_channels(Scene& scene) {
  scene.channels = 1;
  for (const Material& material : scene.materials) {
    if (!material.diffuse.grey()) scene.channels = 3;
  }
  for (const Texture& texture : scene.textures) {
    if (texture.channels != 1) scene.channels = 3;
  }
  for (const Light& light : scene.lights) {
    if (!light.colour.grey()) scene.channels = 3;
  }
  for (const Optics& optics : scene.optics) {
    if (!optics.reflect.grey() || !optics.transmit.grey()) scene.channels = 3;
  }
  for (const Background& seen : scene.background) {
    if (!seen.zenith.grey() || !seen.horizon.grey() || !seen.ground.grey()) scene.channels = 3;
  }
}

}  // namespace shodo
