#include "base/child_process.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include "base/confinement.h"
#include "base/error.h"
#include "base/progress.h"

// There where the program has the address sanitizer, which reserves more addresses than any machine has memory. This
// file itself may be compiled without it.
extern "C" [[gnu::weak]] void __asan_init();  // NOLINT(bugprone-reserved-identifier)

namespace st {
namespace {

constexpr int kUnknownFailure = -1;  // instead of an exit code: an exception that is no Error

void write_all(int fd, const void* data, std::size_t size) {
  const char* p = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = write(fd, p, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    p += n;
    size -= static_cast<std::size_t>(n);
  }
}

/// All that the child wrote.
std::string read_all(int fd) {
  std::string text;
  char buffer[65536];
  for (;;) {
    const ssize_t n = read(fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(n));
  }
}

void limit(int resource, double value) {
  rlimit r;
  if (getrlimit(static_cast<__rlimit_resource>(resource), &r) != 0) return;
  r.rlim_cur = std::min<rlim_t>(r.rlim_max, static_cast<rlim_t>(std::ceil(value)));
  setrlimit(static_cast<__rlimit_resource>(resource), &r);
}

/// SIGPROF ends the process after this much processor time.
void end_after(double cpu_seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(cpu_seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (cpu_seconds - std::floor(cpu_seconds))) + 1;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

double machine_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

/// The child: a code, then the text. Never returns.
[[noreturn]] void be_child(const std::function<std::string()>& work, const ChildLimits& limits, int fd,
                           const std::string& subject) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (limits.cpu_seconds > 0) end_after(limits.cpu_seconds);
  if (limits.wall_seconds > 0) alarm(static_cast<unsigned>(std::ceil(limits.wall_seconds)));
  if (&__asan_init == nullptr) limit(RLIMIT_AS, machine_memory());
  limit(RLIMIT_CORE, 0);
  confine_process(limits.writable_folder);
  int code = kUnknownFailure;
  std::string text;
  try {
    text = work();
    code = static_cast<int>(ExitCode::kOk);
  } catch (const Error& e) {
    code = static_cast<int>(e.code());
    text = e.what();
  } catch (const std::bad_alloc&) {
    code = static_cast<int>(ExitCode::kInput);
    text = subject + ": needs more memory than the machine has; the file is damaged, or the model must be split";
  } catch (const std::exception& e) {
    text = e.what();
  } catch (...) {
    text = "exception of an unknown type";
  }
  std::fflush(nullptr);
  write_all(fd, &code, sizeof code);
  write_all(fd, text.data(), text.size());
  _exit(0);
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

[[noreturn]] void fail(const std::string& subject, int status, const ChildLimits& limits) {
  erase_progress_of_child();
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF)
    throw Error(ExitCode::kInput, subject + ": not read within " + number(limits.cpu_seconds) +
                                      " s of processor time; it may be damaged, or give it more with --time-limit");
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    throw Error(ExitCode::kInput, subject + ": not done within " + number(limits.wall_seconds) + " s");
  if (WIFSIGNALED(status))
    throw Error(ExitCode::kInput, subject + ": OpenCASCADE crashed on this file (" + strsignal(WTERMSIG(status)) +
                                      "); it is damaged: export the model again, or in another format");
  throw Error(
      ExitCode::kInput,
      subject + ": OpenCASCADE gave up on this file; it is damaged: export the model again, or in another format");
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits,
                         const std::string& subject) {
  int ends[2];
  if (pipe(ends) != 0)
    throw Error(ExitCode::kInternal, std::string("pipe: ") + std::strerror(errno) + "; close some files");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0)
    throw Error(ExitCode::kInternal, std::string("fork: ") + std::strerror(errno) + "; end some processes");
  if (child == 0) {
    close(ends[0]);
    be_child(work, limits, ends[1], subject);
  }
  close(ends[1]);
  const std::string answer = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  int code = kUnknownFailure;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.size() < sizeof code) fail(subject, status, limits);
  std::memcpy(&code, answer.data(), sizeof code);
  const std::string text = answer.substr(sizeof code);
  if (code == kUnknownFailure) throw std::runtime_error(text);
  if (code != static_cast<int>(ExitCode::kOk)) throw Error(static_cast<ExitCode>(code), text);
  return text;
}

}  // namespace st
