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
    {"box", 0x171f136a5a5c9a8e, 0x94a08a7ee189b563},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xbe116337c4344440, 0x658bffe4443e8449},
    {"rules", 0x38893717c94b46b8, 0x74822eaf9d05b3d3},
    {"rule2+", 0xf73cddada5f963fd, 0xd3ae0eafa1c05f76},
    {"blocks", 0x5da372a67cbf944a, 0xd6b4474e1e283d38},
    {"planes", 0x19b9cb31c4a677a3, 0x5ae731ca98a7bf83},
    {"textures", 0x2c70bc679a65218c, 0x08e3428e2656b4b5},
    {"glass", 0x5a66a6f452d1dada, 0x3ff2e7134b37448e},
    {"day", 0xcb003e6646715cd8, 0x1a8963a60271e7d4},
};

}  // namespace machines
