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
    {"box", 0x2fff126fb5eba675, 0xce14a372ca261786},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xddbb2b05d1d16fb8, 0x4564159a356e8e54},
    {"rules", 0x38893717c94b46b8, 0x74822eaf9d05b3d3},
    {"rule2+", 0xb53bf9770cfa55c5, 0x0d729b21cffe19fa},
    {"blocks", 0x66304eeed0fbd79b, 0x7d8f18a7fa958c73},
    {"planes", 0xf7946a819818c41c, 0xbb0ed19ae748e346},
    {"textures", 0x32f677bba978abff, 0xe903ee013f3ff48c},
    {"day", 0x789844221063c652, 0x3936fbdc8a3204d9},
};

}  // namespace machines
