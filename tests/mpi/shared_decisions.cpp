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
#include "mesh/merge.h"
#include "meshing/engine/model_mesher.h"
#include "support/shapes.h"

namespace st {
namespace {

void check(bool ok, const std::string& what) {
  if (!ok) throw std::runtime_error(what);
}

SurfaceMesh merged_mesh(const ModelMesher& mesher) {
  const ModelTables& t = mesher.tables();
  OrientationReport report;
  SurfaceMesh mesh = merge_patches({mesher.edges, t.vertex_xyz, t.edge_vertices, mesher.patches, {}}, report);
  mesh.merged = mesher.merged();
  return mesh;
}

/// On rank 0. The mesh is whole, and crosses itself nowhere.
void check_whole(const ModelMesher& mesher) {
  check(mesher.failures.empty(), "a face failed");
  const SurfaceMesh mesh = merged_mesh(mesher);
  check(check_topology(mesh).passes(), "the mesh is not closed");
  check(mesher.n_crossing_pairs == 0, "triangles cross");
}

/// Edges that rank 0 leaves as they are and every other rank would merge.
void shares_merged_features(const Communicator& comm) {
  const Model model = test::make_model("box");
  const UniformField field(200);
  ModelMesherOptions options;
  options.merge_below = comm.is_root() ? 0 : 0.2;
  ModelMesher mesher(model, field, {}, options, comm);
  check(mesher.merged().empty(), "a rank merged edges on its own");
  mesher.run();
  if (comm.is_root()) check_whole(mesher);
}

/// Walls that cross until they are refined, where every rank has slightly other lengths: as it would refine, and as the
/// mesh needs to be.
void shares_refinements(const Communicator& comm) {
  const Model model = test::make_model("thin_pipe");
  const UniformField field(comm.is_root() ? 2.0 : 2.0 + 0.3 * comm.rank());
  ModelMesher mesher(model, field, {}, {}, comm);
  mesher.run();
  if (!comm.is_root()) return;
  check(mesher.n_refinements > 0, "nothing was refined: the scenario shows nothing");
  check_whole(mesher);
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
