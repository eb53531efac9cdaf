// Files that are read beside scenes: the first byte says which reader gets the others. 'p' a texture of the library's,
// 'i' a picture that stb_image decodes, 'g' a picture or map that is compared, 'w' and 'm' what the report reads.
#include <string>

#include "cli/image_file.h"
#include "cli/report_counts.h"
#include "cli/report_document.h"
#include "cli/report_memory.h"
#include "cli/report_scaling.h"
#include "cli/report_workstation.h"
#include "cli/value_grid.h"
#include "fuzz/fuzz.h"

namespace {

using namespace shodo;

constexpr std::size_t kBytes = 1 << 20;
alignas(16) unsigned char g_memory[kBytes];

/// A scene whose only surface has the texture.
void load_texture(std::string_view texture) {
  constexpr std::string_view kScene =
      "shodo 1\nunit m\nmaterial m diffuse 0.3 texture t.ppm size 0.5 0.25\nobject o\n"
      "quad m 0 0 0  0 0 1  1 0 1  1 0 0 patches 1 1 sub 1 1\n";
  const Reader reader{[](void* text, std::string_view, std::string_view& file) {
                        file = *static_cast<std::string_view*>(text);
                        return true;
                      },
                      &texture};
  Model* model = nullptr;
  fuzz::expect_told(load("top.scn", kScene, reader, {}, g_memory, kBytes, model));
}

void compare(std::string_view bytes) {
  ValueGrid grid;
  std::string mistake;
  const bool read = read_grid(bytes, grid, mistake);
  SHODO_CHECK(read ? grid.value.size() == std::size_t{grid.width} * grid.height * grid.channels : !mistake.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 'p': load_texture(text); break;
    case 'i': {
      std::string ppm;
      constexpr int kMost = 300;  // larger ones take long, and are the same
      if (decode_image(text, ppm, kMost)) load_texture(ppm);
      break;
    }
    case 'g': compare(text); break;
    case 'w': {
      std::optional<WorkstationSeconds> seconds;
      workstation_seconds(text, "day", seconds);
      break;
    }
    case 'm': {
      Document document;
      std::vector<MemoryCost> costs;
      memory_costs(text, costs);
      add_memory_chapter(document, costs);
      CaseCosts().read(text);
      std::vector<CountedLine> sizes;
      read_scaling(text, sizes);
      add_scaling_chapter(document, sizes);
      break;
    }
  }
  return 0;
}
