// The words of a material that do more than diffuse reflection, and the background (contract 2; doc/optics.md).
#pragma once

#include "scene/statements.h"

namespace shodo {

/// highlight COEFFICIENT EXPONENT
bool read_highlight(Words& words, Optics& optics);

/// Refuses what would send out more light than it gets: diffuse + reflect + transmit above 0.9999 in some channel. The
/// highlight is not in the contract's sum: it is cut to what the three leave.
bool keep_energy(SceneReading& reading, const Token& name, const Material& material, Optics& optics);

bool does_anything(const Optics& optics);

}  // namespace shodo
