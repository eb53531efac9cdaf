// Everything a caller can ask of a run; the defaults are those of the command line.
#pragma once

#include <cstdint>
#include <string_view>

namespace shodo {

enum class FlagMode : std::uint8_t { kOff, kAuto, kScene };

/// Which of the sparsity rules of paper 3.2 are used.
struct Rules {
  bool rule1 = false;
  bool rule2 = false;
  bool rule2_repeated = false;
  bool rule3 = false;
  bool blocks = false;
  double rule3_diameters = 0;   // 0: the default of the rule
  double blocks_error = 0;      // 0: the default
};

inline constexpr std::uint32_t kMostGatherLines = 65536;

struct Options {
  /// Whether sub-patches gather.
  constexpr bool gathers() const {
    return gather && !mirror_light && !rules.rule1 && !rules.rule2 && !rules.rule2_repeated && !rules.rule3;
  }

  FlagMode flags = FlagMode::kAuto;     // lossless; the rules are none (deviation D9)
  Rules rules;
  double tolerance = 1e-4;             // bound on the solver's error, of the largest illuminance
  double patch_size = 0;               // longest edge, scene units; 0: 1/24 of the scene's diagonal
  double sub_patch_size = 0;           // longest edge, scene units; 0: a third of the patch
  double refine = 1;                   // patch counts along each edge times this
  double tiers = 1e-3;                 // error allowed to a form factor's geometry, of A_j / (pi d^2); 0: the contour
                                       // integral always
  std::uint32_t segments_first = 16;   // segments a pair of patches: 1, 16, 64 or 256
  std::uint32_t segments_mixed = 64;   // the same, where some of the first are blocked and some not
  bool scale_rows = true;
  bool interpolate = true;
  bool gather = false;                 // every sub-patch gathers its ambient light (doc/gather.md); not with rules 1,
                                       // 2, 2+ and 3, which are the paper's, as its interpolation is, nor with light
                                       // that mirrors send on
  std::uint32_t gather_lines = 0;      // of a sub-patch on average, up to kMostGatherLines; 0: the
                                       // default
  std::uint32_t row_value_bits = 16;   // 16 or 64
  bool mirror_light = false;           // mirrors send light on, once
  bool effects = true;                 // textures, panes, mirrors, highlights and the background are drawn; else the
                                       // picture is made of illuminance maps and mean reflectances, as the paper's
  std::uint32_t width = 1280;          // pixels, 1 .. 16384
  std::uint32_t height = 1024;
  std::uint32_t antialias = 4;         // 1: a sample a pixel; 4, 16: what covers it along 2 or 4 rows
  std::string_view camera;             // empty: the first
};

}  // namespace shodo
