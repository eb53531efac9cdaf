// The program (contract 1): the only code that touches files.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <new>
#include <string>

#include "cli/clashes.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "cli/watch.h"

namespace {

using namespace shodo;

/// A file opened where standard output or error was closed would receive messages: these descriptors are never free.
void hold_standard_descriptors() {
  for (int descriptor = open("/dev/null", O_RDONLY); descriptor >= 0; descriptor = open("/dev/null", O_RDONLY)) {
    if (descriptor <= STDERR_FILENO) continue;
    close(descriptor);
    return;
  }
}

int print(const std::string& text) {
  FileError error;
  OutputFile out("-");
  if (out.open(error) && out.write(text, error) && out.close(error)) return 0;
  std::fprintf(stderr, "shodo: %s\n", error.text.c_str());
  return 1;
}

int run(int count, char** words) {
  Arguments arguments;
  std::string mistake;
  if (!parse_arguments(count, words, arguments, mistake) || !outputs_apart(arguments, arguments.scenes, mistake)) {
    std::fprintf(stderr, "shodo: %s (see shodo --help)\n", mistake.c_str());
    return 2;
  }
  switch (arguments.command) {
    case Command::kHelp: return print(help_text());
    case Command::kVersion: return print(std::string(kVersion) + "\n");
    case Command::kRender: return render(arguments);
    case Command::kMap: return map(arguments);
    case Command::kReport: return report(arguments);
    case Command::kDifference: return difference(arguments);
    case Command::kCheck: return check(arguments);
    case Command::kNone: break;
  }
  return 2;
}

}  // namespace

int main(int count, char** words) {
  shodo::listen_for_interrupts();
  hold_standard_descriptors();
  // Writing then fails, and is reported, instead of ending the program in the middle.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(count, words);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "shodo: the system has not enough memory\n");
    return 1;
  }
}
