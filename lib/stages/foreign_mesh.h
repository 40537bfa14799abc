// A triangulation of another program as st-remesh takes it. Internal to stages.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geometry/model/model.h"
#include "io/hdf5/artifact.h"
#include "meshing/associate/mesh_association.h"
#include "sizing/size_field.h"

namespace st {

struct ForeignMeshOptions {
  std::string tolerance;                ///< length: how far nodes may lie from the CAD; empty: by the mesh's edges
  const SizeField* sizes = nullptr;     ///< of the model, now; null: none
  const SizeField* made_for = nullptr;  ///< sizes the mesh was made for; null: not known
};

/// A foreign mesh on its geometry, as if st-merge had written it, and where it comes from.
struct ForeignMesh {
  MeshArtifact artifact;                  ///< header: name-independent hash of the triangulation
  std::vector<NodeId> file_node;          ///< [n_nodes] number in the file, from 0
  std::vector<TriangleId> file_triangle;  ///< [n_triangles] likewise
  std::size_t n_file_nodes = 0;
  AssociationReport report;
};

/// Reads and associates (associate_mesh). Stored lengths are those of the file (point data "size"), else those the mesh
/// was made for, else measured: `sizes` where the mean edge at the node is 0.7 to 1.4 of them, that mean elsewhere.
/// Throws Error(kInput), Error(kMismatch) naming the file, Error(kUsage).
ForeignMesh read_foreign_mesh(const std::string& path, const Model& model, const ForeignMeshOptions& options);

/// The model with its vertices where the mesh has its nodes on them, so that these stay to the bit. `composites`: those
/// of the model.
Model with_vertices_of(const SurfaceMesh& mesh, Model&& model, const Composites& composites);

/// "wing.stl: 12 triangles on 6 faces ...", and its JSON object.
std::string association_text(const std::string& path, const SurfaceMesh& mesh, const AssociationReport& report);
nlohmann::json association_json(const SurfaceMesh& mesh, const AssociationReport& report);

}  // namespace st
