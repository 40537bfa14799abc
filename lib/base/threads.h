// Loops over the threads of this process. Standard threads are the only ones of the project.
#pragma once

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

/// Runs independent jobs, the longest should come first; otherwise as parallel_for.
void run_jobs(const std::vector<std::function<void()>>& jobs);

}  // namespace st
