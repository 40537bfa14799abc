// Messages to stderr, decided by one verbosity of the process. The library prints nowhere else, progress apart.
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

/// Wall-clock seconds since construction.
class Timer {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace st
