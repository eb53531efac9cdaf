// What the ambient light of a sub-patch should be, by chance and without approximation: paths of diffuse reflections.
//
//   E(x) = mean over cosine-distributed directions of rho(y) (D(y) + E(y)),   y what is met first, D its direct light
//
// (paper 2.2's equation before it is cut into patches). A sub-patch gets two independent estimates a and b, each from
// points spread evenly over its area and directions by a shifted additive sequence (Roberts 2018) in four dimensions;
// what follows along a path is by plain chance, with Russian roulette from the second reflection on. For any map x the
// mean of (x - a)(x - b) is (x - truth)^2: no noise is counted as error, and nothing of shodo's methods is in it.
//
// The direct light of the sub-patch is found beside it, in the same way.
//
// Hidden points (deviation D4) are left out: those that see a back along the normal (within a degree) and in at least
// a third of 24 directions by cosine. In a closed piece of furniture all are backs; under a table none along the
// normal but its underside, which is a front; beside a closed thing that stands at a wall the wall is seen from the
// front in at most half of the directions, while outside of it no back is seen at all. A third leaves room for both.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "truth/lamps.h"

namespace shodo::truth {

struct Estimate {
  double lux[3] = {0, 0, 0};
  double direct[3] = {0, 0, 0};
  double seen = 0;  // part of the area that is not hidden
};

/// Of one sub-patch; the halves are independent.
struct Truth {
  Estimate half[2];
};

class Tracer {
 public:
  explicit Tracer(const Scene& scene) : Tracer(scene, scene) {}
  Tracer(const Scene& scene, const Scene& reflecting) : world_(scene, reflecting), lamps_(world_) {}

  const World& world() const { return world_; }

  /// Paths end where they meet something first: each sub-patch is one value there, lux by number and channel; `lit`:
  /// and has its direct light besides, as it is where it is met. What they find is what the best of gathers would.
  using Senders = std::vector<std::array<double, 3>>;
  void end_at(Senders senders, bool lit) {
    senders_ = std::move(senders);
    lit_ = lit;
  }

  /// `paths`: of each half.
  Truth sub_patch(std::uint32_t m, std::uint32_t local, std::uint32_t paths) const {
    const Mesh& mesh = world_.scene().meshes[m];
    const Spot spot(world_.scene(), mesh, local);
    Truth truth;
    if (!(length(spot.piece.vector_area()) > 0)) return truth;
    const std::uint64_t number = mesh.first_sub_patch + std::uint64_t{local} + senders_.size();  // by other chances
    Chance looks(3 * number);
    const bool covered = may_be_hidden(spot, looks);
    for (std::uint64_t half = 0; half < 2; ++half) {
      Chance chance(3 * number + 1 + half);
      truth.half[half] = estimate(spot, covered, paths, chance);
    }
    return truth;
  }

