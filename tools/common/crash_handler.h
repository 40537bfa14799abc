// What happens when the program crashes or does not end: the face is named, and left out of another try.
#pragma once

namespace st {

/// A crash says at which face or edge it happened, where that is known (CurrentWork); temporaries are removed, and the
/// signal ends the program. `tool` outlives the program. A sanitizer's own handler stays.
void install_crash_handler(const char* tool);

/// From now on work that is late (CurrentWork) counts as a crash: looked for once in a while, by a thread of its own.
void watch_late_work();

/// From now on a crash at a face that a Journal takes note of starts the program again, in the same process: the
/// journal says what to leave out. After several crashes the next one ends it. `argv`: of main. Not for ranks: the
/// others would wait.
void restart_after_crashes(char** argv);

/// The same where this process is a fork of one that starts another: a crash at such a face ends it with code kAgain.
void leave_restart_to_parent();
inline constexpr int kAgain = 75;  ///< EX_TEMPFAIL of sysexits.h

/// What this process is at, "st-mesh: ": messages of crashes begin with it. `text` outlives the process.
void name_part(const char* text);

/// How often the program was started again; a new try by who started it has to count with count_try().
int n_tries();
inline constexpr int kMostTries = 8;
/// For programs that are started from now on.
void count_try();

}  // namespace st
