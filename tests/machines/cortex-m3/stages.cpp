// One stage of the pipeline as an overlay: what is compiled with STAGE 1, 2 or 3 holds all that load, solve or draw
// needs and nothing else (doc/determinism.md).
#include "machines/cortex-m3/overlays.h"
#include "model.h"

namespace machines {

#if STAGE == 1
shodo::Status enter_load(const LoadCall& call, shodo::Model*& model) {
  return shodo::load(call.name, call.text, call.reader, call.options, call.memory, call.bytes, model);
}
std::uint64_t enter_smallest(const shodo::Model& model, bool picture) {
  return shodo::smallest_memory(model, picture);
}
shodo::Status enter_self_check() { return shodo::self_check(); }
#elif STAGE == 2
shodo::Status enter_solve(shodo::Model& model, const shodo::Progress& progress) {
  return shodo::solve(model, progress);
}
#else
shodo::Status enter_draw(shodo::Model& model, const shodo::Progress& progress, const shodo::LineSink& sink) {
  return shodo::draw(model, progress, sink);
}
#endif

}  // namespace machines
