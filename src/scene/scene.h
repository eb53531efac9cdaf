// The data model of a scene, as the paper has it: objects are surface models with a mesh structure, every surface a
// diffuse reflector; light sources are points, surfaces (area), polyhedra and suns (paper 2, 2.1).
//
// All coordinates are in scene units, relative to the centre of the scene's box (Scene::origin), so that a scene far
// from the origin loses no digits. Everything lies in the arena; names are copies, the scene's text may go after
// loading.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/features.h"
#include "base/vector.h"

namespace shodo {

inline constexpr std::uint32_t kNone = 0xffffffff;

struct Material {
  std::string_view name;  // empty: of a model
  Rgb diffuse;  // reflectance rho, 0 .. 0.9999
};

/// What a material does besides reflecting diffusely (doc/optics.md); only materials that do any of it have one.
struct Optics {
  std::uint32_t material = 0;
  Rgb reflect;                 // the mirror's part, on the front
  Rgb transmit;                // what goes straight through, both ways; above 0: a pane, which blocks nothing
  double highlight = 0;        // reflectance of the gloss at normal incidence
  double highlight_exponent = 1;

  bool mirrors() const { return reflect.c[0] > 0 || reflect.c[1] > 0 || reflect.c[2] > 0; }
  bool transmits() const { return transmit.c[0] > 0 || transmit.c[1] > 0 || transmit.c[2] > 0; }
};

/// What is seen where nothing stands: luminance by the direction's sine s above the horizon, cd/m2.
struct Background {
  Rgb zenith, horizon, ground;  // horizon + s^2 (zenith - horizon) above, ground below
  Vec3 up{0, 1, 0};             // unit
  // A picture far away, in the middle of the direction `towards`, upright against `up`: index of its texture.
  std::uint32_t picture = kNone;
  bool around = false;          // beside it its mirror image goes on, all round
  Vec3 towards{0, 0, -1};       // unit
  double width_degrees = 60;
  double luminance = 0;         // of its white, cd/m2
};

/// A pane that is drawn and nothing else: it mirrors, transmits and has highlights as its material does. No light knows
/// it, so what comes through it is given as it is after the glass.
struct Glass {
  std::uint32_t material = 0;
  Vec3 corners[4];              // front towards (c1-c0) x (c2-c0)
};

/// One of the two sets of flags of paper 3.1 as a scene file gives them: -1 cleared, +1 set, 0 not given.
struct GivenFlags {
  std::int8_t blocks = 0;
  std::int8_t shadowed_towards = 0;
  std::int8_t shadowed_leaving = 0;
};

struct Object {
  std::string_view name;
  std::uint32_t first_mesh = 0;
  std::uint32_t mesh_count = 0;
  std::uint32_t light = kNone;  // the polyhedral light whose faces these are
  GivenFlags direct, ambient;
};

enum class MeshKind : std::uint8_t { kQuad, kTriangle, kGrid };

/// A grid of patches on a quad, on a triangle or on a grid of vertices (scene/mesh.h has its geometry).
///
/// A quad is one cell, a grid (columns-1) x (rows-1); each cell carries patches_per_cell_u x _v patches. A triangle
/// divides each edge by `nu` (== nv) and has nu^2 patches. Sub-patches: su x sv a patch, a triangle su^2.
struct Mesh {
  features::FixedUnless<features::kMeshes, MeshKind, MeshKind::kQuad> kind = MeshKind::kQuad;
  /// Quad only: cut from corner 1 to corner 3 (else the fixed diagonal 0 to 2).
  features::FixedUnless<features::kMeshes, bool, false> concave = false;
  features::FixedUnless<features::kMeshes, bool, false> cut = false;      // quad: not convex, on the diagonal that
                                  // `concave` says; grid: some cell is so
  bool wraps_u = false;           // grid only: the last column of vertices is the first
  std::uint32_t object = 0;
  std::uint32_t material = 0;
  std::uint32_t first_vertex = 0; // quad 4, triangle 3, grid cells_u+1 by cells_v+1 row by row
  std::uint32_t cells_u = 1, cells_v = 1;
  std::uint32_t nu = 1, nv = 1;   // patches along u and v, of the whole mesh
  std::uint32_t su = 1, sv = 1;   // sub-patches a patch along u and v
  std::uint32_t first_patch = 0;      // index of its first patch among all patches of the scene
  std::uint32_t first_sub_patch = 0;  // and sub-patch

