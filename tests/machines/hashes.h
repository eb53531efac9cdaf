// The contract of doc/determinism.md in figures: the hashes of maps and pictures on every machine and in every build.
//
// A change here changes the pixels of every user: these lines are changed by hand, in the commit that means to change
// them and says why. Where a hash differs, `make machines` prints the line to put in.
#pragma once

#include <cstdint>

namespace machines {

struct Hashes {
  const char* name;
  std::uint64_t maps, picture;  // FNV-1a, 64 bits
};

inline constexpr Hashes kHashes[] = {
    {"box", 0xf05f133455233400, 0xe14d0fbab40667de},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xe172d80437caa710, 0x9cc97328ebb26d17},
    {"rules", 0x93531a6d034cebd3, 0xad1e3ee8deb68bb0},
    {"rule2+", 0x72b8f90567c946d6, 0x5ff5f74d3979ced5},
    {"blocks", 0xc1ed55ed74e9dd36, 0x41fbd32f8b017c31},
    {"textures", 0x32f677bba978abff, 0xe903ee013f3ff48c},
    {"day", 0x5400ccb94ce11f23, 0xc9e04aa147b0992d},
};

}  // namespace machines
