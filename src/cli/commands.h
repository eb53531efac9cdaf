// The program's commands; each returns the exit status.
#pragma once

#include "cli/arguments.h"

namespace shodo {

int render(const Arguments& arguments);
int map(const Arguments& arguments);
int report(const Arguments& arguments);
int difference(const Arguments& arguments);
int check(const Arguments& arguments);

}  // namespace shodo
