#include "stages/cell_budget.h"

#include <algorithm>
#include <map>
#include <string>

#include "base/host_name.h"
#include "base/memory.h"
#include "base/packer.h"
#include "base/share.h"
#include "sizing/gap_patch.h"
#include "sizing/sample_seeds.h"

namespace st {
namespace {

constexpr double kShare = 0.8;  // of the memory
constexpr double kUnlimited = 1e30;
constexpr double kMeasuredAt = 2;  // lengths per cell: what kRasterBytesPerCell stands for

/// What a cell takes, bytes.
struct HostMemory {
  double of_rank = 0;  ///< least share of a rank in the memory of its host
  double of_host = 0;  ///< least memory of a host
  double of_all = 0;   ///< of all hosts together
};

/// Collective, the same on every rank.
HostMemory memory_of_hosts(const Communicator& comm) {
  Packer own;
  own.add(host_name());
  own.add(memory_limit());
  std::map<std::string, std::pair<double, int>> hosts;  // memory and ranks
  for (const Bytes& bytes : comm.gather(own.take())) {
    std::string host;
    double memory = 0;
    Unpacker unpacker(bytes);
    unpacker.get(host);
    unpacker.get(memory);
    auto& [least, n_ranks] = hosts.try_emplace(host, memory, 0).first->second;
    least = std::min(least, memory);
    ++n_ranks;
  }
  HostMemory memory{kUnlimited, kUnlimited, 0};
  for (const auto& [host, of] : hosts)
    memory = {std::min(memory.of_rank, of.first / of.second), std::min(memory.of_host, of.first),
              memory.of_all + of.first};
  share(comm, memory);
  return memory;
}

/// Cells that are larger are fewer, by the square on a surface, for as many samples.
double raster_bytes_per_cell(const ModelLimits& limits) {
  const double larger = std::max(1.0, limits.far.cell_per_length / kMeasuredAt);
  return kRasterBytesPerCell * larger * larger;
}

/// What fits here, and into st-prolong afterwards.
double fitting_cells(const HostMemory& memory, const ModelLimits& limits) {
  return kShare * std::min(memory.of_rank / raster_bytes_per_cell(limits), memory.of_host / kProlongBytesPerCell);
}

double bytes_per_sample(const ModelLimits& limits) {
  return static_cast<double>(2 * sizeof(RasterBox) + sizeof(LengthSample) + (limits.wants_gaps ? sizeof(GapPatch) : 0));
}

}  // namespace

CellBudget make_cell_budget(std::optional<int> max_cells, const ModelLimits& limits, const Communicator& comm) {
  const auto countable = [](double n) {
    return static_cast<std::uint64_t>(std::clamp(n, 1.0, static_cast<double>(kMaxIds)));
  };
  CellBudget budget;
  budget.max_cells =
      max_cells ? static_cast<std::uint64_t>(*max_cells) : countable(fitting_cells(memory_of_hosts(comm), limits));
  budget.max_samples =
      countable(static_cast<double>(budget.max_cells) * raster_bytes_per_cell(limits) / bytes_per_sample(limits));
  return budget;
}

double memory_of_all_hosts(const Communicator& comm) { return memory_of_hosts(comm).of_all; }

DepthLimit gather_depth_limit(const DepthLimit& own, const Communicator& comm) {
  Packer packer;
  packer.add(own);
  DepthLimit all;
  for (const Bytes& bytes : comm.gather(packer.take())) {
    DepthLimit of_rank;
    Unpacker(bytes).get(of_rank);
    all.add(of_rank);
  }
  return all;
}

}  // namespace st
