// The hard cases as a table that GoogleTest asserts and `make hard` prints: both run the same functions.
//
// A case builds its scenes as text, runs the library over a sweep and not at one point, and puts to its Findings what
// the demand of the table in doc/stability.md says. The first demand that doesn't hold makes the case fail.
#pragma once

#include <span>
#include <string>

namespace shodo::hard {

enum class Outcome { kPass, kRefused, kFail };

struct CaseResult {
  Outcome outcome = Outcome::kPass;
  double figure = 0;     // what `sentence` is about
  std::string sentence;  // what was found; of a failure, what didn't hold
};

struct HardCase {
  int number;
  const char* name;
  CaseResult (*run)();
};

/// In ascending order of their numbers, 1 to 35.
std::span<const HardCase> hard_cases();

/// Whether `make hard` asked for the long sweeps and the loads (SHODO_HARD=all); tests run the short ones.
bool thorough();

class Findings {
 public:
  /// `where` and `what` are told if it doesn't hold.
  void demand(bool holds, const std::string& what) {
    if (!holds && failed_.empty()) failed_ = what;
  }
  /// Keeps the largest.
  void worst(double value) { figure_ = value > figure_ ? value : figure_; }
  double figure() const { return figure_; }

  CaseResult result(const std::string& sentence) const { return result(Outcome::kPass, sentence); }
  CaseResult refused(const std::string& sentence) const { return result(Outcome::kRefused, sentence); }

 private:
  CaseResult result(Outcome outcome, const std::string& sentence) const {
    if (!failed_.empty()) return {Outcome::kFail, figure_, "expected " + failed_};
    return {outcome, figure_, sentence};
  }

  std::string failed_;
  double figure_ = 0;
};

/// "%g" and the like.
std::string say(const char* format, ...) __attribute__((format(printf, 1, 2)));

// By group; each in a file of its own name.
CaseResult rho_to_1();
CaseResult rho_exactly_1();
CaseResult sliver_1e4();
CaseResult t_junction();
CaseResult coplanar_overlap();
CaseResult coplanar_identical();
CaseResult interpenetrating_boxes();
CaseResult far_origin();
CaseResult scaled();
CaseResult zero_area();
CaseResult duplicate_vertices();
CaseResult light_on_surface();
CaseResult light_in_plane();
CaseResult light_on_sample();
CaseResult edge_on_patch();
CaseResult leaky_corner();
CaseResult thin_wall();
CaseResult camera_on_surface();
CaseResult near_plane_crossers();
CaseResult nonplanar_quad();
CaseResult huge_polygon();
CaseResult subpixel_polygons();
CaseResult coords_65k();
CaseResult shared_edge_sheet();
CaseResult bad_numbers();
CaseResult zero_lights();
CaseResult all_black_all_white();
CaseResult disconnected();
CaseResult one_patch();
CaseResult patches_1e5();
CaseResult mirror_symmetry();
CaseResult permuted_input();
CaseResult close_plates();
CaseResult long_corridor();
CaseResult window_grid();

}  // namespace shodo::hard
