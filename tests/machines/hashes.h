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
    {"box", 0x915a524483e3786e, 0xe885b5d2cc38959f},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xbe116337c4344440, 0x4564159a356e8e54},
    {"rules", 0x32a380f0ed61f205, 0x74822eaf9d05b3d3},
    {"rule2+", 0xf0576b2d5e26b869, 0xa52898c5ff55a8bd},
    {"blocks", 0x09a543aeb2e22008, 0x1e483c3b7cc910c1},
    {"planes", 0x46d06a62b9397f3a, 0x9cf3347e51215359},
    {"textures", 0xd59f1eab32955471, 0x9a330aa220930530},
    {"glass", 0x30197b0573f5e29a, 0xecf67a77144a2a16},
    {"day", 0xe27ad23c906dbb46, 0xcecfa2330786fde9},
};

}  // namespace machines
