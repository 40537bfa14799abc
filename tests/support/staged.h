// A shape taken through the stages, each with the options that a test sets.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/log.h"
#include "stages/import_stage.h"
#include "stages/mesh_stage.h"
#include "stages/prolong_stage.h"
#include "stages/raster_stage.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st::test {

/// Every stage writes its artifact, named as the workflow does, into one folder. What a function returns is the summary
/// of its last stage.
class StagedModel {
 public:
  TemporaryDirectory dir;
  RasterStageOptions raster;
  ProlongStageOptions prolong;
  MeshStageOptions mesh;

  StagedModel() {
    set_verbosity(Verbosity::kQuiet);
    raster.geometry = mesh.geometry = dir / "geometry.hdf";
    raster.output = prolong.raster = dir / "raster.hdf";
    prolong.output = mesh.sizing = dir / "sizing.hdf";
    mesh.output = dir / "patches.hdf";
  }

  /// st-import and st-raster.
  nlohmann::json make_raster(const std::string& shape) const {
    write_brep(shape, dir / "model.brep");
    ImportStageOptions import;
    import.model = dir / "model.brep";
    import.output = raster.geometry;
    run_import(import);
    return nlohmann::json::parse(run_raster(raster, Communicator()).json);
  }
  /// st-prolong.
  nlohmann::json make_sizing() const { return nlohmann::json::parse(run_prolong(prolong).json); }
  nlohmann::json make_sizing(const std::string& shape) const {
    make_raster(shape);
    return make_sizing();
  }
  /// st-mesh.
  nlohmann::json make_patches() const { return nlohmann::json::parse(run_mesh(mesh, Communicator()).json); }
};

}  // namespace st::test
