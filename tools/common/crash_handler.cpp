#include "common/crash_handler.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "base/current_work.h"
#include "base/error.h"
#include "base/own_program.h"
#include "io/file/journal.h"
#include "io/file/temporary_file.h"

namespace st {
namespace {

constexpr char kVariable[] = "ST_TRIES";
constexpr char kCrashed[] = ": crashed there, a defect: please report it with the CAD file";
constexpr char kDidNotEnd[] = ": takes too long, probably a defect: please report it with the CAD file";
constexpr int kLate = SIGUSR1;
constexpr std::size_t kAltStack = 65'536;

const char* g_tool = "st";
const char* g_part = "";
std::atomic_flag g_is_crashing = ATOMIC_FLAG_INIT;
char g_alt_stack[kAltStack];  // of the main thread: its own may be what overflowed

// What the handler needs to start again, made ready ahead: it may not allocate.
bool g_may_restart = false, g_parent_restarts = false;
std::string g_program;
std::string g_tries;  // an entry of the environment
char** g_argv = nullptr;
std::vector<char*> g_environment;

void print(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

void print_line(const char* kind, const char* work, const char* end) {
  for (const char* text : {g_tool, kind, g_part, work, end}) print(text);
}

void say_again(const char* work, int signal) {
  print_line(": warning: ", work, signal == kLate ? kDidNotEnd : kCrashed);
  print("; again without it\n");
}

/// Does not come back where it succeeds. `work`: "face 12".
void start_again(const char* work, int signal) {
  say_again(work, signal);
  sigset_t crash;
  sigemptyset(&crash);
  sigaddset(&crash, signal);
  pthread_sigmask(SIG_UNBLOCK, &crash, nullptr);  // the mask would stay
  execve(g_program.c_str(), g_argv, g_environment.data());
}

extern "C" void end_on_crash(int signal) {
  const bool is_late = signal == kLate;
  if (is_late && !is_current_work_late()) return;  // it has ended meanwhile
  if (g_is_crashing.test_and_set())                // another thread is at it
    for (;;) pause();
  char work[64];
  remove_temporaries();
  if (describe_current_work(work, sizeof work)) {
    const bool is_noted = std::strncmp(work, "face ", 5) == 0 && note_crash(std::atoi(work + 5) - 1, signal);
    if (is_noted && g_may_restart) start_again(work, signal);
    if (is_noted && g_parent_restarts) {
      say_again(work, signal);
      _exit(kAgain);
    }
    print_line(": error: ", work, is_late ? kDidNotEnd : kCrashed);
    print("\n");
  }
  if (is_late) _exit(static_cast<int>(ExitCode::kInternal));
  std::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

void install_crash_handler(const char* tool) {
  g_tool = tool;
  stack_t stack{};
  stack.ss_sp = g_alt_stack;
  stack.ss_size = sizeof g_alt_stack;
  sigaltstack(&stack, nullptr);
  for (const int signal : {SIGSEGV, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction old {};
    sigaction(signal, nullptr, &old);
    if (old.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = end_on_crash;
    action.sa_flags = SA_ONSTACK;
    sigaction(signal, &action, nullptr);
  }
}

void watch_late_work() {
  struct sigaction action {};
  action.sa_handler = end_on_crash;
  action.sa_flags = SA_ONSTACK | SA_RESTART;
  sigaction(kLate, &action, nullptr);
  std::thread([] {
    for (;;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      signal_late_work(kLate);
    }
  }).detach();
}

void restart_after_crashes(char** argv) {
  g_program = own_program();
  if (g_program.empty()) return;
  if (n_tries() >= kMostTries) return;
  const std::string name = std::string(kVariable) + "=";
  g_tries = name + std::to_string(n_tries() + 1);
  for (char** entry = environ; *entry; ++entry)
    if (std::strncmp(*entry, name.c_str(), name.size()) != 0) g_environment.push_back(*entry);
  g_environment.push_back(g_tries.data());
  g_environment.push_back(nullptr);
  g_argv = argv;
  g_may_restart = true;
}

void leave_restart_to_parent() { g_parent_restarts = true; }

void name_part(const char* text) { g_part = text; }

int n_tries() {
  const char* text = std::getenv(kVariable);
  return text ? std::atoi(text) : 0;
}

void count_try() { setenv(kVariable, std::to_string(n_tries() + 1).c_str(), 1); }

}  // namespace st
