#include "machines/cases.h"

namespace machines {

namespace {

using shodo::FlagMode;
using shodo::Options;

void small(Options& o) {
  o.width = kSentWidth;
  o.height = kSentHeight;
}

void shapes(Options& o) {
  o.width = 96;
  o.height = 72;
  o.antialias = 16;
  o.row_value_bits = 64;
  o.tiers = 0;
}

void papers_rules(Options& o) {
  shapes(o);
  o.antialias = 1;
  o.row_value_bits = 16;
  o.tiers = 1e-3;
  o.rules.rule1 = o.rules.rule2 = o.rules.rule3 = true;
  o.flags = FlagMode::kOff;
}

void repeated_rule2(Options& o) {
  small(o);
  o.rules.rule2_repeated = true;
  o.interpolate = o.scale_rows = false;
  o.segments_first = 1;
}

void blocks(Options& o) {
  small(o);
  o.rules.blocks = true;
  o.refine = 1.5;
  o.segments_first = 1;
  o.segments_mixed = 16;
}

void gather(Options& o) {
  shapes(o);
  o.rules.blocks = true;
  o.gather = true;
  o.gather_lines = 64;
}

void room(Options& o) {
  o.refine = 0.2;
  o.segments_first = 1;
  o.segments_mixed = 16;
  o.width = 160;
  o.height = 128;
  o.rules.blocks = true;
  o.effects = false;  // without the outdoor picture; light asks for the textures
}

constexpr Case kCases[] = {
    {"box", "tests/cli/scenes/box.scn", small, Scarce::kAlways, true, true},
    {"sun", "tests/cli/scenes/sun.scn", small, Scarce::kNever, false, false},
    {"shapes", "tests/cli/scenes/shapes.scn", shapes, Scarce::kNever, false, false},
    {"rules", "tests/cli/scenes/shapes.scn", papers_rules, Scarce::kNever, false, false},
    {"rule2+", "tests/cli/scenes/box.scn", repeated_rule2, Scarce::kNever, false, false},
    {"blocks", "tests/cli/scenes/box.scn", blocks, Scarce::kIfFast, false, false},
    {"planes", "tests/cli/scenes/planes.scn", small, Scarce::kIfFast, false, false},
    {"textures", "tests/cli/scenes/textures.scn", small, Scarce::kNever, false, false},
    {"glass", "tests/cli/scenes/glass.scn", small, Scarce::kNever, false, true},
    {"gather", "tests/cli/scenes/shapes.scn", gather, Scarce::kNever, false, false},
    {"panes", "tests/cli/scenes/glass.scn", gather, Scarce::kNever, false, false},
    {"model", "tests/cli/scenes/model.scn", small, Scarce::kNever, false, false},
    {"luminaires", "tests/cli/scenes/luminaires.scn", gather, Scarce::kNever, false, false, true},
    {"day", "data/day.scn", room, Scarce::kNever, false, false},
};

}  // namespace

std::span<const Case> all_cases() { return kCases; }

}  // namespace machines
