// One table says everything of an option: its name, what it takes, who takes it, its help. Reading, the messages and
// --help all follow it.
#include "cli/arguments.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/decimal.h"

namespace shodo {

namespace {

constexpr unsigned kForRender = 1, kForMap = 2, kForCheck = 4, kForReport = 8, kForDifference = 16;
constexpr unsigned kForOne = kForRender | kForMap | kForCheck;  // a report has its own list of flags and rules
constexpr unsigned kForAll = kForOne | kForReport;
constexpr unsigned kForPicture = kForRender | kForReport | kForCheck;
constexpr unsigned kForTables = kForRender | kForMap;
constexpr unsigned kForOutput = kForTables | kForReport;
constexpr unsigned kForEvery = kForAll | kForDifference;

struct CommandName {
  std::string_view name;
  Command command;
  unsigned bit;
  std::string_view usage;
  std::string_view help;
};

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

bool number_in(std::string_view text, double least, double most, double& value) {
  const DecimalResult number = parse_decimal(text);
  if (number.error != DecimalError::none || !(number.value >= least && number.value <= most)) return false;
  value = number.value;
  return true;
}

bool one_of(std::string_view text, std::initializer_list<std::uint32_t> allowed, std::uint32_t& value) {
  std::uint32_t number = 0;
  if (!parse_unsigned(text, number) || std::find(allowed.begin(), allowed.end(), number) == allowed.end()) return false;
  value = number;
  return true;
}

bool on_or_off(std::string_view text, bool& value) {
  if (text != "on" && text != "off") return false;
  value = text == "on";
  return true;
}

/// Two parts around the first `separator`.
bool split(std::string_view text, char separator, std::string_view& left, std::string_view& right) {
  const std::size_t at = text.find(separator);
  if (at == std::string_view::npos) return false;
  left = text.substr(0, at);
  right = text.substr(at + 1);
  return true;
}

bool take_memory(std::string_view text, Arguments& a) {
  unsigned shift = 0;
  if (!text.empty()) {
    const std::size_t unit = std::string_view("KMG").find(text.back());
    if (unit != std::string_view::npos) {
      shift = 10 * (static_cast<unsigned>(unit) + 1);
      text.remove_suffix(1);
    }
  }
  std::uint64_t bytes = 0;
  if (text.empty() || text.size() > 15) return false;
  for (const char c : text) {
    if (c < '0' || c > '9') return false;
    bytes = 10 * bytes + static_cast<std::uint64_t>(c - '0');
  }
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
  if (bytes == 0 || bytes > (kMost >> shift)) return false;
  a.memory = bytes << shift;
  return true;
}

bool take_segments(std::string_view text, Arguments& a) {
  std::string_view first, mixed;
  std::uint32_t n = 0, m = 0;
  if (!split(text, ',', first, mixed) || !one_of(first, {1, 16, 64, 256}, n) || !one_of(mixed, {1, 16, 64, 256}, m))
    return false;
  if (n > m) return false;
  a.options.segments_first = n;
  a.options.segments_mixed = m;
  return true;
}

bool take_size(std::string_view text, Arguments& a) {
  constexpr std::uint32_t kMost = 16384;
  std::string_view w, h;
  std::uint32_t width = 0, height = 0;
  if (!split(text, 'x', w, h) || !parse_unsigned(w, width) || !parse_unsigned(h, height)) return false;
  if (width < 1 || width > kMost || height < 1 || height > kMost) return false;
  a.options.width = width;
  a.options.height = height;
  return true;
}

bool take_flags(std::string_view text, Arguments& a) {
  a.options.flags = text == "off" ? FlagMode::kOff : text == "scene" ? FlagMode::kScene : FlagMode::kAuto;
  return text == "off" || text == "auto" || text == "scene";
}

/// One item of the list; none may come twice, nor 3 beside blocks or 2 beside 2+.
bool take_rule(std::string_view item, Rules& rules) {
  std::string_view name = item, value;
  const bool has_value = split(item, ':', name, value);
  if (name == "3" && !rules.rule3 && !rules.blocks) {
    rules.rule3 = true;
    return !has_value || number_in(value, 0.1, 1000, rules.rule3_diameters);
  }
  if (name == "blocks" && !rules.rule3 && !rules.blocks) {
    rules.blocks = true;
    return !has_value || number_in(value, 1e-9, 1, rules.blocks_error);
  }
  bool* const rule = item == "1"    ? &rules.rule1
                     : item == "2"  ? &rules.rule2
                     : item == "2+" ? &rules.rule2_repeated
                                    : nullptr;
  if (rule == nullptr || *rule) return false;
  *rule = true;
  return !(rules.rule2 && rules.rule2_repeated);
}

bool take_rules(std::string_view text, Arguments& a) {
  Rules rules;
  if (text == "all") {
    rules.rule1 = rules.rule2 = rules.rule3 = true;
  } else if (text != "none") {
    std::string_view item, rest = text;
    for (bool more = true; more;) {
      item = rest;
      more = split(rest, ',', item, rest);
      if (!take_rule(item, rules)) return false;
    }
  }
  a.options.rules = rules;
  return true;
}

bool take_tiers(std::string_view text, Arguments& a) {
  a.options.tiers = 0;
  return text == "near" || number_in(text, 1e-9, 1, a.options.tiers);
}

constexpr double kMostLux = 1e9;

bool take_false_colour(std::string_view text, Arguments& a) {
  a.measured.false_colour = true;
  std::string_view low, high;
  LuxScale& scale = a.measured.scale;
  return text == "auto" || (split(text, ',', low, high) && number_in(low, 0, kMostLux, scale.low) &&
                            number_in(high, 1e-3, kMostLux, scale.high) && scale.low < scale.high);
}

bool take_isolux(std::string_view text, Arguments& a) {
  constexpr std::size_t kMost = 100;
  a.measured.isolux = true;
  if (text == "auto") return true;
  std::string_view item, rest = text;
  for (bool more = true; more;) {
    item = rest;
    more = split(rest, ',', item, rest);
    double level = 0;
    std::vector<double>& levels = a.measured.levels;
    if (!number_in(item, 1e-3, kMostLux, level) || levels.size() == kMost) return false;
    if (!levels.empty() && level <= levels.back()) return false;
    levels.push_back(level);
  }
  return true;
}

bool take_show(std::string_view text, Arguments& a) {
  a.measured.show = text == "patches" ? MeasuredOptions::Show::kPatches : MeasuredOptions::Show::kSubPatches;
  return text == "patches" || text == "sub-patches";
}

bool take_gather(std::string_view text, Arguments& a) {
  a.options.gather_error = 0;
  if (on_or_off(text, a.options.gather)) return true;
  a.options.gather = true;
  return number_in(text, 1e-9, 1, a.options.gather_error);
}

bool take_text(std::string_view text, std::string& value) {
  value = text;
  return !text.empty();
}

// As coordinates in a scene file.
constexpr double kLargest = 1e30, kSmallest = 1e-30;

struct OptionRule {
  std::string_view name;
  std::string_view value;  // its name in --help; empty: takes none
  unsigned commands;
  std::string_view expected;  // in messages
  std::string_view help;
  bool (*take)(std::string_view text, Arguments& arguments);
};

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
     "segments a pair, first and where visibility is mixed (16,64)", take_segments},
    {"--scale-rows", "on|off", kForAll, "on or off", "rows of form factors made to sum to 1 where they should (on)",
     [](std::string_view t, Arguments& a) { return on_or_off(t, a.options.scale_rows); }},
    {"--mirror-light", "on|off", kForAll, "on or off", "mirrors send light on, once (off)",
     [](std::string_view t, Arguments& a) { return on_or_off(t, a.options.mirror_light); }},
    {"--effects", "on|off", kForOne, "on or off",
     "textures, glass, mirrors, highlights and the background are drawn; off: illuminance maps alone (on)",
     [](std::string_view t, Arguments& a) { return on_or_off(t, a.options.effects); }},
    {"--interpolate", "on|off", kForAll, "on or off", "ambient light interpolated between patches (on)",
     [](std::string_view t, Arguments& a) { return on_or_off(t, a.options.interpolate); }},
    {"--gather", "on|off|REL", kForAll, "on, off, or a number from 1e-9 to 1",
     "every sub-patch gathers its ambient light, REL: error of one sender's, of the mean; not with rules 1, 2, 2+, 3 "
     "(off)",
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

std::string quoted(std::string_view text) { return std::string(1, '\'').append(text).append("'"); }

bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() > ending.size() && name.ends_with(ending);
}

/// Reads the words one after the other; `mistake` stays empty if all is well.
class Words {
 public:
  Words(int count, char** words, Arguments& arguments, std::string& mistake)
      : words_(words + std::min(count, 1), words + count), arguments_(arguments), mistake_(mistake) {}

