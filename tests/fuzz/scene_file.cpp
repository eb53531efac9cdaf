// Any bytes as a scene file, with the files that it includes: it is read, or refused with a place and a reason, in
// bounded memory; and what is refused or read doesn't depend on how much memory there is.
#include "fuzz/fuzz.h"

namespace {

using namespace shodo;

constexpr std::size_t kSmall = 200 << 10, kLarge = 2 << 20;
alignas(16) unsigned char g_memory[kLarge];

Status load_into(fuzz::InputFiles& files, std::size_t bytes, Model*& model) {
  return load("top.scn", files.top(), files.reader(), {}, g_memory, bytes, model);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::InputFiles files({reinterpret_cast<const char*>(data), size});
  Model* model = nullptr;
  const Status small = load_into(files, kSmall, model);
  fuzz::expect_told(small);
  if (small.done()) SHODO_CHECK(smallest_memory(*model) >= smallest_memory(*model, false));
  const Status large = load_into(files, kLarge, model);
  fuzz::expect_told(large);
  SHODO_CHECK(small.code == StatusCode::kMemory || fuzz::same(small, large));
  return 0;
}
