// What every machine runs: small scenes that between them use every kind of light and mesh, grey and colour, all rules,
// full and scarce memory; and the paper's room by day with coarser patches. Freestanding, as the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "shodo/shodo.h"

namespace machines {

/// Whether a case runs once more in the smallest memory that works, to the same hashes.
enum class Scarce : std::uint8_t { kNever, kIfFast, kAlways };

struct Case {
  const char* name;
  const char* scene;                  // among the files compiled in
  void (*choose)(shodo::Options&);
  Scarce scarce;
  bool sent;                          // its picture leaves the machine as it is drawn
  bool lean;                          // the lean library (tools/machines) can do it; else it must refuse
  bool luminaires = false;            // a library without them must refuse it
};

std::span<const Case> all_cases();

/// The library's budget, fixed when the program is built.
inline constexpr std::size_t kBudgetBytes = 640 << 10;

/// Pixels of the picture that is sent.
inline constexpr std::uint32_t kSentWidth = 64, kSentHeight = 48;

/// The scene files, compiled in.
shodo::Reader compiled_in();
bool find_file(std::string_view path, std::string_view& text);

/// What a machine must offer.
struct Machine {
  std::span<unsigned char> memory;    // kBudgetBytes
  void (*print)(const char* text);    // for the log
  shodo::LineSink picture;            // takes the lines of the case that is sent, each as it is finished
  bool fast;
};

/// Runs all cases, or the one of that name, and compares with hashes.h. Prints a line a case, and one of all:
///   case NAME maps H picture H same|differs peak BYTES
///   case NAME refused WORD or MESSAGE             of a library built without what it needs (base/features.h)
///   all maps H picture H same|differs peak BYTES
/// The process's exit status: 0 if all hashes are the constants, else 1.
int run_cases(const Machine& machine, std::string_view only);

}  // namespace machines
