#include "cli/report_cases.h"

#include <algorithm>
#include <charconv>

#include "ambient/gather.h"

namespace shodo {

namespace {

constexpr Rules kNoRules{};
constexpr Rules kAllRules{.rule1 = true, .rule2 = true, .rule3 = true};

constexpr Rules blocks(double error) { return {.blocks = true, .blocks_error = error}; }

template <std::uint32_t kLines>
void gather_by(Options& options) {
  options.gather = true;
  options.gather_lines = kLines;
}

/// A line of the list; what is 0 or empty is as in the base.
struct Line {
  CaseGroup group;
  FlagMode flags = FlagMode::kAuto;
  Rules rules{};
  double refine = 1;
  std::uint32_t segments_first = 0, segments_mixed = 0;
  std::string_view other{};
  void (*change)(Options& options) = nullptr;
};

constexpr Line kLines[] = {
    // The paper's settings with and without flags, and what the flags alone do.
    {CaseGroup::kFlags},
    {CaseGroup::kFlags, FlagMode::kOff},
    {CaseGroup::kFlags, FlagMode::kScene},
    {CaseGroup::kFlags, FlagMode::kOff, kAllRules},
    {CaseGroup::kFlags, FlagMode::kScene, kAllRules},
    {CaseGroup::kFlags, FlagMode::kScene, blocks(0)},

    // The paper's rules, each alone and together; 2+.
    {CaseGroup::kRules, FlagMode::kAuto, {.rule1 = true}},
    {CaseGroup::kRules, FlagMode::kAuto, {.rule2 = true}},
    {CaseGroup::kRules, FlagMode::kAuto, {.rule2_repeated = true}},
    {CaseGroup::kRules, FlagMode::kAuto, {.rule1 = true, .rule2 = true}},
    {CaseGroup::kRules, FlagMode::kAuto, {.rule3 = true}},
    {CaseGroup::kRules, FlagMode::kAuto, kAllRules},
    {CaseGroup::kRules, FlagMode::kAuto, {.rule1 = true, .rule2_repeated = true, .rule3 = true}},

    // Rule 3 carried on.
    {CaseGroup::kBlocks, FlagMode::kAuto, blocks(0)},
    {CaseGroup::kBlocks, FlagMode::kAuto, blocks(0.03)},
    {CaseGroup::kBlocks, FlagMode::kAuto, blocks(0.01)},
    {CaseGroup::kBlocks, FlagMode::kAuto, blocks(0.003)},
    {CaseGroup::kBlocks, FlagMode::kAuto, blocks(0.0003)},
    {CaseGroup::kBlocks, FlagMode::kAuto, blocks(0.0001)},
    {CaseGroup::kBlocks, FlagMode::kAuto, {.rule2_repeated = true, .blocks = true}},
    {CaseGroup::kBlocks, FlagMode::kAuto, blocks(0), 1, 1, 1},
    {CaseGroup::kBlocks, FlagMode::kAuto, blocks(0.01), 1, 1, 1},

    // Sub-patches that gather.
    {CaseGroup::kGather, FlagMode::kAuto, blocks(0), 1, 0, 0, "gather 256", gather_by<256>},
    {CaseGroup::kGather, FlagMode::kAuto, blocks(0), 1, 0, 0, "gather 1024", gather_by<1024>},
    {CaseGroup::kGather, FlagMode::kAuto, blocks(0), 1, 0, 0, "gather 4096", gather_by<4096>},
    {CaseGroup::kGather, FlagMode::kAuto, blocks(0.001), 1, 0, 0, "gather 1024", gather_by<1024>},
    {CaseGroup::kGather, FlagMode::kAuto, kNoRules, 1, 0, 0, "gather 1024", gather_by<1024>},

    // Segments a pair.
    {CaseGroup::kSegments, FlagMode::kAuto, kNoRules, 1, 1, 1},
    {CaseGroup::kSegments, FlagMode::kAuto, kNoRules, 1, 16, 16},
    {CaseGroup::kSegments, FlagMode::kAuto, kNoRules, 1, 16, 64},
    {CaseGroup::kSegments, FlagMode::kAuto, kNoRules, 1, 64, 64},

    // Sizes of patches.
    {CaseGroup::kPatches, FlagMode::kAuto, kNoRules, 0.5},
    {CaseGroup::kPatches, FlagMode::kAuto, kNoRules, 0.5, 1, 1},
    {CaseGroup::kPatches, FlagMode::kAuto, blocks(0), 0.5},
    {CaseGroup::kPatches, FlagMode::kAuto, kNoRules, 2, 1, 1},
    {CaseGroup::kPatches, FlagMode::kAuto, blocks(0), 2},
    {CaseGroup::kPatches, FlagMode::kAuto, blocks(0.01), 2},
    {CaseGroup::kPatches, FlagMode::kAuto, blocks(0.01), 2, 1, 1},

    // The other approximations, each turned off alone.
    {CaseGroup::kOther, FlagMode::kAuto, kNoRules, 1, 0, 0, "interpolate off",
     [](Options& o) { o.interpolate = false; }},
    {CaseGroup::kOther, FlagMode::kAuto, kNoRules, 1, 0, 0, "scale-rows off",
     [](Options& o) { o.scale_rows = false; }},
    {CaseGroup::kOther, FlagMode::kAuto, kNoRules, 1, 0, 0, "row-values 64",
     [](Options& o) { o.row_value_bits = 64; }},
    {CaseGroup::kOther, FlagMode::kAuto, kNoRules, 1, 0, 0, "tiers near",
     [](Options& o) { o.tiers = 0; }},
    {CaseGroup::kOther, FlagMode::kAuto, kNoRules, 1, 0, 0, "mirror-light on",
     [](Options& o) { o.mirror_light = true; }},
};

std::uint32_t lines_of(const Options& options) {
  return options.gather_lines == 0 ? kGatherLines : options.gather_lines;
}

Options options_of(const Line& line, const Options& base) {
  Options options = base;
  options.flags = line.flags;
  options.rules = line.rules;
  options.refine = base.refine * line.refine;
  if (line.segments_first != 0) {
    options.segments_first = line.segments_first;
    options.segments_mixed = line.segments_mixed;
  }
  if (line.change != nullptr) line.change(options);
  return options;
}

}  // namespace

std::string_view group_name(CaseGroup group) {
  switch (group) {
    case CaseGroup::kFlags: return "flags";
    case CaseGroup::kRules: return "the paper's rules";
    case CaseGroup::kBlocks: return "blocks";
    case CaseGroup::kGather: return "gather";
    case CaseGroup::kSegments: return "segments";
    case CaseGroup::kPatches: return "patch size";
    case CaseGroup::kOther: return "other settings";
  }
  return "";
}

std::vector<ReportCase> report_cases(const Options& base, bool mirrors) {
  std::vector<ReportCase> cases;
  for (const Line& line : kLines) {
    const Options options = options_of(line, base);
    if (options.mirror_light != base.mirror_light && (!mirrors || base.gather)) continue;
    if (line.group == CaseGroup::kGather && !options.gathers()) continue;
    const auto there = [&](const ReportCase& c) { return same_settings(c.options, options); };
    if (std::any_of(cases.begin(), cases.end(), there)) continue;
    const std::uint32_t number = static_cast<std::uint32_t>(cases.size()) + 1;
    cases.push_back({number, line.group, options, line.refine, line.other});
  }
  return cases;
}

Options reference_options(const Options& base) {
  constexpr double kTiers = 1e-4;
  constexpr std::uint32_t kLines = 4096;
  const bool gathers = !base.mirror_light;
  const std::uint32_t first = gathers ? 16 : 64, mixed = gathers ? 64 : 256;
  Options options = base;
  options.flags = FlagMode::kAuto;
  options.rules = {};
  options.refine = (gathers ? 3 : 2) * base.refine;
  options.tiers = std::min(base.tiers, kTiers);
  options.segments_first = std::max(base.segments_first, first);
  options.segments_mixed = std::max(base.segments_mixed, mixed);
  options.row_value_bits = 64;
  options.scale_rows = true;
  options.interpolate = true;
  options.gather = gathers;
  options.gather_lines = kLines;
  return options;
}

std::string_view flags_text(FlagMode flags) {
  switch (flags) {
    case FlagMode::kOff: return "off";
    case FlagMode::kAuto: return "auto";
    case FlagMode::kScene: return "scene";
  }
  return "";
}

std::string number_text(double value) {
  char digits[400];  // without an exponent the smallest double takes 341
  auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 14).ptr;
  std::from_chars(digits, end, value);
  end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed).ptr;
  return {digits, end};
}

