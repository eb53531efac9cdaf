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
    {"box", 0xd1ce5376a206fe49, 0x6f39f1d73d03a684},
    {"sun", 0x9e54c6cd4147ac22, 0x6973181985d668a5},
    {"shapes", 0xbe974c307329fb4f, 0x6bae46df3570df52},
    {"rules", 0x6273541003762f78, 0xd3c6e30876d572e4},
    {"rule2+", 0x81936dfec66a794b, 0x30775391f7383ca3},
    {"blocks", 0x5893e099251dbb4a, 0x36c68ca7622121c4},
    {"planes", 0x3d41118a6a492842, 0x0705705b6ae7d01e},
    {"textures", 0x62baca3b71e1a2c1, 0x89a34cb4338ce487},
    {"glass", 0x30197b0573f5e29a, 0xecf67a77144a2a16},
    {"day", 0x624cae61a97d03e7, 0x8471f9cef3d9e601},
};

}  // namespace machines
