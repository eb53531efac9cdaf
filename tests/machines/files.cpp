// The scene files as part of the program: `.incbin` is the one thing that all assemblers of all machines share.
#include "machines/cases.h"

// Paths count from the folder in which the compiler runs, the top of the sources.
#define COMPILED_IN(symbol, path)                                                                            \
  asm(".section .rodata\n.balign 8\n.globl " #symbol "\n" #symbol ":\n.incbin \"" path "\"\n.globl " #symbol \
      "_end\n" #symbol "_end:\n.byte 0\n.previous\n");                                                        \
  extern "C" const char symbol[], symbol##_end[]

COMPILED_IN(file_box, "tests/cli/scenes/box.scn");
COMPILED_IN(file_sun, "tests/cli/scenes/sun.scn");
COMPILED_IN(file_shapes, "tests/cli/scenes/shapes.scn");
COMPILED_IN(file_planes, "tests/cli/scenes/planes.scn");
COMPILED_IN(file_textures, "tests/cli/scenes/textures.scn");
COMPILED_IN(file_tiles, "tests/cli/scenes/tiles.ppm");
COMPILED_IN(file_glass, "tests/cli/scenes/glass.scn");
COMPILED_IN(file_model, "tests/cli/scenes/model.scn");
COMPILED_IN(file_model_obj, "tests/cli/scenes/model.obj");
COMPILED_IN(file_model_mtl, "tests/cli/scenes/model.mtl");
COMPILED_IN(file_luminaires, "tests/cli/scenes/luminaires.scn");
COMPILED_IN(file_spread, "tests/cli/scenes/spread.ies");
COMPILED_IN(file_day, "data/day.scn");
COMPILED_IN(file_room, "data/room.scn");
COMPILED_IN(file_planks, "data/textures/planks.pgm");
COMPILED_IN(file_cloth, "data/textures/cloth.pgm");
COMPILED_IN(file_wood, "data/textures/wood.pgm");
COMPILED_IN(file_rug, "data/textures/rug.ppm");
COMPILED_IN(file_coast, "data/textures/coast.ppm");

namespace machines {

namespace {

struct File {
  std::string_view path;
  const char* start;
  const char* end;
};

constexpr File kFiles[] = {
    {"tests/cli/scenes/box.scn", file_box, file_box_end},
    {"tests/cli/scenes/sun.scn", file_sun, file_sun_end},
    {"tests/cli/scenes/shapes.scn", file_shapes, file_shapes_end},
    {"tests/cli/scenes/planes.scn", file_planes, file_planes_end},
    {"tests/cli/scenes/textures.scn", file_textures, file_textures_end},
    {"tiles.ppm", file_tiles, file_tiles_end},  // as textures.scn calls it
    {"tests/cli/scenes/glass.scn", file_glass, file_glass_end},
    {"tests/cli/scenes/model.scn", file_model, file_model_end},
    {"model.obj", file_model_obj, file_model_obj_end},  // as model.scn and model.obj call them
    {"model.mtl", file_model_mtl, file_model_mtl_end},
    {"tests/cli/scenes/luminaires.scn", file_luminaires, file_luminaires_end},
    {"spread.ies", file_spread, file_spread_end},  // as luminaires.scn calls it
    {"data/day.scn", file_day, file_day_end},
    {"room.scn", file_room, file_room_end},  // as day.scn calls it
    {"textures/planks.pgm", file_planks, file_planks_end},
    {"textures/cloth.pgm", file_cloth, file_cloth_end},
    {"textures/wood.pgm", file_wood, file_wood_end},
    {"textures/rug.ppm", file_rug, file_rug_end},
    {"textures/coast.ppm", file_coast, file_coast_end},
};

}  // namespace

bool find_file(std::string_view path, std::string_view& text) {
  for (const File& file : kFiles) {
    if (file.path != path) continue;
    text = std::string_view(file.start, static_cast<std::size_t>(file.end - file.start));
    return true;
  }
  return false;
}

shodo::Reader compiled_in() {
  return {[](void*, std::string_view path, std::string_view& text) { return find_file(path, text); }, nullptr};
}

}  // namespace machines
