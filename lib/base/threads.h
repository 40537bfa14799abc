// Loops over the threads of this process. Standard threads are the only ones of the project.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace st {

/// Threads that a loop may use; 1 until it is set. For the whole process, as the verbosity is.
int thread_count();
/// Throws Error(kInternal) below 1.
void set_thread_count(int n);
/// Processors that this process may use.
int processor_count();

/// Runs body(begin, end) for pieces of at most `grain` that make up [0, n), on up to thread_count() threads, the
/// caller's among them. The pieces are handed out in order and do not depend on the number of threads: who sums up by
/// piece gets the same bits. An exception ends the loop when the pieces already begun are done; of several the one of
/// the first piece is thrown. A piece may run a loop of its own: idle threads help there, too.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Processor seconds that this thread has spent in calls of parallel_for that stand in no other one: what more threads
/// speed up. In a piece of a loop: in those that stand in this piece. A loop of one piece does not count as one.
struct LoopSeconds {
  double all = 0;
  double longest = 0;  ///< of the longest piece of each, of which loops in it count likewise: more threads cannot speed
                       ///< up more. Counted with one thread
};
LoopSeconds seconds_in_loops();

/// Sorts as std::sort does, by pieces that are merged. Elements that are equal to `less` end in an order that does not
/// depend on the number of threads.
template <class Iterator, class Less>
void parallel_sort(Iterator begin, Iterator end, const Less& less) {
  constexpr std::size_t kPieces = 8, kWorthIt = 20'000;
  const auto n = static_cast<std::size_t>(end - begin), piece = n / kPieces + 1;
  const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(std::min(i, n)); };
  if (n < kWorthIt) return std::sort(begin, end, less);
  parallel_for(kPieces, 1, [&](std::size_t i, std::size_t) { std::sort(at(i * piece), at((i + 1) * piece), less); });
  for (std::size_t width = piece; width < n; width *= 2)
    parallel_for((n + 2 * width - 1) / (2 * width), 1, [&](std::size_t i, std::size_t) {
      std::inplace_merge(at(2 * i * width), at((2 * i + 1) * width), at((2 * i + 2) * width), less);
    });
}

/// Runs independent jobs, the longest should come first; otherwise as parallel_for.
void run_jobs(const std::vector<std::function<void()>>& jobs);

}  // namespace st
