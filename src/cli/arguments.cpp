// The words one after the other, then what only all of them together can tell. What there is to say and how a value is
// read stand in cli/option_table.h and cli/option_values.h.
#include "cli/arguments.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "cli/option_table.h"
#include "cli/option_values.h"

namespace shodo {

namespace {

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
    for (const CommandName& command : all_commands()) {
      if (command.name == word) command_ = &command;
    }
    if (command_ == nullptr) {
      mistake_ = "expected a command (render, map, report, difference or check), found " + quoted(word);
    }
  }

  void read_option(std::string_view word) {
    std::string_view name = word, value;
    const bool attached = word.starts_with("--") && split(word, '=', name, value);
    const OptionRule* rule = nullptr;
    for (const OptionRule& option : all_options()) {
      if (option.name == name) rule = &option;
    }
    if (rule == nullptr) {
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
      check_scenes();
      if (mistake_.empty()) check_gather();
      if (mistake_.empty() && (command_->bit & kForOutput) != 0) check_outputs();
    }
  }

  void check_scenes() {
    const std::vector<std::string>& scenes = arguments_.scenes;
    for (auto at = scenes.begin(); at != scenes.end(); ++at) {
      if (std::find(scenes.begin(), at, *at) != at)
        mistake_ = std::string(command_->name) + ": expected each scene once, found " + quoted(*at) + " twice";
    }
  }

  /// Found in vain: the paper's rules have the paper's interpolation, and lines don't follow mirrors.
  void check_gather() {
    const Options& o = arguments_.options;
    if (!o.gather || o.gathers()) return;
    mistake_ = o.mirror_light ? "--gather works without --mirror-light, found on"
                              : "--gather works without --rules or with blocks alone, found 1, 2, 2+ or 3 beside it";
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
  for (const CommandName& command : all_commands()) add_line(text, "shodo " + std::string(command.usage), command.help);
  text += "\nOptions, with their defaults in brackets:\n";
  for (const OptionRule& rule : all_options()) {
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
