// shared_decisions SCENARIO: ranks that would decide differently, as processors of different makes do where sines round
// differently, must make one whole mesh: rank 0 decides. Exit code 0, or 1 for a failed check.
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "base/log.h"
#include "comm/communicator.h"
#include "mesh/checks.h"
#include "support/meshed.h"

namespace st {
namespace {

void check(bool ok, const std::string& what) {
  if (!ok) throw std::runtime_error(what);
}

/// On rank 0. The mesh is whole, and crosses itself nowhere.
void check_whole(const MeshTopology& topology, const MeshResult& result) {
  check(result.failures.empty(), "a face failed");
  OrientationReport report;
  check(
      check_topology(test::merged(topology, result, report), edges_of(test::merged(topology, result, report))).passes(),
      "the mesh is not closed");
  check(result.n_crossing_pairs == 0, "triangles cross");
}

/// Edges that rank 0 leaves as they are and every other rank would merge.
void shares_merged_features(const Communicator& comm) {
  const Model model = test::make_model("box");
  const UniformField field(200);
  const MeshTopology topology = merge_small_features(model, field, comm.is_root() ? 0 : 0.2, comm);
  check(topology.merged().empty(), "a rank merged edges on its own");
  const MeshResult result = mesh_regions(model, topology, field, plan_all(topology), {}, comm);
  if (comm.is_root()) check_whole(topology, result);
}

/// Walls that cross until they are refined, where every rank has slightly other lengths: as it would refine, and as the
/// mesh needs to be.
void shares_refinements(const Communicator& comm) {
  const Model model = test::make_model("thin_pipe");
  const UniformField field(comm.is_root() ? 2.0 : 2.0 + 0.3 * comm.rank());
  const MeshTopology topology = merge_small_features(model, field, MeshOptions().merge_below, comm);
  const MeshResult result = mesh_regions(model, topology, field, plan_all(topology), {}, comm);
  if (!comm.is_root()) return;
  check(result.n_refinements > 0, "nothing was refined: the scenario shows nothing");
  check_whole(topology, result);
}

const std::map<std::string, std::function<void(const Communicator&)>> kScenarios = {
    {"shares_merged_features", shares_merged_features}, {"shares_refinements", shares_refinements}};

}  // namespace
}  // namespace st

int main(int argc, char** argv) {
  const st::Communicator comm;
  st::set_verbosity(st::Verbosity::kQuiet);
  const auto scenario = argc == 2 ? st::kScenarios.find(argv[1]) : st::kScenarios.end();
  if (scenario == st::kScenarios.end()) {
    std::fputs("usage: shared_decisions SCENARIO\n", stderr);
    return 2;
  }
  try {
    scenario->second(comm);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "shared_decisions: rank %d: %s\n", comm.rank(), e.what());
    comm.abort(1);
  }
  return 0;
}
