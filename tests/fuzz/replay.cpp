// Files given to a fuzzer's function, whole or cut at every byte; linked in the place of libFuzzer. For sanitizers that
// libFuzzer itself doesn't stand, too: what one build found is replayed with another.
//     replay [--cut] FILE...
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

/// A copy of its own, so that a read past its end is seen.
void give(const std::vector<char>& bytes, std::size_t size) {
  const std::vector<std::uint8_t> beginning(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  LLVMFuzzerTestOneInput(beginning.data(), size);
}

std::size_t replay(const char* path, bool cut) {
  std::FILE* file = std::fopen(path, "rb");
  if (file == nullptr) return 0;
  std::vector<char> bytes;
  for (int byte = std::getc(file); byte != EOF; byte = std::getc(file)) bytes.push_back(static_cast<char>(byte));
  std::fclose(file);
  for (std::size_t size = 0; cut && size < bytes.size(); ++size) give(bytes, size);
  give(bytes, bytes.size());
  return 1;
}

}  // namespace

int main(int count, char** words) {
  const bool cut = count > 1 && std::strcmp(words[1], "--cut") == 0;
  std::size_t files = 0;
  for (int k = cut ? 2 : 1; k < count; ++k) files += replay(words[k], cut);
  std::printf("%zu inputs\n", files);
  return files > 0 ? 0 : 1;
}
