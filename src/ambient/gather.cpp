#include "ambient/gather.h"

#include "ambient/ray_light.h"
#include "ambient/ray_places.h"
#include "ambient/spiral.h"
#include "base/finite.h"
#include "base/interrupted.h"
#include "scene/sub_patches.h"

namespace shodo {

namespace {

constexpr std::uint32_t kMostTogether = 16;
constexpr std::uint32_t kPilotRays = 32;    // at most, and
constexpr std::uint32_t kPilotPart = 8;     // no more than this part of all
constexpr std::uint32_t kPilotPlaces = 4;
constexpr double kEvenly = 0.25;            // part of all other rays
constexpr double kMostOfMean = 16;          // rays, of those asked for
constexpr double kPerDirection = 1;         // what a direction costs, in rays
constexpr double kTurn = 0x1.a827999fcef34p-2;  // from patch to patch: sqrt(2) - 1
constexpr std::uint32_t kProgressInterval = 16;

/// By how much the spiral of a patch is turned.
double turn_of(std::uint32_t patch, bool pilot) {
  const double turn = (pilot ? 0.25 : 0.5) + patch * kTurn;
  return turn - static_cast<double>(static_cast<std::uint32_t>(turn));
}

/// A sub-patch that gathers.
struct Point {
  std::uint32_t sub_patch = 0;       // counted from the mesh's first
  RayPlaces places;
  std::uint64_t sum[3] = {0, 0, 0};  // of what its rays brought, in units of SentLight
};

static_assert(sizeof(Point) == 224);  // as src/memory_plan.cpp tells

struct Memory {
  SubPatchFinder finder;
  SentLight sent;
  std::span<Point> points;
  std::span<float> spread;  // per patch: standard deviation of the light from a direction, weighted
};

class Gather {
 public:
  Gather(const Scene& scene, const Geometry& geometry, const DirectLight& direct, std::uint32_t rays,
         Intersector& intersector, Memory& memory, std::span<float> ambient_lx)
      : scene_(scene), geometry_(geometry), direct_(direct), rays_(rays), intersector_(intersector), memory_(memory),
        ambient_lx_(ambient_lx), light_(scene, geometry, intersector, memory.finder, memory.sent) {}

  /// Both passes. False if the progress callback asked to stop.
  bool run(const Progress& progress);

 private:
  bool pass(const Progress& progress);
  void share_out();
  std::uint32_t pilot_rays() const {
    const std::uint32_t part = rays_ / kPilotPart;
    return part < kPilotRays ? part : kPilotRays;
  }
  std::uint32_t rays_of(std::uint32_t patch) const;
  [[gnu::noinline]] void patch(std::uint32_t local);
  bool place(const RayStarts& starts, std::uint32_t local, Point& point) const;
  void gather(std::uint32_t count);
  [[gnu::noinline]] void shoot(std::span<Point> points);
  void note_spread(std::uint32_t count, double all, double squares);
  void store(const Point& point);

