#include "base/supervised_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "base/stopped_processes.h"

namespace st {
namespace {

constexpr std::array kPassedOn = {SIGINT, SIGTERM, SIGHUP};

// What a signal handler may look at. Handler and begin() each write one and then read the other, perhaps at once on two
// processors: in one order for all (not so with volatile), else a signal at the start of a program is lost.
std::atomic<pid_t> g_program = 0;
std::atomic<int> g_passed_signal = 0;
static_assert(std::atomic<pid_t>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

/// A terminal has sent its signal to the program as well.
extern "C" void pass_on(int signal, siginfo_t* info, void*) {
  g_passed_signal = signal;
  const pid_t program = g_program;
  if (info->si_code <= 0 && program > 0) kill(program, signal);
}

/// Passes signals on as long as it lives; those that are ignored (nohup) stay ignored. Made before the program is: a
/// thread that does not hold signals back may take one meanwhile.
class SignalPassing {
 public:
  SignalPassing() {
    g_program = 0;
    g_passed_signal = 0;
    for (std::size_t i = 0; i < kPassedOn.size(); ++i) {
      sigaction(kPassedOn[i], nullptr, &old_[i]);
      if (!(old_[i].sa_flags & SA_SIGINFO) && old_[i].sa_handler == SIG_IGN) continue;
      struct sigaction action {};
      action.sa_flags = SA_SIGINFO | SA_RESTART;
      action.sa_sigaction = pass_on;
      sigaction(kPassedOn[i], &action, nullptr);
    }
  }
  ~SignalPassing() { stop(); }
  /// From now on, and what came before.
  void begin(pid_t program) const {
    g_program = program;
    const int signal = g_passed_signal;
    if (signal != 0) kill(program, signal);
  }
  /// In the program as well, which has signals of its own.
  void stop() const {
    for (std::size_t i = 0; i < kPassedOn.size(); ++i) sigaction(kPassedOn[i], &old_[i], nullptr);
    g_program = 0;
  }
  SignalPassing(const SignalPassing&) = delete;
  SignalPassing& operator=(const SignalPassing&) = delete;

 private:
  std::array<struct sigaction, kPassedOn.size()> old_{};
};

/// Holds these signals back until released: while a program starts, nobody could pass them on.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : kPassedOn) sigaddset(&held, signal);
    sigprocmask(SIG_BLOCK, &held, &before_);
  }
  ~HeldSignals() { release(); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  void release() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

struct Pipe {
  Pipe() {
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw Error(ExitCode::kInternal, std::string("pipe: ") + std::strerror(errno) + "; close some files");
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_end(int i) {
    if (ends[i] >= 0) close(ends[i]);
    ends[i] = -1;
  }
  int ends[2] = {-1, -1};
};

/// The child: becomes the program. What goes wrong is told through `failure`.
[[noreturn]] void become(std::vector<std::string> words, pid_t parent, int errors, int failure) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(128 + SIGTERM);
  dup2(errors, STDERR_FILENO);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  const int error = errno;
  if (write(failure, &error, sizeof error) < 0) _exit(126);
  _exit(127);
}

/// Looks at the processes of a program from time to time. Ends it where one stands still, or the program no
/// longer takes note of the end of its children.
class Watcher {
 public:
  Watcher(pid_t program, const StopWatch& watch)
      : program_(program),
        watch_(watch),
        interval_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(watch.seconds / kLooks))),
        processes_(program, kLooks) {}

  bool was_deaf() const { return was_deaf_; }

