// Messages and progress to stderr, decided by one verbosity of the process. The library never prints elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace st {

enum class Verbosity : int { kQuiet = 0, kNormal = 1, kVerbose = 2 };

/// Process-wide verbosity (default kNormal). On MPI runs every rank but the first is set to kQuiet.
void set_verbosity(Verbosity v);
Verbosity verbosity();

/// One warning line on stderr ("warning: ..."), shown unless quiet.
void log_warning(const std::string& text);
/// One line of a result on stderr, such as a row of a table, shown unless quiet.
void log_report(const std::string& text);
/// One information line on stderr, shown when verbose.
void log_info(const std::string& text);

/// A progress line on a terminal (nothing when stderr is none, or quiet).
class Progress {
 public:
  Progress(std::string label, double total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `done` in [0, total]; redraws at most ten times a second.
  void update(double done);

 private:
  std::string label_;
  double total_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_{};
};

/// Wall-clock seconds since construction.
class Timer {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace st
