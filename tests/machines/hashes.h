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
    {"box", 0x35b3735f888ace3f, 0x6f39f1d73d03a684},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xc9b1c550f33e0033, 0x6bae46df3570df52},
    {"rules", 0x6273541003762f78, 0xd3c6e30876d572e4},
    {"rule2+", 0xc036a9ed51588182, 0x30775391f7383ca3},
    {"blocks", 0xd0aee0ad0c6bf11a, 0xadec2535ebd38703},
    {"planes", 0xd968bcb115f4acf7, 0x0705705b6ae7d01e},
    {"textures", 0xd59f1eab32955471, 0x9a330aa220930530},
    {"day", 0xdad13cb4bf5236a9, 0xc93fbed20444a7d0},
};

}  // namespace machines
