// Sweeps of one parameter over many decades: our error and that of the textbook's formula, for doc/stability.md.
#pragma once

#include <string>
#include <vector>

namespace shodo::hard {

struct SweepPoint {
  double x = 0;
  double ours = 0, textbook = 0;  // relative errors
};

struct Sweep {
  const char* name;  // of its files
  const char* title;
  const char* x_title;
  const char* y_title;
  const char* textbook;  // what it is
  std::vector<SweepPoint> (*run)();
  double allowed;   // what ours keeps within, all along
  double from, to;  // where that is asserted
};

const std::vector<Sweep>& sweeps();

}  // namespace shodo::hard
