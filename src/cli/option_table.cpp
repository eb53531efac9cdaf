#include "cli/option_table.h"

#include "cli/option_values.h"

namespace shodo {

namespace {

constexpr CommandName kCommands[] = {
    {"render", Command::kRender, kForRender, "render SCENE -o FILE.png|.ppm",
     "the picture: direct and ambient light, maps, scanlines"},
    {"map", Command::kMap, kForMap, "map SCENE -o DIR", "the illuminance maps, a PFM file a mesh"},
    {"report", Command::kReport, kForReport, "report SCENE... -o DIR",
     "the paper's table, and speed against error: HTML, Markdown, CSV"},
    {"difference", Command::kDifference, kForDifference, "difference A B [-o FILE.png|.ppm]",
     "two pictures (PPM, PNG) or maps (PFM): mean, root mean square, largest; FILE shows where"},
    {"check", Command::kCheck, kForCheck, "check SCENE",
     "what will be modelled, the lattice step, the memory it takes"},
};

// As coordinates in a scene file.
constexpr double kLargest = 1e30, kSmallest = 1e-30;

constexpr OptionRule kOptions[] = {
    {"-o", "FILE|DIR", kForOutput | kForDifference, "a name", "where the picture, the maps or the report go",
     [](std::string_view t, Arguments& a) { return take_text(t, a.output); }},
    {"--memory", "SIZE", kForAll, "bytes from 1 to 1024G, with K, M or G for their multiples",
     "budget for everything the library holds (8M)", take_memory},
    {"--flags", "off|auto|scene", kForOne, "off, auto or scene", "which blocking flags are used (auto)", take_flags},
    {"--rules", "LIST", kForOne,
     "none, all, or a list of 1, 2 or 2+, and 3, 3:D or blocks, blocks:REL (D from 0.1 to 1000, REL from 1e-9 to 1)",
     "which sparsity rules are used: none, all (1,2,3), or some of 1, 2 or 2+, and 3[:D] or blocks[:REL] (none)",
     take_rules},
    {"--tolerance", "REL", kForAll, "a number from 1e-12 to 1", "the solver's bound, of the largest illuminance (1e-4)",
     [](std::string_view t, Arguments& a) { return number_in(t, 1e-12, 1, a.options.tolerance); }},
    {"--patch", "SIZE", kForAll, "a number from 1e-30 to 1e30",
     "longest edge of a patch where the scene gives no counts, scene units (1/24 of the diagonal)",
     [](std::string_view t, Arguments& a) { return number_in(t, kSmallest, kLargest, a.options.patch_size); }},
    {"--sub-patch", "SIZE", kForAll, "a number from 1e-30 to 1e30",
     "the same of a sub-patch; finer near lights (a third of the patch)",
     [](std::string_view t, Arguments& a) { return number_in(t, kSmallest, kLargest, a.options.sub_patch_size); }},
    {"--refine", "K", kForAll, "a number from 0.001 to 1000", "patch counts times K along each edge (1)",
     [](std::string_view t, Arguments& a) { return number_in(t, 0.001, 1000, a.options.refine); }},
    {"--tiers", "REL|near", kForAll, "near, or a number from 1e-9 to 1",
     "error allowed to a form factor's geometry; near: always the contour integral (0.001)", take_tiers},
    {"--segments", "N,M", kForAll, "two of 1, 16, 64, 256, the second not smaller",
     "segments a pair, first and where visibility is mixed: 1, 16, 64 or 256 (16,64)", take_segments},
    {"--scale-rows", "on|off", kForAll, "on or off", "rows of form factors made to sum to 1 where they should (on)",
     [](std::string_view t, Arguments& a) { return on_or_off(t, a.options.scale_rows); }},
    {"--mirror-light", "on|off", kForAll, "on or off", "mirrors send light on, once (off)",
     [](std::string_view t, Arguments& a) { return on_or_off(t, a.options.mirror_light); }},
    {"--effects", "on|off", kForOne, "on or off",
     "textures, glass, mirrors, highlights and the background are drawn; off: illuminance maps alone (on)",
     [](std::string_view t, Arguments& a) { return on_or_off(t, a.options.effects); }},
    {"--interpolate", "on|off", kForAll, "on or off", "ambient light interpolated between patches (on)",
     [](std::string_view t, Arguments& a) { return on_or_off(t, a.options.interpolate); }},
    {"--gather", "on|off|N", kForAll, "on, off, or a whole number from 1 to 65536",
     "every sub-patch gathers its ambient light by N lines on average (on: 1024); not with rules 1, 2, 2+, 3 nor "
     "mirror light (off)",
     take_gather},
    {"--row-values", "16|64", kForAll, "16 or 64", "bits of a stored form factor (16)",
     [](std::string_view t, Arguments& a) {
       return one_of(t, {16, 64}, a.options.row_value_bits);
     }},
    {"--size", "WxH", kForPicture, "WxH in pixels, each from 1 to 16384", "the picture's size (1280x1024)", take_size},
    {"--antialias", "1|4|16", kForPicture, "1, 4 or 16", "1 sample a pixel, or exact edges along 2 or 4 rows (4)",
     [](std::string_view t, Arguments& a) {
       return one_of(t, {1, 4, 16}, a.options.antialias);
     }},
    {"--camera", "NAME", kForPicture, "a name", "which camera of the scene (the first)",
     [](std::string_view t, Arguments& a) {
       a.options.camera = t;
       return !t.empty();
     }},
    {"--false-colour", "auto|LOW,HIGH", kForRender,
     "auto, or LOW,HIGH in lux, LOW from 0, HIGH from 0.001 to 1e9 and above LOW",
     "illuminance as colours, with a legend: a logarithmic scale, or from LOW 0 a linear one", take_false_colour},
    {"--isolux", "auto|LIST", kForRender, "auto, or up to 100 ascending numbers from 0.001 to 1e9 with commas between",
     "lines of equal illuminance with their values, over the picture or its false colours", take_isolux},
    {"--show", "patches|sub-patches", kForRender, "patches or sub-patches", "their borders, over the picture",
     take_show},
    {"--csv", "FILE", kForTables, "a name, or - for standard output", "a table, one line a sub-patch",
     [](std::string_view t, Arguments& a) { return take_text(t, a.csv); }},
    {"--stats", "FILE", kForTables, "a name, or - for standard output",
     "what was counted and how long it took, as JSON",
     [](std::string_view t, Arguments& a) { return take_text(t, a.statistics); }},
    {"--summary", "FILE", kForTables, "a name, or - for standard output",
     "illuminance of each object and measuring plane: mean, least, greatest, uniformity, as CSV",
     [](std::string_view t, Arguments& a) { return take_text(t, a.summary); }},
    {"--quiet", "", kForEvery, "", "no progress, no warnings",
     [](std::string_view, Arguments& a) { return a.quiet = true; }},
    {"--help", "", kForEvery, "", "this text",
     [](std::string_view, Arguments& a) {
       a.command = Command::kHelp;
       return true;
     }},
    {"--version", "", kForEvery, "", "the version",
     [](std::string_view, Arguments& a) {
       a.command = Command::kVersion;
       return true;
     }},
};

}  // namespace

std::span<const CommandName> all_commands() { return kCommands; }

std::span<const OptionRule> all_options() { return kOptions; }

}  // namespace shodo
