// What of a model gives way where memory is short, and how it comes back (doc/memory.md).
//
// Patches, blocking triangles, the sub-patches' direct light and the drawn triangles serve some stages only. They stay
// while the memory suffices. Where a stage needs their memory they go, and are made once more, the same bit by bit,
// when they are wanted again; nothing is counted twice. What the picture is made of moves down to where they were.
#pragma once

#include "model.h"

namespace shodo {

/// They come back when the scene is solved once more.
Status place_again(Model& model);
/// The patches of load(), or new ones if the picture had their memory; none where memory is short.
Status take_patches(Model& model);
/// The sub-patches' direct light stands in spare blocks; if the rows took them, all is lit once more.
Status keep_sub_patches(Model& model, const Progress& progress);
/// The drawn triangles, if the light took their memory; patches and what blocks give way to them and to the picture.
Status place_drawn_again(Model& model);

}  // namespace shodo
