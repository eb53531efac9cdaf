// Luminaires: what IES files (ANSI/IES LM-63 of 1986, 1991, 1995, 2002 and 2019) say of point lights.
//
//     I = candela * multiplier * ballast factor (* photometric factor, in files of 1986 and 1991)
//
// Type C photometry: a vertical angle V from the light's axis, and half-planes through the axis at horizontal angles C,
// counter-clockwise as seen from where the light doesn't go (from above, of a luminaire that shines down). Between the
// angles of the file intensity is linear in both; beyond the vertical ones there is no light. Along the axis all planes
// share one direction: where they differ the mean over C counts. Lumens are not read: the flux is the integral over the
// distribution. A file's dimensions don't count: the light is a point. TILT isn't applied, nor is a file opened that it
// names. Types A and B are refused.
// Bytes: 4 a candela and an angle, once a file. Time: the file is read twice.
#pragma once

#include <cstdint>

#include "base/arena.h"
#include "scene/scene.h"
#include "shodo/callbacks.h"
#include "shodo/status.h"

namespace shodo {

/// Reads the files of all luminaires; strengths and widths of their lights follow. On a mistake the status has its
/// place in the file, or none and `at` is the luminaire whose file can't be read. Errors: kFile, kScene, kMemory.
bool load_luminaires(Scene& scene, const Reader& reader, Arena& arena, Status& status, std::uint32_t& at);

}  // namespace shodo