  std::uint32_t patch_count() const { return nu * nv; }
  std::uint32_t map_width() const { return nu * su; }    // sub-patches; also of a triangle's square
  std::uint32_t map_height() const { return nv * sv; }
  std::uint32_t sub_patch_count() const { return map_width() * map_height(); }
};

enum class LightKind : std::uint8_t { kPoint, kArea, kPolyhedron, kSun };

struct Light {
  std::string_view name;
  LightKind kind = LightKind::kPoint;
  bool aimed = false;            // point: I cos^n about `towards`
  bool open = false;             // area: an opening, blocks nothing
  std::uint32_t luminaire = kNone;  // point: its distribution is that one's
  double cosine_exponent = 0;    // n; with a luminaire that of a cos^n with its flux and its largest intensity
  double strength = 0;           // point: (largest) intensity, cd; area, polyhedron: luminance, cd/m2; sun:
                                 // illuminance, lx
  Rgb colour{{1, 1, 1}};
  double attenuation[3] = {0, 0, 1};  // C, L, Q: illuminance times d^2 / (C + L d + Q d^2), d in metres
  Vec3 position;                 // point: where; area and polyhedron: the light's centre
  Vec3 towards;                  // aimed point and sun: unit vector, the way the light goes
  Vec3 corners[4];               // area: front towards (c1-c0) x (c2-c0)
  std::uint32_t object = kNone;  // polyhedron: the object whose faces emit
  GivenFlags direct, ambient;
};

/// How the light of a point light goes out, as an IES file has it (scene/ies_file.h).
struct Luminaire {
  std::string_view path;           // relative to the top file's folder
  std::uint32_t light = 0;
  bool tilted = false;             // the file has a TILT, which isn't applied
  bool poles_differ = false;       // along the axis half-planes differed by more than 1 %: it is their mean
  Vec3 along, across;              // unit: where V is 90 and C is 0, and 90
  std::span<const float> vertical;    // angles V from the axis, degrees, ascending: 0 or 90 to 90 or 180
  // Angles C of half-planes, degrees, ascending: 0, 0 to 90, 180 or 360, or 90 to 270; others are their mirror images.
  std::span<const float> horizontal;
  std::span<const float> candela;     // [half-plane * vertical.size() + v]
  double lumens = 0;               // all of its light
};

/// A measuring plane: a plane convex quadrilateral that receives light on its front and does nothing else. It is no
/// mesh: it neither blocks nor reflects, it isn't drawn, and it is in no count of patches.
struct Plane {
  std::string_view name;
  Vec3 corners[4];                // front towards (c1-c0) x (c2-c0)
  std::uint32_t nu = 0, nv = 0;   // as of a quad
  std::uint32_t su = 0, sv = 0;
  std::uint32_t first_sub_patch = 0;  // among those of all planes

  std::uint32_t width() const { return nu * su; }  // sub-patches
  std::uint32_t height() const { return nv * sv; }
  std::uint32_t sub_patch_count() const { return width() * height(); }
};

struct Camera {
  std::string_view name;
  Vec3 eye, look, up;
  double fov_degrees = 60;  // vertical angle
};

/// A material's pattern (scene/texture.h).
struct Texture {
  std::string_view path;               // relative to the top file's folder
  std::uint32_t material = 0;          // kNone: the background's picture
  std::uint32_t width = 0, height = 0; // of the picture; 0 if no mesh has the material
  std::uint32_t channels = 1;          // 1 if it is grey
  double size_u = 0, size_v = 0;       // scene units it covers before it is repeated; 0: it covers each mesh once
  double mean[3] = {0, 0, 0};          // linear, of 65535
  std::uint8_t lightest[3] = {0, 0, 0};  // texel, 8-bit sRGB
  std::span<const std::uint8_t> texels;  // 8-bit sRGB, all levels of detail; only while a picture is drawn
};

/// A mesh whose material has a texture: its patches' reflectances.
struct TexturedMesh {
  std::uint32_t mesh = 0;
  std::uint32_t first = 0;         // of Scene::patch_reflectance
  float most[3] = {0, 0, 0};       // the largest of any patch, by channel
  std::uint32_t unused = 0;
};

struct Display {
  double min_cd_m2 = 1;
  double max_cd_m2 = 250;
  bool roll = false;  // brightness beyond half of the range is rolled off; else it is clipped at the maximum
};

struct Scene {
  double metres_per_unit = 1;
  Vec3 origin;              // scene units: what was subtracted from every coordinate
  Vec3 half_extent;         // of the box of geometry, planes, point lights and cameras
  Display display;
  bool effects = true;      // Options::effects; without, there are no textures, no background and no glass here
  std::uint32_t channels = 1;
  std::span<Material> materials;
  std::span<Object> objects;
  std::span<Mesh> meshes;   // an object's meshes stand together, objects ascending
  std::span<Vec3> vertices;
  std::span<Light> lights;  // as an object for flags: index objects.size() + light
  std::span<Luminaire> luminaires;   // of lights, ascending; mostly none
  std::span<Camera> cameras;
  std::span<Plane> planes;
  std::span<Optics> optics;          // ascending material; mostly none
  std::span<Background> background;  // one or none
  std::span<Glass> glass;            // mostly none
  std::span<Texture> textures;              // of materials, in their order
  std::span<std::uint16_t> texture_linear;  // of 256 levels of sRGB, 65535 is 1; empty without textures
  std::span<const TexturedMesh> textured;       // ascending (scene/patch_reflectance.h); empty without textures
  std::span<const float> patch_reflectance;     // of their patches, by channel
  std::uint32_t patch_count = 0;
  std::uint32_t sub_patch_count = 0;
  std::uint32_t plane_sub_patch_count = 0;
  std::uint32_t polygons_dropped = 0;  // faces without area that the file has

  /// Null: the material only reflects diffusely.
  const Optics* optics_of(std::uint32_t material) const {
    for (const Optics& found : optics) {
      if (found.material == material) return &found;
    }
    return nullptr;
  }
  bool transmits(std::uint32_t material) const {
    const Optics* const found = optics_of(material);
    return found != nullptr && found->transmits();
  }

  double largest_half_extent() const {
    const double xy = half_extent.x > half_extent.y ? half_extent.x : half_extent.y;
    return xy > half_extent.z ? xy : half_extent.z;
  }
};

}  // namespace shodo
