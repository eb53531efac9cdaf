// The cases of `shodo report`: which settings are run and compared. The list is data, in report_cases.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shodo/options.h"

namespace shodo {

/// What a case is about; decides its mark in the plots.
enum class CaseGroup : std::uint8_t { kFlags, kRules, kBlocks, kGather, kSegments, kPatches, kOther };
inline constexpr std::uint32_t kCaseGroups = 7;
std::string_view group_name(CaseGroup group);

struct ReportCase {
  std::uint32_t number = 0;  // from 1, in the order of the list
  CaseGroup group = CaseGroup::kFlags;
  Options options;
  double refine = 1;          // patch counts times this, over the base's
  std::string_view other;     // an option that the columns don't show, without its --; empty: none
};

/// Every case on top of the settings that the user gave; none twice. The first is flags auto without rules: the base.
/// `mirrors`: the scenes have some, so that the light which these send on is a case of its own.
std::vector<ReportCase> report_cases(const Options& base, bool mirrors = false);

/// What all are measured against: three times the patch counts along each edge, form factors to 1e-4 (or as the base,
/// if that is finer), 64-bit rows, no rules; every sub-patch gathers its ambient light. Light over mirrors as in the
/// base: with it, which a gather doesn't know, twice the counts, ambient light interpolated, by 64 and 256 segments.
Options reference_options(const Options& base);

std::string_view flags_text(FlagMode flags);
/// As --rules takes it: "none", "all", "1,2+", "blocks:0.01".
std::string rules_text(const Rules& rules);
/// "16,64"
std::string segments_text(const Options& options);
/// A decimal of at most 15 digits without an exponent, no longer than it must be: "0.5".
std::string number_text(double value);

/// As the command line takes them: flags, rules, refine and segments always, what else light depends on where it is not
/// as without options.
std::string options_text(const Options& options);

bool same_rules(const Rules& a, const Rules& b);
/// Equal in everything that a case can change.
bool same_settings(const Options& a, const Options& b);

/// The case with these flags and rules and everything else as in the base; nullptr if there is none. `blocks_error`
/// 0 matches the rule's default.
const ReportCase* find_case(const std::vector<ReportCase>& cases, FlagMode flags, const Rules& rules);

}  // namespace shodo
