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
    {"box", 0xf2658acd70bc3e68, 0x07d7a1d6c43784f1},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0x469cceb63c854071, 0x91e43f4aec05d876},
    {"rules", 0x5c4dbdebdc599f33, 0x802a2d6b7938aed8},
    {"rule2+", 0xf1df80867dbf1291, 0x0c328bdef64ee4c7},
    {"blocks", 0xeacf022d2e91f573, 0x052d57c02559a326},
    {"day", 0xfa9d1499cc61f7c9, 0x9891e8be803d8f63},
};

}  // namespace machines