  bool read() {
    while (next_ < words_.size() && mistake_.empty()) read_word(words_[next_++]);
    if (mistake_.empty() && arguments_.command != Command::kHelp && arguments_.command != Command::kVersion) check();
    return mistake_.empty();
  }

 private:
  void read_word(std::string_view word) {
    if (word.starts_with("-") && word != "-") return read_option(word);
    if (command_ == nullptr) return read_command(word);
    if (command_->command == Command::kDifference) {
      read_file(word);
    } else if (!arguments_.scene.empty() && command_->command != Command::kReport) {
      mistake_ = "expected one scene, found " + quoted(word) + " after " + quoted(arguments_.scene);
    } else if (word.empty() || word == "-") {
      mistake_ = "expected the name of a scene file, found " + quoted(word);
    } else {
      if (arguments_.scene.empty()) arguments_.scene = word;
      arguments_.scenes.emplace_back(word);
    }
  }

  /// One of the two that are compared.
  void read_file(std::string_view word) {
    if (arguments_.scenes.size() == 2) {
      mistake_ = "difference: expected two files, found " + quoted(word) + " after " + quoted(arguments_.scenes[1]);
    } else if (word.empty() || word == "-") {
      mistake_ = "difference: expected the name of a file, found " + quoted(word);
    } else {
      arguments_.scenes.emplace_back(word);
    }
  }

