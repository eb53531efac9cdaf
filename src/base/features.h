// What a build of the library leaves out, and what it is made for: the one place to look (doc/determinism.md).
//
// A machine with little room for code models only what its scenes need. Each part below can be left out when the
// library is compiled (-DSHODO_WITHOUT_...): scenes and options that ask for it are then refused, everything else gives
// the same bits as the full library. All files, and the program's, are compiled with the same set.
//
//     BLOCKS      blocks of patches (Rules::blocks)                               the option is refused
//     RULES       the paper's rules 1, 2, 2+ and 3                                options are refused
//     AIMS        the search for what can stand between: every segment tries      flags of a scene (FlagMode::kScene)
//                 every triangle, as with flags off, to the same bits             are refused
//     GATHER      ambient light gathered by sub-patches (Options::gather)          the option is refused
//     MESHES      triangles, grids, quads that are not convex                     the statements are refused
//     PLANES      measuring planes                                                the statement is refused
//     INCLUDES    `include` in a scene                                            the statement is refused
//     MODELS      surfaces from Wavefront OBJ files (`obj`)                        the statement is refused
//     LUMINAIRES  point lights as IES files have them (`ies`)                     the word is refused
//     MESSAGES    texts: a Status has code, file, line, column, bytes_needed, and as its message the word it is about
#pragma once

#include <type_traits>

#include "base/check.h"
#include "shodo/options.h"

namespace shodo {
namespace features {

#ifdef SHODO_WITHOUT_BLOCKS
inline constexpr bool kBlocks = false;
#else
inline constexpr bool kBlocks = true;
#endif
#ifdef SHODO_WITHOUT_RULES
inline constexpr bool kRules = false;
#else
inline constexpr bool kRules = true;
#endif
#ifdef SHODO_WITHOUT_AIMS
inline constexpr bool kAims = false;
#else
inline constexpr bool kAims = true;
#endif
#ifdef SHODO_WITHOUT_GATHER
inline constexpr bool kGather = false;
#else
inline constexpr bool kGather = true;
#endif
#ifdef SHODO_WITHOUT_MESHES
inline constexpr bool kMeshes = false;
#else
inline constexpr bool kMeshes = true;
#endif
#ifdef SHODO_WITHOUT_PLANES
inline constexpr bool kPlanes = false;
#else
inline constexpr bool kPlanes = true;
#endif
#ifdef SHODO_WITHOUT_INCLUDES
inline constexpr bool kIncludes = false;
#else
inline constexpr bool kIncludes = true;
#endif
#ifdef SHODO_WITHOUT_MODELS
inline constexpr bool kModels = false;
#else
inline constexpr bool kModels = true;
#endif
#ifdef SHODO_WITHOUT_LUMINAIRES
inline constexpr bool kLuminaires = false;
#else
inline constexpr bool kLuminaires = true;
#endif
#ifdef SHODO_WITHOUT_MESSAGES
inline constexpr bool kMessages = false;
#else
inline constexpr bool kMessages = true;
#endif

// Compiled for size, a loop asks at run time what it is given otherwise: one piece of code for all kinds of rows, none
// made for each. Same operations in the same order, same bits.
#ifdef __OPTIMIZE_SIZE__
inline constexpr bool kSmallCode = true;
#else
inline constexpr bool kSmallCode = false;
#endif

/// Nothing is left out but files of models and luminaires, perhaps.
inline constexpr bool kFull = kBlocks && kRules && kAims && kGather && kMeshes && kPlanes && kIncludes && kMessages;

/// Nodes that hold others.
inline constexpr bool kTrees = kBlocks || kRules;

constexpr bool blocks(const Rules& rules) { return kBlocks && rules.blocks; }
constexpr bool gathers(const Options& options) { return kGather && options.gathers(); }
/// Flags off.
constexpr bool aims(FlagMode mode) { return kAims && mode != FlagMode::kOff; }

/// A member that has one value only: what it would choose between falls away where it is compiled.
template <class T, T kValue>
struct Fixed {
  constexpr Fixed(T value = kValue) { SHODO_CHECK(value == kValue); }
  constexpr operator T() const { return kValue; }
};
template <bool kFree, class T, T kValue>
using FixedUnless = std::conditional_t<kFree, T, Fixed<T, kValue>>;

}  // namespace features
}  // namespace shodo
