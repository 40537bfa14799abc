// The group of a program that never has more than one rank: the class without MPI, and a program that does not load it.
#include "comm/communicator.h"

#include <unistd.h>

#include "comm/local_tasks.h"
#include "comm/worker_threads.h"

namespace st {

struct Communicator::Impl {};

Communicator::Communicator() = default;
Communicator::~Communicator() = default;

int Communicator::rank() const { return 0; }
int Communicator::size() const { return 1; }
void Communicator::barrier() const {}
void Communicator::broadcast(Bytes&) const {}
void Communicator::reduce_min(std::vector<std::uint64_t>&) const {}
void Communicator::abort(int exit_code) const { _exit(exit_code); }

std::vector<Bytes> Communicator::gather(Bytes own) const {
  std::vector<Bytes> all;
  all.push_back(std::move(own));
  return all;
}

void Communicator::run_tasks(std::int32_t n_tasks, const std::vector<std::int32_t>& order,
                             const std::function<Bytes(std::int32_t task)>& compute,
                             const std::function<void(std::int32_t task, Bytes&& result)>& collect) const {
  require_order(order, n_tasks);
  run_local_tasks(order, compute, collect);
}

void Communicator::run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t task)>& compute,
                                   const std::function<void(std::int32_t task, Bytes&& result)>& collect) const {
  run_local_tasks(tasks.order, compute, collect);
}

std::vector<Bytes> Communicator::ask(const std::vector<Request>& requests) const { return ask_ranks(requests); }

}  // namespace st
