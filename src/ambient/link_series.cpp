#include "ambient/link_series.h"

#include <bit>

namespace shodo {

namespace {

constexpr std::int32_t kOne = 1 << 14;
constexpr std::int32_t kThirdOf2To16 = 21845;
constexpr double kCurved = 0.1;  // times q^2: what ends right opposite each other vary all the same
constexpr double kRounding = 0x1p-12;  // of heights and ratios, relative to the kernel with both cosines 1
constexpr double kRoughly = 1.2;  // of close ends, what the disc lacks in the mean
constexpr double kMostTwist = 0.25;  // of the normal part of d, of the root of the area of a x b
constexpr std::int32_t kFlat = 8;   // heights that rounding may make

std::int32_t magnitude(std::int32_t x) { return x < 0 ? -x : x; }

std::int32_t rounded(double x) { return static_cast<std::int32_t>(x < 0 ? x - 0.5 : x + 0.5); }

void put(std::int32_t* to, const Vec3& v) {
  to[0] = rounded(v.x);
  to[1] = rounded(v.y);
  to[2] = rounded(v.z);
}

std::int32_t product(const std::int32_t* x, const std::int32_t* y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

std::int32_t rounded_up(std::int32_t x, int shift) { return (x + (1 << shift) - 1) >> shift; }

/// Half axis of `count` patches.
void stretch(const std::int32_t* axis, std::uint32_t count, std::int32_t* to) {
  const std::int32_t times = static_cast<std::int32_t>(count);
  for (int k = 0; k < 3; ++k) to[k] = (axis[k] * times) >> 4;
}

/// As many bits as the way from the centre to the farthest corner along any axis.
std::uint32_t reach_of(const std::int32_t* a, const std::int32_t* b, const MeshPlace& place) {
  const int by = place.kind == PlaceKind::kTriangle ? 1 : 0;
  std::uint32_t bits = 0;
  for (int k = 0; k < 3; ++k) {
    bits |= static_cast<std::uint32_t>(magnitude(a[k]) + magnitude(b[k]) + place.extra) << by;
  }
  return bits;
}

/// Everything of one end, shifted.
struct End {
  std::int32_t a[3], b[3];
  std::int32_t climb_a, climb_b;  // over the other's plane

  void shift(const std::int32_t* from_a, const std::int32_t* from_b, int by, const std::int32_t* other_normal) {
    for (int k = 0; k < 3; ++k) {
      a[k] = from_a[k] >> by;
      b[k] = from_b[k] >> by;
    }
    climb_a = product(other_normal, a) >> 14;
    climb_b = product(other_normal, b) >> 14;
  }
  /// How far the corners stand off the centre's height.
  std::int32_t extent(PlaceKind kind, std::int32_t extra) const {
    const std::int32_t sum = magnitude(climb_a) + magnitude(climb_b);
    return kind == PlaceKind::kTriangle ? 2 * sum : sum + extra;
  }
};

/// The two axes of one end: what they add to the kernel's mean, and its variation, both in 1/2^14.
struct Moments {
  std::int32_t mean = 0, vary = 0;

  void add(const std::int32_t* axis, std::int32_t climb, const std::int32_t* way, std::int32_t squared_13,
           std::int32_t height) {
    const std::int32_t u = ((product(way, axis) >> 13) * kOne) / squared_13;
    const std::int32_t climbs = magnitude(climb) <= height ? climb : climb < 0 ? -height : height;  // rounding
    const std::int32_t p = (climbs * kOne) / height;
    mean += ((u * (3 * u - p)) >> 14) * 4;
    const std::int32_t g = (p - 4 * u) >> 1;
    vary += (g * g) >> 12;
  }
};

/// Bit k: all samples of the mesh have the same coordinate along axis k. The cached ones may be one point: only across
/// the mesh do they speak for all.
std::uint8_t flat_axes(const Surfaces& s, std::uint32_t k) {
  LatticeBox box;
  for (std::uint32_t node = s.mesh_begin[k]; node < s.mesh_begin[k + 1]; ++node) {
    if (!(s.root_area[node] > 0)) continue;
    for (std::uint32_t p = 0; p < s.cached_points; ++p) box.include(s.samples(node)[p]);
  }
  const Vec3 normal = s.patch(s.mesh_begin[k]).normal;
  const double across[3] = {normal.x, normal.y, normal.z};
  std::uint32_t flat = 0;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    flat |= box.low[axis] == box.high[axis] && across[axis] * across[axis] > 0.5 ? 1u << axis : 0;
  }
  return static_cast<std::uint8_t>(flat);
}

/// Whether a mesh's nodes have places of their own.
bool differs(const Scene& scene, const Mesh& mesh) {
  return mesh.kind != MeshKind::kTriangle && (shape_count(scene, mesh) != 1 || mesh.kind == MeshKind::kGrid ||
                                              shape_of(cell_piece(scene, mesh, 0)).even == 0);
}

/// From the centre of a quadrilateral to its centroid.
Vec3 centroid_offset(const PatchShape& shape) {
  return (shape.alpha * (1.0 / 3)) * shape.a + (shape.beta * (1.0 / 3)) * shape.b;
}

MeshPlace place_mesh(const Surfaces& s, std::uint32_t k) {
  MeshPlace place;
  const std::uint32_t first = s.mesh_begin[k];
  const Mesh& mesh = s.scene->meshes[s.mesh_at[k]];
  const PatchShape shape = shape_of(patch_piece(*s.scene, mesh, 0));
  if (first == s.mesh_begin[k + 1]) return place;
  place.flat = flat_axes(s, k);
  const Vec3 normal = s.patch(first).normal;
  std::int32_t n[3];
  put(n, static_cast<double>(kOne) * normal);
  for (int c = 0; c < 3; ++c) place.normal[c] = s.planar[k] != 0 ? static_cast<std::int16_t>(n[c]) : std::int16_t{0};
  const bool triangle = mesh.kind == MeshKind::kTriangle;
  const bool parallelogram = !differs(*s.scene, mesh) && shape.outline == Outline::kQuad && shape.even != 0;
  if (!triangle && !parallelogram) return place;
  if (s.planar[k] == 0 || mesh.nu > 0xffff || mesh.nv > 0xffff) return place;
  place.kind = triangle ? PlaceKind::kTriangle : PlaceKind::kQuad;
  const double steps = 16 * s.geometry->lattice.steps_per_unit;
  put(place.a, triangle ? (steps / square_root(6)) * (shape.a - 0.5 * shape.b) : steps * shape.a);
  put(place.b, triangle ? (steps / square_root(8)) * shape.b : steps * shape.b);
  return place;
}

/// A quadrilateral node with half axes of its own; kOdd if it is concave or much twisted.
MeshPlace place_node(const Surfaces& s, std::uint32_t node) {
  MeshPlace place;
  const PatchShape& shape = s.shape(node);
  const Vec3 normal = s.patch(node).normal;
  if (shape.outline != Outline::kQuad) return place;
  const double twist = dot(normal, shape.d);
  if (twist * twist > kMostTwist * kMostTwist * length(cross(shape.a, shape.b))) return place;
  const double steps = s.geometry->lattice.steps_per_unit;
  const double a2 = shape.alpha * shape.alpha, b2 = shape.beta * shape.beta;
  const double of_a = square_root((1 + b2) * (1 - a2 / 3)), of_b = square_root((1 + a2) * (1 - b2 / 3));
  const Vec3 shift = centroid_offset(shape);
  double farthest = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const double x = k % 2 == 0 ? -1 : 1, y = k / 2 == 0 ? -1 : 1;
    const Vec3 off = shape.offset(x, y) - shift - ((x * of_a) * shape.a + (y * of_b) * shape.b);
    const double squared = length_squared(off);
    if (squared > farthest) farthest = squared;
  }
  place.kind = PlaceKind::kOwn;
  place.extra = rounded(steps * square_root(farthest)) + 1;
  std::int32_t n[3];
  put(n, static_cast<double>(kOne) * normal);
  for (int c = 0; c < 3; ++c) place.normal[c] = static_cast<std::int16_t>(n[c]);
  put(place.a, (16 * steps * of_a) * shape.a);
  put(place.b, (16 * steps * of_b) * shape.b);
  return place;
}

}  // namespace

