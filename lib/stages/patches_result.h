// The end that st-mesh and st-remesh share: the patches artifact and its summary.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "base/executor.h"
#include "base/log.h"
#include "io/hdf5/artifact.h"
#include "meshing/engine/mesh_result.h"
#include "meshing/topology/mesh_topology.h"
#include "stages/summary.h"

namespace st {

struct RunFacts {
  Timer timer;
  double load_seconds;
  int n_ranks;
  std::int64_t n_parts = 0, n_resumed = 0;         ///< faces and tiles, once per round; and those of an earlier run
  nlohmann::json more = nlohmann::json::object();  ///< for the summary
  Composites composites = {};                      ///< of the geometry
};

/// What write_patches_result() is to write: throws Error(kOutput, kUsage) now where it may not. Local.
void require_patches_outputs(const std::string& path);

/// Collective where patches are on the ranks that made them, and each rank writes its own; else local, on rank 0.
/// Completes `header` (tool, options and inputs are the caller's), writes the artifact, warns of every face without a
/// patch. The summary is of rank 0.
StageSummary write_patches_result(const std::string& path, const ModelTables& tables, const ArtifactHeader& geometry,
                                  ArtifactHeader header, const MeshTopology& topology, MeshResult result,
                                  const RunFacts& facts, const Executor& executor);

}  // namespace st