  /// Until there is something to read.
  void wait_for(int fd) {
    pollfd wanted{fd, POLLIN, 0};
    while (watch_.on_stopped && !has_ended_) {
      const auto rest = std::chrono::ceil<std::chrono::milliseconds>(next_ - Clock::now()).count();
      if (rest > 0 && poll(&wanted, 1, static_cast<int>(rest)) > 0) return;
      if (rest <= 0) look();
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kLooks = 30, kLooksDeaf = 10;

  void look() {
    next_ = Clock::now() + interval_;
    end_deaf();
    std::vector<pid_t> ended = processes_.look();
    if (ended.empty()) return;
    has_ended_ = true;
    watch_.on_stopped(ended[0]);
    ended.insert(ended.begin(), program_);
    for (const pid_t process : ended) {
      kill(process, SIGTERM);
      kill(process, SIGCONT);  // else it would not get the other one
    }
  }

  /// mpirun may wait for a lock of its own for ever, when a rank is killed as it begins.
  void end_deaf() {
    n_deaf_ = has_unreaped_child(program_) ? n_deaf_ + 1 : 0;
    if (n_deaf_ < kLooksDeaf) return;
    has_ended_ = was_deaf_ = true;
    kill(program_, SIGKILL);
  }

  const pid_t program_;
  const StopWatch& watch_;
  const Clock::duration interval_;
  Clock::time_point next_ = Clock::now() + interval_;
  StoppedProcesses processes_;
  int n_deaf_ = 0;  // looks at which it had not taken note of the end of a child
  bool has_ended_ = false, was_deaf_ = false;
};

/// Up to the end of the file.
void read_lines(int fd, const std::function<void(const std::string&)>& on_line, Watcher& watcher) {
  std::string text;
  char buffer[4096];
  for (;;) {
    watcher.wait_for(fd);
    const ssize_t n = read(fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    text.append(buffer, static_cast<std::size_t>(n));
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
      on_line(text.substr(begin, end + 1 - begin));
    text.erase(0, begin);
  }
  if (!text.empty()) on_line(text);
}

void require_started(int failure, const std::string& program) {
  int error = 0;
  ssize_t n = 0;
  while ((n = read(failure, &error, sizeof error)) < 0 && errno == EINTR) {
  }
  if (n == sizeof error) throw Error(ExitCode::kUsage, program + " cannot be started (" + std::strerror(error) + ")");
}

/// Its status, as waitpid() says it.
int wait_for_end(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) throw Error(ExitCode::kInternal, std::string("waitpid: ") + std::strerror(errno));
  return status;
}

/// In both processes. A parent may have left SIGCHLD ignored: nobody could wait for a child then.
pid_t fork_or_throw() {
  std::signal(SIGCHLD, SIG_DFL);
  const pid_t child = fork();
  if (child < 0)
    throw Error(ExitCode::kInternal, std::string("fork: ") + std::strerror(errno) + "; end some processes");
  return child;
}

ProgramEnd end_of(int status, bool was_deaf) {
  return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), WIFSIGNALED(status), was_deaf,
          g_passed_signal};
}

}  // namespace

std::string signal_text(int signal) { return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")"; }

ProgramEnd run_supervised(const std::vector<std::string>& words,
                          const std::function<void(const std::string& line)>& on_error_line, const StopWatch& watch) {
  Pipe errors, failure;
  std::fflush(nullptr);
  const HeldSignals signals;
  const SignalPassing passing;
  const pid_t self = getpid(), program = fork_or_throw();
  if (program == 0) {
    passing.stop();
    signals.release();
    become(words, self, errors.ends[1], failure.ends[1]);
  }
  passing.begin(program);
  signals.release();
  errors.close_end(1);
  failure.close_end(1);
  Watcher watcher(program, watch);
  read_lines(errors.ends[0], on_error_line, watcher);
  const int status = wait_for_end(program);
  require_started(failure.ends[0], words[0]);
  return end_of(status, watcher.was_deaf());
}

ProgramEnd run_forked(const std::function<int()>& work) {
  std::fflush(nullptr);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const HeldSignals signals;
  const SignalPassing passing;
  const pid_t self = getpid(), child = fork_or_throw();
  if (child == 0) {
    passing.stop();
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != self) _exit(128 + SIGTERM);
    signals.release();
    const int code = work();
    std::fflush(nullptr);
    _exit(code);
  }
  passing.begin(child);
  signals.release();
  const int status = wait_for_end(child);
  while (waitpid(-1, nullptr, 0) > 0 || errno == EINTR) {  // children that it had, ended as it ended
  }
  return end_of(status, false);
}

}  // namespace st