  const Scene& scene_;
  const Geometry& geometry_;
  const DirectLight& direct_;
  std::uint32_t rays_;
  Intersector& intersector_;
  Memory& memory_;
  std::span<float> ambient_lx_;
  RayLight light_;
  double rays_of_all_ = 0, rays_per_spread_ = 0;
  bool pilot_ = true;
  std::uint32_t mesh_ = 0, patch_ = 0, rays_here_ = 0;  // at work; the patch counted from the mesh's first
};

/// False if it is hidden, or no place is seen.
bool Gather::place(const RayStarts& starts, std::uint32_t local, Point& point) const {
  if (!direct_.hidden.empty() && direct_.hidden[scene_.meshes[mesh_].first_sub_patch + local] != 0) return false;
  point = {};
  point.sub_patch = local;
  if (pilot_) starts.find(local, 0, kPilotPlaces, point.places);
  // A pilot that sees nothing takes the others' places: what has rays now had some in the pilot.
  if (point.places.count == 0) starts.find(local, kPilotPlaces, RayPlaces::kMost, point.places);
  return point.places.count > 0;
}

/// The points share their directions.
void Gather::shoot(std::span<Point> points) {
  const Mesh& mesh = scene_.meshes[mesh_];
  const Vec3 normal = normalised(patch_piece(scene_, mesh, patch_).vector_area());
  Spiral spiral(normal, rays_here_, turn_of(mesh.first_patch + patch_, pilot_));
  const Link link{mesh.object, kNone, LightSet::kAmbient};
  double all = 0, squares = 0;
  for (std::uint32_t k = 0; k < rays_here_; ++k) {
    const LatticeVector direction = spiral.next();
    LatticeBox box;
    for (const Point& point : points) box.include(point.places.of_ray(k));
    light_.aim(box, direction);
    const std::uint64_t tests = light_.tests();
    std::uint64_t before = 0, after = 0;
    for (Point& point : points) {
      before += point.sum[0] + point.sum[1] + point.sum[2];
      light_.add(point.places.of_ray(k), point.sum);
      after += point.sum[0] + point.sum[1] + point.sum[2];
      intersector_.count(link, tests, kNone);
    }
    if (!pilot_) continue;
    const double light = static_cast<double>(after - before);
    all += light;
    squares += light * light;
  }
  if (pilot_) note_spread(static_cast<std::uint32_t>(points.size()), all, squares);
}

/// Neyman's allocation (1934): the area-weighted variance of all means is least, for as many rays in all, if each has
/// rays in proportion to the square root of its area times its variance over its cost. The variance is that of the
/// points' mean; a direction costs as much for each of them as (count + 1) / count rays. Areas in steps of the lattice,
/// since a scene's own units may be any.
void Gather::note_spread(std::uint32_t count, double all, double squares) {
  const Mesh& mesh = scene_.meshes[mesh_];
  const double variance = (squares - all * all / rays_here_) / rays_here_;
  const double steps = geometry_.lattice.steps_per_unit;
  const double area = length(patch_piece(scene_, mesh, patch_).vector_area()) * steps * steps / (mesh.su * mesh.sv);
  const double weighted = area * variance / (count * (count + kPerDirection));
  const float spread = weighted > 0 ? static_cast<float>(square_root(weighted)) : 0.0f;
  float& most = memory_.spread[mesh.first_patch + patch_];
  if (spread > most) most = spread;
}

void Gather::store(const Point& point) {
  const std::size_t first = (std::size_t{scene_.meshes[mesh_].first_sub_patch} + point.sub_patch) * scene_.channels;
  const double over = memory_.sent.unit() / rays_here_;
  for (std::uint32_t c = 0; c < scene_.channels; ++c) {
    ambient_lx_[first + c] = static_cast<float>(finite(over * static_cast<double>(point.sum[c])));
  }
}

void Gather::gather(std::uint32_t count) {
  const std::span<Point> points = memory_.points.first(count);
  shoot(points);
  if (pilot_) return;
  const MeshReflectance reflectance(scene_, mesh_);
  for (const Point& point : points) {
    store(point);
    memory_.sent.set(reflectance, scene_.meshes[mesh_], point.sub_patch, ambient_lx_);
  }
}

void Gather::patch(std::uint32_t local) {
  patch_ = local;
  const Mesh& mesh = scene_.meshes[mesh_];
  const RayStarts starts(scene_, geometry_, intersector_, mesh_, cell_of_patch(mesh, local));
  SubPatchesOfPatch parts(mesh, local);
  std::uint32_t count = 0;
  for (std::uint32_t k = parts.next(); k != kNone; k = parts.next()) {
    if (place(starts, k, memory_.points[count])) ++count;
    if (count < kMostTogether) continue;
    gather(count);
    count = 0;
  }
  if (count > 0) gather(count);
}

std::uint32_t Gather::rays_of(std::uint32_t patch) const {
  const double rays = rays_of_all_ + rays_per_spread_ * static_cast<double>(memory_.spread[patch]);
  const double most = kMostOfMean * rays_;
  return rays < 1 ? 1 : static_cast<std::uint32_t>(rays < most ? rays : most);
}

/// So that a sub-patch has as many rays as were asked for on average. A part of them is shared out evenly: a pilot's
/// few rays can miss the little that is bright. Its light is not added to the others': where it missed that, it would
/// count for more among fewer, and means would be too low.
void Gather::share_out() {
  double spread = 0, parts = 0;
  for (const Mesh& mesh : scene_.meshes) {
    const double here = static_cast<double>(mesh.su) * mesh.sv;
    for (std::uint32_t k = 0; k < mesh.patch_count(); ++k) {
      spread += here * static_cast<double>(memory_.spread[mesh.first_patch + k]);
      parts += here;
    }
  }
  const double left = rays_ - pilot_rays();
  rays_of_all_ = spread > 0 ? kEvenly * left : left;
  rays_per_spread_ = spread > 0 ? (1 - kEvenly) * left * parts / spread : 0;
}

bool Gather::pass(const Progress& progress) {
  for (mesh_ = 0; mesh_ < scene_.meshes.size(); ++mesh_) {
    const Mesh& mesh = scene_.meshes[mesh_];
    for (std::uint32_t k = 0; k < mesh.patch_count(); ++k) {
      const std::uint32_t number = mesh.first_patch + k, done = (pilot_ ? 0 : scene_.patch_count) + number;
      if (number % kProgressInterval == 0 && !progress.go_on(Stage::kSolution, done, 2 * scene_.patch_count)) {
        return false;
      }
      if (!(direct_.visible_area[number] > 0)) continue;
      rays_here_ = pilot_ ? pilot_rays() : rays_of(number);
      if (rays_here_ > 0) patch(k);
    }
  }
  return true;
}

bool Gather::run(const Progress& progress) {
  if (!pass(progress)) return false;
  share_out();
  pilot_ = false;
  return pass(progress);
}

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

Status gather_illuminance(const Scene& scene, const Geometry& geometry, const DirectLight& direct,
                          Intersector& intersector, const Options& options, const Progress& progress, Arena& arena,
                          std::span<float> ambient_lx, Statistics& statistics) {
  const ArenaScratch release(arena);
  const IntersectorScratch seeking(intersector);
  Memory memory;
  if (!intersector.start(arena, Rectangles::kWhole) || !memory.finder.take(scene, geometry, arena) ||
      !memory.sent.take(scene, direct, ambient_lx, arena) ||
      !arena.take("sub-patches that gather", kMostTogether, memory.points) ||
      !arena.take("spread of light", scene.patch_count, memory.spread) || !intersector.take_masks(arena)) {
    return arena.refused();
  }
  const std::uint32_t asked = options.gather_rays > 0 ? options.gather_rays : kGatherRays;
  const std::uint32_t rays = asked < kMostGatherRays ? asked : kMostGatherRays;
  Gather gather(scene, geometry, direct, rays, intersector, memory, ambient_lx);
  if (!gather.run(progress)) return interrupted();
  statistics.segments_ambient = intersector.segments(LightSet::kAmbient);
  statistics.tests_ambient = intersector.tests(LightSet::kAmbient);
  return {};
}

std::uint64_t gather_bytes(const Scene& scene, const Geometry& geometry, const Options& options) {
  return Intersector::bytes(geometry, options.flags) + SubPatchFinder::bytes(geometry) + SentLight::bytes(scene) +
         block(sizeof(Point) * kMostTogether) + block(4 * std::uint64_t{scene.patch_count});
}

}  // namespace shodo
