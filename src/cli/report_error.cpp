#include "cli/report_error.h"

#include <algorithm>
#include <cstdlib>

#include "base/elementary.h"

namespace shodo {

namespace {

/// sum A dE^2 and sum A, over channels.
struct Squares {
  double sum = 0, area = 0;

  void add(double weight, double difference) {
    sum += weight * difference * difference;
    area += weight;
  }
  double over(double mean) const { return area > 0 && mean > 0 ? square_root(sum / area) / mean : 0; }
};

/// What a sub-patch adds to sum A dE^2 of the ambient maps, channels averaged.
struct SubPatch {
  double area = 0, square = 0;
};

SubPatch ambient_square(const ComparedMap& reference, const ComparedMap& map, std::size_t k) {
  SubPatch piece;
  if (!(map.area[k] > 0)) return piece;
  piece.area = reference.area[k];
  for (std::uint32_t c = 0; c < reference.channels; ++c) {
    const std::size_t at = k * reference.channels + c;
    const double d = map.ambient[at] - reference.ambient[at];
    piece.square += piece.area * d * d / reference.channels;
  }
  return piece;
}

/// RMS without the pieces that are worst per area, `part` of the area; the last one counts in part.
double trimmed(std::vector<SubPatch> pieces, double part, double mean_lx) {
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const SubPatch& a, const SubPatch& b) { return a.square * b.area > b.square * a.area; });
  double area = 0, square = 0;
  for (const SubPatch& piece : pieces) area += piece.area;
  double left_out = part * area;
  const double kept = area - left_out;
  for (const SubPatch& piece : pieces) {
    const double out = std::min(piece.area, left_out);
    left_out -= out;
    if (piece.area > 0) square += piece.square * (1 - out / piece.area);
  }
  return kept > 0 && mean_lx > 0 ? square_root(square / kept) / mean_lx : 0;
}

double largest_channel(const std::vector<double>& values, const std::vector<double>& factors, std::size_t patch,
                       std::uint32_t channels) {
  double largest = 0;
  for (std::uint32_t c = 0; c < channels; ++c) {
    const std::size_t at = patch * channels + c;
    largest = std::max(largest, values[at] * factors[at]);
  }
  return largest;
}

}  // namespace

MapError map_error(const ComparedMap& reference, const ComparedMap& map, double mean_lx) {
  Squares ambient, direct, direct_cut, total;
  double area = 0, cut_area = 0, left_out = 0;
  for (std::size_t k = 0; k < reference.area.size(); ++k) {
    const double weight = reference.area[k];
    area += weight;
    if (reference.cut[k] != 0) cut_area += weight;
    if (!(map.area[k] > 0)) {
      left_out += weight;
      continue;
    }
    for (std::uint32_t c = 0; c < reference.channels; ++c) {
      const std::size_t at = k * reference.channels + c;
      const double d = map.direct[at] - reference.direct[at], a = map.ambient[at] - reference.ambient[at];
      (reference.cut[k] != 0 ? direct_cut : direct).add(weight, d);
      ambient.add(weight, a);
      total.add(weight, d + a);
    }
  }
  const double whole = area > 0 ? area : 1;
  std::vector<SubPatch> pieces;
  for (std::size_t k = 0; k < reference.area.size(); ++k) pieces.push_back(ambient_square(reference, map, k));
  return {ambient.over(mean_lx),
          trimmed(std::move(pieces), 0.01, mean_lx),
          direct.over(mean_lx),
          direct_cut.over(mean_lx),
          total.over(mean_lx),
          cut_area / whole,
          left_out / whole};
}

std::vector<ObjectError> object_errors(const ComparedMap& reference, const ComparedMap& map, const MapCopy& like,
                                       double mean_lx) {
  std::vector<ObjectError> objects;
  double area = 0, square = 0;
  for (const MeshGrid& mesh : like.meshes) {
    if (objects.empty() || objects.back().object != mesh.object) objects.push_back({mesh.object, 0, 0, 0});
    for (std::size_t k = mesh.first; k < mesh.first + std::size_t{mesh.width} * mesh.height; ++k) {
      const SubPatch piece = ambient_square(reference, map, k);
      objects.back().area += piece.area;
      objects.back().square += piece.square;
      area += piece.area;
      square += piece.square;
    }
  }
  for (ObjectError& o : objects) {
    o.error = o.area > 0 && mean_lx > 0 ? square_root(o.square / o.area) / mean_lx : 0;
    if (area > 0) o.area /= area;
    if (square > 0) o.square /= square;
  }
  std::stable_sort(objects.begin(), objects.end(),
                   [](const ObjectError& a, const ObjectError& b) { return a.square > b.square; });
  return objects;
}

