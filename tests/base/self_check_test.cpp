// The self-check in every state that this processor can be put in. Other machines: tests/machines.
#include "base/self_check.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <string>

#include "shodo/shodo.h"
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace {

using shodo::StatusCode;

constexpr const char* kScene =
    "shodo 1\ncamera c eye 0 1 0 look 1 0 1 up 0 1 0 fov 60\nmaterial m diffuse 0.5\nobject o\n"
    "quad m 0 0 0  0 0 1  1 0 1  1 0 0\nlight l sun towards 0 -1 0 illuminance 100\n";

/// Nothing of GoogleTest runs while the processor is in another state.
template <class Enter, class Leave>
std::string fault_in(Enter enter, Leave leave) {
  enter();
  const char* const fault = shodo::arithmetic_fault();
  leave();
  return fault == nullptr ? "" : fault;
}

TEST(SelfCheck, PassesHere) {
  EXPECT_EQ(shodo::arithmetic_fault(), nullptr);
  EXPECT_TRUE(shodo::self_check().done());
}

TEST(SelfCheck, RefusesEveryOtherRoundingMode) {
  const auto leave = [] { std::fesetround(FE_TONEAREST); };
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    EXPECT_EQ(fault_in([mode] { std::fesetround(mode); }, leave), "doubles rounded once, to the nearest, ties to even");
  }
}

#if defined(__SSE2__)
TEST(SelfCheck, RefusesDenormalsMadeZero) {
  const unsigned normal = _mm_getcsr();
  constexpr unsigned kResultsToZero = 0x8000, kOperandsToZero = 0x0040;
  for (const unsigned bit : {kResultsToZero, kOperandsToZero}) {
    EXPECT_EQ(fault_in([&] { _mm_setcsr(normal | bit); }, [&] { _mm_setcsr(normal); }),
              "doubles below 2^-1022 kept, not made zero");
  }
}
#endif

TEST(SelfCheck, IsAskedBeforeLoadingSolvingAndDrawing) {
  alignas(8) static unsigned char memory[1 << 20];
  const auto upward = [] { std::fesetround(FE_UPWARD); };
  const auto nearest = [] { std::fesetround(FE_TONEAREST); };
  shodo::Model* model = nullptr;
  upward();
  const shodo::Status loaded = shodo::load("s", kScene, {}, {}, memory, sizeof memory, model);
  nearest();
  EXPECT_EQ(loaded.code, StatusCode::kFile);
  EXPECT_EQ(model, nullptr);
  EXPECT_STREQ(loaded.message,
               "this machine's arithmetic would change pixels: expected doubles rounded once, to the nearest, ties to "
               "even, found otherwise");
  ASSERT_TRUE(shodo::load("s", kScene, {}, {}, memory, sizeof memory, model).done());
  upward();
  const shodo::Status solved = shodo::solve(*model, {});
  nearest();
  EXPECT_EQ(solved.code, StatusCode::kFile);
  ASSERT_TRUE(shodo::solve(*model, {}).done());
  upward();
  const shodo::Status drawn = shodo::draw(*model, {}, {});
  nearest();
  EXPECT_EQ(drawn.code, StatusCode::kFile);
}

}  // namespace
