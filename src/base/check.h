// A mistake of ours stops the program at once; a mistake of the user's is a Status instead.
#pragma once

#define SHODO_CHECK(condition) \
  do {                         \
    if (!(condition)) __builtin_trap(); \
  } while (false)
