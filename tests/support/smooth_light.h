// Made-up maps that vary gently from one sub-patch to the next, so that a picture is tested and no light.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "map/illuminance_map.h"
#include "scene/scene.h"

namespace shodo {

/// Direct light of mean + swing sin(pace k) lx on the k-th sub-patch, grey; no ambient light.
class SmoothLight {
 public:
  SmoothLight(const Scene& scene, double mean, double swing, double pace)
      : direct_(std::size_t{scene.sub_patch_count} * scene.channels), ambient_(direct_.size()) {
    for (std::size_t k = 0; k < direct_.size(); ++k) {
      direct_[k] = static_cast<float>(mean + swing * std::sin(pace * static_cast<double>(k / scene.channels)));
    }
    maps_.direct_lx = direct_;
    maps_.ambient_lx = ambient_;
  }
  SmoothLight(const SmoothLight&) = delete;
  SmoothLight& operator=(const SmoothLight&) = delete;

  const IlluminanceMaps& maps() const { return maps_; }
  void fill(float lx) { std::fill(direct_.begin(), direct_.end(), lx); }

 private:
  std::vector<float> direct_, ambient_;
  IlluminanceMaps maps_;
};

}  // namespace shodo
