// Rounds over the edges and faces of a model.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/model/model.h"
#include "meshing/engine/crossing_search.h"
#include "meshing/engine/facing_edges.h"
#include "meshing/engine/hopeless_faces.h"
#include "meshing/engine/mesh_plan.h"
#include "meshing/engine/mesh_rounds.h"
#include "meshing/engine/patch_store.h"
#include "meshing/engine/tiled_regions.h"

namespace st {

class FaceRounds : public MeshRounds {
 public:
  /// All references outlive the object. `plan`: its patches and edges go into the result at once.
  FaceRounds(const Model& model, const MeshTopology& topology, const SizeField& field, MeshPlan plan,
             const MeshOptions& options, const Executor& executor, MeshResult& result);

  /// Collective, once after run(): folds, failures and patches into the result. The patches of a rank are those that it
  /// has made, or rank 0 has all.
  void report(PatchesGo patches);

 private:
  struct FaceOutcome {
    FailureCause cause = FailureCause::kNone;
    std::string error;  // what was thrown, for kError
    Vec3 cause_xyz;
    std::vector<RefinementPoint> fold_places;
    std::vector<RefinementPoint> failed_places;
    int n_folds = 0;
    FailedFace failed;       // where it failed
    bool is_closed = false;  // it failed, and its loops were closed; then:
    bool is_near = false;    // the triangles are near the surface
    double deviation = 0;
    bool is_hole() const { return cause != FailureCause::kNone && !is_closed; }
  };
  struct WholeMesh {  // no face failed: what has been redone since, as it was
    EdgeMesh edges;
    std::map<FaceId, std::pair<FacePlace, FaceOutcome>> faces;
  };

  void mesh_edges() override;
  std::vector<RefinementPoint> mesh_regions() override;
  void join() override;
  std::vector<RefinementPoint> find_crossings() override;
  void choose_again(std::size_t first_refinement) override;

  void follow_leaders(EdgeMesh& fresh, std::vector<EdgeId>& place) const;
  EdgeMesh make_edge(EdgeId e) const;
  EdgeMesh make_mirrored(const MeshTopology::Strip& strip, const EdgeMesh& kept) const;
  void end_at_vertices(EdgeId e, EdgeMesh& nodes, int min_segments) const;
  struct FaceReport {
    PatchPlace place;        // of the whole patch, or of its last section
    bool is_parted = false;  // it has more
    FailureCause cause = FailureCause::kNone;
    std::string error;
    std::vector<RefinementPoint> wanted;
    int n_folds = 0;
    FailedFace failed;

    static auto fields(auto& x) {
      return std::tie(x.place, x.is_parted, x.cause, x.error, x.wanted, x.n_folds, x.failed);
    }
  };
  struct FaceResult {
    PatchSection section;
    FaceReport report;

    static auto fields(auto& x) { return std::tie(x.section, x.report); }
  };
  using MakeMesh = std::function<FaceMesh(const Surface&, const FaceBoundary&, const SizeField&)>;
  FaceResult make_face(FaceId f, const MakeMesh& make_mesh) const;
  FaceResult mesh_whole(FaceId f) const;
  WorkLimit time_limit(double n_triangles) const;
  std::string made_from() const;
  void mesh_dirty_faces();
  void give_up(bool by_crossings);
  std::int64_t n_more_of_hopeless() const;
  std::vector<FaceId> sound_faces() const;
  FaceReport keep(FaceResult&& result);
  Bytes record_whole(FaceId f, const Bytes& report) const;
  Bytes restore_whole(Bytes&& whole);
  void take_whole(FaceId f, const Bytes& bytes);
  void put(FaceId f, FacePatch&& patch);
  bool take_seams(FaceId f, const Bytes& bytes, std::map<FaceId, FaceReport>& parted);
  FaceResult mesh_seams_of(FaceId f, TiledRegions& tiled) const;
  std::vector<FaceId> store_sections(TiledRegions& tiled, std::map<FaceId, FaceReport>&& parted);
  Regions faces_as_regions() const;
  void take_face(FaceId f, FaceReport&& report, FacePlace&& place);
  bool has_holes() const;
  void close_holes();
  void close_hole(FaceId f);
  void refill_bad();
  bool refill_once();
  void part_touching();
  using Patches = std::map<FaceId, FacePatch>;
  using BadTriangles = std::map<FaceId, std::vector<std::size_t>>;
  FacePatch take_whole(FaceId f);
  void hand_over(PatchesGo patches);
  Patches bring(const std::vector<FaceId>& faces) const;
  std::vector<FaceId> suspects() const;
  BadTriangles bad_triangles(const Patches& patches) const;
  std::vector<Vec3> nodes_of(const FacePatch& patch) const;
  void remember_whole();
  void drop_replaced();
  void find_dirty(std::span<const Refinement> refinements);
  void take_back_refinements();
  enum class TakeBack { kAtBadPlaces, kOfHopelessFacesToo };
  bool take_back_once(TakeBack what);
  std::vector<Refinement> drop_useless_refinements(TakeBack what);
  std::vector<Vec3> bad_places() const;
  std::int64_t n_bad() const;
  void mesh_without(const std::vector<Refinement>& changed, const char* why);
  struct Trial {  // what it may change
    std::vector<Refinement> refinements;
    EdgeMesh edges;
    std::vector<FacePlace> places;
    std::vector<FaceOutcome> outcomes;
  };
  Trial begin_trial() const;
  void go_back(const Trial& before, const std::vector<FaceId>& meshed);
  void loosen_refinements();
  bool loosen_once();
  std::vector<char> must_stay() const;
  std::vector<Refinement> find_needed(const std::vector<Refinement>& all, std::vector<char>& is_needed) const;

  const Model& model_;
  const MeshTopology& topology_;
  const ModelTables& tables_;  // of topology_
  MeshPlan plan_;
  MeshOptions options_;
  std::vector<double> expected_;        // [n_faces] triangles, by the weights of the plan; empty: it has none
  std::vector<double> face_tolerance_;  // [n_faces] of their groups, or empty
  std::vector<int> min_segments_;
  std::vector<FacingEdges> facing_;
  std::vector<EdgeId> dirty_edges_;  // to be meshed in this round
  std::vector<FaceId> dirty_faces_;
  std::optional<BoundaryNumbering> numbering_;        // of the present edges
  std::vector<FaceOutcome> outcomes_;                 // by face, on rank 0
  std::vector<std::vector<RefinementPoint>> wanted_;  // likewise, of this round
  std::optional<WholeMesh> whole_;                    // the last one, on rank 0
  bool is_restored_ = false;
  PatchStore store_;
  std::vector<FacePlace> places_;  // [n_faces] of the patches, on rank 0
  std::int64_t version_ = 0;       // of patches made in this round
  std::int64_t own_version_ = 0;   // of patches that rank 0 changed itself: negative
  CrossingSearch crossings_;
  HopelessFaces hopeless_;  // on rank 0
};

}  // namespace st
