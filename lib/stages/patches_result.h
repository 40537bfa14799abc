// The end that st-mesh and st-remesh share: the patches artifact and its summary.
#pragma once

#include <string>

#include "base/log.h"
#include "io/hdf5/artifact.h"
#include "meshing/engine/model_mesher.h"
#include "stages/summary.h"

namespace st {

struct RunFacts {
  Timer timer;
  double load_seconds;
  int n_ranks;
};

/// Local, on rank 0. Gives every node the length that `field` requests there: what a later st-remesh compares with,
/// whatever was refined since. Nodes that st-remesh kept (with a number in the mesh before) stay as they are.
void store_requests(const SizeField& field, ModelMesher& mesher);

/// Local, on rank 0. Completes `header` (tool, options and inputs are the caller's), writes the artifact, warns of
/// every face without a patch.
StageSummary write_patches_result(const std::string& path, const ModelTables& tables, const ArtifactHeader& geometry,
                                  ArtifactHeader header, ModelMesher& mesher, const RunFacts& facts);

}  // namespace st
