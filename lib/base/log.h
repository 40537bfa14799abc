// Messages to stderr, decided by one verbosity of the process. The library prints nowhere else, progress apart.
#pragma once

#include <chrono>
#include <string>

namespace st {

/// kBrief: what a program says that runs several stages, each of which says less than by itself.
enum class Verbosity : int { kQuiet = 0, kBrief = 1, kNormal = 2, kVerbose = 3 };

/// Process-wide verbosity (default kNormal). On MPI runs every rank but the first is set to kQuiet.
void set_verbosity(Verbosity v);
Verbosity verbosity();

/// From now on messages name files in this folder, which is there for a while only, without it. Before there are
/// threads.
void hide_folder(const std::string& folder);
/// `text` without the folders that are hidden.
std::string without_hidden_folders(std::string text);

/// One warning line on stderr ("warning: ..."), shown unless quiet.
void log_warning(const std::string& text);
/// One line for a finished step on stderr, shown unless quiet.
void log_step(const std::string& text);
/// One line of a result on stderr, such as a row of a table, shown unless quiet or brief.
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
