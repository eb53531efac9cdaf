#include "ambient/plane_gather.h"

#include "ambient/patch_shape.h"
#include "ambient/sample_set.h"
#include "base/interrupted.h"
#include "light/polygon_factor.h"
#include "light/receiver_group.h"
#include "scene/mesh.h"
#include "scene/patch_reflectance.h"

namespace shodo {

namespace {

/// A centre of a plane's sub-patch, and what it has gathered.
struct Point {
  Vec3 at;               // scene units
  std::uint32_t index;   // of PlaneMaps
};

struct Scratch {
  std::span<Point> point;
  std::span<LatticePoint> lattice;  // of point[k]
  std::span<double> lux;            // [k * channels + channel]
};

bool take(Arena& arena, std::uint32_t count, std::uint32_t channels, Scratch& scratch) {
  return arena.take("points of a plane's patch", count, scratch.point) &&
         arena.take("their lattice points", count, scratch.lattice) &&
         arena.take("what they gather", std::size_t{count} * channels, scratch.lux);
}

/// Points of a patch to which segments go.
struct SenderEnds {
  Vec3 at[kMostSamples];
  LatticePoint lattice[kMostSamples];
  LatticeBox box;
  std::uint32_t count = 0;
  bool panes = false;  // some may be between
};

/// A patch that sends.
struct Sender {
  const Mesh* mesh = nullptr;
  std::uint32_t mesh_index = 0, cell = 0;
  Patch patch;
  Piece piece;
  double sent[3] = {0, 0, 0};  // rho E, lx
};

class Gather {
 public:
  Gather(const SolvedPatches& solved, Intersector& intersector, PlaneMaps& maps)
      : solved_(solved), scene_(solved.scene), intersector_(intersector), maps_(maps) {}

  /// Patch (i, j) of a plane.
  void gather_patch(const Plane& plane, const Receiver& receiver, std::uint32_t i, std::uint32_t j, Scratch& scratch);

 private:
  bool start(const Plane& plane, const Receiver& receiver, std::uint32_t i, std::uint32_t j, Scratch& scratch);
  bool sender(std::uint32_t m, std::uint32_t local, Sender& s) const;
  void add(const Receiver& receiver, const Sender& s, Scratch& scratch);
  void place(const Sender& s, SenderEnds& ends) const;
  void see(const Receiver& receiver, const Sender& s, const Point& from, const LatticePoint& lattice,
           const SenderEnds& ends, const Aim& aim, double (&visible)[3]);
  Link link_of(const Sender& s) const { return {s.mesh->object, kNone, LightSet::kAmbient}; }

