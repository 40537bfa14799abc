#include "base/log.h"

#include <unistd.h>

#include <cstdio>

#include "base/text.h"

namespace st {
namespace {
Verbosity g_verbosity = Verbosity::kNormal;
}

void set_verbosity(Verbosity v) { g_verbosity = v; }
Verbosity verbosity() { return g_verbosity; }

void log_warning(const std::string& text) {
  if (g_verbosity != Verbosity::kQuiet) std::fprintf(stderr, "warning: %s\n", one_line(text).c_str());
}

void log_report(const std::string& text) {
  if (g_verbosity != Verbosity::kQuiet) std::fprintf(stderr, "%s\n", printable(text).c_str());
}

void log_info(const std::string& text) {
  if (g_verbosity == Verbosity::kVerbose) std::fprintf(stderr, "%s\n", printable(text).c_str());
}

Progress::Progress(std::string label, double total) : label_(std::move(label)), total_(total) {}

Progress::~Progress() {
  if (shown_) std::fprintf(stderr, "\r\033[K");
}

void Progress::update(double done) {
  if (g_verbosity == Verbosity::kQuiet || !isatty(STDERR_FILENO)) return;
  const auto now = std::chrono::steady_clock::now();
  if (shown_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  shown_ = true;
  std::fprintf(stderr, "\r%s %3.0f %%", label_.c_str(), total_ > 0 ? 100.0 * done / total_ : 100.0);
  std::fflush(stderr);
}

}  // namespace st
