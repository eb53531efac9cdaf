// The near part of a gather: contours, and senders' own sub-patches (doc/gather.md).
#include "ambient/gather_group.h"
#include "ambient/box_factor.h"
#include "base/quadrature.h"
#include "light/piece_grid.h"
#include "light/polygon_factor.h"
#include "scene/sub_patches.h"

namespace shodo {

namespace {

constexpr double kOfUneven = 0.5;  // of the unevenness, what a contour's integral makes wrong
constexpr double kCloseShare = 1.0 / 32;
constexpr double kClose = 1;       // times both longest sides squared: a squared distance below it is close
constexpr double kPartQ = 0.2;     // sub-patches beyond it send by their contour
constexpr double kPartShare = 0.3;  // times q: the error of their kernel
constexpr std::int32_t kMoved = 16;  // samples are moved in front of their surface by less than that

/// Planar or not, cut or not.
double piece_factor(const Vec3& point, const Vec3& normal, const Piece& piece, bool planar) {
  if (piece.corners == 3 || (planar && !piece.cut)) return point_to_polygon(point, normal, piece.corner, piece.corners);
  const std::uint32_t first = piece.concave ? 1 : 0;
  double sum = 0;
  for (std::uint32_t half = 0; half < 2; ++half) {
    const Vec3 corner[3] = {piece.corner[first], piece.corner[first + 1 + half], piece.corner[(first + 2 + half) & 3]};
    sum += point_to_polygon(point, normal, corner, 3);
  }
  return sum;
}

}  // namespace

/// The free part of so many segments to `ends` (1 or 4) ends; of twice as many if they disagree.
double GatherGroup::visible(GatherPoint& point, std::uint32_t turn, const LatticePoint* to, std::uint32_t ends,
                            std::uint32_t segments, double factor) {
  std::uint32_t free = 0, done = 0;
  double passed = 0;
  for (std::uint32_t most = segments; done < most; ++done) {
    const std::uint32_t origin = (turn + done) & 3, end = (turn / 4 + 3 * done + done / 4) & (ends - 1);
    if (!scene_.lists.blocked(point.from[origin], to[end])) {
      ++free;
      passed += scene_.lists.pass(point.from[origin], to[end]);
    }
    if (done + 1 == most && most > 1 && most == segments && free > 0 && free <= done) most = 2 * segments;
  }
  const double n = done, f = free;
  point.variance += factor * factor * ((f + 0.5) * (n - f + 0.5) / ((n + 1) * (n + 1) * (n + 2)));
  return passed / n;
}

/// Around the samples of a patch and the centres of its sub-patches.
LatticeBox GatherGroup::inner_box(std::uint32_t j, const Mesh& mesh) const {
  LatticeBox box = samples_box(j), whole = whole_box(j);
  const std::uint32_t most = mesh.su > mesh.sv ? mesh.su : mesh.sv;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t inset = (whole.high[k] - whole.low[k]) / static_cast<std::int32_t>(2 * most) - kMoved;
    if (inset <= 0) continue;
    if (whole.low[k] + inset < box.low[k]) box.low[k] = whole.low[k] + inset;
    if (whole.high[k] - inset > box.high[k]) box.high[k] = whole.high[k] - inset;
  }
  return box;
}

/// A patch too near for one kernel, or partly in the shade.
void GatherGroup::gather_near(const Look& look) {
  const Surfaces& s = scene_.surfaces;
  const Mesh& mesh = s.mesh(look.node);
  const bool clear = scene_.lists.clear(inner_box(look.node, mesh), look.node);
  const double uneven = scene_.senders.uneven(look.node);
  const bool parts = mesh.su * mesh.sv > 1 && (kOfUneven * look.bound * uneven > error_ * look.level ||
                                               (!clear && look.bound > kMostMixed * error_));
  if (parts) {
    gather_parts(look, clear);
  } else {
    gather_polygon(look, s.piece(look.node), clear);
  }
}

/// A sub-patch as a rectangle along the axes, if it is one.
AxisRectangle GatherGroup::rectangle(const GatherPoint& point) const {
  const Surfaces& s = scene_.surfaces;
  PatchShape shape;
  const Vec3 across = point.place[1] - point.place[0], up = point.place[2] - point.place[0];
  shape.a = (0.5 / kGaussTwo) * across;
  shape.b = (0.5 / kGaussTwo) * up;
  const bool even = length_squared(point.place[3] - point.place[2] - across) <= s.flat * s.flat;
  if (!even || s.patch(node_).thin != 0) return {};
  return axis_rectangle(centre_ + point.offset, normal_, shape, s.flat);
}

/// By the closed form as a whole, if one serves and nothing is between; else by the contour from each of four places,
/// with a segment from there, in all what the closed form says.
void GatherGroup::gather_close(GatherPoint& point, const Piece& piece, bool planar, const AxisRectangle& sender,
                               const double* radiosity, const LatticePoint* to, std::uint32_t ends, bool clear) {
  double closed = -1;
  if (sender.axis >= 0) {
    const AxisRectangle own = rectangle(point);
    closed = box_exchange(own, sender);
    for (int k = 0; k < 3 && closed > 0; ++k) closed /= k == own.axis ? 1 : own.high[k] - own.low[k];
  }
  // All else is found at the centre: what curves over the sub-patch counts there and here differently.
  const auto gather = [&](double factor) {
    point.geometry_error += kCloseShare * factor;
    add(point, radiosity, factor);
  };
  if (closed == 0) return;
  if (closed > 0 && clear) {
    gather(closed);
    return;
  }
  double factors[4], sum = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const double factor = piece_factor(point.place[k], normal_, piece, planar);
    factors[k] = factor > 0 ? 0.25 * factor : 0;
    sum += factors[k];
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    double factor = factors[k];
    if (closed > 0) factor = sum > 0 ? factor * (closed / sum) : 0.25 * closed;
    if (!(factor > 0)) continue;
    const LatticePoint& end = to[k & (ends - 1)];
    if (!clear && scene_.lists.blocked(point.from[k], end)) continue;
    gather(clear ? factor : factor * scene_.lists.pass(point.from[k], end));
  }
}

