// The command line (contract 1), read strictly: what is unknown, missing or out of range is refused, never guessed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/measured_options.h"
#include "shodo/options.h"

namespace shodo {

enum class Command : std::uint8_t { kNone, kRender, kMap, kReport, kDifference, kCheck, kHelp, kVersion };

struct Arguments {
  Command command = Command::kNone;
  std::string scene;                // the first
  std::vector<std::string> scenes;  // all of them: report takes more than one, difference two files
  std::string output;              // -o: a picture's file, the maps' or the report's folder
  std::uint64_t memory = 8 << 20;  // bytes
  Options options;                 // options.camera views the words of the command line
  std::string csv;                 // "-": standard output; empty: none
  std::string statistics;
  std::string summary;
  MeasuredOptions measured;
  bool quiet = false;
};

/// False, and `mistake` one line, if the words are wrong. `words` must stay: some of the options view them.
bool parse_arguments(int count, char** words, Arguments& arguments, std::string& mistake);

/// What --help prints.
std::string help_text();

inline constexpr const char* kVersion = "shodo 0.1.0";

/// 8388608 as "8M", 1000 as "1000": the way --memory takes it.
std::string size_text(std::uint64_t bytes);

}  // namespace shodo
