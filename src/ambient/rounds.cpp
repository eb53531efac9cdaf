#include "ambient/rounds.h"

#include "ambient/mirror_share.h"

namespace shodo {

namespace {

constexpr std::uint8_t kRounds = 2;

}  // namespace

Status AmbientRounds::begin(const AmbientStage& stage) {
  const std::size_t values = std::size_t{stage.scene.patch_count} * stage.scene.channels;
  begun = true;
  mirrors = mirrors_share(stage.scene, stage.options);
  coloured = stage.intersector.panes().coloured();
  after_result = stage.arena.mark();
  if (!combines()) return {};
  if (!stage.arena.take("ambient illuminance in all", values, stage.ambient.patch_lx)) return stage.arena.refused();
  after_result = stage.arena.mark();
  if (!mirrors) return {};
  if (!stage.arena.take("light over mirrors", values, share_lx)) return stage.arena.refused();
  if (!stage.arena.take("first light and that over mirrors", values, first.patch_lx)) return stage.arena.refused();
  return {};
}

Status AmbientRounds::prepare(const AmbientStage& stage) {
  Status status;
  if (!begun) status = begin(stage);
  if (!status.done()) return ended(stage, status);
  const std::span<double> with_mirrors = first.patch_lx;
  first = stage.direct;
  if (mirrors) {
    first.patch_lx = with_mirrors;
    for (std::size_t k = 0; k < share_lx.size(); ++k) first.patch_lx[k] = stage.direct.patch_lx[k] + share_lx[k];
  }
  if (coloured) stage.intersector.set_channel(channel);
  before_solution = stage.arena.mark();
  status = prepare_ambient(stage.scene, stage.geometry, stage.patches, first, stage.intersector, stage.options,
                           stage.arena, solved, work);
  next = Step::kSolve;
  return status.done() ? status : ended(stage, status);
}

Status AmbientRounds::solve(const AmbientStage& stage) {
  const Status status = solve_prepared(first, stage.intersector, stage.progress, *work, stage.statistics);
  if (!status.done()) return ended(stage, status);
  combine(stage);
  end_solution(stage);
  next = Step::kPrepare;
  if (coloured && ++channel < stage.scene.channels) return status;
  channel = 0;
  if (!mirrors || round++ == kRounds) return ended(stage, status);
  next = Step::kMirrors;
  return status;
}

Status AmbientRounds::send_over_mirrors(const AmbientStage& stage) {
  const Status status = share_over_mirrors(stage.scene, stage.geometry, stage.patches, stage.direct, stage.ambient,
                                           stage.intersector, stage.progress, stage.arena, share_lx);
  next = Step::kPrepare;
  return status.done() ? status : ended(stage, status);
}

/// What was solved goes to the answer.
void AmbientRounds::combine(const AmbientStage& stage) const {
  if (!combines()) {
    stage.ambient = solved;
    return;
  }
  const std::size_t step = coloured ? stage.scene.channels : 1;
  for (std::size_t k = channel; k < stage.ambient.patch_lx.size(); k += step) {
    stage.ambient.patch_lx[k] = solved.patch_lx[k] + (mirrors ? share_lx[k] : 0);
  }
}

/// Gives back what one solution took.
void AmbientRounds::end_solution(const AmbientStage& stage) {
  stage.intersector.finish();
  stage.intersector.set_channel(0);
  if (work == nullptr) return;
  stage.arena.release(combines() ? before_solution : work->after_result);
  work = nullptr;
}

Status AmbientRounds::ended(const AmbientStage& stage, const Status& status) {
  end_solution(stage);
  if (combines()) stage.arena.release(after_result);
  *this = {};
  next = Step::kDone;
  return status;
}

std::uint64_t rounds_bytes(const Scene& scene, const Geometry& geometry, const Options& options) {
  const std::uint64_t values = 8 * std::uint64_t{scene.patch_count} * scene.channels;
  if (mirrors_share(scene, options)) return 3 * values;
  return Panes(geometry).coloured() ? values : 0;
}

}  // namespace shodo
