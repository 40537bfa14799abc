#include "base/log.h"

#include <cstdio>
#include <vector>

#include "base/progress.h"
#include "base/text.h"

namespace st {
namespace {
Verbosity g_verbosity = Verbosity::kNormal;
std::vector<std::string> g_hidden_folders;  // with a slash at the end

void print_line(const char* before, const std::string& text) {
  hide_progress();
  std::fprintf(stderr, "%s%s\n", before, without_hidden_folders(text).c_str());
}

}  // namespace

void set_verbosity(Verbosity v) { g_verbosity = v; }
Verbosity verbosity() { return g_verbosity; }

void hide_folder(const std::string& folder) { g_hidden_folders.push_back(folder + "/"); }

std::string without_hidden_folders(std::string text) {
  for (const std::string& folder : g_hidden_folders)
    for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) text.erase(at, folder.size());
  return text;
}

void log_warning(const std::string& text) {
  if (g_verbosity != Verbosity::kQuiet) print_line("warning: ", one_line(text));
}

void log_step(const std::string& text) {
  if (g_verbosity != Verbosity::kQuiet) print_line("", printable(text));
}

void log_report(const std::string& text) {
  if (g_verbosity >= Verbosity::kNormal) print_line("", printable(text));
}

void log_info(const std::string& text) {
  if (g_verbosity == Verbosity::kVerbose) print_line("", printable(text));
}

}  // namespace st
