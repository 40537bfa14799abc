// For how many threads a loop is cut into pieces.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "base/threads.h"

namespace st {

/// thread_count(), or as many as the environment asks for in ST_PIECES_FOR: bench/replay.py judges by a run with one
/// thread what more of them would take. Results do not depend on it.
inline int threads_of_pieces() {
  const char* asked = std::getenv("ST_PIECES_FOR");
  return std::max(thread_count(), asked ? std::atoi(asked) : 1);
}

}  // namespace st
