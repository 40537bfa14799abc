#include "base/assert.h"

#include <cstdio>
#include <cstdlib>

namespace st {

void assertion_failed(const char* condition, const char* file, int line, const char* function) {
  std::fprintf(stderr, "%s:%d: %s: assertion failed: %s\n", file, line, function, condition);
  std::abort();
}

}  // namespace st
