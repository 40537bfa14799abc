// Meshes the edges and faces of a model on all ranks, in rounds: what cannot be meshed, folds or crosses is refined and
// done again.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/executor.h"
#include "base/packer.h"
#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"
#include "meshing/face/face_boundary.h"
#include "meshing/face/face_mesher.h"
#include "meshing/face/failed_face.h"
#include "meshing/face/refinements.h"
#include "meshing/topology/curve_discretiser.h"
#include "sizing/size_field.h"

namespace st {

struct ModelMesherOptions {
  int enhance_rounds = 5;
  double max_turning_deg = 30;    ///< of a CAD edge along one segment
  int max_rounds = 6;             ///< refinements of loops, folds and narrow parts
  int max_crossing_rounds = 8;    ///< refinements of crossing facets
  int max_promising_rounds = 14;  ///< likewise where few are left, or ever fewer
  double merge_below = 0.05;      ///< of the requested length, see find_merged_features(); 0: nothing is merged
  const MergedFeatures* merged = nullptr;  ///< of an earlier mesh: taken over instead of looking for them
  std::vector<char> keep_edge = {};        ///< [n_edges] 1: run_from() leaves its nodes; empty: none
};

/// Where the time went, seconds on rank 0.
struct ModelMesherTimes {
  double edges = 0, faces = 0, crossing = 0;
};

class ModelMesher {
 public:
  /// `face_weight`: expected work per face, [n_faces] or empty. All references outlive the object.
  ModelMesher(const Model& model, const SizeField& field, std::vector<double> face_weight,
              const ModelMesherOptions& options, const Executor& executor);

  /// Collective. Meshes everything.
  void run();
  /// Collective. Meshes `faces` only (ascending), on the given nodes where `fixed` has nodes of an edge (it may be
  /// empty): parts meshed apart fit.
  void run_part(const std::vector<FaceId>& faces, EdgeMesh fixed);
  /// Collective. Keeps the given nodes of every edge and the patches of faces not in `faces_to_redo` (on rank 0); edges
  /// of which all faces are redone get new nodes, unless `keep_edge` has them.
  void run_from(EdgeMesh edges, std::vector<FacePatch> patches, const std::vector<FaceId>& faces_to_redo);

  // results, complete on rank 0 only (edges on every rank)
  EdgeMesh edges;
  std::vector<FacePatch> patches;        ///< by face; without triangles where the face failed
  std::vector<FaceFailure> failures;     ///< by face
  std::vector<FailedFace> failed_faces;  ///< likewise: boundary and partial state of each
  /// What was merged, and the model's tables with that; on every rank.
  const MeshTopology& topology() const { return topology_; }
  const MergedFeatures& merged() const { return topology_.merged(); }
  const ModelTables& tables() const { return topology_.tables(); }
  std::vector<RefinementPoint> folds;  ///< places where a triangle is still turned against the surface
  int n_rounds = 0, n_crossing_pairs = 0, n_refinements = 0;
  ModelMesherTimes times;

 private:
  struct FaceOutcome {
    FailureCause cause = FailureCause::kNone;
    std::string error;  // what was thrown, for kError
    Vec3 cause_xyz;
    int n_folds = 0;
    std::vector<RefinementPoint> fold_places;
  };
  struct FacetPair {  // two triangles by face and place in its patch
    FaceId face_a, face_b;
    std::int32_t index_a, index_b;
    auto operator<=>(const FacetPair&) const = default;
  };
  struct WholeMesh {  // no face failed: what has been redone since, as it was
    EdgeMesh edges;
    std::map<FaceId, std::pair<FacePatch, FaceOutcome>> faces;
  };
  MergedFeatures find_small_features() const;
  void add_mirrored(const MeshTopology::Strip& strip, const Curve& curve, const CurveNodes& nodes,
                    Packer& packer) const;
  void rounds(std::vector<EdgeId> dirty_edges, std::vector<FaceId> dirty_faces);
  void keep_whole(const std::vector<FaceId>& dirty);
  bool restore_whole();
  void limit_scope(const std::vector<EdgeId>& edges_in, const std::vector<FaceId>& faces_in);
  void mesh_edges(const std::vector<EdgeId>& dirty);
  std::vector<RefinementPoint> mesh_faces(const std::vector<FaceId>& dirty);
  std::vector<RefinementPoint> find_crossings();
  bool accept(const std::vector<RefinementPoint>& points, double floor, std::vector<EdgeId>& dirty_edges,
              std::vector<FaceId>& dirty_faces);
  void find_dirty(std::size_t first_refinement, std::vector<EdgeId>& dirty_edges,
                  std::vector<FaceId>& dirty_faces) const;
  Bytes compute_edges(const std::vector<EdgeId>& batch) const;
  Bytes compute_face(FaceId f) const;
  void broadcast_edges();

  const Model& model_;
  const SizeField& field_;
  ModelMesherOptions options_;
  const Executor& executor_;
  MeshTopology topology_;
  const ModelTables& tables_;                   // of topology_
  std::vector<double> face_tolerance_;          // [n_faces] of their groups, or empty
  std::optional<BoundaryNumbering> numbering_;  // of the present edges
  std::vector<double> face_weight_;
  std::vector<int> min_segments_;
  std::vector<char> edge_in_scope_, face_in_scope_;  // what may be meshed (again)
  Refinements refinements_;
  std::vector<FaceOutcome> outcomes_;  // by face, on rank 0
  std::map<FaceId, FailedFace> failed_faces_;
  std::optional<WholeMesh> whole_;         // the last one, on rank 0
  std::vector<char> face_is_fresh_;        // meshed since the last search for crossings
  std::vector<FacetPair> crossing_pairs_;  // found so far and still there, sorted
};

}  // namespace st
