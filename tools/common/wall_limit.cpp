#include "common/wall_limit.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace st {
namespace {

constexpr char kVariable[] = "ST_STARTED";  // "PID SECONDS": of the steady clock; a program that starts itself again
                                            // keeps its process id

/// Seconds of the steady clock at which this process began to count.
double start_time() {
  using Seconds = std::chrono::duration<double>;
  const double now = Seconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  const std::string own = std::to_string(getpid()) + " ";
  if (const char* text = std::getenv(kVariable); text && std::string_view(text).starts_with(own))
    return std::strtod(text + own.size(), nullptr);
  setenv(kVariable, (own + std::to_string(now)).c_str(), 1);
  return now;
}

}  // namespace

void watch_wall_time(double seconds, std::function<int()> end) {
  using Clock = std::chrono::steady_clock;
  const std::chrono::duration<double> last(start_time() + seconds);
  std::thread([last, end = std::move(end)] {
    std::this_thread::sleep_until(Clock::time_point(std::chrono::duration_cast<Clock::duration>(last)));
    _exit(end());
  }).detach();
}

}  // namespace st
