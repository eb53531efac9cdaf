// The whole pipeline in a few calls: load, solve, draw. No globals, no allocation, no I/O, no exceptions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "shodo/callbacks.h"
#include "shodo/options.h"
#include "shodo/statistics.h"
#include "shodo/status.h"

namespace shodo {

/// A scene and everything computed of it; lives in the memory given to load().
struct Model;

/// Whether this machine's arithmetic is the one that the pixels rest on (doc/determinism.md). load, solve and draw ask
/// it first: the state of a processor can change in between. Errors: kFile, and `message` says what was expected.
Status self_check();

/// Reads a scene and places it on the lattice; `model` then lives in `memory`, and so does everything that follows.
/// What `options.camera` views stays the caller's. Errors: kScene with file:line:column, kFile, kMemory, kUsage.
Status load(std::string_view name, std::string_view text, const Reader& reader, const Options& options, void* memory,
            std::size_t bytes, Model*& model);

/// Direct and ambient illuminance and the maps; from the start if called again. Errors: kMemory, before anything is
/// lit; kInterrupted.
Status solve(Model& model, const Progress& progress);

/// The picture, line by line from the top, of a solved model. Errors: kMemory, before the first line; kInterrupted;
/// kUsage (no such camera, not solved).
Status draw(Model& model, const Progress& progress, const LineSink& sink);

/// What was counted so far.
const Statistics& statistics(const Model& model);

/// The smallest `bytes` with which load, solve and draw of this scene with these options work, known after load().
/// Without `picture`: load and solve only.
std::uint64_t smallest_memory(const Model& model, bool picture = true);

/// A name for messages and statistics: "load", "direct", "form_factors", "solution", "map", "picture".
const char* stage_name(Stage stage);

}  // namespace shodo