  void read_command(std::string_view word) {
    const auto at =
        std::find_if(std::begin(kCommands), std::end(kCommands), [&](const auto& c) { return c.name == word; });
    if (at != std::end(kCommands)) {
      command_ = at;
    } else {
      mistake_ = "expected a command (render, map, report, difference or check), found " + quoted(word);
    }
  }

  void read_option(std::string_view word) {
    std::string_view name = word, value;
    const bool attached = word.starts_with("--") && split(word, '=', name, value);
    const auto rule =
        std::find_if(std::begin(kOptions), std::end(kOptions), [&](const auto& o) { return o.name == name; });
    if (rule == std::end(kOptions)) {
      mistake_ = "unknown option " + quoted(name);
      return;
    }
    if (std::find(seen_.begin(), seen_.end(), rule) != seen_.end()) {
      mistake_ = std::string(name) + " is given twice";
      return;
    }
    seen_.push_back(rule);
    if (rule->value.empty()) {
      if (attached) mistake_ = std::string(name) + " takes no value, found " + quoted(value);
    } else if (!attached) {
      if (next_ == words_.size() || words_[next_].starts_with("--")) {
        mistake_ = std::string(name) + ": expected " + std::string(rule->expected) + ", found nothing";
        return;
      }
      value = words_[next_++];
    }
    if (mistake_.empty() && !rule->take(value, arguments_)) {
      mistake_ = std::string(name) + ": expected " + std::string(rule->expected) + ", found " + quoted(value);
    }
  }

