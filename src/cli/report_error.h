// How wrong a map and a picture are, what a rule lost, and which cases are efficient.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cli/report_maps.h"

namespace shodo {

/// Root mean square over area and channels, sqrt(sum A dE^2 / sum A), over the area mean of the reference's total
/// illuminance. A: the area that has a value in the reference. Sub-patches without a value in the case are left out.
struct MapError {
  double ambient = 0;     // of all sub-patches
  double ambient_99 = 0;  // of all but the worst hundredth of the area
  double direct = 0;      // of those that no shadow edge cuts
  double direct_cut = 0;  // of those that one does
  double total = 0;       // direct and ambient together, of all
  double cut_area = 0;    // the part of the area that shadow edges cut
  double left_out = 0;    // the part of the area without a value in the case
};

/// `reference` and `map` on the same sub-patches. `mean_lx`: area mean of the reference's total illuminance.
MapError map_error(const ComparedMap& reference, const ComparedMap& map, double mean_lx);

/// Where the error of the ambient maps sits.
struct ObjectError {
  std::string object;
  double area = 0;    // its part of the area
  double square = 0;  // its part of sum A dE^2
  double error = 0;   // RMS over it, of the mean total illuminance
};

/// Objects by their part of the squared error, the largest first. `like`: whose sub-patches the maps are on.
std::vector<ObjectError> object_errors(const ComparedMap& reference, const ComparedMap& map, const MapCopy& like,
                                       double mean_lx);

/// Over all bytes of two pictures of the same size, grey levels.
struct PictureError {
  double mean = 0;
  std::uint32_t largest = 0;
};

PictureError picture_error(std::span<const std::uint8_t> reference, std::span<const std::uint8_t> picture);

/// A point is efficient if no other is at most as dear and at most as wrong, and better in one of the two. Of equal
/// points all are.
struct CostAndError {
  double cost = 0, error = 0;
};

std::vector<bool> efficient(std::span<const CostAndError> points);

/// What the rules' bounds and losses are about: the patches of a solved model.
struct PatchLight {
  std::uint32_t channels = 1;
  double min_cd_m2 = 0, max_cd_m2 = 0;  // the display's
  std::vector<double> area;             // 0 for patches that were dropped or hidden altogether
  std::vector<double> reflectance;      // [patch * channels + channel], as the next two
  std::vector<double> direct, ambient;  // lux
};

PatchLight copy_patches(const Model& model);

/// What a rule left out, the bound on what that can lose, and what it did lose against the same case without rules.
struct RuleLoss {
  std::uint64_t rows = 0;     // empty by rule 1: largest channel of rho E0 / pi above the display's largest luminance
  std::uint64_t columns = 0;  // empty by rule 2: below its smallest (with 2+: those still below it in the end)
  double bound_lx = 0;
  double largest_lx = 0;      // over patches and channels
  double mean_lx = 0;         // area mean, over channels; negative if light was gained
  double brightest_lx = 0;    // the largest illuminance of either
  double solver_lx = 0;       // what the solver may have made wrong of both; evaluate() knows

  bool within_bound() const { return largest_lx <= bound_lx + solver_lx; }
};

/// Bounds. Rule 2: if columns D are dropped from E = E0 + R E, the solution Ê of the rest loses at most
///   max over D of rho_j Ê_j / (1 - max rho)
/// since E - Ê = R (E - Ê) + R_D Ê (references: "What errors do"; Ê for E makes it computable without E). Rule 1: a
/// row that is emptied loses its ambient illuminance, and the others at most as much: the largest of `none` over these
/// rows.
/// Together at most the sum. Rule 3 and blocks have an estimate and no bound: they add nothing here.
RuleLoss rule_loss(const PatchLight& none, const PatchLight& ruled, const Rules& rules);

}  // namespace shodo
