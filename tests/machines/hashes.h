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
    {"shapes", 0xc367a3712f3801f7, 0xe410fa696f9d6f0b},
    {"rules", 0xe16b7d8e207894ab, 0x54a02dc0fbbdd733},
    {"rule2+", 0xae6684bae61bfd1e, 0x02058ee4215183ef},
    {"blocks", 0x58f188843dbe3202, 0x86e971cc73a1a6c2},
    {"planes", 0xb736224681ec12bc, 0x69f4c7a50455a704},
    {"textures", 0xcbdb3cfe3740623d, 0x5804eee79f24b372},
    {"glass", 0x6cc751323a778a3d, 0x58697b5a63077c42},
    {"gather", 0x60717a8824becd08, 0x2dc08ce90015848c},
    {"panes", 0x6e254e90baa5f731, 0x3e05a44b45aac202},
    {"model", 0x54348534509b4037, 0x54e827a78fd9d9b9},
    {"luminaires", 0x027b85ac47e4766d, 0x8b1ee0156b48cc9d},
    {"day", 0x4d17f10317cab793, 0x01f88f56d6b2d7be},
};

}  // namespace machines