  /// What only all words together can tell.
  void check() {
    if (command_ == nullptr) {
      mistake_ = "expected a command (render, map, report, difference or check), found none";
      return;
    }
    arguments_.command = command_->command;
    for (const OptionRule* rule : seen_) {
      if ((rule->commands & command_->bit) == 0) {
        mistake_ = std::string(rule->name) + " has no meaning for " + std::string(command_->name);
        return;
      }
    }
    if (command_->command == Command::kDifference) {
      check_difference();
    } else if (arguments_.scene.empty()) {
      mistake_ = std::string(command_->name) + ": expected a scene file, found none";
    } else {
      check_gather();
      if (mistake_.empty() && (command_->bit & kForOutput) != 0) check_outputs();
    }
  }

  /// Found in vain: the paper's rules have the paper's interpolation.
  void check_gather() {
    const Options& o = arguments_.options;
    if (!o.gather || o.gathers()) return;
    mistake_ = "--gather works without --rules or with blocks alone, found 1, 2, 2+ or 3 beside it";
  }

  void check_difference() {
    const Arguments& a = arguments_;
    if (a.scenes.size() < 2) {
      const std::string found = a.scenes.empty() ? "none" : quoted(a.scenes[0]) + " alone";
      mistake_ = "difference: expected two files, found " + found;
    } else if (!a.output.empty() && !has_ending(a.output, ".png") && !has_ending(a.output, ".ppm")) {
      mistake_ = "-o: expected a name that ends in .png or .ppm, found " + quoted(a.output);
    }
  }

  void check_outputs() {
    const Arguments& a = arguments_;
    const bool is_picture = a.command == Command::kRender;
    if (a.output.empty()) {
      mistake_ = std::string(command_->name) + ": expected -o and where the " +
                 (is_picture ? "picture goes" : a.command == Command::kMap ? "maps go" : "report goes") +
                 ", found nothing";
    } else if (is_picture && !has_ending(a.output, ".png") && !has_ending(a.output, ".ppm")) {
      mistake_ = "-o: expected a name that ends in .png or .ppm, found " + quoted(a.output);
    } else if (!is_picture && a.output == "-") {
      mistake_ = "-o: expected the name of a folder, found '-'";
    } else {
      const std::string names[] = {a.output, a.csv, a.statistics, a.summary};
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t before = 0; before < k; ++before) {
          if (names[k].empty() || names[k] != names[before]) continue;
          mistake_ = "two outputs have the same name " + quoted(names[k]);
        }
      }
    }
  }

  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
  Arguments& arguments_;
  std::string& mistake_;
  const CommandName* command_ = nullptr;
  std::vector<const OptionRule*> seen_;
};

/// `left` in a column of its own, `right` beside it.
void add_line(std::string& text, std::string left, std::string_view right) {
  constexpr std::size_t kColumn = 38;
  left.resize(std::max(left.size() + 1, kColumn), ' ');
  text += "  " + left + std::string(right) + "\n";
}

}  // namespace

bool parse_arguments(int count, char** words, Arguments& arguments, std::string& mistake) {
  return Words(count, words, arguments, mistake).read();
}

std::string help_text() {
  std::string text = "shodo renders interreflected light: deterministic, exact, inside a memory budget.\n\n";
  for (const CommandName& command : kCommands) add_line(text, "shodo " + std::string(command.usage), command.help);
  text += "\nOptions, with their defaults in brackets:\n";
  for (const OptionRule& rule : kOptions) {
    const std::string gap = rule.value.empty() ? "" : " ";
    add_line(text, std::string(rule.name) + gap + std::string(rule.value), rule.help);
  }
  text +=
      "\nExit status: 0 done, 1 a file could not be read or written, or this machine's arithmetic is not the one\n"
      "expected, 2 wrong usage, 3 the scene is wrong, 4 the memory budget is too small (the smallest that works is\n"
      "named), 130 interrupted.\n";
  return text;
}

std::string size_text(std::uint64_t bytes) {
  const char* units = " KMG";
  std::size_t unit = 0;
  for (; unit < 3 && bytes != 0 && bytes % 1024 == 0; ++unit) bytes /= 1024;
  return std::to_string(bytes) + (unit == 0 ? "" : std::string(1, units[unit]));
}

}  // namespace shodo
