// comm_farm SCENARIO [ranks] [--np N] [--threads N]: one scenario of the task farm, checked by the program itself; exit
// code 0, that of the Error, or 1 for a failed check.
#define OMPI_SKIP_MPICXX 1  // the C API alone
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/packer.h"
#include "base/threads.h"
#include "comm/communicator.h"

namespace {
std::set<int> looked_for;  // tags
}

/// In place of the library's: notes what is looked for. Called from the main thread alone.
extern "C" int MPI_Iprobe(int source, int tag, MPI_Comm comm, int* is_there, MPI_Status* status) {
  looked_for.insert(tag);
  return PMPI_Iprobe(source, tag, comm, is_there, status);
}

namespace st {
namespace {

#define CHECK(condition) check((condition), #condition, __LINE__)
void check(bool ok, const char* condition, int line) {
  if (!ok) throw std::runtime_error("line " + std::to_string(line) + ": not " + condition);
}

std::vector<std::int32_t> descending(std::int32_t n) {
  std::vector<std::int32_t> order(n);
  std::iota(order.rbegin(), order.rend(), 0);
  return order;
}

double cpu_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Uses `seconds` of CPU time of this thread.
void burn(double seconds) {
  const double end = cpu_seconds(CLOCK_THREAD_CPUTIME_ID) + seconds;
  while (cpu_seconds(CLOCK_THREAD_CPUTIME_ID) < end) {
  }
}

double wall_seconds(const std::function<void()>& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The answer of task t: t+1 numbers, and the rank that made them.
Bytes answer(const Communicator& comm, std::int32_t task) {
  std::vector<std::int64_t> numbers(task + 1);
  for (std::int32_t i = 0; i <= task; ++i) numbers[i] = std::int64_t{task} * i;
  Packer packer;
  packer.add(comm.rank());
  packer.add(numbers);
  return packer.take();
}

/// Runs n tasks and checks every answer; returns how many tasks each rank did (rank 0 only).
std::vector<int> run_and_check(const Communicator& comm, std::int32_t n,
                               const std::function<void(std::int32_t)>& work = {}) {
  std::vector<int> n_seen(n, 0), n_done(comm.size(), 0);
  const auto main_thread = std::this_thread::get_id();
  comm.run_tasks(
      n, descending(n),
      [&](std::int32_t task) {
        if (work) work(task);
        return answer(comm, task);
      },
      [&](std::int32_t task, Bytes&& bytes) {
        CHECK(comm.is_root());
        CHECK(std::this_thread::get_id() == main_thread || (comm.size() == 1 && thread_count() > 1));
        Unpacker unpacker(bytes);
        int rank = -1;
        std::vector<std::int64_t> numbers;
        unpacker.get(rank);
        unpacker.get(numbers);
        CHECK(numbers.size() == static_cast<std::size_t>(task) + 1);
        CHECK(numbers.back() == std::int64_t{task} * task);
        ++n_seen[task];
        ++n_done[rank];
      });
  if (comm.is_root()) CHECK(std::all_of(n_seen.begin(), n_seen.end(), [](int seen) { return seen == 1; }));
  return n_done;
}

void collects_every_task_once(const Communicator& comm) { run_and_check(comm, 2000); }
void runs_fewer_tasks_than_ranks(const Communicator& comm) { run_and_check(comm, 1); }
void runs_no_task(const Communicator& comm) { run_and_check(comm, 0); }

void runs_twice(const Communicator& comm) {
  run_and_check(comm, 50);
  comm.barrier();
  run_and_check(comm, 70);
  run_and_check(comm, 2);
}

void broadcasts(const Communicator& comm) {
  const auto nth = [](std::size_t i) { return static_cast<std::byte>(i * 2654435761U >> 24); };
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, (std::size_t{1} << 20) + 5, std::size_t{50000000}}) {
    Bytes bytes;
    for (std::size_t i = 0; comm.is_root() && i < n; ++i) bytes.push_back(nth(i));
    comm.broadcast(bytes);
    CHECK(bytes.size() == n);
    for (std::size_t i = 0; i < n; ++i) CHECK(bytes[i] == nth(i));
  }
}

void gathers_the_bytes_of_all_ranks(const Communicator& comm) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{20000000}}) {
    const std::size_t own = n * static_cast<std::size_t>(comm.rank());
    const std::vector<Bytes> all = comm.gather(Bytes(own, static_cast<std::byte>(comm.rank())));
    CHECK(all.size() == static_cast<std::size_t>(comm.is_root() ? comm.size() : 0));
    for (std::size_t rank = 0; rank < all.size(); ++rank) {
      CHECK(all[rank].size() == n * rank);
      CHECK(std::all_of(all[rank].begin(), all[rank].end(),
                        [&](std::byte b) { return b == static_cast<std::byte>(rank); }));
    }
  }
}