PictureError picture_error(std::span<const std::uint8_t> reference, std::span<const std::uint8_t> picture) {
  std::uint64_t sum = 0;
  PictureError error;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const std::uint32_t difference = static_cast<std::uint32_t>(std::abs(int{reference[k]} - int{picture[k]}));
    sum += difference;
    error.largest = std::max(error.largest, difference);
  }
  error.mean = reference.empty() ? 0 : static_cast<double>(sum) / static_cast<double>(reference.size());
  return error;
}

std::vector<bool> efficient(std::span<const CostAndError> points) {
  std::vector<bool> marks;
  for (const CostAndError& p : points) {
    marks.push_back(std::none_of(points.begin(), points.end(), [&](const CostAndError& q) {
      return q.cost <= p.cost && q.error <= p.error && (q.cost < p.cost || q.error < p.error);
    }));
  }
  return marks;
}

PatchLight copy_patches(const Model& model) {
  PatchLight copy;
  copy.channels = model.scene.channels;
  copy.min_cd_m2 = model.scene.display.min_cd_m2;
  copy.max_cd_m2 = model.scene.display.max_cd_m2;
  copy.direct.assign(model.direct.patch_lx.begin(), model.direct.patch_lx.end());
  copy.ambient.assign(model.ambient.patch_lx.begin(), model.ambient.patch_lx.end());
  for (std::uint32_t m = 0; m < model.scene.meshes.size(); ++m) {
    const Mesh& mesh = model.scene.meshes[m];
    const Rgb& rho = model.scene.materials[mesh.material].diffuse;
    for (std::uint32_t local = 0; local < mesh.patch_count(); ++local) {
      const Patch patch = make_patch(model.scene, model.geometry, m, local);
      const double visible = static_cast<double>(model.direct.visible_area[mesh.first_patch + local]);
      copy.area.push_back(patch.dropped != 0 ? 0 : patch.area * visible);
      for (std::uint32_t c = 0; c < copy.channels; ++c) copy.reflectance.push_back(rho.c[c]);
    }
  }
  return copy;
}

RuleLoss rule_loss(const PatchLight& none, const PatchLight& ruled, const Rules& rules) {
  RuleLoss loss;
  double dropped = 0, emptied = 0, most_reflectance = 0, area = 0, lost = 0;
  for (std::size_t i = 0; i < none.area.size(); ++i) {
    if (!(none.area[i] > 0)) continue;
    area += none.area[i];
    std::vector<double> total(ruled.channels);
    const double luminance = largest_channel(ruled.direct, ruled.reflectance, i, ruled.channels) / kPi;
    double reflected = 0;
    for (std::uint32_t c = 0; c < ruled.channels; ++c) {
      const std::size_t at = i * ruled.channels + c;
      most_reflectance = std::max(most_reflectance, ruled.reflectance[at]);
      reflected = std::max(reflected, ruled.reflectance[at] * (ruled.direct[at] + ruled.ambient[at]));
      loss.brightest_lx = std::max(
          {loss.brightest_lx, none.direct[at] + none.ambient[at], ruled.direct[at] + ruled.ambient[at]});
      const double less = none.ambient[at] - ruled.ambient[at];
      loss.largest_lx = std::max(loss.largest_lx, less);
      lost += none.area[i] * less;
    }
    if (rules.rule1 && luminance > ruled.max_cd_m2) {
      ++loss.rows;
      for (std::uint32_t c = 0; c < ruled.channels; ++c)
        emptied = std::max(emptied, none.ambient[i * ruled.channels + c]);
    }
    const bool dark = luminance < ruled.min_cd_m2 && (!rules.rule2_repeated || reflected / kPi < ruled.min_cd_m2);
    if ((rules.rule2 || rules.rule2_repeated) && dark) {
      ++loss.columns;
      dropped = std::max(dropped, reflected);
    }
  }
  loss.bound_lx = emptied + dropped / (1 - most_reflectance);
  loss.mean_lx = area > 0 ? lost / (area * ruled.channels) : 0;
  return loss;
}

}  // namespace shodo
