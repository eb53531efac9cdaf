// The library in overlays: one piece of memory for code holds in turn what each stage needs. What a stage leaves to the
// next lies in the caller's memory, and nothing in it points into code or constants.
#include "machines/cortex-m3/overlays.h"

#include "model.h"

extern "C" {
extern std::uint32_t stage_code[];
extern const std::uint32_t load_from[], load_to[], direct_from[], direct_to[], ambient_from[], ambient_to[],
    map_from[], map_to[], draw_from[], draw_to[];
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

}  // namespace
}  // namespace machines

namespace shodo {

using machines::bring;

Status self_check() {
  bring(load_from, load_to);
  return machines::enter_self_check();
}

Status load(std::string_view name, std::string_view text, const Reader& reader, const Options& options, void* memory,
            std::size_t bytes, Model*& model) {
  bring(load_from, load_to);
  return machines::enter_load({name, text, reader, options, memory, bytes}, model);
}

std::uint64_t smallest_memory(const Model& model, bool picture) {
  bring(load_from, load_to);
  return machines::enter_smallest(model, picture);
}

Status solve(Model& model, const Progress& progress) {
  bring(direct_from, direct_to);
  Status status = machines::enter_direct(model, progress);
  if (!status.done()) return status;
  bring(ambient_from, ambient_to);
  status = machines::enter_ambient(model, progress);
  if (!status.done()) return status;
  bring(map_from, map_to);
  return machines::enter_map(model, progress);
}

Status draw(Model& model, const Progress& progress, const LineSink& sink) {
  bring(draw_from, draw_to);
  return machines::enter_draw(model, progress, sink);
}

const Statistics& statistics(const Model& model) { return model.statistics; }

}  // namespace shodo