void finds_the_smallest_values_of_all_ranks(const Communicator& comm) {
  std::vector<std::uint64_t> values(1000000), none;
  const auto n = static_cast<std::uint64_t>(comm.size()), rank = static_cast<std::uint64_t>(comm.rank());
  for (std::uint64_t i = 0; i < values.size(); ++i)
    values[i] = (i % n == rank ? 0 : std::uint64_t{1} << 63) + i % 7 + rank;
  comm.reduce_min(none);
  comm.reduce_min(values);
  for (std::uint64_t i = 0; comm.is_root() && i < values.size(); ++i) CHECK(values[i] == i % n + i % 7);
}

void moves_large_results(const Communicator& comm) {
  constexpr std::size_t kBytes = 40000000;
  int n_right = 0;
  comm.run_tasks(
      6, descending(6), [](std::int32_t task) { return Bytes(kBytes + task, static_cast<std::byte>(task)); },
      [&](std::int32_t task, Bytes&& bytes) {
        n_right += bytes.size() == kBytes + task && bytes.back() == static_cast<std::byte>(task);
      });
  if (comm.is_root()) CHECK(n_right == 6);
}

/// Results stay on the ranks that are told to compute them; later tasks ask for them, all at once.
void asks_other_ranks(const Communicator& comm) {
  constexpr std::int32_t kTasks = 30;
  constexpr std::size_t kBytes = 300000;
  std::mutex mutex;
  std::map<std::int32_t, Bytes> kept;
  NamedTasks tasks;
  tasks.order = descending(kTasks);
  for (std::int32_t task = 0; task < kTasks; ++task) tasks.home.push_back((task * 7) % comm.size());
  tasks.answer = [&](const Bytes& request) {
    std::int32_t task = 0;
    unpack(request, task);
    const std::lock_guard lock(mutex);
    return kept.at(task);
  };
  const auto home = tasks.home;
  int n_right = 0;
  comm.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        const std::lock_guard lock(mutex);
        kept[task] = Bytes(kBytes + task, static_cast<std::byte>(task));
        return packed(static_cast<std::int32_t>(comm.rank()));
      },
      [&](std::int32_t task, Bytes&& bytes) {
        std::int32_t rank = 0;
        unpack(bytes, rank);
        n_right += rank == home[task];
      });
  if (comm.is_root()) CHECK(n_right == kTasks);
  for (const auto& [task, bytes] : kept) CHECK(home[task] == comm.rank());
  tasks.home.clear();
  n_right = 0;
  comm.run_named_tasks(
      tasks,
      [&](std::int32_t) {
        std::vector<Request> requests;
        std::vector<std::int32_t> asked;
        for (std::int32_t task = 0; task < kTasks; ++task) {
          if (home[task] == comm.rank()) continue;
          requests.push_back({home[task], packed(task)});
          asked.push_back(task);
        }
        const std::vector<Bytes> answers = comm.ask(requests);
        CHECK(answers.size() == asked.size());
        for (std::size_t i = 0; i < answers.size(); ++i)
          CHECK(answers[i].size() == kBytes + asked[i] && answers[i].back() == static_cast<std::byte>(asked[i]));
        return Bytes();
      },
      [&](std::int32_t, Bytes&&) { ++n_right; });
  if (comm.is_root()) CHECK(n_right == kTasks);
}

/// A failure ends the job although tasks wait for answers.
void fails_while_others_ask(const Communicator& comm) {
  NamedTasks tasks;
  tasks.order = descending(40);
  tasks.answer = [](const Bytes&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return Bytes(1000);
  };
  comm.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        if (task == 16) throw Error(ExitCode::kGeometry, "face 17 is unusable");
        std::vector<Request> requests;
        for (int rank = 0; rank < comm.size(); ++rank)
          if (rank != comm.rank()) requests.push_back({rank, {}});
        comm.ask(requests);
        return Bytes();
      },
      [](std::int32_t, Bytes&&) {});
}

void rejects_a_wrong_order(const Communicator& comm) {
  const std::vector<std::vector<std::int32_t>> wrong = {{0, 1}, {0, 1, 1}, {0, 1, 3}, {0, 1, 2, 2}};
  for (const auto& order : wrong) {
    bool is_rejected = false;
    try {
      comm.run_tasks(
          3, order, [](std::int32_t) { return Bytes(); }, [](std::int32_t, Bytes&&) {});
    } catch (const Error& e) {
      is_rejected = e.code() == ExitCode::kInternal;
    }
    CHECK(is_rejected);
  }
}

void fails_in_compute(const Communicator& comm) {
  run_and_check(comm, 200, [](std::int32_t task) {
    if (task == 16) throw Error(ExitCode::kGeometry, "face 17 is unusable");
  });
}

void fails_with_foreign_exception(const Communicator& comm) {
  run_and_check(comm, 20, [](std::int32_t task) {
    if (task == 0) throw std::out_of_range("vector is broken");
  });
}

void fails_in_collect(const Communicator& comm) {
  comm.run_tasks(
      30, descending(30), [](std::int32_t) { return Bytes(10); },
      [](std::int32_t task, Bytes&&) {
        if (task == 5) throw Error(ExitCode::kOutput, "disk is full");
      });
}

