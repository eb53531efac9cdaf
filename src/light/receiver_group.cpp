#include "light/receiver_group.h"

namespace shodo {

namespace {

void add(const Sample& sample, ReceiverGroup& group) {
  group.point[group.count] = sample.point;
  group.lattice[group.count] = sample.lattice;
  group.box.include(sample.lattice);
  ++group.count;
}

/// The half of the grid to which a sample belongs.
std::uint32_t half_of(bool triangle, std::uint32_t sample) {
  if (triangle) return triangle_piece(kGridCuts, sample).inverted ? 1 : 0;
  const std::uint32_t u = sample % kGridCuts, v = sample / kGridCuts;
  const bool outer_u = u == 0 || u == kGridCuts - 1, outer_v = v == 0 || v == kGridCuts - 1;
  return outer_u == outer_v ? 0 : 1;
}

}  // namespace

Sample sample_at(const Scene& scene, const Geometry& geometry, const Receiver& receiver, const Vec3& point) {
  if (receiver.front.flat()) return {point, receiver.front.move(odd_point(geometry.lattice, point))};
  if (!receiver.own.empty()) return {point, sample_point(geometry.lattice, receiver.own, point)};
  return {point, sample_point(scene, geometry, receiver.mesh, receiver.cell, point)};
}

ReceiverGroup gauss_group(const Scene& scene, const Geometry& geometry, const Receiver& receiver,
                          const PieceGrid& grid) {
  ReceiverGroup group;
  for (std::uint32_t k = 0; k < kGaussSamples; ++k) {
    add(sample_at(scene, geometry, receiver, grid.point_at(grid.gauss(k))), group);
  }
  return group;
}

ReceiverGroup centre_group(const Scene& scene, const Geometry& geometry, const Receiver& receiver, const Piece& piece) {
  ReceiverGroup group;
  group.ends_of_area = kAllEnds;
  add(sample_at(scene, geometry, receiver, piece.centre()), group);
  return group;
}

ReceiverGroup fine_group(const PieceGrid& grid) {
  ReceiverGroup group;
  group.count = grid.fine_count();
  for (std::uint32_t k = 0; k < group.count; ++k) group.point[k] = grid.point_at(grid.fine(k).at);
  return group;
}

ReceiverGroup grid_half(const PieceGrid& grid, std::uint32_t half) {
  ReceiverGroup group;
  group.ends_of_area = half == 0 ? kFirstEnds : kSecondEnds;
  for (std::uint32_t k = 0; k < kGridSamples; ++k) {
    if (half_of(grid.corner_count() == 3, k) != half) continue;
    group.point[group.count] = grid.point(k);
    group.grid_index[group.count++] = static_cast<std::uint8_t>(k);
  }
  return group;
}

ReceiverGroup grid_group(const Scene& scene, const Geometry& geometry, const Receiver& receiver, const PieceGrid& grid,
                         std::uint32_t half) {
  ReceiverGroup group = grid_half(grid, half);
  for (std::uint32_t k = 0; k < group.count; ++k) {
    group.lattice[k] = sample_at(scene, geometry, receiver, group.point[k]).lattice;
    group.box.include(group.lattice[k]);
  }
  return group;
}

}  // namespace shodo
