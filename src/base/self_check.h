// Whether this machine, with this compiler and in this state, computes as the library takes for granted.
//
// The same pixels everywhere rest on IEEE 754 (doc/determinism.md): every + - * / and square root of doubles and floats
// is rounded once, to the nearest, ties to even; denormals are numbers; a product and a sum are never fused; nothing is
// held in wider registers. Compilers, options and the state of the processor (rounding mode, flush to zero) can break
// each of these, and the pictures would still look right. Here a few dozen operations whose exact answers lie next to
// a tie, where every known departure shows, are computed at run time and compared bit by bit.
//
// Not a proof: a machine that passes may still be wrong somewhere else. No memory but some 200 bytes of stack.
#pragma once

namespace shodo {

/// What this machine does otherwise: the rule that it breaks, as a sentence in the form "doubles rounded once ...".
/// nullptr if it keeps all.
const char* arithmetic_fault();

}  // namespace shodo
