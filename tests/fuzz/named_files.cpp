// Files that are read beside scenes: the first byte says which reader gets the others.
#include "cli/report_document.h"
#include "cli/report_memory.h"
#include "cli/report_workstation.h"
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace shodo;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 'w':
      static_cast<void>(workstation_seconds(text, "day"));
      static_cast<void>(workstation_options(text));
      break;
    case 'm': {
      Document document;
      add_memory_chapter(document, memory_costs(text));
      break;
    }
  }
  return 0;
}
