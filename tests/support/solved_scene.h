// A scene from a string through the whole pipeline, with its model open to the tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model.h"
#include "support/scene_from_text.h"

namespace shodo {

struct SolvedScene {
  explicit SolvedScene(const std::string& text, const Options& options = {}, std::size_t bytes = std::size_t{64} << 20,
                       const Reader& reader = {})
      : memory((bytes + 7) / 8) {
    status = load("top.scn", text, reader, options, memory.data(), bytes, model);
    if (status.done()) status = solve(*model, {});
    EXPECT_TRUE(status.done()) << to_text(status);
  }

  /// Total illuminance in the grey scene.
  double plane_lx(std::uint32_t plane, std::uint32_t u, std::uint32_t v) const {
    const Plane& p = model->scene.planes[plane];
    const std::size_t at = std::size_t{p.first_sub_patch} + v * p.width() + u;
    return static_cast<double>(model->planes.direct_lx[at]) + static_cast<double>(model->planes.ambient_lx[at]);
  }

  std::vector<std::uint64_t> memory;
  Model* model = nullptr;
  Status status;
};

}  // namespace shodo
