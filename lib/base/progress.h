// How far a long piece of work has come, on stderr: a line that is redrawn on a terminal, a line now and then in a log.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace st {

/// How progress appears.
enum class ProgressSink : int {
  kNone,      ///< quiet
  kLog,       ///< lines, when the work takes longer than 10 s
  kTerminal,  ///< one line, redrawn
  kRelay      ///< lines for relay_progress() of a process that owns the terminal
};

/// What update() shows after `seconds` of work: "meshing 43 %, 0.35 million triangles/s, 8 s left". Without the rate
/// where `unit` is empty, without the time left before it can be told.
std::string progress_text(const std::string& label, double done, double total, const std::string& unit, double seconds);

/// Which moments get a line in a log: none in the first 10 s of a piece of work, then one for each 10 % or 10 s,
/// whichever comes first.
class LogPace {
 public:
  explicit LogPace(double period_seconds = 10) : period_(period_seconds) {}
  /// `seconds` since the beginning, `share` done, 0 to 1. True: write a line now.
  bool is_due(double seconds, double share);
  /// A line was written now.
  void note(double seconds, double share);

 private:
  double period_, last_seconds_ = 0, last_share_ = 0;
};

class Heartbeat;

/// One piece of work. Shows nothing when quiet; says how long it took when verbose. On MPI runs only the first rank's
/// shows. In a log a step that tells nothing itself gets a line every 10 s, from 10 s after the first piece of work on:
/// "importing: sewing 40 %, 12 s so far". A thread writes it; see run_in_child() for processes that fork then.
/// ST_PROGRESS_SECONDS in the environment replaces the 10 s everywhere.
class Progress {
 public:
  /// `total` in units of `unit` (a plural, as in "triangles"; empty: shares alone are meaningful).
  Progress(std::string label, double total, std::string unit = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `done` in [0, total]. Redraws at most ten times a second; cheap enough for every few microseconds of work. Any
  /// thread, one at a time.
  void update(double done);
  /// So much more is done; from any thread, also from several at once.
  void advance(double part);
  /// Begins a step with a name of its own, `done` as before: "checking: crossings". In a log it gets a line when the
  /// first work of this process began 10 s ago or earlier.
  void step(const std::string& name, double done);

 private:
  friend class Heartbeat;
  void show(double done, bool is_new_step);
  /// Says in a log what is being done.
  void beat();

  std::string label_, step_, unit_;
  double total_, done_ = 0;
  ProgressSink sink_;
  LogPace pace_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point start_, last_;
};

/// Clears the redrawn line, so that other words may stand there; the next update draws it again.
void hide_progress();

/// On a terminal: removes the line that a child process left there when it was ended.
void erase_progress_of_child();

/// Tells processes that are started from now on to write progress as kRelay does, if stderr is a terminal.
void offer_progress_relay();
/// Text of a process that offer_progress_relay() told so: its progress redrawn on this process's terminal. False, and
/// nothing was written, when the text is no progress.
bool relay_progress(const std::string& line);

}  // namespace st
