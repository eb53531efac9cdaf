// A tree of boxes over triangles, in doubles: what the slow tracer of tests/truth meets. It shares no code with
// src/visibility: no lattice, no aims, no flags.
//
// Boxes are split by the surface-area heuristic in 16 bins; each node holds both children's boxes in single precision,
// grown by what rounding can do. A triangle is met by Moeller and Trumbore's test; rays that pass exactly through a
// seam may slip through, which is rounding in about 1e-15 of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "base/vector.h"

namespace shodo::truth {

struct Facet {
  Vec3 a, ab, ac;             // a corner and two edges
  Vec3 normal;                // unit, to the front
  std::uint32_t mesh = 0;     // kNone: of an area light
  std::uint32_t cell = 0;
  std::uint32_t pane = 0;     // 1: light passes it
};

struct Meeting {
  double distance = std::numeric_limits<double>::infinity();
  std::uint32_t facet = 0xffffffff;
  bool any() const { return facet != 0xffffffff; }
};

class Tree {
 public:
  void build(std::vector<Facet> facets, double extent) {
    facets_ = std::move(facets);
    margin_ = static_cast<float>(4e-6 * extent);
    order_.resize(facets_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.clear();
    if (!facets_.empty()) nodes_.push_back({}), split(0, 0, static_cast<std::uint32_t>(order_.size()));
    sorted_.clear();
    for (const std::uint32_t f : order_) sorted_.push_back(facets_[f]);
  }
  const Facet& facet(std::uint32_t f) const { return sorted_[f]; }
  std::size_t size() const { return sorted_.size(); }

  /// The nearest facet before `end`.
  Meeting nearest(const Vec3& from, const Vec3& along, double end) const {
    Meeting meeting;
    meeting.distance = end;
    walk(from, along, meeting.distance, [&](std::uint32_t f, double t) {
      meeting.distance = t;
      meeting.facet = f;
      return false;
    });
    return meeting;
  }

  /// visit(facet) for those between; true ends the walk.
  template <class Visit>
  void between(const Vec3& from, const Vec3& along, double end, Visit visit) const {
    walk(from, along, end, [&](std::uint32_t f, double) { return visit(sorted_[f]); });
  }

 private:
  struct Box {
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
    void include(const Vec3& p) {
      const double at[3] = {p.x, p.y, p.z};
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
    }
    void include(const Box& b) {
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], b.low[k]), high[k] = std::max(high[k], b.high[k]);
    }
    double half_area() const {
      const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
      return x < 0 ? 0 : x * y + y * z + z * x;
    }
  };
  struct Node {
    float low[2][3], high[2][3];   // of the two children
    std::uint32_t first[2];        // a node, or the first facet
    std::uint32_t count[2];        // facets; 0: a node
  };

  Box box_of(std::uint32_t f) const {
    Box box;
    box.include(facets_[f].a);
    box.include(facets_[f].a + facets_[f].ab);
    box.include(facets_[f].a + facets_[f].ac);
    return box;
  }
  static double middle(const Box& box, int axis) { return 0.5 * (box.low[axis] + box.high[axis]); }

