#include "stages/mesh_stage.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "io/artifact.h"
#include "io/sizing_artifact.h"
#include "stages/model_mesher.h"
#include "stages/patches_result.h"

namespace st {
namespace {

void require_valid(const MeshStageOptions& o) {
  if (o.enhance_rounds < 0 || o.enhance_rounds > 10)
    throw Error(ExitCode::kUsage, fmt::format("--enhance-rounds {}: not in [0, 10]", o.enhance_rounds));
  if (!(o.max_turning_deg > 0 && o.max_turning_deg <= 60))
    throw Error(ExitCode::kUsage, fmt::format("--max-turning {}: not in (0, 60] degrees", o.max_turning_deg));
}

}  // namespace

StageSummary run_mesh(const MeshStageOptions& o, const Communicator& comm) {
  const Timer timer;
  require_valid(o);
  if (comm.is_root()) require_writable(o.output);
  GeometryArtifact geometry = read_geometry(o.geometry);
  const MappedSizing sizing = map_sizing(o.sizing);
  require_same_geometry(o.geometry, geometry.header, o.sizing, sizing.header);
  const ArtifactHeader geometry_header = geometry.header;
  const Model model(std::move(geometry.tables), std::move(geometry.brep));
  ModelMesherOptions options;
  options.enhance_rounds = o.enhance_rounds;
  options.max_turning_deg = o.max_turning_deg;
  ModelMesher mesher(model, *sizing.field, sizing.face_weight, options, comm);
  const double load_seconds = timer.seconds();
  mesher.run();
  if (!comm.is_root()) return {};

  ArtifactHeader header;
  header.tool = "st-mesh";
  header.options_json = nlohmann::json{{"enhance_rounds", o.enhance_rounds}, {"max_turning", o.max_turning_deg}}.dump();
  header.inputs = {{"geometry", std::filesystem::path(o.geometry).filename().string(), geometry_header.content_hash},
                   {"sizing", std::filesystem::path(o.sizing).filename().string(), sizing.header.content_hash}};
  return write_patches_result(o.output, model.tables(), geometry_header, header, mesher, {timer, load_seconds, comm.size()});
}

}  // namespace st
