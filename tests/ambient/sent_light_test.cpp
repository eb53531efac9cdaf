// What sub-patches send, packed into 16 bits: against the value itself.
#include <gtest/gtest.h>

#include <cmath>

#include "ambient/sent_light.h"

namespace shodo {
namespace {

TEST(SentLight, ElevenBitsOfAValueAreKeptToTheNearest) {
  std::uint64_t seed = 1;
  double worst = 0, off = 0, large = 0;
  for (int k = 0; k < 200000; ++k) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    const std::uint32_t value = static_cast<std::uint32_t>(seed >> 32) >> (k % 32);
    const double found = SentLight::unpacked(SentLight::packed(value));
    if (value < 2048) {
      EXPECT_EQ(found, value);
    } else {
      worst = std::max(worst, std::abs(found / value - 1));
      if (value >= 1u << 20) off += found / value - 1, ++large;  // of smaller ones many lie half way, and go up
    }
  }
  EXPECT_LE(worst, 0x1p-11);  // half of the last of eleven bits, of a number whose first bit alone is set
  EXPECT_NEAR(off / large, 0, 3e-6);  // six standard errors
}

/// A value that rounds up to the next power of two, and the largest.
TEST(SentLight, CarriesAndTheLargestValueAreKept) {
  for (int width = 12; width < 32; ++width) {
    const std::uint32_t whole = std::uint32_t{1} << width;
    EXPECT_EQ(SentLight::unpacked(SentLight::packed(whole - 1)), whole) << width;
    EXPECT_EQ(SentLight::unpacked(SentLight::packed(whole)), whole) << width;
  }
  EXPECT_EQ(SentLight::unpacked(SentLight::packed(0xffffffffu)), 2047u << 21);
  EXPECT_EQ(SentLight::packed(0), 0);
}

TEST(SentLight, SaysWhenTheArenaIsTooSmall) {
  Scene scene;
  scene.sub_patch_count = 4;
  const float lx[4] = {1, 1, 1, 1};
  Arena none(nullptr, 0);
  EXPECT_FALSE(SentLight().take(scene, 1e-6, 0, DirectLight(), lx, none));
}

}  // namespace
}  // namespace shodo
