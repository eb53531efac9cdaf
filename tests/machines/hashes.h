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
    {"box", 0x171f136a5a5c9a8e, 0xce14a372ca261786},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xd1919c69009e64eb, 0x4d0bfd0e3368ccde},
    {"rules", 0x3065b42e817ca296, 0xf367878047500352},
    {"rule2+", 0xf73cddada5f963fd, 0x0d729b21cffe19fa},
    {"blocks", 0x5da372a67cbf944a, 0x29045894871129d3},
    {"planes", 0x19b9cb31c4a677a3, 0xbb0ed19ae748e346},
    {"textures", 0x2c70bc679a65218c, 0x28145b20e51e651c},
    {"glass", 0x606e4804fefa1042, 0xe91376256b9c69b9},
    {"day", 0x21483d4e7d39591e, 0x69409276995680c2},
};

}  // namespace machines
