// A picture far away, behind everything: what stands outside the window (beyond the paper; doc/optics.md).
//
// It hangs at infinity on a plane square to its direction, so it is seen by direction alone, in mirrors too: with r and
// u to its right and upwards, over half its width and height, a direction d meets it at (d.r / d.a, d.u / d.a) if both
// lie within -1 .. 1 and d.a is positive. Luminance is that of the picture's white times what it shows, in linear
// light. Where the picture goes `around`, a direction beside it is mirrored in the planes through the picture's left
// and right borders until it meets it, or passes above or below: what a mirror or another camera sees beside the
// picture looks like what is in it, without seams and without another picture's bytes.
//
// Exact: d.r, d.u and d.a, of r, u and a rounded to 2^-15; mirrored directions to 2^-15 a plane. The quotients have
// 31 bits. The level of detail is that of the middle of the camera's view, for all rays: a mirror that is bent would
// want another.
#pragma once

#include <cstdint>

#include "base/lattice.h"
#include "picture/texture_lookup.h"
#include "picture/view.h"
#include "scene/scene.h"

namespace shodo {

class BackgroundPicture {
 public:
  /// `white`: what its white shows as, in any unit.
  void start(const Scene& scene, const SampleGrid& grid, std::uint32_t white);
  /// False where the direction doesn't meet it; else its value there, of `white`, by channel of the scene.
  bool look_up(const LatticeVector& direction, std::uint32_t (&value)[3]) const;

 private:
  LatticeVector before(LatticeVector direction) const;

  TextureLookup lookup_;
  std::uint32_t white_ = 0, step_ = 0;  // step_: texels a sample, 16.16
  LatticeVector right_, up_, towards_;
  LatticeVector border_[2];             // normals of the planes through left and right border, 2^15 long, outwards
  bool any_ = false, around_ = false;
};

}  // namespace shodo
