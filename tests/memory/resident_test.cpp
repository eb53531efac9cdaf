// What the whole process holds, writing PPM: the budget and a constant (doc/memory.md).
#include <gtest/gtest.h>

#include "faults/watched_run.h"

namespace shodo {
namespace {

/// doc/memory.md: the program's code and data, the C and C++ libraries, stack, heap. 3.5 to 4.1 MiB were seen: which
/// pages of a library come with one that is touched depends on where it lies.
constexpr long kConstantKib = 5 * 1024;

long peak_kib(const std::string& memory, const std::string& size, const std::string& file) {
  const TestFolder folder;
  const WatchedOutcome outcome = watched_run(
      {"render", test_scene("shapes.scn"), "-o", file, "--memory", memory, "--size", size, "--refine", "4",
       "--segments", "1,1"},
      folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.seen.at("peak_kib");
}

TEST(Resident, APpmKeepsTheProcessWithinTheBudgetAndAConstant) {
  // 3,072 x 3,072 pixels are 27 MiB: no frame is held.
  for (const std::string size : {"64x48", "3072x3072"}) {
    const long small = peak_kib("1M", size, "x.ppm"), large = peak_kib("8M", size, "x.ppm");
    EXPECT_LE(small, 1024 + kConstantKib);
    EXPECT_LE(large, 8192 + kConstantKib);
  }
}

TEST(Resident, APngTakesWhatCheckNamesBesides) {
  const Outcome check = run({"check", test_scene("shapes.scn"), "--size", "1024x1024"});
  const std::string before = "a PNG of 1024 x 1024 takes up to ";
  const std::size_t at = check.out.find(before);
  ASSERT_NE(at, std::string::npos) << check.out;
  std::string digits;
  for (std::size_t k = at + before.size(); check.out[k] != ' '; ++k) {
    if (check.out[k] != ',') digits += check.out[k];
  }
  const long named_kib = std::stol(digits) / 1024;
  const long png = peak_kib("1M", "1024x1024", "x.png");
  EXPECT_LE(png, 1024 + named_kib + kConstantKib);
  EXPECT_GT(png, 1024 + 3 * 1024) << "the frame is there";
}

}  // namespace
}  // namespace shodo
