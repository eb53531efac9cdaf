// What a build of the library leaves out, and what it is made for: the one place to look (doc/determinism.md).
#pragma once

namespace shodo::features {

// Compiled for size, a loop asks at run time what it is given otherwise: one piece of code for all kinds of rows, none
// made for each. Same operations in the same order, same bits.
#ifdef __OPTIMIZE_SIZE__
inline constexpr bool kSmallCode = true;
#else
inline constexpr bool kSmallCode = false;
#endif

}  // namespace shodo::features