  /// Where to part order_[first, end): the best of 15 planes on each axis, else in the middle of the list.
  std::uint32_t part(std::uint32_t first, std::uint32_t end) {
    constexpr int kBins = 16;
    Box middles;
    for (std::uint32_t k = first; k < end; ++k) {
      const Box box = box_of(order_[k]);
      middles.include(Vec3{middle(box, 0), middle(box, 1), middle(box, 2)});
    }
    double best = 1e300;
    int best_axis = -1, best_bin = 0;
    const auto bin_of = [&](const Box& box, int axis) {
      const double at = (middle(box, axis) - middles.low[axis]) / (middles.high[axis] - middles.low[axis]);
      return std::min(kBins - 1, static_cast<int>(at * kBins));
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!(middles.high[axis] > middles.low[axis])) continue;
      std::array<Box, kBins> boxes;
      std::array<double, kBins> counts{};
      for (std::uint32_t k = first; k < end; ++k) {
        const Box box = box_of(order_[k]);
        const auto bin = static_cast<std::size_t>(bin_of(box, axis));
        boxes[bin].include(box);
        ++counts[bin];
      }
      for (std::size_t cut = 1; cut < kBins; ++cut) {
        Box side[2];
        double count[2] = {0, 0};
        for (std::size_t b = 0; b < kBins; ++b) side[b >= cut].include(boxes[b]), count[b >= cut] += counts[b];
        if (count[0] == 0 || count[1] == 0) continue;
        const double cost = side[0].half_area() * count[0] + side[1].half_area() * count[1];
        if (cost < best) best = cost, best_axis = axis, best_bin = static_cast<int>(cut);
      }
    }
    if (best_axis < 0) return (first + end) / 2;
    const auto at = std::partition(order_.begin() + first, order_.begin() + end, [&](std::uint32_t f) {
      return bin_of(box_of(f), best_axis) < best_bin;
    });
    return static_cast<std::uint32_t>(at - order_.begin());
  }

  void split(std::uint32_t node, std::uint32_t first, std::uint32_t end) {
    const std::uint32_t cut = end - first < 2 ? end : part(first, end);
    const std::uint32_t from[2] = {first, cut}, to[2] = {cut, end};
    for (int side = 0; side < 2; ++side) {
      Box box;
      for (std::uint32_t k = from[side]; k < to[side]; ++k) box.include(box_of(order_[k]));
      for (int k = 0; k < 3; ++k) {
        nodes_[node].low[side][k] = static_cast<float>(box.low[k]) - margin_;
        nodes_[node].high[side][k] = static_cast<float>(box.high[k]) + margin_;
      }
      const std::uint32_t count = to[side] - from[side];
      if (count <= 2) {
        if (count == 0) nodes_[node].low[side][0] = 1e30f, nodes_[node].high[side][0] = -1e30f;
        nodes_[node].first[side] = from[side];
        nodes_[node].count[side] = count == 0 ? 1 : count;  // an empty box is never entered
        continue;
      }
      const auto child = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back({});
      nodes_[node].first[side] = child;
      nodes_[node].count[side] = 0;
      split(child, from[side], to[side]);
    }
  }

  static bool meets(const Facet& facet, const Vec3& from, const Vec3& along, double end, double& t) {
    const Vec3 p = cross(along, facet.ac);
    const double det = dot(facet.ab, p);
    if (det == 0) return false;
    const double inverse = 1 / det;
    const Vec3 s = from - facet.a;
    const double u = dot(s, p) * inverse;
    if (!(u >= 0 && u <= 1)) return false;
    const Vec3 q = cross(s, facet.ab);
    const double v = dot(along, q) * inverse;
    if (!(v >= 0 && u + v <= 1)) return false;
    t = dot(facet.ac, q) * inverse;
    return t > 0 && t < end;
  }

  /// take(facet, distance) for each one met before `end`, which take may lower; true ends the walk.
  template <class End, class Take>
  void walk(const Vec3& from, const Vec3& along, End& end, Take take) const {
    if (nodes_.empty()) return;
    const float o[3] = {static_cast<float>(from.x), static_cast<float>(from.y), static_cast<float>(from.z)};
    const auto inverse = [](double x) { return static_cast<float>(1 / (std::abs(x) < 1e-12 ? 1e-12 : x)); };
    const float d[3] = {inverse(along.x), inverse(along.y), inverse(along.z)};
    const int near_low[3] = {d[0] > 0, d[1] > 0, d[2] > 0};
    struct Entry {
      std::uint32_t node;
      float enter;
    } stack[64];
    int height = 0;
    std::uint32_t node = 0;
    for (;;) {
      const Node& n = nodes_[node];
      float enter[2];
      bool inside[2];
      for (int side = 0; side < 2; ++side) {
        float low = 0, high = static_cast<float>(end) * 1.000001f;
        for (int k = 0; k < 3; ++k) {
          const float t0 = ((near_low[k] ? n.low : n.high)[side][k] - o[k]) * d[k];
          const float t1 = ((near_low[k] ? n.high : n.low)[side][k] - o[k]) * d[k];
          low = t0 > low ? t0 : low;
          high = t1 < high ? t1 : high;
        }
        enter[side] = low;
        inside[side] = low <= high;
      }
      std::uint32_t next = 0xffffffff;
      const int first = enter[1] < enter[0] ? 1 : 0;
      for (int turn = 0; turn < 2; ++turn) {
        const int side = turn == 0 ? first : 1 - first;
        if (!inside[side]) continue;
        if (n.count[side] == 0) {
          if (next == 0xffffffff) {
            next = n.first[side];
          } else {
            stack[height++] = {n.first[side], enter[side]};
          }
          continue;
        }
        for (std::uint32_t f = n.first[side]; f < n.first[side] + n.count[side]; ++f) {
          double t;
          if (meets(sorted_[f], from, along, end, t) && take(f, t)) return;
        }
      }
      while (next == 0xffffffff && height > 0) {
        const Entry& top = stack[--height];
        if (static_cast<double>(top.enter) <= end * 1.000001) next = top.node;
      }
      if (next == 0xffffffff) return;
      node = next;
    }
  }

  std::vector<Facet> facets_, sorted_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  float margin_ = 0;
};

}  // namespace shodo::truth
