// The program with tests/faults/system_faults.cpp in front of the system: what it called, what it left behind.
#pragma once

#include <cstdlib>
#include <map>
#include <sstream>
#include <string>

#include "cli/program.h"

namespace shodo {

struct WatchedOutcome : Outcome {
  std::map<std::string, long> seen;  // calls by name, and "blocks", "descriptors", "maps", "peak_kib"

  /// Nothing is left that isn't left at the end of a usual run: what the C library keeps for itself.
  bool gave_all_back(const WatchedOutcome& usual) const {
    return seen.at("blocks") <= usual.seen.at("blocks") && seen.at("descriptors") == 0 && seen.at("maps") == 0;
  }
};

/// `fault`: as SHODO_FAULT takes it; empty: none.
inline WatchedOutcome watched_run(const Running::Words& words, const std::string& folder,
                                  const std::string& fault = "") {
  const std::string program = program_path();
  const std::string shim = program.substr(0, program.rfind('/') + 1) + "system_faults.so";
  const TestFolder scratch;
  setenv("LD_PRELOAD", shim.c_str(), 1);
  setenv("SHODO_LOG", (scratch / "log").c_str(), 1);
  setenv("SHODO_FAULT", fault.c_str(), 1);
  Running running(words, folder);
  for (const char* name : {"LD_PRELOAD", "SHODO_LOG", "SHODO_FAULT"}) unsetenv(name);
  WatchedOutcome outcome;
  static_cast<Outcome&>(outcome) = running.wait();
  std::istringstream log(file_text(scratch / "log"));
  for (std::string name; log >> name;) log >> outcome.seen[name];
  return outcome;
}

}  // namespace shodo
