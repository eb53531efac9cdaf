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
    {"box", 0x95e93224079ddf30, 0xaa0995f94a9ec6ac},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0x1b77209b5622d367, 0x3dbc97d3f19e1961},
    {"rules", 0x660a7900a1896902, 0x8dabdffa0d2e1960},
    {"rule2+", 0xae6684bae61bfd1e, 0x02058ee4215183ef},
    {"blocks", 0x58f188843dbe3202, 0x86e971cc73a1a6c2},
    {"planes", 0xb736224681ec12bc, 0x69f4c7a50455a704},
    {"textures", 0xcbdb3cfe3740623d, 0x5804eee79f24b372},
    {"glass", 0x0634c812b8d70bc2, 0xea9b963b2f0b549d},
    {"gather", 0x6db934db226b046f, 0x151c34374008fcee},
    {"panes", 0x3925f996a93ae0f2, 0xed7ad2817d901793},
    {"day", 0x4ea10208e7bbaf0c, 0x867f02686b237587},
};

}  // namespace machines