std::int32_t mean_in_front(std::int32_t height, std::int32_t extent) {
  if (height >= extent) return height;
  const std::int32_t top = height + extent;
  return top <= 0 || extent == 0 ? 0 : static_cast<std::int32_t>(static_cast<std::uint32_t>(top) *
                                                                  static_cast<std::uint32_t>(top) /
                                                                  (4 * static_cast<std::uint32_t>(extent)));
}

std::uint64_t Places::bytes(const Scene& scene, const Rules& rules) {
  if (!rules.blocks) return 0;
  std::uint64_t places = scene.meshes.size();
  for (const Mesh& mesh : scene.meshes) places += differs(scene, mesh) ? mesh_nodes(scene, mesh, rules) : 0;
  return (sizeof(NodePlace) * node_count(scene, rules) + 7) / 8 * 8 + sizeof(MeshPlace) * places;
}

Status Places::take(Arena& arena, const Surfaces& s, const Rules& rules) {
  if (!rules.blocks) return {};
  if (!arena.take("places of nodes", s.size(), nodes_) || !arena.take("places of meshes", s.mesh_at.size(), meshes_)) {
    return arena.refused();
  }
  surfaces_ = &s;
  const double steps = s.geometry->lattice.steps_per_unit;
  std::uint32_t own = 0;
  for (std::uint32_t k = 0; k < s.mesh_at.size(); ++k) {
    if (differs(*s.scene, s.scene->meshes[s.mesh_at[k]])) own += s.mesh_begin[k + 1] - s.mesh_begin[k];
  }
  if (!arena.take("places of single nodes", own, own_)) return arena.refused();
  own = 0;
  for (std::uint32_t k = 0; k < s.mesh_at.size(); ++k) {
    meshes_[k] = place_mesh(s, k);
    if (differs(*s.scene, s.scene->meshes[s.mesh_at[k]])) {
      meshes_[k].own = own;
      own += s.mesh_begin[k + 1] - s.mesh_begin[k];
    }
    for (std::uint32_t node = s.mesh_begin[k]; node < s.mesh_begin[k + 1]; ++node) {
      if (!(s.root_area[node] > 0)) continue;
      NodePlace& place = nodes_[node];
      const bool single = meshes_[k].own != kNone;
      if (single) own_[meshes_[k].own + (node - s.mesh_begin[k])] = place_node(s, node);
      const Vec3 shift = single && s.shape(node).outline == Outline::kQuad ? centroid_offset(s.shape(node)) : Vec3{};
      put(place.centre, steps * (s.patch(node).centre + shift));
      place.weight = static_cast<float>(s.patch(node).area / s.root_area[node] * steps * square_root(kInversePi));
    }
  }
  return {};
}

