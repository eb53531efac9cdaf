// The transfer function of sRGB (IEC 61966-2-1), from the screen's side.
#pragma once

#include "base/elementary.h"

namespace shodo {

/// The linear value in [0, 1] that sRGB shows as `s`.
inline double linear_of_srgb(double s) { return s <= 0.04045 ? s / 12.92 : power((s + 0.055) / 1.055, 2.4); }

}  // namespace shodo
