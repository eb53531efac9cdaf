// The ambient stage, as often as a scene needs it: by channel where panes are coloured, and again where mirrors send
// light on (doc/optics.md). One solution for all else.
//
// Coloured panes. The rows hold one value a pair, but a form factor then differs from channel to channel, so each
// channel is found by itself, with what panes let through of it.
// Mirrors. What they send on of a solution (ambient/mirror_share.h) is added to E0, and all is solved again, twice;
// what a third time would add is the square of the mirrors' share.
//
// The stage goes in steps, each with code of its own, so that a machine with little memory for code can hold one at a
// time: `next` says which, and what is between them lies here and in the arena.
// Bytes while it goes on: 8 channels a patch where panes are coloured, 24 where mirrors send light on.
#pragma once

#include "ambient/ambient.h"

namespace shodo {

/// What the stage works on.
struct AmbientStage {
  const Scene& scene;
  const Geometry& geometry;
  std::span<const Patch> patches;  // or none
  const DirectLight& direct;
  Intersector& intersector;
  const Options& options;
  const Progress& progress;
  Arena& arena;
  AmbientLight& ambient;  // the answer
  Statistics& statistics;
};

struct AmbientRounds {
  enum class Step : std::uint8_t { kPrepare, kSolve, kMirrors, kDone };

  Step next = Step::kPrepare;
  bool mirrors = false;
  bool coloured = false;
  bool begun = false;
  std::uint8_t channel = 0;    // where panes are coloured
  std::uint8_t round = 0;      // with mirrors
  AmbientWork* work = nullptr;
  AmbientLight solved;         // of one channel, or without what came over mirrors
  DirectLight first;           // E0 and what came over mirrors
  std::span<double> share_lx;  // that, [patch * channels + channel]
  Arena::Mark after_result = 0;
  Arena::Mark before_solution = 0;

  /// Does the step that is next. Whatever its end, `stage.ambient` alone stays of the last one. Errors: kMemory,
  /// kInterrupted.
  Status prepare(const AmbientStage& stage);
  Status solve(const AmbientStage& stage);
  Status send_over_mirrors(const AmbientStage& stage);

 private:
  bool combines() const { return mirrors || coloured; }
  Status begin(const AmbientStage& stage);
  void combine(const AmbientStage& stage) const;
  void end_solution(const AmbientStage& stage);
  Status ended(const AmbientStage& stage, const Status& status);
};

/// Arena bytes that it takes besides those of one solution.
std::uint64_t rounds_bytes(const Scene& scene, const Geometry& geometry, const Options& options);

}  // namespace shodo
