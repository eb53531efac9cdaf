// Illuminance maps of one scene, computed with other patches or other settings, made comparable: copied out of the
// model and brought to the same sub-patches.
//
// A sub-patch that is hidden, or whose patch was dropped, has no value: its area counts as 0. A coarser value is the
// mean of the finer ones, weighted by area, so that with twice the counts it is the mean of 2 x 2 sub-patches exactly;
// a finer value is that of the coarser sub-patch it lies in. Counts that don't divide each other (13 patches at half
// the counts are 7) overlap by fractions, found in whole numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model.h"

namespace shodo {

struct MeshGrid {
  MeshKind kind = MeshKind::kQuad;
  std::uint32_t width = 1, height = 1;  // sub-patches; a triangle's width == height has width^2
  std::size_t first = 0;                // its first sub-patch
  std::string object{};                 // whose mesh it is
};

struct MapCopy {
  std::uint32_t channels = 1;
  std::vector<MeshGrid> meshes;
  std::vector<double> area;            // per sub-patch, scene units squared; 0: it has no value
  std::vector<float> direct, ambient;  // lux, [sub_patch * channels + channel]
};

MapCopy copy_maps(const Model& model);

/// A map on the sub-patches of another.
struct ComparedMap {
  std::uint32_t channels = 1;
  std::vector<double> area;             // the part of each sub-patch that has a value
  std::vector<double> direct, ambient;  // lux, [sub_patch * channels + channel]
  std::vector<std::uint8_t> cut;        // per sub-patch: 1 if a shadow edge cuts it, as far as the finer map shows
};

/// A shadow edge cuts a sub-patch if the direct light of the pieces in it differs, in some channel, by more than this
/// part of the largest of them, and by more than kCutOfMean of the area mean of the total illuminance of all.
inline constexpr double kCutOfLargest = 0.25;
inline constexpr double kCutOfMean = 0.02;

ComparedMap bring_to(const MapCopy& from, const MapCopy& like);

/// Area mean of the total illuminance, over all channels, lux; 0 without area.
double mean_illuminance(const MapCopy& map);

/// Whether every bit of every value is the same.
bool identical(const MapCopy& a, const MapCopy& b);

}  // namespace shodo
