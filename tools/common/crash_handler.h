// What happens when the program crashes or does not end: the face is named, and left out of another try.
#pragma once

#include <cstdint>
#include <vector>

namespace st {

/// A crash says at which face or edge it happened, where that is known (CurrentWork); temporaries are removed, and the
/// signal ends the program. `tool` outlives the program. A sanitizer's own handler stays.
void install_crash_handler(const char* tool);

/// From now on work that is late (CurrentWork) counts as a crash: looked for once in a while, by a thread of its own.
void watch_late_work();

/// From now on a crash at a face starts the program again, in the same process, with this face among crashed_faces().
/// After several faces a crash ends it. `argv`: of main. Not for ranks: the others would wait.
void restart_after_crashes(char** argv);

/// Faces at which earlier tries crashed, 0-based, ascending.
std::vector<std::int32_t> crashed_faces();

}  // namespace st
