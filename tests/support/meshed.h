// Shapes meshed as st-mesh and st-merge would, on one rank.
#pragma once

#include <string>
#include <utility>

#include "base/log.h"
#include "mesh/merge.h"
#include "meshing/engine/mesh_regions.h"
#include "support/shapes.h"

namespace st::test {

inline const SerialExecutor one_rank;

/// The patches as one mesh.
inline SurfaceMesh merged(const MeshTopology& topology, const MeshResult& result, OrientationReport& report) {
  const ModelTables& t = topology.tables();
  SurfaceMesh mesh =
      merge_patches({result.edges, t.vertex_xyz, t.edge_vertices, result.patches, t.labels.face_group}, report);
  mesh.labels = t.labels;
  mesh.merged = topology.merged();
  return mesh;
}

/// A model meshed with one length.
struct Meshed {
  Model model;
  UniformField field;
  MeshTopology topology;
  MeshResult result;
  OrientationReport orientation;
  SurfaceMesh mesh;

  Meshed(Model m, double length, const MeshOptions& options = {})
      : model(std::move(m)),
        field(length),
        topology(merge_small_features(model, field, options.merge_below, one_rank)),
        result(make(options)),
        mesh(merged(topology, result, orientation)) {}
  Meshed(const std::string& shape, double length, const MeshOptions& options = {})
      : Meshed(make_model(shape), length, options) {}

  BoundaryNumbering numbering() const { return BoundaryNumbering(topology, result.edges); }

 private:
  MeshResult make(const MeshOptions& options) const {
    set_verbosity(Verbosity::kQuiet);
    return mesh_regions(model, topology, field, plan_all(topology), options, one_rank);
  }
};

}  // namespace st::test
