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
    {"box", 0xe8d08d62db7c49e9, 0x709afabce5665816},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0x1fabf40f0d29f4c8, 0x6e17d988c66b7633},
    {"rules", 0x376fa97cd2d6a642, 0x17418ca946c560ca},
    {"rule2+", 0xae6684bae61bfd1e, 0xdedb5a4448faeba8},
    {"blocks", 0x58f188843dbe3202, 0x07808376e1412b0a},
    {"planes", 0x8f1af93ae34d0b8b, 0x2660a48dd2bb8961},
    {"textures", 0xcbdb3cfe3740623d, 0x19f2dd2cc93c7843},
    {"glass", 0xe01b7882c215a4ea, 0xdc8d5e335763985b},
    {"day", 0x6a217c5711c7adba, 0x0ce771ae36fd6fc4},
};

}  // namespace machines