void Places::half_axes(std::uint32_t node, const MeshPlace& mesh, std::int32_t* a, std::int32_t* b) const {
  if (mesh.kind != PlaceKind::kOwn && surfaces_->is_block(node)) {
    const MeshPart& part = surfaces_->block(node).part;
    const std::uint32_t across = part.across();
    const std::uint32_t up = mesh.kind == PlaceKind::kTriangle ? across : part.up();
    stretch(mesh.a, across, a);
    stretch(mesh.b, up, b);
    return;
  }
  for (int k = 0; k < 3; ++k) {
    a[k] = mesh.a[k] >> 4;
    b[k] = mesh.b[k] >> 4;
  }
}

LatticeBox Places::box(const Surfaces& s, std::uint32_t node, std::uint32_t place, bool whole) const {
  if (!whole) {
    const LatticePoint* samples = s.samples(node);
    LatticeBox box{{samples[0].x, samples[0].y, samples[0].z}, {samples[0].x, samples[0].y, samples[0].z}};
    for (std::uint32_t k = 1; k < s.cached_points; ++k) box.include(samples[k]);
    return box;
  }
  const MeshPlace& mesh = meshes_[place];
  const NodePlace& at = nodes_[node];
  std::int32_t half[3];
  if (mesh.kind == PlaceKind::kOdd) {
    const PatchShape& shape = s.shape(node);
    const double steps = s.geometry->lattice.steps_per_unit;
    if (shape.outline == Outline::kConcave) {
      half[0] = half[1] = half[2] = rounded(2 * steps * s.patch(node).longest_side);
    } else {
      std::int32_t a[3], b[3], d[3];
      put(a, steps * shape.a);
      put(b, steps * shape.b);
      put(d, steps * shape.d);
      std::int32_t shift[3];
      put(shift, steps * centroid_offset(shape));
      for (int k = 0; k < 3; ++k) {
        half[k] = magnitude(a[k]) + magnitude(b[k]) + magnitude(d[k]) + magnitude(shift[k]);
      }
    }
  } else {
    std::int32_t a[3], b[3];
    half_axes(node, mesh, a, b);
    const int by = mesh.kind == PlaceKind::kTriangle ? 1 : 0;
    for (int k = 0; k < 3; ++k) half[k] = (magnitude(a[k]) + magnitude(b[k])) << by;
  }
  LatticeBox box;
  const LatticePoint& sample = s.samples(node)[0];
  for (int k = 0; k < 3; ++k) {
    const bool flat = (mesh.flat >> k & 1) != 0;
    box.low[k] = flat ? component(sample, k) : at.centre[k] - half[k] - kMostMoved;
    box.high[k] = flat ? component(sample, k) : at.centre[k] + half[k] + kMostMoved;
  }
  return box;
}

