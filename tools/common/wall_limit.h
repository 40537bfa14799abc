// The end of a run that takes too long.
#pragma once

#include <functional>

namespace st {

/// From now on: calls `end` in a thread of its own when the program has run for `seconds` of wall time, then ends it
/// with the code that `end` returns. The time before this program started itself again (restart_after_crashes())
/// counts, so call this first.
void watch_wall_time(double seconds, std::function<int()> end);

}  // namespace st
