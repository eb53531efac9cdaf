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
    {"box", 0xe8d08d62db7c49e9, 0x4907714283d9ca20},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xfd226d969b39a009, 0xe5d97d7200f6e278},
    {"rules", 0xbba7fac311814be1, 0xa97c4ee6b29333a2},
    {"rule2+", 0xae6684bae61bfd1e, 0x02058ee4215183ef},
    {"blocks", 0x58f188843dbe3202, 0x86e971cc73a1a6c2},
    {"planes", 0x8f1af93ae34d0b8b, 0x76cc9a3e852eac5d},
    {"textures", 0xcbdb3cfe3740623d, 0x5804eee79f24b372},
    {"glass", 0xd8703eb4ea4f305a, 0x4f32996de6ee3e9e},
    {"day", 0xd94e515e7cd8b47b, 0xf54d3eba49ea3ad5},
};

}  // namespace machines