PlacedSide Places::side(std::uint32_t node, std::uint32_t mesh_place) const {
  PlacedSide side;
  const NodePlace& place = nodes_[node];
  const MeshPlace& mesh = place_of(node, mesh_place);
  half_axes(node, mesh, side.a, side.b);
  for (int k = 0; k < 3; ++k) {
    side.centre[k] = place.centre[k];
    side.normal[k] = mesh.normal[k];
  }
  side.reach = reach_of(side.a, side.b, mesh);
  side.extra = mesh.extra;
  side.weight = static_cast<double>(place.weight);
  side.kind = mesh.kind;
  return side;
}

/// In 1/32 lattice steps times 2^14: 31 bits hold it. Rounding makes less than kTellable: 1.7 from the normal, 1.7 from
/// the way, half a step from moving the point in front of its surface.
int Places::sign_over(std::uint32_t node, std::uint32_t place, const LatticePoint& point) const {
  constexpr std::int32_t kTellable = 8 * kOne;
  const std::int32_t* centre = nodes_[node].centre;
  const std::int32_t way[3] = {(point.x - centre[0]) >> 5, (point.y - centre[1]) >> 5, (point.z - centre[2]) >> 5};
  const MeshPlace& own = place_of(node, place);
  const std::int16_t* normal = own.kind == PlaceKind::kOwn ? own.normal : meshes_[place].normal;
  const std::int32_t height = normal[0] * way[0] + normal[1] * way[1] + normal[2] * way[2];
  return height > kTellable ? 1 : height < -kTellable ? -1 : 0;
}

