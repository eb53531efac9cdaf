// The doors of the overlays: each is good only while its overlay is in (overlays.cpp brings them in).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "shodo/shodo.h"

// The one thing that stays when an overlay is optimised as a whole program.
#define DOOR __attribute__((externally_visible, used))

namespace machines {

struct LoadCall {
  std::string_view name, text;
  const shodo::Reader& reader;
  const shodo::Options& options;
  void* memory;
  std::size_t bytes;
};

DOOR shodo::Status enter_load(const LoadCall& call, shodo::Model*& model);
DOOR shodo::Status enter_place(shodo::Model& model);
DOOR std::uint64_t enter_smallest(const shodo::Model& model, bool picture);
DOOR shodo::Status enter_self_check();
DOOR shodo::Status enter_solving(shodo::Model& model);
DOOR shodo::Status enter_drawing(shodo::Model& model, const shodo::Progress& progress);
DOOR shodo::Status enter_direct(shodo::Model& model, const shodo::Progress& progress);
DOOR shodo::Status enter_prepare(shodo::Model& model, const shodo::Progress& progress);
DOOR shodo::Status enter_ambient(shodo::Model& model, const shodo::Progress& progress);
DOOR shodo::Status enter_mirrors(shodo::Model& model, const shodo::Progress& progress);
DOOR shodo::Status enter_again(shodo::Model& model, const shodo::Progress& progress);
DOOR shodo::Status enter_map(shodo::Model& model, const shodo::Progress& progress);
DOOR shodo::Status enter_picture(shodo::Model& model);
DOOR shodo::Status enter_draw(shodo::Model& model, const shodo::Progress& progress, const shodo::LineSink& sink);

}  // namespace machines