void GatherGroup::gather_polygon(const Look& look, const Piece& piece, bool clear) {
  const Surfaces& s = scene_.surfaces;
  const LatticePoint* const samples = s.samples(look.node);
  const bool planar = s.mesh(look.node).kind != MeshKind::kGrid;
  const AxisRectangle box = axis_rectangle(look.patch->centre, look.patch->normal, s.shape(look.node), s.flat);
  std::uint32_t turn = gather_hash(node_, look.node);
  const double side = look.patch->longest_side;
  for (GatherPoint& point : points_) {
    turn += 5;
    const Vec3 way = look.way - point.offset;
    if (look.bound > kOneSegment * error_ && length_squared(way) < kClose * (side * side + point.side_squared)) {
      gather_close(point, piece, planar, box, look.radiosity, samples, s.cached_points, clear);
      continue;
    }
    double factor = piece_factor(centre_ + point.offset, normal_, piece, planar);
    if (!(factor > 0)) continue;
    const std::uint32_t segments = factor * look.level <= kMostMixed * error_ ? 2 : 4;
    if (!clear) factor *= visible(point, turn, samples, s.cached_points, segments, factor);
    add(point, look.radiosity, factor);
  }
}

/// A sub-patch that sends.
struct GatherGroup::Part {
  Piece piece;
  Vec3 centre, normal;
  double area, side;
  bool planar;
};

/// By the kernel between the centres, or by the contour.
double GatherGroup::part_factor(GatherPoint& point, const Part& part) const {
  const Vec3 from = centre_ + point.offset, way = part.centre - from;
  const double over_i = dot(normal_, way), squared = length_squared(way);
  const double q = part.side * part.side / (3 * squared);
  if (q > kPartQ || over_i < part.side) return piece_factor(from, normal_, part.piece, part.planar);
  const double over_j = -dot(part.normal, way);
  if (!(over_j > 0)) return 0;
  const double factor = over_i * over_j * part.area * kInversePi / (squared * squared);
  point.geometry_error += kPartShare * q * factor;
  return factor;
}

void GatherGroup::gather_parts(const Look& look, bool clear) {
  const Surfaces& s = scene_.surfaces;
  const Mesh& mesh = s.mesh(look.node);
  double room[3];
  const double* const rho = s.reflectance(look.node, room);
  const std::uint32_t mesh_index = s.mesh_index(look.node), local = s.local(look.node), channels = s.scene->channels;
  const std::uint32_t cell = cell_of_patch(mesh, local);
  const bool planar = mesh.kind != MeshKind::kGrid;
  PatchShape part_shape = s.shape(look.node);
  part_shape.a = (1.0 / mesh.su) * part_shape.a;
  part_shape.b = (1.0 / mesh.sv) * part_shape.b;
  std::uint32_t turn = gather_hash(node_, look.node);
  SubPatchesOfPatch parts(mesh, local);
  for (std::uint32_t k = parts.next(); k != kNone; k = parts.next()) {
    const std::size_t at = mesh.first_sub_patch + std::size_t{k};
    if (!scene_.direct.hidden.empty() && scene_.direct.hidden[at] != 0) continue;
    double sends[3] = {0, 0, 0};
    for (std::uint32_t c = 0; c < channels; ++c) {
      const std::size_t value = at * channels + c;
      sends[c] = rho[c] * (static_cast<double>(scene_.direct.sub_patch_lx[value]) +
                           static_cast<double>(scene_.ambient_lx[value]));
    }
    const double level = scene_.senders.level_of(sends);
    Part part{sub_patch_piece(*s.scene, mesh, k), {}, look.patch->normal, 0, 0, planar};
    part.centre = part.piece.centre();
    part.area = length(part.piece.vector_area());
    part.side = part.piece.longest_side();
    const AxisRectangle box = axis_rectangle(part.centre, part.normal, part_shape, s.flat);
    LatticePoint ends[4];
    const PieceGrid grid(part.piece, 1);
    for (std::uint32_t e = 0; e < 4 && !clear; ++e) {
      ends[e] = sample_point(*s.scene, *s.geometry, mesh_index, cell, grid.point_at(grid.gauss(e)));
    }
    for (GatherPoint& point : points_) {
      turn += 5;
      const double squared = length_squared(part.centre - centre_ - point.offset);
      if (squared < kClose * (part.side * part.side + point.side_squared)) {
        gather_close(point, part.piece, planar, box, sends, ends, 4, clear);
        continue;
      }
      double factor = part_factor(point, part);
      if (!(factor > 0)) continue;
      const double w = factor * level;
      const std::uint32_t segments = w <= kOneSegment * error_ ? 1 : w <= kMostMixed * error_ ? 2 : 4;
      if (!clear) factor *= visible(point, turn, ends, 4, segments, factor);
      add(point, sends, factor);
    }
  }
}

}  // namespace shodo
