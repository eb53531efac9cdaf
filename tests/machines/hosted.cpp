// The cases on a machine with an operating system: the log goes to standard output.
//   hosted [CASE]     one case only
#include <cstdio>

#include "machines/cases.h"

namespace {

alignas(8) unsigned char memory[machines::kBudgetBytes];

void print(const char* text) {
  std::fputs(text, stdout);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  return machines::run_cases({memory, print, {}, true}, count > 1 ? words[1] : "");
}
