#include "base/progress.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <utility>
#include <vector>

#include "base/log.h"

namespace st {
namespace {

constexpr double kLogSeconds = 10, kLogShare = 0.1;
constexpr const char* kSecondsVariable = "ST_PROGRESS_SECONDS";      // instead of kLogSeconds
constexpr double kSecondsBeforeGuess = 1, kShareBeforeGuess = 0.02;  // earlier the time left is a guess
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr const char* kRelayVariable = "ST_PROGRESS";
constexpr const char* kRelayValue = "relay";
constexpr char kErase[] = "\r\033[K";
constexpr char kRelayMark = '\r';  // begins a line of kRelay

ProgressSink find_sink() {
  if (verbosity() == Verbosity::kQuiet) return ProgressSink::kNone;
  if (isatty(STDERR_FILENO)) return ProgressSink::kTerminal;
  const char* asked = std::getenv(kRelayVariable);
  return asked && std::string(asked) == kRelayValue ? ProgressSink::kRelay : ProgressSink::kLog;
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string amount(double value) {
  return value >= 1e5   ? formatted("%.2f million", value / 1e6)
         : value >= 1e3 ? formatted("%.1f thousand", value / 1e3)
                        : formatted("%.3g", value);
}

std::string duration(double seconds) {
  if (seconds < 99.5) return formatted("%.0f s", seconds);
  const double minutes = seconds / 60;
  return minutes < 99.5 ? formatted("%.0f min", minutes) : formatted("%.1f h", minutes / 60);
}

/// Where a line of progress stands now; kNone: nowhere.
std::atomic<ProgressSink> g_shown = ProgressSink::kNone;

std::chrono::steady_clock::time_point first_work() {
  static const auto start = std::chrono::steady_clock::now();
  return start;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Before the first line in a log, and between lines.
double log_seconds() {
  static const double seconds = [] {
    const char* asked = std::getenv(kSecondsVariable);
    const double value = asked ? std::strtod(asked, nullptr) : 0;
    return value > 0 ? value : kLogSeconds;
  }();
  return seconds;
}

/// When the last line in a log was written, seconds since first_work().
std::atomic<double> g_last_line = 0;

void write_line(const std::string& text) {
  g_last_line = seconds_since(first_work());
  std::fprintf(stderr, "%s\n", text.c_str());
}

}  // namespace

/// A thread that lets the innermost piece of work speak while it says nothing itself: in steps that cannot tell how far
/// they are. Starts with the first piece in a log. A forked process has another one: what a thread of its parent waits
/// for, or holds, is stuck there.
class Heartbeat {
 public:
  static Heartbeat& one() { return *current(); }
  void add(Progress* work) {
    const std::lock_guard lock(mutex_);
    works_.push_back(work);
    if (!is_started_) start();
    changed_.notify_one();
  }
  void remove(Progress* work) {
    const std::lock_guard lock(mutex_);
    std::erase(works_, work);
  }

 private:
  /// Never destroyed: the thread may look at it while the program ends.
  static Heartbeat*& current() {
    static Heartbeat* heartbeat = [] {
      pthread_atfork(nullptr, nullptr, [] { current() = new Heartbeat; });
      return new Heartbeat;
    }();
    return heartbeat;
  }
  /// The thread gets no signals: they are for those that work.
  void start() {
    is_started_ = true;
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    std::thread([this] { run(); }).detach();
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  [[noreturn]] void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return !works_.empty(); });
      changed_.wait_for(lock, std::chrono::duration<double>(0.1 * log_seconds()));
      if (!works_.empty() && seconds_since(first_work()) - g_last_line >= log_seconds()) works_.back()->beat();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Progress*> works_;
  bool is_started_ = false;
};

std::string progress_text(const std::string& label, double done, double total, const std::string& unit,
                          double seconds) {
  const double share = total > 0 ? std::clamp(done / total, 0.0, 1.0) : 1.0;
  std::string text = label + formatted(" %.0f %%", 100 * share);
  if (seconds < kSecondsBeforeGuess || share < kShareBeforeGuess) return text;
  if (!unit.empty()) text += ", " + amount(done / seconds) + " " + unit + "/s";
  if (share < 1) text += ", " + duration(seconds * (1 - share) / share) + " left";
  return text;
}

bool LogPace::is_due(double seconds, double share) {
  if (seconds < period_) return false;
  if (seconds - last_seconds_ < period_ && share - last_share_ < kLogShare) return false;
  note(seconds, share);
  return true;
}

void LogPace::note(double seconds, double share) {
  last_seconds_ = seconds;
  last_share_ = share;
}

Progress::Progress(std::string label, double total, std::string unit)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total),
      sink_(find_sink()),
      pace_(log_seconds()),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {
  first_work();
  if (sink_ == ProgressSink::kLog) Heartbeat::one().add(this);
}

Progress::~Progress() {
  if (sink_ == ProgressSink::kLog) Heartbeat::one().remove(this);
  hide_progress();
  log_info("  " + label_ + formatted(": %.2f s", seconds_since(start_)));
}

void Progress::update(double done) {
  if (sink_ == ProgressSink::kNone) return;
  const std::lock_guard lock(mutex_);
  show(done, false);
}

void Progress::advance(double part) {
  if (sink_ == ProgressSink::kNone) return;
  const std::lock_guard lock(mutex_);
  show(done_ + part, false);
}

void Progress::step(const std::string& name, double done) {
  if (sink_ == ProgressSink::kNone) return;
  const std::lock_guard lock(mutex_);
  step_ = ": " + name;
  show(done, true);
}

void Progress::beat() {
  const std::lock_guard lock(mutex_);
  const double so_far = seconds_since(start_), share = total_ > 0 ? done_ / total_ : 1;
  pace_.note(so_far, share);
  write_line(progress_text(label_ + step_, done_, total_, "", 0) + ", " + duration(so_far) + " so far");
}

void Progress::show(double done, bool is_new_step) {
  done_ = done;
  const double so_far = seconds_since(start_);
  const std::string text = progress_text(label_ + step_, done, total_, unit_, so_far);
  if (sink_ == ProgressSink::kLog) {
    const bool is_due = pace_.is_due(so_far, total_ > 0 ? done / total_ : 1);
    if (is_due || (is_new_step && seconds_since(first_work()) >= log_seconds())) write_line(text);
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!is_new_step && now - last_ < kRedraw) return;
  last_ = now;
  g_shown = sink_;
  std::fprintf(stderr, "%s%s%s", kErase, text.c_str(), sink_ == ProgressSink::kRelay ? "\n" : "");
  std::fflush(stderr);
}

void hide_progress() {
  const ProgressSink shown = g_shown.exchange(ProgressSink::kNone);
  if (shown != ProgressSink::kNone) std::fprintf(stderr, "%s%s", kErase, shown == ProgressSink::kRelay ? "\n" : "");
}

void erase_progress_of_child() {
  if (find_sink() == ProgressSink::kTerminal) std::fputs(kErase, stderr);
}

void offer_progress_relay() {
  if (isatty(STDERR_FILENO)) setenv(kRelayVariable, kRelayValue, 1);
}

bool relay_progress(const std::string& line) {
  if (line.empty() || line.front() != kRelayMark) return false;
  std::string shown = line;
  while (!shown.empty() && shown.back() == '\n') shown.pop_back();
  std::fwrite(shown.data(), 1, shown.size(), stderr);
  std::fflush(stderr);
  return true;
}

}  // namespace st
