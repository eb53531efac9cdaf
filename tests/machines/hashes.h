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
    {"box", 0x7d0370b599003cc3, 0xa9a5b49974afe280},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xf7fbc8b10b47155f, 0xdc78574ecb08cedd},
    {"rules", 0x93531a6d034cebd3, 0x250d75e13c00b291},
    {"rule2+", 0x9fe96d5b24690786, 0xdce93435537fe323},
    {"blocks", 0xc1ed55ed74e9dd36, 0x937ba125e9fcc7a4},
    {"planes", 0x3d41118a6a492842, 0x0705705b6ae7d01e},
    {"textures", 0x32f677bba978abff, 0xe903ee013f3ff48c},
    {"day", 0xae791216d5db4551, 0x4b9d56911116618e},
};

}  // namespace machines
