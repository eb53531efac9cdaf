// One stage of the pipeline as an overlay: compiled with STAGE 1 to 5 it holds all that one of them needs and nothing
// else (doc/determinism.md).
#include "machines/cortex-m3/overlays.h"
#include "model.h"

namespace machines {

using shodo::Model;
using shodo::Progress;
using shodo::Status;

#if STAGE == 1
Status enter_load(const LoadCall& call, Model*& model) {
  return shodo::load(call.name, call.text, call.reader, call.options, call.memory, call.bytes, model);
}
std::uint64_t enter_smallest(const Model& model, bool picture) { return shodo::smallest_memory(model, picture); }
Status enter_self_check() { return shodo::self_check(); }
#elif STAGE == 2
Status enter_direct(Model& model, const Progress& progress) {
  const Status status = shodo::start_solving(model);
  return status.done() ? shodo::solve_directly(model, progress) : status;
}
#elif STAGE == 3
Status enter_ambient(Model& model, const Progress& progress) { return shodo::solve_ambiently(model, progress); }
#elif STAGE == 4
Status enter_map(Model& model, const Progress& progress) { return shodo::solve_maps(model, progress); }
#else
Status enter_draw(Model& model, const Progress& progress, const shodo::LineSink& sink) {
  return shodo::draw(model, progress, sink);
}
#endif

}  // namespace machines