std::string rules_text(const Rules& rules) {
  if (same_rules(rules, kNoRules)) return "none";
  if (same_rules(rules, kAllRules)) return "all";
  std::string text;
  const auto add = [&](bool given, std::string_view name, double value) {
    if (!given) return;
    text.append(text.empty() ? "" : ",").append(name);
    if (value != 0) text.append(":").append(number_text(value));
  };
  add(rules.rule1, "1", 0);
  add(rules.rule2, "2", 0);
  add(rules.rule2_repeated, "2+", 0);
  add(rules.rule3, "3", rules.rule3_diameters);
  add(rules.blocks, "blocks", rules.blocks_error);
  return text;
}

std::string segments_text(const Options& options) {
  return std::to_string(options.segments_first) + "," + std::to_string(options.segments_mixed);
}

std::string options_text(const Options& options) {
  const Options defaults;
  std::string text = "--flags " + std::string(flags_text(options.flags)) + " --rules " + rules_text(options.rules) +
                     " --refine " + number_text(options.refine) + " --segments " + segments_text(options);
  const auto add = [&](bool differs, std::string_view name, const std::string& value) {
    if (differs) text.append(" --").append(name).append(" ").append(value);
  };
  add(options.patch_size != defaults.patch_size, "patch", number_text(options.patch_size));
  add(options.sub_patch_size != defaults.sub_patch_size, "sub-patch", number_text(options.sub_patch_size));
  add(options.tolerance != defaults.tolerance, "tolerance", number_text(options.tolerance));
  add(options.tiers != defaults.tiers, "tiers", options.tiers > 0 ? number_text(options.tiers) : "near");
  add(!options.interpolate, "interpolate", "off");
  add(!options.scale_rows, "scale-rows", "off");
  add(options.row_value_bits != defaults.row_value_bits, "row-values", std::to_string(options.row_value_bits));
  add(options.mirror_light, "mirror-light", "on");
  add(options.gathers(), "gather", std::to_string(lines_of(options)));
  return text;
}

