// The library in overlays: one piece of memory for code holds in turn what each stage needs. What a stage leaves to the
// next lies in the caller's memory, where nothing that a later one reads points into code or constants.
#include "machines/cortex-m3/overlays.h"

#include "model.h"

extern "C" {
extern std::uint32_t stage_code[];
extern const std::uint32_t load_from[], load_to[], place_from[], place_to[], direct_from[], direct_to[],
    prepare_from[], prepare_to[], ambient_from[], ambient_to[], mirrors_from[], mirrors_to[],
    map_from[], map_to[], picture_from[], picture_to[], draw_from[], draw_to[];
}

namespace machines {
namespace {

/// Copies an overlay's code and constants to where they run, if they aren't there.
void bring(const std::uint32_t* from, const std::uint32_t* to) {
  static const std::uint32_t* in = nullptr;
  if (in == from) return;
  in = from;
  for (std::uint32_t* at = stage_code; from < to; ++at) *at = *from++;
  asm volatile("dsb\n\tisb" ::: "memory");
}

shodo::Status step_ambiently(shodo::Model& model, const shodo::Progress& progress) {
  switch (model.rounds.next) {
    case shodo::AmbientRounds::Step::kPrepare:
      bring(prepare_from, prepare_to);
      return enter_prepare(model, progress);
    case shodo::AmbientRounds::Step::kSolve:
      bring(ambient_from, ambient_to);
      return enter_ambient(model, progress);
    default:
      bring(mirrors_from, mirrors_to);
      return enter_mirrors(model, progress);
  }
}

}  // namespace
}  // namespace machines

namespace shodo {

using machines::bring;

Status self_check() {
  bring(place_from, place_to);
  return machines::enter_self_check();
}

Status load(std::string_view name, std::string_view text, const Reader& reader, const Options& options, void* memory,
            std::size_t bytes, Model*& model) {
  bring(load_from, load_to);
  Status status = machines::enter_load({name, text, reader, options, memory, bytes}, model);
  if (!status.done()) return status;
  bring(place_from, place_to);
  status = machines::enter_place(*model);
  if (!status.done()) model = nullptr;
  return status;
}

std::uint64_t smallest_memory(const Model& model, bool picture) {
  bring(place_from, place_to);
  return machines::enter_smallest(model, picture);
}

Status solve(Model& model, const Progress& progress) {
  bring(place_from, place_to);
  Status status = machines::enter_solving(model);
  if (!status.done()) return status;
  bring(direct_from, direct_to);
  status = machines::enter_direct(model, progress);
  if (!status.done()) return status;
  while (model.rounds.next != AmbientRounds::Step::kDone) {
    status = machines::step_ambiently(model, progress);
    if (!status.done()) return status;
  }
  bring(direct_from, direct_to);
  status = machines::enter_again(model, progress);
  if (!status.done()) return status;
  bring(map_from, map_to);
  return machines::enter_map(model, progress);
}

Status draw(Model& model, const Progress& progress, const LineSink& sink) {
  bring(place_from, place_to);
  Status status = machines::enter_drawing(model, progress);
  if (!status.done()) return status;
  bring(picture_from, picture_to);
  status = machines::enter_picture(model);
  if (!status.done()) return status;
  bring(draw_from, draw_to);
  return machines::enter_draw(model, progress, sink);
}

const Statistics& statistics(const Model& model) { return model.statistics; }

}  // namespace shodo
