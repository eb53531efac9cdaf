// Sums of what lines bring, in 31 bits and a scale, against sums in doubles, which hold them exactly.
#include "ambient/gathered_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/visibility/scenes.h"

namespace shodo {
namespace {

constexpr double kUnit = 0x1p-12;  // lux

struct Gathering {
  Gathering(std::uint32_t channels, std::uint32_t count) : lx(std::size_t{count} * channels) {
    scene.channels = channels;
    scene.sub_patch_count = count;
    for (std::size_t k = 0; k < lx.size(); ++k) lx[k] = 0.25f + 3.5f * static_cast<float>(k);
    memory.resize(GatheredSums::bytes(scene).rest / 8);
    elsewhere.resize(GatheredSums::bytes(scene).lines / 8);
  }
  bool takes(std::size_t bytes, std::size_t bytes_elsewhere) {
    Arena arena(memory.data(), bytes), for_lines(elsewhere.data(), bytes_elsewhere);
    if (!sums.take(scene, lx, arena, for_lines)) return false;
    EXPECT_EQ(arena.used(), bytes);
    EXPECT_EQ(for_lines.used(), bytes_elsewhere);
    return true;
  }
  void take() { ASSERT_TRUE(takes(8 * memory.size(), 8 * elsewhere.size())); }
  /// A line that brings the same in each channel.
  void add(std::uint32_t sub_patch, std::uint32_t units) {
    const auto same = [&](std::uint32_t) { return units; };
    ASSERT_TRUE(sums.count(sub_patch));
    if (scene.channels == 1) {
      sums.add<1>(sub_patch, same);
    } else {
      sums.add<3>(sub_patch, same);
    }
  }