bool same_rules(const Rules& a, const Rules& b) {
  return a.rule1 == b.rule1 && a.rule2 == b.rule2 && a.rule2_repeated == b.rule2_repeated && a.rule3 == b.rule3 &&
         a.blocks == b.blocks && a.rule3_diameters == b.rule3_diameters && a.blocks_error == b.blocks_error;
}

bool same_settings(const Options& a, const Options& b) {
  return a.flags == b.flags && same_rules(a.rules, b.rules) && a.refine == b.refine &&
         a.segments_first == b.segments_first && a.segments_mixed == b.segments_mixed &&
         a.interpolate == b.interpolate && a.scale_rows == b.scale_rows && a.row_value_bits == b.row_value_bits &&
         a.tiers == b.tiers && a.mirror_light == b.mirror_light && a.gathers() == b.gathers() &&
         (!a.gathers() || lines_of(a) == lines_of(b));
}

const ReportCase* find_case(const std::vector<ReportCase>& cases, FlagMode flags, const Rules& rules) {
  Options wanted = cases.front().options;
  wanted.flags = flags;
  wanted.rules = rules;
  const auto matches = [&](const ReportCase& c) { return same_settings(c.options, wanted); };
  const auto at = std::find_if(cases.begin(), cases.end(), matches);
  return at == cases.end() ? nullptr : &*at;
}

}  // namespace shodo