  const SolvedPatches& solved_;
  const Scene& scene_;
  Intersector& intersector_;
  PlaneMaps& maps_;
  LatticeBox box_;            // around the points
  std::uint32_t points_ = 0;  // not hidden
};

/// False if all points are hidden.
bool Gather::start(const Plane& plane, const Receiver& receiver, std::uint32_t i, std::uint32_t j, Scratch& scratch) {
  box_ = {};
  points_ = 0;
  for (std::uint32_t k = 0; k < plane.su * plane.sv; ++k) {
    const std::uint32_t local = (j * plane.sv + k / plane.su) * plane.width() + i * plane.su + k % plane.su;
    if (maps_.hidden[plane.first_sub_patch + local] != 0) continue;
    const Vec3 centre = plane_sub_patch(plane, local).centre();
    scratch.point[points_] = {centre, plane.first_sub_patch + local};
    scratch.lattice[points_] = sample_at(scene_, solved_.geometry, receiver, centre).lattice;
    box_.include(scratch.lattice[points_]);
    for (std::uint32_t c = 0; c < scene_.channels; ++c) scratch.lux[points_ * scene_.channels + c] = 0;
    ++points_;
  }
  return points_ > 0;
}

/// False if it sends nothing.
bool Gather::sender(std::uint32_t m, std::uint32_t local, Sender& s) const {
  s.mesh = &scene_.meshes[m];
  s.mesh_index = m;
  const std::uint32_t index = s.mesh->first_patch + local;
  if (!(solved_.direct.visible_area[index] > 0)) return false;
  bool any = false;
  double room[3];
  const double* const rho = MeshReflectance(scene_, m).of(local, room);
  for (std::uint32_t c = 0; c < scene_.channels; ++c) {
    const std::size_t at = std::size_t{index} * scene_.channels + c;
    s.sent[c] = rho[c] * (solved_.direct.patch_lx[at] + solved_.ambient.patch_lx[at]);
    any = any || s.sent[c] > 0;
  }
  if (!any) return false;
  s.patch = solved_.patches.empty() ? make_patch(scene_, solved_.geometry, m, local) : solved_.patches[index];
  s.piece = patch_piece(scene_, *s.mesh, local);
  s.cell = cell_of_patch(*s.mesh, local);
  return s.patch.dropped == 0;
}

void Gather::place(const Sender& s, SenderEnds& ends) const {
  const PatchShape shape = shape_of(s.piece);
  const double inset = s.patch.thin != 0 ? 0.5 : 1;
  for (const SamplePoint& sample : sample_points(SampleSet::kGrid, shape.outline == Outline::kTriangle)) {
    const double x = inset * sample.x, y = inset * sample.y;
    const Vec3 at = shape.outline == Outline::kConcave ? s.piece.point(0.5 + 0.5 * x, 0.5 + 0.5 * y)
                                                       : s.patch.centre + shape.offset(x, y);
    ends.at[ends.count] = at;
    ends.lattice[ends.count] = sample_point(scene_, solved_.geometry, s.mesh_index, s.cell, at);
    ends.box.include(ends.lattice[ends.count++]);
  }
}

/// Of the segments to the patch, by cos cos / r^2, and what panes let through of each channel; all alike if each end is
/// below a horizon.
void Gather::see(const Receiver& receiver, const Sender& s, const Point& from, const LatticePoint& lattice,
                 const SenderEnds& ends, const Aim& aim, double (&visible)[3]) {
  double all = 0, free[3] = {0, 0, 0}, ends_free[3] = {0, 0, 0};
  for (std::uint32_t k = 0; k < ends.count; ++k) {
    const Vec3 way = ends.at[k] - from.at;
    const double up = dot(receiver.normal, way), towards = -dot(s.patch.normal, way), squared = length_squared(way);
    const double weight = up > 0 && towards > 0 ? up * towards / (squared * squared) : 0;
    all += weight;
    if (!aim.clear() && intersector_.blocked(lattice, ends.lattice[k], link_of(s), aim)) continue;
    for (std::uint32_t c = 0; c < scene_.channels; ++c) {
      intersector_.set_channel(c);
      const double part = ends.panes ? intersector_.panes().pass(lattice, ends.lattice[k]) : 1;
      free[c] += weight * part;
      ends_free[c] += part;
    }
    intersector_.set_channel(0);
  }
  for (std::uint32_t c = 0; c < scene_.channels; ++c) visible[c] = all > 0 ? free[c] / all : ends_free[c] / ends.count;
}

void Gather::add(const Receiver& receiver, const Sender& s, Scratch& scratch) {
  SenderEnds ends;  // when the first point sees the patch
  Aim aim;
  for (std::uint32_t k = 0; k < points_; ++k) {
    const Point& point = scratch.point[k];
    const double factor = point_to_polygon(point.at, receiver.normal, s.piece.corner, s.piece.corners);
    if (!(factor > 0)) continue;
    if (ends.count == 0) {
      place(s, ends);
      ends.panes = intersector_.panes().any() && intersector_.panes().between(box_, ends.box);
      aim = intersector_.aim(box_, ends.box, link_of(s));
    }
    double visible[3] = {1, 1, 1};
    if (!aim.clear() || ends.panes) see(receiver, s, point, scratch.lattice[k], ends, aim, visible);
    for (std::uint32_t c = 0; c < scene_.channels; ++c) {
      scratch.lux[k * scene_.channels + c] += factor * visible[c] * s.sent[c];
    }
  }
}

void Gather::gather_patch(const Plane& plane, const Receiver& receiver, std::uint32_t i, std::uint32_t j,
                          Scratch& scratch) {
  if (!start(plane, receiver, i, j, scratch)) return;
  for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m) {
    for (std::uint32_t local = 0; local < scene_.meshes[m].patch_count(); ++local) {
      Sender s;
      if (sender(m, local, s)) add(receiver, s, scratch);
    }
  }
  for (std::uint32_t k = 0; k < points_ * scene_.channels; ++k) {
    maps_.ambient_lx[std::size_t{scratch.point[k / scene_.channels].index} * scene_.channels + k % scene_.channels] =
        static_cast<float>(scratch.lux[k]);
  }
}

std::uint32_t most_points(const Scene& scene) {
  std::uint32_t most = 0;
  for (const Plane& plane : scene.planes) most = plane.su * plane.sv > most ? plane.su * plane.sv : most;
  return most;
}

}  // namespace

Status gather_planes(const SolvedPatches& solved, Intersector& intersector, const Progress& progress, Arena& arena,
                     PlaneMaps& maps, Statistics& statistics) {
  const Scene& scene = solved.scene;
  const ArenaScratch arena_scratch(arena);
  const IntersectorScratch seeking(intersector);
  if (!intersector.start(arena)) return arena.refused();
  statistics.segments_planes -= intersector.segments(LightSet::kAmbient);
  statistics.tests_planes -= intersector.tests(LightSet::kAmbient);
  Scratch scratch;
  if (!take(arena, most_points(scene), scene.channels, scratch)) return arena.refused();
  Gather gather(solved, intersector, maps);
  for (const Plane& plane : scene.planes) {
    const PlaneReceiver receiver(solved.geometry, plane);
    for (std::uint32_t p = 0; p < plane.nu * plane.nv && receiver.there(); ++p) {
      const std::uint32_t done = scene.plane_sub_patch_count + plane.first_sub_patch + p * plane.su * plane.sv;
      if (!progress.go_on(Stage::kMap, done, 2 * scene.plane_sub_patch_count)) return interrupted();
      gather.gather_patch(plane, receiver.receiver(), p % plane.nu, p / plane.nu, scratch);
    }
  }
  statistics.segments_planes += intersector.segments(LightSet::kAmbient);
  statistics.tests_planes += intersector.tests(LightSet::kAmbient);
  return {};
}

std::uint64_t plane_gather_bytes(const Scene& scene) {
  const auto block = [](std::uint64_t bytes) { return (bytes + 7) / 8 * 8; };
  const std::uint64_t points = most_points(scene);
  return block(sizeof(Point) * points) + block(sizeof(LatticePoint) * points) + 8 * points * scene.channels;
}

}  // namespace shodo