LinkSeries Places::series(const PlacedSide& i, std::uint32_t j, std::uint32_t place) const {
  LinkSeries link;
  const MeshPlace& mesh = place_of(j, place);
  if (i.kind == PlaceKind::kOdd || mesh.kind == PlaceKind::kOdd) return link;
  const NodePlace& node = nodes_[j];
  std::int32_t a[3], b[3], way[3];
  half_axes(j, mesh, a, b);
  std::uint32_t bits = i.reach | reach_of(a, b, mesh);
  for (int k = 0; k < 3; ++k) {
    way[k] = node.centre[k] - i.centre[k];
    bits |= static_cast<std::uint32_t>(magnitude(way[k]));
  }
  const int width = static_cast<int>(std::bit_width(bits)), by = width > 14 ? width - 14 : 0;
  for (std::int32_t& w : way) w >>= by;
  const std::int32_t normal_j[3] = {mesh.normal[0], mesh.normal[1], mesh.normal[2]};
  // Heights of each centre over the other's plane; the corners' besides.
  const std::int32_t over_i = product(i.normal, way) >> 14, over_j = -(product(normal_j, way) >> 14);
  End of_i, of_j;
  of_j.shift(a, b, by, i.normal);
  const std::int32_t extent_j = of_j.extent(mesh.kind, rounded_up(mesh.extra, by));
  link.kind = LinkKind::kAway;
  if (over_i + extent_j < -kFlat) return link;
  of_i.shift(i.a, i.b, by, normal_j);
  const std::int32_t extent_i = of_i.extent(i.kind, rounded_up(i.extra, by));
  if (over_j + extent_i < -kFlat) return link;
  link.kind = LinkKind::kOdd;  // rounding doesn't tell
  if (over_i + extent_j <= kFlat || over_j + extent_i <= kFlat) return link;

  const std::int32_t squared = product(way, way);
  const std::int32_t axes_i = product(of_i.a, of_i.a) + product(of_i.b, of_i.b);
  const std::int32_t axes_j = product(of_j.a, of_j.a) + product(of_j.b, of_j.b);
  const bool crossing = over_i + kFlat < extent_j || over_j + kFlat < extent_i || over_i <= 0 || over_j <= 0;
  if (crossing && (i.extra | mesh.extra) != 0) return link;
  // q = 4/3 (axes) / r^2
  const std::int32_t axes_13 = ((axes_i >> 1) + (axes_j >> 1)) >> 12, squared_13 = squared >> 13;
  const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - 2 * by) << 52);  // 4^-by
  const double weights = i.weight * static_cast<double>(node.weight);
  if (crossing || 8 * axes_13 > 3 * squared_13 || squared_13 == 0) {
    link.kind = crossing ? LinkKind::kCrossing : LinkKind::kClose;
    // A disc's form factor, cos cos A / (pi r^2 + A), with the larger end for A and what of each is in front.
    const std::int32_t hh = mean_in_front(over_i, extent_j) * mean_in_front(over_j, extent_i);
    const std::int32_t larger = axes_i > axes_j ? axes_i : axes_j;
    const double r2 = static_cast<double>(squared) , disc = r2 + 0.6 * static_cast<double>(larger);
    link.most = weights * scale / disc;
    link.value = hh < squared ? link.most * kRoughly * static_cast<double>(hh) / r2 : link.most;
    return link;
  }
  link.kind = LinkKind::kSeries;
  Moments at_i, at_j;
  at_j.add(of_j.a, of_j.climb_a, way, squared_13, over_i);
  at_j.add(of_j.b, of_j.climb_b, way, squared_13, over_i);
  const std::int32_t back[3] = {-way[0], -way[1], -way[2]};
  at_i.add(of_i.a, of_i.climb_a, back, squared_13, over_j);
  at_i.add(of_i.b, of_i.climb_b, back, squared_13, over_j);
  const std::int32_t w = axes_13 * kOne / squared_13;
  const std::int32_t mean = kOne + (((at_i.mean + at_j.mean - 2 * w) * kThirdOf2To16) >> 16);
  const double r2 = static_cast<double>(squared);
  link.most = weights * scale / r2;
  const double cosines = static_cast<double>(over_i * over_j) * static_cast<double>(mean) / (r2 * kOne);
  link.value = mean > 0 ? link.most * cosines : 0;
  const double q = static_cast<double>(w) * (4.0 / 3 / kOne);
  link.error = (kSeriesError * q * q + kRounding) * link.most;
  const double curved = kCurved * q * q;
  link.vary_i = static_cast<double>(at_i.vary) * (1.0 / 3 / kOne) + curved;
  link.vary_j = static_cast<double>(at_j.vary) * (1.0 / 3 / kOne) + curved;
  return link;
}

}  // namespace shodo
