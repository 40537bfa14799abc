#include "base/current_work.h"

#include <csignal>
#include <ctime>
#include <exception>
#include <mutex>
#include <sstream>
#include <string>
#include <utility>

namespace st {
namespace {

thread_local const char* t_kind = nullptr;
thread_local std::int64_t t_number = 0;
thread_local double t_deadline = std::numeric_limits<double>::infinity();
thread_local double t_seconds = std::numeric_limits<double>::infinity();
thread_local bool t_throws = false;
thread_local unsigned t_n_asked = 0;
thread_local const char* t_ended_kind = nullptr;
thread_local std::int64_t t_ended_number = 0;

constexpr unsigned kAsksPerLook = 64;  // of throw_if_late(): looking at the clock takes 30 ns

std::mutex g_mutex;

/// Never destroyed: a watching thread may look at it while the program ends.
std::list<LateWatch>& watches() {
  static auto& list = *new std::list<LateWatch>;
  return list;
}

std::string short_number(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

double now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

CurrentWork::CurrentWork(const char* kind, std::int64_t number, const WorkLimit& limit)
    : n_exceptions_before_(std::uncaught_exceptions()),
      seconds_before_(std::exchange(t_seconds, limit.seconds)),
      throws_before_(std::exchange(t_throws, limit.when_late == WhenLate::kThrow)),
      kind_before_(std::exchange(t_kind, kind)),
      number_before_(std::exchange(t_number, number)),
      deadline_before_(std::exchange(t_deadline, now() + limit.seconds)) {
  forget_ended_work();
  const std::lock_guard lock(g_mutex);
  watch_ = watches().insert(watches().end(), {pthread_self(), t_deadline});
}

CurrentWork::~CurrentWork() {
  {
    const std::lock_guard lock(g_mutex);
    watches().erase(watch_);
  }
  if (std::uncaught_exceptions() > n_exceptions_before_ && !t_ended_kind) {
    t_ended_kind = t_kind;
    t_ended_number = t_number;
  }
  t_seconds = seconds_before_;
  t_throws = throws_before_;
  t_deadline = deadline_before_;
  t_kind = kind_before_;
  t_number = number_before_;
}

bool describe_current_work(char* text, int size) {
  if (!t_kind) return false;
  int n = 0;
  for (const char* c = t_kind; *c && n < size - 1; ++c) text[n++] = *c;
  if (n < size - 1) text[n++] = ' ';
  char digits[20];
  int n_digits = 0;
  for (std::int64_t rest = t_number; n_digits == 0 || rest > 0; rest /= 10)
    digits[n_digits++] = static_cast<char>('0' + rest % 10);
  while (n_digits > 0 && n < size - 1) text[n++] = digits[--n_digits];
  text[n] = '\0';
  return true;
}

std::string ended_work() {
  return t_ended_kind ? std::string(t_ended_kind) + " " + std::to_string(t_ended_number) + ": " : "";
}

void forget_ended_work() { t_ended_kind = nullptr; }

bool is_current_work_late() { return now() > t_deadline; }

void signal_late_work(int signal) {
  const std::lock_guard lock(g_mutex);
  for (const LateWatch& watch : watches())
    if (now() > watch.deadline) pthread_kill(watch.thread, signal);
}

LateWork::LateWork(double seconds)
    : Error(ExitCode::kGeometry, "takes longer than " + short_number(seconds) +
                                     " s, its surface may be damaged; give it more with --time-limit") {}

void throw_if_late() {
  if (t_throws && ++t_n_asked % kAsksPerLook == 0 && is_current_work_late()) throw LateWork(t_seconds);
}

}  // namespace st