  /// All of them, in the scene's order; the same whatever the threads.
  std::vector<Truth> all(std::uint32_t paths, unsigned threads) const {
    const Scene& scene = world_.scene();
    std::vector<Truth> truths(scene.sub_patch_count);
    std::vector<std::uint32_t> mesh_of(scene.sub_patch_count);
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
      const Mesh& mesh = scene.meshes[m];
      for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) mesh_of[mesh.first_sub_patch + k] = m;
    }
    std::atomic<std::uint32_t> next{0};
    const auto work = [&] {
      for (std::uint32_t s = next++; s < truths.size(); s = next++) {
        truths[s] = sub_patch(mesh_of[s], s - scene.meshes[mesh_of[s]].first_sub_patch, paths);
      }
    };
    std::vector<std::thread> others;
    for (unsigned k = 1; k < threads; ++k) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
    return truths;
  }

  /// Direct light at a place, for tests.
  void direct(const Place& place, Chance& chance, double (&lux)[3]) const { lamps_.light(place, chance, lux); }

 private:
  struct Spot {
    Spot(const Scene& scene, const Mesh& mesh, std::uint32_t local)
        : piece(sub_patch_piece(scene, mesh, local)),
          cell(cell_piece(scene, mesh, cell_of_patch(mesh, patch_of_sub_patch(mesh, local)))) {
      const Vec3 n = normalised(cell.vector_area());
      for (std::uint32_t k = 1; k < cell.corners; ++k) {
        twisted = twisted || std::abs(dot(n, cell.corner[k] - cell.corner[0])) > 1e-9 * cell.longest_side();
      }
    }
    Piece piece, cell;
    bool twisted = false;
  };

  /// A point at (x, y) of the unit square, and its share of the area, up to a factor.
  Place place(const Spot& spot, double x, double y, double& weight) const {
    const Piece& piece = spot.piece;
    weight = 1;
    if (piece.corners == 3) {
      if (x + y > 1) x = 1 - x, y = 1 - y;
    } else {
      const Vec3* c = piece.corner;
      Vec3 along_s, along_t;
      if (piece.concave) {
        along_s = x + y <= 1 ? c[1] - c[0] : c[2] - c[3];
        along_t = x + y <= 1 ? c[3] - c[0] : c[2] - c[1];
      } else if (piece.cut) {
        along_s = x >= y ? c[1] - c[0] : c[2] - c[3];
        along_t = x >= y ? c[2] - c[1] : c[3] - c[0];
      } else {
        along_s = (1 - y) * (c[1] - c[0]) + y * (c[2] - c[3]);
        along_t = (1 - x) * (c[3] - c[0]) + x * (c[2] - c[1]);
      }
      weight = length(cross(along_s, along_t));
    }
    const Vec3 point = piece.point(x, y);
    if (spot.twisted) return world_.on_surface(spot.cell, point);
    return {point, normalised(spot.cell.vector_area())};
  }

  /// Cosine-distributed; x = 0 is the normal.
  static Vec3 direction(const Vec3& n, double x, double y) {
    const double sign = n.z < 0 ? -1 : 1, a = -1 / (sign + n.z), b = n.x * n.y * a;  // Duff et al. 2017
    const Vec3 u{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, v{b, sign + n.y * n.y * a, -n.y};
    const double r = std::sqrt(x), turn = kTwoPi * y;
    return (r * std::cos(turn)) * u + (r * std::sin(turn)) * v + std::sqrt(std::max(0.0, 1 - x)) * n;
  }

  bool sees_back(const Place& at, const Vec3& along) const {
    const Meeting meeting = world_.tree().nearest(at.point + world_.small() * at.normal, along, 1e300);
    return meeting.any() && dot(world_.tree().facet(meeting.facet).normal, along) > 0;
  }
  static constexpr double kAlongNormal = 0.0003;  // of direction()'s x

  bool is_hidden(const Place& at, Chance& chance) const {
    const double turn = chance.next(), shift = chance.next();
    if (!sees_back(at, direction(at.normal, kAlongNormal * chance.next(), turn))) return false;
    std::uint32_t backs = 0;
    for (std::uint32_t k = 0; k < 24; ++k) {
      const double y = shift + k * 0.6180339887498949;
      if (sees_back(at, direction(at.normal, (k + chance.next()) / 24, y - std::floor(y)))) ++backs;
    }
    return backs >= 8;
  }

  /// Whether any of 64 points spread over a sub-patch sees a back along its normal.
  bool may_be_hidden(const Spot& spot, Chance& chance) const {
    for (int k = 0; k < 64; ++k) {
      double weight;
      const double x = (k % 8 + chance.next()) / 8, y = (k / 8 + chance.next()) / 8;
      const Place at = place(spot, x, y, weight);
      if (sees_back(at, direction(at.normal, kAlongNormal * chance.next(), chance.next()))) return true;
    }
    return false;
  }

  Estimate estimate(const Spot& spot, bool covered, std::uint32_t paths, Chance& chance) const {
    // The root of x^5 = x + 1 makes the sequence in four dimensions.
    static constexpr double kStep[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087, 0.5385972572236101};
    double shift[4];
    for (double& s : shift) s = chance.next();
    Estimate sum;
    double area = 0;
    for (std::uint32_t k = 0; k < paths; ++k) {
      double x[4];
      for (int d = 0; d < 4; ++d) x[d] = shift[d] + k * kStep[d], x[d] -= std::floor(x[d]);
      double weight;
      const Place at = place(spot, x[0], x[1], weight);
      area += weight;
      if (covered && is_hidden(at, chance)) continue;
      sum.seen += weight;
      double lux[3] = {0, 0, 0}, direct[3];
      trace(at, direction(at.normal, x[2], x[3]), chance, lux);
      lamps_.light(at, chance, direct);
      for (int c = 0; c < 3; ++c) sum.lux[c] += weight * lux[c], sum.direct[c] += weight * direct[c];
    }
    for (int c = 0; c < 3 && sum.seen > 0; ++c) sum.lux[c] /= sum.seen, sum.direct[c] /= sum.seen;
    sum.seen /= area;
    return sum;
  }

  /// The path that leaves a place this way.
  void trace(const Place& start, Vec3 along, Chance& chance, double (&lux)[3]) const {
    double part[3] = {1, 1, 1};
    Vec3 from = start.point + world_.small() * start.normal;
    for (std::uint32_t reflections = 0;;) {
      const Meeting meeting = world_.tree().nearest(from, along, 1e300);
      if (!meeting.any()) return;
      const Facet& facet = world_.tree().facet(meeting.facet);
      const bool front = dot(facet.normal, along) < 0;
      const Vec3 point = from + meeting.distance * along;
      if (facet.pane != 0 && (!front || chance.next() < 0.5)) {  // as often through it as back from its front
        const Rgb through = world_.transmit(facet);
        for (int c = 0; c < 3; ++c) part[c] *= (front ? 2 : 1) * through.c[c];
        from = point + world_.small() * along;
        continue;
      }
      if (!front || facet.mesh == kNone) return;
      double rho[3], direct[3];
      world_.reflectance(facet, point, rho);
      double most = 0;
      for (int c = 0; c < 3; ++c) part[c] *= (facet.pane != 0 ? 2 : 1) * rho[c], most = std::max(most, part[c]);
      if (!(most > 0)) return;
      const Place place{point, facet.normal};
      if (senders_.empty() || lit_) {
        lamps_.light(place, chance, direct);
        for (int c = 0; c < 3; ++c) lux[c] += part[c] * direct[c];
      }
      if (!senders_.empty()) {
        const std::array<double, 3>& sent = senders_[world_.sub_patch_at(facet, point)];
        for (std::size_t c = 0; c < 3; ++c) lux[c] += part[c] * sent[c];
        return;
      }
      if (++reflections > 1) {
        const double go_on = std::min(most, 0.999);
        if (chance.next() >= go_on) return;
        for (double& p : part) p /= go_on;
      }
      const double x = chance.next(), y = chance.next();
      along = direction(place.normal, x, y);
      from = point + world_.small() * place.normal;
    }
  }

  World world_;
  Lamps lamps_;
  Senders senders_;
  bool lit_ = false;
};

}  // namespace shodo::truth
