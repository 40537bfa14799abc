#include "base/log.h"

#include <cstdio>

#include "base/progress.h"
#include "base/text.h"

namespace st {
namespace {
Verbosity g_verbosity = Verbosity::kNormal;

void print_line(const char* before, const std::string& text) {
  hide_progress();
  std::fprintf(stderr, "%s%s\n", before, text.c_str());
}

}  // namespace

void set_verbosity(Verbosity v) { g_verbosity = v; }
Verbosity verbosity() { return g_verbosity; }

void log_warning(const std::string& text) {
  if (g_verbosity != Verbosity::kQuiet) print_line("warning: ", one_line(text));
}

void log_report(const std::string& text) {
  if (g_verbosity != Verbosity::kQuiet) print_line("", printable(text));
}

void log_info(const std::string& text) {
  if (g_verbosity == Verbosity::kVerbose) print_line("", printable(text));
}

}  // namespace st
