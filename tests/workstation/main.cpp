// Lights and draws a scene as the program does, without files, and marks its stages for the counting plugin.
//
// Takes the words of `shodo render`; the picture isn't written, but its hash is printed, so that a counted run is
// known to have drawn the right pixels. The hash stands for the picture's file, which isn't counted either.
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>

#include "cli/arguments.h"
#include "shodo/shodo.h"
#include "support/files.h"

namespace {

void mark(int stage) { close(-1000 - stage); }

/// Whatever is before the first stage counts as 0: start-up and loading.
bool watch(void* context, shodo::Stage stage, std::uint64_t, std::uint64_t) {
  auto& now = *static_cast<int*>(context);
  const int next = static_cast<int>(stage);
  if (next != now) mark(next);
  now = next;
  return true;
}

/// FNV-1a over the bytes of the picture, outside of all stages.
bool hash_line(void* context, std::uint32_t, std::span<const std::uint8_t> rgb) {
  mark(0);
  auto& hash = *static_cast<std::uint64_t*>(context);
  for (const std::uint8_t byte : rgb) hash = (hash ^ byte) * 0x100000001b3;
  mark(static_cast<int>(shodo::Stage::kPicture));
  return true;
}

int fail(const char* message) {
  std::fprintf(stderr, "workstation: %s\n", message);
  return 1;
}

}  // namespace

int main(int count, char** words) {
  shodo::Arguments arguments;
  std::string mistake;
  if (!shodo::parse_arguments(count, words, arguments, mistake)) return fail(mistake.c_str());
  const std::size_t slash = arguments.scene.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  shodo::FolderReader files(name == 0 ? "." : arguments.scene.substr(0, slash));
  std::string_view text;
  if (!files.read(arguments.scene.substr(name), text)) return fail("the scene can't be read");

  const std::unique_ptr<unsigned char[]> memory(new unsigned char[arguments.memory]);
  shodo::Model* model = nullptr;
  int stage = 0;
  const shodo::Progress progress{watch, &stage};
  std::uint64_t hash = 0xcbf29ce484222325;
  shodo::Status status =
      load(arguments.scene, text, files.reader(), arguments.options, memory.get(), arguments.memory, model);
  if (status.done()) status = solve(*model, progress);
  if (status.done()) status = draw(*model, progress, {hash_line, &hash});
  mark(0);
  if (!status.done()) return fail(status.message);
  std::printf("picture %016llx\n", static_cast<unsigned long long>(hash));
  const shodo::Statistics& counted = statistics(*model);
  std::printf("rows %u,%u,%u,%u\n", counted.rows_kept, counted.rows_recomputed, counted.lit_again,
              counted.placed_again);
  return 0;
}
