// The direct illuminance of one sub-patch: an area mean (paper 2.1, 2.3; deviation D6).
//
// What a light would send with nothing in the way and the part of it that is visible are found apart.
//
// How much is asked goes by where the light goes. A light of whose flux a sub-patch would get next to nothing, with
// nothing in the way (1/10,000 is the mean in a room of so many), is looked at from the centre alone: one segment to a
// point light, 8 or 32 to an area light, one to each face of a polyhedron. Many lights are weak in most places, and few
// places matter: so half of all segments and searches are saved. Only if the centre is dark and under something that
// leaves the rest free does such a light count as all others:
//
// A point light or sun is asked at the centre and next to the corners. Where these five (four of a triangle) agree on
// what is visible, and the illuminance is nearly linear, the mean is a rule of their values that is exact for
// polynomials of the third degree (second on a triangle). Otherwise it is the mean over 4 x 4 samples (16 triangles); a
// near point light sends its exact flux (point_source.h) times the visible part.
//
// An area or polyhedral light is asked at four Gauss points, each of which looks at some of its ends, and an area light
// at the centre too, which looks at many: 32 + 32 segments where something may be in the way, none elsewhere. What it
// sends is interpolated over the patch where that is far enough (light/factor_field.h); else a near face has its mean
// from nine points or 16, and an area light its segments to the leaves of a quadtree. Where the four points disagree on
// what is visible, or all are dark beneath something that leaves a part free, the 16 samples share out the mean, eight
// segments each.
//
// Hidden samples, those inside or under something, are no part of the mean: a floor beside a cupboard is as bright as
// its visible part. A sample that any light reaches is not hidden; only dark ones are looked at, since that takes a
// search. A sub-patch that no light reaches is hidden if its centre is and backs lie above all corner samples; once
// that is known no other light is asked.
//
// Approximate: what falls between the samples. Against 16 samples everywhere, with 1,936 to 6,400 ends of an area light
// and 16 of a polyhedron's face, both rooms are 5.9 % (day) and 4.6 % (evening) off: a root mean square over the mean
// of direct light, 5.2 % and 3.2 % outside shadow edges (as doc/report.md tells them) and 8.6 % and 8.7 % at them.
// (Before lights were told by their flux: 7.3 and 6.5 %, 5.8 and 4.3, 11.8 and 13.1. A coarser reference flatters both:
// with 16 x 16 ends it has the columns in common with the 32.)
// Stack: 3.5 KiB, 2 in a function at most; no memory.
#pragma once

#include <cstdint>

#include "light/sources.h"

namespace shodo {

struct SubPatchLight {
  double lux[3] = {0, 0, 0};  // channels that the scene has
  double light_factor = 0;    // the part of its hemisphere that area lights and openings fill
  double visible = 1;         // the part of its area that is not hidden, as far as dark samples told
  bool hidden = false;        // all of it is
};

SubPatchLight light_sub_patch(Sources& sources, const Receiver& receiver, const Piece& piece, bool thin);

}  // namespace shodo
