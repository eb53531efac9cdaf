// One stage of the pipeline as an overlay: compiled with STAGE 1 to 9 it holds all that one of them needs and nothing
// else (doc/determinism.md).
#include "machines/cortex-m3/overlays.h"
#include "model.h"

namespace machines {

using shodo::Model;
using shodo::Progress;
using shodo::Status;

#if STAGE == 1
Status enter_load(const LoadCall& call, Model*& model) {
  return shodo::start_loading(call.name, call.text, call.reader, call.options, call.memory, call.bytes, model);
}
#elif STAGE == 2
Status enter_place(Model& model) { return shodo::finish_loading(model); }
std::uint64_t enter_smallest(const Model& model, bool picture) { return shodo::smallest_memory(model, picture); }
Status enter_self_check() { return shodo::self_check(); }
Status enter_solving(Model& model) { return shodo::start_solving(model); }
Status enter_drawing(Model& model, const Progress& progress) { return shodo::start_drawing(model, progress); }
#elif STAGE == 3
Status enter_direct(Model& model, const Progress& progress) { return shodo::solve_directly(model, progress); }
Status enter_again(Model& model, const Progress& progress) { return shodo::solve_again(model, progress); }
#elif STAGE == 4
Status enter_prepare(Model& model, const Progress& progress) { return shodo::prepare_ambiently(model, progress); }
#elif STAGE == 5
Status enter_ambient(Model& model, const Progress& progress) { return shodo::solve_ambiently(model, progress); }
#elif STAGE == 6
Status enter_mirrors(Model& model, const Progress& progress) { return shodo::send_over_mirrors(model, progress); }
#elif STAGE == 7
Status enter_map(Model& model, const Progress& progress) { return shodo::solve_maps(model, progress); }
#elif STAGE == 8
Status enter_picture(Model& model) { return shodo::prepare_drawing(model); }
#else
Status enter_draw(Model& model, const Progress& progress, const shodo::LineSink& sink) {
  return shodo::finish_drawing(model, progress, sink);
}
#endif

}  // namespace machines