void loses_a_rank(const Communicator& comm) {
  run_and_check(comm, 200, [&](std::int32_t) {
    burn(0.002);
    if (comm.rank() == 1) raise(SIGKILL);
  });
}

/// Each look for a message is a round through all connections: where no task asks, nobody looks for questions.
void looks_for_one_kind_of_message(const Communicator& comm) {
  looked_for.clear();
  run_and_check(comm, 500, [](std::int32_t) { burn(0.0002); });
  CHECK(looked_for.size() == (comm.size() > 1 ? 1U : 0U));
}

/// One long task: all others wait, in the farm and at the barrier, and must not use a core meanwhile.
void idle_ranks_sleep(const Communicator& comm) {
  constexpr double kWait = 1.5;
  const double before = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
  run_and_check(comm, 1, [&](std::int32_t) { std::this_thread::sleep_for(std::chrono::duration<double>(kWait)); });
  if (comm.is_root()) std::this_thread::sleep_for(std::chrono::duration<double>(kWait));
  comm.barrier();
  const double used = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - before;
  std::fprintf(stderr, "rank %d: %.3f s of CPU time in %.1f s of waiting\n", comm.rank(), used, 2 * kWait);
  CHECK(used < 0.1 * 2 * kWait);
}

/// Both ranks take part in the work, in proportion. Measured in CPU time of tasks, so that a busy machine does not
/// matter.
void keeps_both_ranks_computing(const Communicator& comm) {
  std::vector<int> n_done;
  const double seconds = wall_seconds([&] { n_done = run_and_check(comm, 100, [](std::int32_t) { burn(0.02); }); });
  if (!comm.is_root()) return;
  std::fprintf(stderr, "%d + %d tasks of 20 ms in %.2f s\n", n_done[0], n_done[1], seconds);
  CHECK(n_done[0] >= 25 && n_done[1] >= 25);
}

void gives_short_tasks_ahead(const Communicator& comm) {
  std::vector<int> n_done;
  const double seconds = wall_seconds([&] { n_done = run_and_check(comm, 5000, [](std::int32_t) { burn(0.0002); }); });
  if (!comm.is_root()) return;
  std::fprintf(stderr, "%d + %d tasks of 0.2 ms in %.2f s\n", n_done[0], n_done[1], seconds);
  CHECK(n_done[0] >= 100 && n_done[1] >= 100);
}

int run(int argc, char** argv) {
  const std::map<std::string, std::function<void(const Communicator&)>> scenarios = {
      {"collects_every_task_once", collects_every_task_once},
      {"runs_fewer_tasks_than_ranks", runs_fewer_tasks_than_ranks},
      {"runs_no_task", runs_no_task},
      {"runs_twice", runs_twice},
      {"broadcasts", broadcasts},
      {"gathers_the_bytes_of_all_ranks", gathers_the_bytes_of_all_ranks},
      {"finds_the_smallest_values_of_all_ranks", finds_the_smallest_values_of_all_ranks},
      {"moves_large_results", moves_large_results},
      {"asks_other_ranks", asks_other_ranks},
      {"fails_while_others_ask", fails_while_others_ask},
      {"rejects_a_wrong_order", rejects_a_wrong_order},
      {"fails_in_compute", fails_in_compute},
      {"fails_with_foreign_exception", fails_with_foreign_exception},
      {"fails_in_collect", fails_in_collect},
      {"loses_a_rank", loses_a_rank},
      {"looks_for_one_kind_of_message", looks_for_one_kind_of_message},
      {"idle_ranks_sleep", idle_ranks_sleep},
      {"keeps_both_ranks_computing", keeps_both_ranks_computing},
      {"gives_short_tasks_ahead", gives_short_tasks_ahead},
      {"has_ranks", [&](const Communicator& comm) { CHECK(comm.size() == std::atoi(argv[2])); }}};
  std::unique_ptr<Communicator> comm;
  int code = 0;
  const auto report = [&](int error_code, const char* text) {
    std::fprintf(stderr, "comm_farm: error: %s\n", text);
    if (comm && comm->size() > 1) comm->abort(error_code);
    code = error_code;
  };
  try {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const auto np = std::find(arguments.begin(), arguments.end(), "--np");
    if (np != arguments.end()) {
      const int n = std::stoi(np[1]);
      arguments.erase(np, np + 2);
      if (const auto job_code =
              run_under_mpirun(n, arguments, [](const std::string& text) { std::fputs(text.c_str(), stderr); }))
        return *job_code;
    }
    comm = std::make_unique<Communicator>();
    if (const auto threads = std::find(arguments.begin(), arguments.end(), "--threads"); threads != arguments.end())
      set_thread_count(std::stoi(threads[1]));
    scenarios.at(arguments.at(0))(*comm);
  } catch (const Error& e) {
    report(static_cast<int>(e.code()), e.what());
  } catch (const std::exception& e) {
    report(std::strstr(e.what(), "line ") ? 1 : static_cast<int>(ExitCode::kInternal), e.what());
  }
  return code;
}

}  // namespace
}  // namespace st

int main(int argc, char** argv) { return st::run(argc, argv); }
