// The faces of a model as far as they are meshed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"
#include "meshing/engine/crossing_search.h"
#include "meshing/engine/mesh_result.h"
#include "meshing/engine/patch_store.h"
#include "meshing/topology/mesh_topology.h"

namespace st {

/// What came of meshing a face.
struct FaceOutcome {
  FailureCause cause = FailureCause::kNone;
  std::string error;                    ///< what was thrown, for kError
  std::vector<RefinementPoint> wanted;  ///< where it failed or folds
  int n_folds = 0;
  FaceAttempt attempt;     ///< where it failed
  bool is_closed = false;  ///< it failed, and its loops were closed; then:
  bool is_near = false;    ///< the triangles are near the surface
  double deviation = 0;

  bool is_hole() const { return cause != FailureCause::kNone && !is_closed; }
  static auto fields(auto& o) {
    return std::tie(o.cause, o.error, o.wanted, o.n_folds, o.attempt, o.is_closed, o.is_near, o.deviation);
  }
};

/// The present nodes of edges, and for each face its patch, what came of it and where it crosses others. Patches stay
/// on the ranks that made them; outcomes, places and counts are those of rank 0.
class MeshedFaces {
 public:
  using Patches = std::map<FaceId, FacePatch>;
  using BadTriangles = std::map<FaceId, std::vector<std::size_t>>;
  struct PatchState {  ///< what can be gone back to
    std::vector<FacePlace> places;
    CrossingSearch::State crossings;
  };
  struct State {
    EdgeMesh edges;
    std::vector<FaceOutcome> outcomes;
    PatchState patches;
  };

  /// All references outlive the object; `edges` are changed by set_edges() alone. `across_bodies`: see CrossingSearch.
  MeshedFaces(const Model& model, const MeshTopology& topology, const Executor& executor, bool across_bodies,
              EdgeMesh& edges);

  // The same on all ranks.
  const EdgeMesh& edges() const { return edges_; }
  const BoundaryNumbering& numbering() const { return *numbering_; }
  void set_edges(EdgeMesh edges);
  std::vector<Vec3> nodes_of(const FacePatch& patch) const;
  const PatchStore& store() const { return store_; }
  /// Local, on any rank: a section stays here, of the present edges. `version`: of the round, not below 0.
  PatchPlace keep(FacePatch&& section, std::int32_t number, std::int64_t version) {
    return store_.put(std::move(section), number, version, edges_, tables_.vertex_xyz);
  }
  CrossingSearch& crossings() { return crossings_; }

  // Local; places and outcomes are those of rank 0.
  State state() const { return {edges_, outcomes_, patch_state()}; }
  PatchState patch_state() const { return {places_, crossings_.state()}; }
  const std::vector<FacePlace>& places() const { return places_; }

  // Local, on rank 0.
  const FaceOutcome& outcome(FaceId f) const { return outcomes_[f]; }
  const FacePlace& place(FaceId f) const { return places_[f]; }
  /// The face has another patch, and this came of it.
  void set(FaceId f, FacePlace place, FaceOutcome outcome);
  /// Rank 0's own patch of the face, from now on; what came of it stays.
  void put(FaceId f, FacePatch&& patch);
  /// The loops of a face that failed were closed, with this patch.
  void close(FaceId f, FacePatch&& patch, bool is_near, double deviation);
  bool has_holes() const;
  /// Failures, folds and crossings.
  std::int64_t n_bad() const;
  /// Collective. Whether there are more than so many without crossings, which need a search.
  bool has_surely_more_bad(std::int64_t n) const;
  /// Faces without a fold, crossing or failure, ascending.
  std::vector<FaceId> sound_faces() const;
  /// Faces of which triangles may be bad, ascending.
  std::vector<FaceId> suspects() const;
  /// By face: folded onto a neighbour, without area, or crossing others. `patches`: of all suspects.
  BadTriangles bad_triangles(const Patches& patches) const;

  // Collective.
  void search_crossings() { crossings_.run(*numbering_, places_); }
  std::vector<RefinementPoint> crossings_to_refine() { return crossings_.places_to_refine(*numbering_, places_); }
  /// Copies of these patches (rank 0's choice) on rank 0.
  Patches bring(const std::vector<FaceId>& faces) const;
  /// Where faces fail, fold or cross; on rank 0.
  std::vector<Vec3> bad_places() const;
  void go_back(const State& before);
  /// To the patches alone: edges and outcomes are the same.
  void go_back(const PatchState& before);
  /// Drops patches that are neither part of the mesh nor among these (rank 0's).
  void keep_only(std::vector<FacePlace> others);
  /// Once, at the end: folds, failures, crossings and patches go into the result.
  void hand_over(PatchesGo patches, MeshResult& result);

 private:
  std::int64_t n_bad_alone() const;
  void report(MeshResult& result) const;
  void hand_to_root(MeshResult& result);
  FacePatch take_whole(FaceId f);

  const MeshTopology& topology_;
  const ModelTables& tables_;  // of topology_
  const Executor& executor_;
  EdgeMesh& edges_;
  std::optional<BoundaryNumbering> numbering_;  // of edges_
  std::vector<FaceOutcome> outcomes_;           // [n_faces]
  std::vector<FacePlace> places_;               // [n_faces]
  std::int64_t own_version_ = 0;                // of patches that rank 0 changed itself: negative
  PatchStore store_;
  CrossingSearch crossings_;
};

}  // namespace st
