#include "base/stopped_processes.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace st {
namespace {

namespace fs = std::filesystem;

/// That in /proc/PID/stat, which follows the name in parentheses; 'X' where there is none.
char state_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t end = text.rfind(") ");
  return end != std::string::npos && end + 2 < text.size() ? text[end + 2] : 'X';
}

void add_children(pid_t process, std::vector<pid_t>& to) {
  std::error_code error;
  for (fs::directory_iterator it("/proc/" + std::to_string(process) + "/task", error), end; !error && it != end;
       it.increment(error)) {
    std::ifstream file(it->path() / "children");
    for (pid_t child = 0; file >> child;) to.push_back(child);
  }
}

}  // namespace

bool has_unreaped_child(pid_t process) {
  std::vector<pid_t> children;
  add_children(process, children);
  return std::any_of(children.begin(), children.end(), [](pid_t child) { return state_of(child) == 'Z'; });
}

std::vector<pid_t> StoppedProcesses::look() {
  std::map<pid_t, int> looks;
  std::vector<pid_t> processes = {root_}, stopped;
  bool is_enough = false;
  for (std::size_t i = 0; i < processes.size(); ++i) {
    const pid_t process = processes[i];
    add_children(process, processes);
    if (state_of(process) != 'T') continue;
    looks[process] = looks_[process] + 1;
    const bool is_first = !is_enough && looks[process] >= n_looks_;
    is_enough |= is_first;
    stopped.insert(is_first ? stopped.begin() : stopped.end(), process);
  }
  looks_ = std::move(looks);
  if (!is_enough) stopped.clear();
  return stopped;
}

}  // namespace st
