// Where in their cells the 4 x 4 samples lie by which a sub-patch cut by a sun's shadow is judged (ours; design: direct
// illuminance of sub-patches).
//
// The sun's rays are parallel, so bars at equal distances have shadows at equal distances. Samples at the centres of
// their cells meet them in step wherever sub-patches are a multiple or a simple part of that distance, and then the
// same error is made on all: half the spacing of bars that cover 30 % comes out with 25 % along each edge. So samples
// lie elsewhere in the cells of each sub-patch: along each edge at eighths of it, moved by a 128th to 127 of them, and
// which of a cell's two eighths a sample takes differs between the two cells to each side of the middle. Over many
// sub-patches the mean is the lit area's, whatever is in the way; across a shadow's edge the samples stand at eight
// distances instead of four. What lies where is a hash and no random number: of the centre's lattice point and the two
// edges, without signs and without order of the axes. Each cell is looked at from the four places that are this one in
// its quarters: 8 x 8 in all, at sixteen distances.
// Exact: mirrored and turned by 90 degrees a scene has mirrored and turned samples, and samples are mirror images of
// each other within a sub-patch, so that the mean of what varies linearly is kept. Approximate: sub-patches on which
// the first five samples (light/sub_patch_light.h) agree are never looked at closely, so an edge within an eighth of a
// sub-patch's side is missed, and where that happens on all alike it adds up. (First looks from elsewhere, too, took
// two thirds of that off, and by luck lost more in the rooms.) Triangles keep their centroids. Lamps are looked at from
// the cells' centres: their light varies over a sub-patch, and equal distances are better for that.
#pragma once

#include <cstdint>

#include "base/lattice.h"
#include "light/piece_grid.h"
#include "scene/mesh.h"

namespace shodo {

class SampleShift {
 public:
  SampleShift() = default;
  /// `centre`: the sample at the centre of the piece, a quadrilateral.
  SampleShift(const Lattice& lattice, const LatticePoint& centre, const Piece& piece);

  /// Where sample k of 4 x 4 stands in its cell, 0 .. 1 from the cell's corner along s and t; never on its border.
  PieceGrid::Parameter in_cell(std::uint32_t sample) const;

 private:
  std::uint32_t along_s_ = 0, along_t_ = 0;  // bits 0 and 1: which eighth in the outer and inner cells; 2 to 7: how far
};

}  // namespace shodo
