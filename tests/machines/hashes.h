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
    {"box", 0x4c35700e370fd730, 0x4ecb82b59cb962f3},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0x24153a29091d3235, 0xd76d3afd8021a9ba},
    {"rules", 0x30dea8a99d6ae2fa, 0x3fe5d939bba065f7},
    {"rule2+", 0xdfb09791b28fb876, 0x321b4ec4ad22423d},
    {"blocks", 0xd5e2fc8e8771ffcf, 0x51a734b8827e7eed},
    {"planes", 0x2657f9b744420f4a, 0x6b2b4aef7e349e1f},
    {"textures", 0xc7f88426d5eac15d, 0x629dd66c4262b521},
    {"glass", 0x5a66a6f452d1dada, 0xb6c333753702c185},
    {"day", 0xb74e27fa735f471c, 0x7a146a491569bc1a},
};

}  // namespace machines