  Scene scene;
  std::vector<float> lx;
  std::vector<std::uint64_t> memory, elsewhere;
  GatheredSums sums;
};

/// A sum loses less than its last place by being started, by each line, and by all halvings together. That is at most a
/// part in 2^30 of the brightest channel's, or, as long as nothing has been halved, two units, of which one a line.
double most_lost(double lines, double brightest) { return (lines + 2) * std::max(1.0, brightest * 0x1p-30); }

template <std::uint32_t kChannels>
void expect_sums_of_random_lines(std::uint64_t seed) {
  constexpr std::uint32_t kCount = 120;
  Gathering gathering(kChannels, kCount);
  Random random(seed);
  double truth[kCount][3] = {};
  int bits[kCount][3] = {};
  std::uint32_t lines[kCount] = {}, prior[kCount] = {};
  for (std::uint32_t k = 0; k < kCount; ++k) {
    prior[k] = 1 + random.below(40);
    for (std::uint32_t c = 0; c < kChannels; ++c) {
      // Single units, all bits, and everything between; a channel may be much darker than others.
      bits[k][c] = k % 8 == 0 ? 1 : k % 8 == 1 ? 32 : random.between(1, 32);
      const double dim = std::exp2(random.between(-32, 0));
      gathering.lx[k * kChannels + c] = k % 5 == 0 ? 0 : static_cast<float>(kUnit * 0x1p32 * dim * random.unit());
      truth[k][c] = prior[k] * (static_cast<double>(gathering.lx[k * kChannels + c]) / kUnit);
    }
  }
  gathering.take();
  for (std::uint32_t k = 0; k < kCount; ++k) gathering.sums.start(k, prior[k], kUnit);
  // In turns: they don't disturb each other.
  for (int turn = 0; turn < 400000; ++turn) {
    const std::uint32_t k = random.below(turn % 2 == 0 ? 12 : kCount);
    ASSERT_TRUE(gathering.sums.count(k));
    ++lines[k];
    std::uint32_t units[3] = {0, 0, 0};
    for (std::uint32_t c = 0; c < kChannels; ++c) {
      const std::uint32_t all = 0xffffffffu >> (32 - bits[k][c]);
      units[c] = k % 8 < 2 ? all : static_cast<std::uint32_t>(random.next()) & all;
      truth[k][c] += units[c];
    }
    gathering.sums.template add<kChannels>(k, [&](std::uint32_t c) { return units[c]; });
  }
  for (std::uint32_t k = 0; k < kCount; ++k) {
    ASSERT_GT(lines[k], 1000u);
    const double brightest = std::max({truth[k][0], truth[k][1], truth[k][2]});
    for (std::uint32_t c = 0; c < kChannels; ++c) {
      const double sum = gathering.sums.mean(k, c, kUnit) / kUnit * (lines[k] + prior[k]);
      EXPECT_LE(sum, truth[k][c] * (1 + 1e-14)) << k;
      EXPECT_GE(sum, truth[k][c] - most_lost(lines[k], brightest)) << k;
    }
  }
}

TEST(GatheredSums, AreThoseOfDoublesForOneChannel) { expect_sums_of_random_lines<1>(1); }
TEST(GatheredSums, AreThoseOfDoublesForThreeChannels) { expect_sums_of_random_lines<3>(2); }

/// Light of any brightness, 1024 lines of it: what is lost is too little for a float to show much of.
TEST(GatheredSums, KeepAMillionth) {
  for (int bits = 22; bits <= 32; ++bits) {
    Gathering gathering(1, 1);
    gathering.lx[0] = 0;
    gathering.take();
    gathering.sums.start(0, 16, kUnit);
    const std::uint32_t units = 0xffffffffu >> (32 - bits);
    for (int k = 0; k < 1024; ++k) gathering.add(0, units);
    const double truth = 1024.0 * units / 1040 * kUnit;
    EXPECT_NEAR(gathering.sums.mean(0, 0, kUnit), truth, truth * 1e-6) << bits;
  }
}

/// What isn't lost by being halved: numbers that are even at every scale.
TEST(GatheredSums, AreExactWhereNothingIsCutOff) {
  Gathering gathering(3, 1);
  for (float& lx : gathering.lx) lx = static_cast<float>(kUnit * 0x1p20);
  gathering.take();
  gathering.sums.start(0, 16, kUnit);
  for (int k = 0; k < 4080; ++k) gathering.add(0, 0x80000000u);
  for (std::uint32_t c = 0; c < 3; ++c) {
    EXPECT_EQ(gathering.sums.mean(0, c, kUnit), kUnit * (16 * 0x1p20 + 4080 * 0x1p31) / 4096);
  }
}

TEST(GatheredSums, StartWithTheMeanOfSoManyLines) {
  // From much less than a unit to more than one line can bring.
  for (double lx = kUnit * 0x1p-4; lx < kUnit * 0x1p40; lx *= 3.7) {
    Gathering gathering(3, 2);
    gathering.lx[3] = static_cast<float>(lx);
    gathering.lx[4] = static_cast<float>(0.25 * lx);
    gathering.lx[5] = 0;
    gathering.take();
    gathering.sums.start(1, 16, kUnit);
    const double first = static_cast<double>(static_cast<float>(lx)), sum = 16 * first / kUnit;
    const double lost = most_lost(0, sum) / 16 * kUnit;
    EXPECT_LE(gathering.sums.mean(1, 0, kUnit), first);
    EXPECT_NEAR(gathering.sums.mean(1, 0, kUnit), first, lost);
    EXPECT_NEAR(gathering.sums.mean(1, 1, kUnit), 0.25 * first, lost);
    EXPECT_EQ(gathering.sums.mean(1, 2, kUnit), 0);
    // As many lines again, dark ones.
    for (int k = 0; k < 16; ++k) ASSERT_TRUE(gathering.sums.count(1));
    EXPECT_NEAR(gathering.sums.mean(1, 0, kUnit), 0.5 * first, lost);
  }
}

/// No light at all: then there is no unit either.
TEST(GatheredSums, OfDarknessAreDark) {
  Gathering gathering(1, 1);
  gathering.lx[0] = 0;
  gathering.take();
  gathering.sums.start(0, 16, 0);
  EXPECT_TRUE(gathering.sums.started(0));
  gathering.add(0, 0);
  EXPECT_EQ(gathering.sums.mean(0, 0, 0), 0);
}

TEST(GatheredSums, LeaveWhatHasNotStartedAlone) {
  for (const std::uint32_t channels : {1u, 3u}) {
    Gathering gathering(channels, 9);
    const std::vector<float> before = gathering.lx;
    gathering.take();
    for (std::uint32_t k = 1; k < 9; k += 3) gathering.sums.start(k, 16, kUnit);
    for (std::uint32_t k = 0; k < 9; ++k) {
      EXPECT_EQ(gathering.sums.started(k), k % 3 == 1);
      EXPECT_EQ(gathering.sums.count(k), k % 3 == 1);
      EXPECT_FALSE(gathering.sums.sees_backs(k));
    }
    for (int line = 0; line < 3000; ++line) {
      for (std::uint32_t k = 1; k < 9; k += 3) gathering.add(k, 0xffffffffu - static_cast<std::uint32_t>(line));
    }
    for (std::uint32_t k = 1; k < 9; k += 3) gathering.sums.finish(k, {1.0 * k, 2.0 * k, 3.0 * k});
    for (std::uint32_t k = 0; k < 9; ++k) {
      for (std::uint32_t c = 0; c < channels; ++c) {
        const std::size_t at = std::size_t{k} * channels + c;
        EXPECT_EQ(gathering.lx[at], k % 3 == 1 ? static_cast<float>((c + 1) * k) : before[at]);
      }
    }
  }
}

/// Whenever so many are counted, those before count half as much.
TEST(GatheredSums, ForgetHalfOfMoreThanTheMostLines) {
  Gathering gathering(3, 2);
  gathering.take();
  gathering.sums.start(1, 16, kUnit);
  const double before = 16 * static_cast<double>(gathering.lx[0]);
  gathering.sums.start(0, 16, kUnit);
  double truth = before / kUnit;
  std::uint32_t lines = 16;
  Random random(4);
  for (int k = 0; k < 300000; ++k) {
    if (lines == GatheredSums::kMost) {
      lines = GatheredSums::kMost / 2;
      truth *= 0.5;
    }
    ++lines;
    // Brighter and brighter, so that what is forgotten matters.
    const std::uint32_t units = static_cast<std::uint32_t>(random.next()) >> (20 - k / 15000);
    truth += units;
    gathering.add(0, units);
    ASSERT_EQ(gathering.sums.lines(0), lines);
  }
  EXPECT_NEAR(gathering.sums.mean(0, 0, kUnit), truth / lines * kUnit, most_lost(300000, truth) / lines * kUnit);
  EXPECT_EQ(gathering.sums.lines(1), 16u);
}

/// Over which something may stand: what it had before mustn't be forgotten.
TEST(GatheredSums, TakeNoMoreThanTheMostLinesWhereTheySeeBacks) {
  Gathering gathering(1, 1);
  gathering.lx = {0};
  gathering.take();
  gathering.sums.start(0, 16, kUnit);
  std::uint32_t taken = 0;
  for (; taken < 100000 && gathering.sums.count(0); ++taken) {
    if (taken % 49 == 0) gathering.sums.count_back(0);
    gathering.sums.add<1>(0, [](std::uint32_t) { return 0xffffffffu; });
  }
  EXPECT_EQ(taken, GatheredSums::kMost - 16);
  EXPECT_FALSE(gathering.sums.count(0));
  EXPECT_EQ(gathering.sums.lines(0), GatheredSums::kMost);
  const double truth = kUnit * 4294967295.0 * taken / GatheredSums::kMost;
  EXPECT_NEAR(gathering.sums.mean(0, 0, kUnit), truth, truth * 0x1p-30 * (taken + 2));
}

TEST(GatheredSums, SeeBacksAlongMoreThanOneLineInFifty) {
  Gathering gathering(1, 3);
  gathering.take();
  for (std::uint32_t k = 0; k < 2; ++k) gathering.sums.start(k, 16, kUnit);
  for (std::uint32_t lines = 17; lines < 3000; ++lines) {
    ASSERT_TRUE(gathering.sums.count(0));
    if (lines % 50 == 49) gathering.sums.count_back(0);  // one line too early
    const std::uint32_t backs = (lines + 1) / 50;
    ASSERT_EQ(gathering.sums.sees_backs(0), 50 * backs > lines) << lines;
    ASSERT_FALSE(gathering.sums.sees_backs(1));
  }
}

/// Of lines that count half as much, backs do too.
TEST(GatheredSums, TellHowManyLinesMetNoBack) {
  Gathering gathering(1, 1);
  gathering.take();
  gathering.sums.start(0, 16, kUnit);
  for (std::uint32_t lines = 17; lines < 1000000; ++lines) {
    ASSERT_TRUE(gathering.sums.count(0));
    if (lines % 128 == 0) gathering.sums.count_back(0);
  }
  const double lines = gathering.sums.lines(0);
  EXPECT_GT(lines, 30000);
  EXPECT_NEAR(gathering.sums.not_backs(0), lines * 127 / 128, 2 + lines * 1e-4);
}

TEST(GatheredSums, EndAsIlluminancesThatFloatsHold) {
  Gathering gathering(3, 2);
  gathering.take();
  gathering.sums.start(0, 16, kUnit);
  gathering.sums.start(1, 16, kUnit);
  gathering.add(1, 77);
  gathering.sums.finish(0, {123.456, 0, 1e300});
  EXPECT_EQ(gathering.lx[0], 123.456f);
  EXPECT_EQ(gathering.lx[1], 0.0f);
  EXPECT_EQ(gathering.lx[2], std::numeric_limits<float>::max());
  EXPECT_FALSE(gathering.sums.started(0));
  EXPECT_FALSE(gathering.sums.count(0));
  EXPECT_TRUE(gathering.sums.started(1));
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  gathering.sums.finish(1, {kInfinite, std::numeric_limits<double>::quiet_NaN(), 1e-3});
  for (std::size_t k = 3; k < 6; ++k) EXPECT_TRUE(std::isfinite(gathering.lx[k]));
  EXPECT_EQ(gathering.lx[5], 1e-3f);
}

TEST(GatheredSums, SayWhenTheArenaIsTooSmall) {
  Gathering gathering(3, 11);
  const std::size_t here = 8 * gathering.memory.size(), elsewhere = 8 * gathering.elsewhere.size();
  EXPECT_TRUE(gathering.takes(here, elsewhere));
  EXPECT_FALSE(gathering.takes(here - 8, elsewhere));
  EXPECT_FALSE(gathering.takes(here, elsewhere - 8));
}

}  // namespace
}  // namespace shodo
