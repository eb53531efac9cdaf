#include "cli/report_maps.h"

#include <algorithm>
#include <cstring>

#include "scene/mesh.h"

namespace shodo {

namespace {

/// Pieces of `from` that a cell of `like` overlaps along one edge, with the part of each that lies in it.
struct Overlap {
  std::uint32_t at;
  double part;
};

/// Cell `k` of `cells` over `pieces` pieces of the same edge: in units of 1 / (cells * pieces), whole numbers.
std::vector<Overlap> overlaps(std::uint64_t k, std::uint64_t cells, std::uint64_t pieces) {
  const std::uint64_t begin = k * pieces, end = begin + pieces;
  std::vector<Overlap> found;
  for (std::uint64_t piece = begin / cells; piece * cells < end; ++piece) {
    const std::uint64_t low = std::max(begin, piece * cells), high = std::min(end, (piece + 1) * cells);
    found.push_back({static_cast<std::uint32_t>(piece), static_cast<double>(high - low) / static_cast<double>(cells)});
  }
  return found;
}

/// Gathers the values of one sub-patch.
class Mean {
 public:
  Mean(const MapCopy& from, double cut_above) : from_(from), cut_above_(cut_above) {}

  void add(std::size_t piece, double part) {
    const double weight = part * from_.area[piece];
    if (!(weight > 0)) return;
    for (std::uint32_t c = 0; c < from_.channels; ++c) {
      const double direct = static_cast<double>(from_.direct[piece * from_.channels + c]);
      direct_[c] += weight * direct;
      ambient_[c] += weight * static_cast<double>(from_.ambient[piece * from_.channels + c]);
      least_[c] = area_ > 0 ? std::min(least_[c], direct) : direct;
      most_[c] = area_ > 0 ? std::max(most_[c], direct) : direct;
    }
    area_ += weight;
  }

  void put(ComparedMap& map) const {
    bool cut = false;
    for (std::uint32_t c = 0; c < from_.channels; ++c) {
      map.direct.push_back(area_ > 0 ? direct_[c] / area_ : 0);
      map.ambient.push_back(area_ > 0 ? ambient_[c] / area_ : 0);
      const double spread = most_[c] - least_[c];
      cut = cut || (spread > kCutOfLargest * most_[c] && spread > cut_above_);
    }
    map.area.push_back(area_);
    map.cut.push_back(cut ? 1 : 0);
  }

 private:
  const MapCopy& from_;
  double cut_above_;
  double area_ = 0;
  double direct_[3] = {}, ambient_[3] = {}, least_[3] = {}, most_[3] = {};
};

void bring_grid(const MapCopy& from, const MeshGrid& source, const MeshGrid& target, double cut_above,
                ComparedMap& map) {
  for (std::uint32_t v = 0; v < target.height; ++v) {
    const std::vector<Overlap> rows = overlaps(v, target.height, source.height);
    for (std::uint32_t u = 0; u < target.width; ++u) {
      Mean mean(from, cut_above);
      for (const Overlap& row : rows) {
        for (const Overlap& column : overlaps(u, target.width, source.width)) {
          mean.add(source.first + std::size_t{row.at} * source.width + column.at, row.part * column.part);
        }
      }
      mean.put(map);
    }
  }
}

/// The piece of a triangle divided `k` times that holds the centre of a piece of one divided `fine` times.
std::uint32_t piece_around(std::uint32_t k, const PieceIndex& small, std::uint64_t fine) {
  const std::uint64_t third = small.inverted ? 2 : 1, whole = 3 * fine;
  const std::uint64_t x = (3 * std::uint64_t{small.u} + third) * k, y = (3 * std::uint64_t{small.v} + third) * k;
  const PieceIndex found{static_cast<std::uint32_t>(x / whole), static_cast<std::uint32_t>(y / whole),
                         x % whole + y % whole > whole};
  return triangle_piece_order(k, found);
}

/// Each piece of `target` is divided in 4^2 or 12^2 equal ones, each of which takes the value around its centre. That
/// is the area mean exactly where one count is 1, 2, 3 or 4 times the other.
void bring_triangle(const MapCopy& from, const MeshGrid& source, const MeshGrid& target, double cut_above,
                    ComparedMap& map) {
  const std::uint32_t k = target.width, divisions = source.width % (3 * k) == 0 ? 12 : 4, fine = divisions * k;
  const double part = static_cast<double>(source.width) * source.width / (static_cast<double>(fine) * fine);
  for (std::uint32_t piece = 0; piece < k * k; ++piece) {
    const PieceIndex at = triangle_piece(k, piece);
    Mean mean(from, cut_above);
    for (std::uint32_t local = 0; local < divisions * divisions; ++local) {
      PieceIndex small = triangle_piece(divisions, local);
      if (at.inverted) small = {divisions - 1 - small.u, divisions - 1 - small.v, !small.inverted};
      small.u += divisions * at.u;
      small.v += divisions * at.v;
      mean.add(source.first + piece_around(source.width, small, fine), part);
    }
    mean.put(map);
  }
}

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

}  // namespace

MapCopy copy_maps(const Model& model) {
  const Scene& scene = model.scene;
  MapCopy copy;
  copy.channels = scene.channels;
  copy.direct.assign(model.maps.direct_lx.begin(), model.maps.direct_lx.end());
  copy.ambient.assign(model.maps.ambient_lx.begin(), model.maps.ambient_lx.end());
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    copy.meshes.push_back({mesh.kind, mesh.map_width(), mesh.map_height(), mesh.first_sub_patch,
                           std::string(scene.objects[mesh.object].name)});
    for (std::uint32_t local = 0; local < mesh.sub_patch_count(); ++local) {
      const std::size_t at = mesh.first_sub_patch + std::size_t{local};
      const bool hidden = !model.maps.hidden.empty() && model.maps.hidden[at] != 0;
      const std::uint32_t patch = patch_of_sub_patch(mesh, local);
      const bool dropped = make_patch(scene, model.geometry, m, patch).dropped != 0;
      copy.area.push_back(hidden || dropped ? 0 : length(sub_patch_piece(scene, mesh, local).vector_area()));
    }
  }
  return copy;
}

ComparedMap bring_to(const MapCopy& from, const MapCopy& like) {
  ComparedMap map;
  map.channels = from.channels;
  const double cut_above = kCutOfMean * mean_illuminance(from);
  for (std::size_t m = 0; m < like.meshes.size(); ++m) {
    const bool triangle = like.meshes[m].kind == MeshKind::kTriangle;
    (triangle ? bring_triangle : bring_grid)(from, from.meshes[m], like.meshes[m], cut_above, map);
  }
  return map;
}

double mean_illuminance(const MapCopy& map) {
  double area = 0, light = 0;
  for (std::size_t k = 0; k < map.area.size(); ++k) {
    area += map.area[k];
    for (std::uint32_t c = 0; c < map.channels; ++c) {
      const std::size_t at = k * map.channels + c;
      light += map.area[k] * (static_cast<double>(map.direct[at]) + static_cast<double>(map.ambient[at]));
    }
  }
  return area > 0 ? light / (area * map.channels) : 0;
}

bool identical(const MapCopy& a, const MapCopy& b) {
  return same_bytes(a.direct, b.direct) && same_bytes(a.ambient, b.ambient) && a.area == b.area;
}

}  // namespace shodo
