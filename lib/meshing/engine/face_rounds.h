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
#include "meshing/engine/edge_mesher.h"
#include "meshing/engine/hopeless_faces.h"
#include "meshing/engine/mesh_plan.h"
#include "meshing/engine/mesh_rounds.h"
#include "meshing/engine/meshed_faces.h"
#include "meshing/engine/paired_faces.h"
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
  struct WholeMesh {  // no face failed: what has been redone since, as it was
    EdgeMesh edges;
    std::map<FaceId, std::pair<FacePlace, FaceOutcome>> faces;
  };

  const ModelTables& tables() const { return topology_.tables(); }
  void mesh_edges() override;
  std::vector<RefinementPoint> mesh_regions() override;
  void join() override;
  std::vector<RefinementPoint> find_crossings() override;
  bool mend_crossings() override;
  void choose_again(std::size_t first_refinement) override;

  struct MadeFace {
    PatchPlace place;        // of the whole patch, or of its last section
    bool is_parted = false;  // it has more
    FaceOutcome outcome;

    static auto fields(auto& x) { return std::tie(x.place, x.is_parted, x.outcome); }
  };
  struct FaceResult {
    FacePatch patch;  // or the last section of it
    MadeFace made;

    static auto fields(auto& x) { return std::tie(x.patch, x.made); }
  };
  using MakeMesh = std::function<FaceMesh(const Surface&, const FaceBoundary&, const SizeField&)>;
  FaceResult make_face(FaceId f, const MakeMesh& make_mesh) const;
  FaceResult mesh_whole(FaceId f) const;
  WorkLimit time_limit(double n_triangles) const;
  std::string made_from() const;
  void mesh_dirty_faces();
  bool is_worth_loosening() const;
  void give_up(bool by_crossings);
  bool gives_up_folds();
  MadeFace keep(FaceResult&& result);
  Bytes record_whole(const Bytes& made) const;
  Bytes restore_whole(Bytes&& whole);
  void take_whole(FaceId f, const Bytes& bytes);
  bool take_seams(FaceId f, const Bytes& bytes, std::map<FaceId, MadeFace>& parted);
  FaceResult mesh_seams_of(FaceId f, TiledRegions& tiled) const;
  std::vector<FaceId> store_sections(TiledRegions& tiled, std::map<FaceId, MadeFace>&& parted);
  Regions faces_as_regions() const;
  void take_face(FaceId f, FaceOutcome&& outcome, FacePlace&& place);
  void close_holes();
  void remember_whole();
  void drop_replaced();
  void find_dirty(std::span<const Refinement> refinements);
  std::vector<FaceId> mesh_changed(const std::vector<Refinement>& changed, const char* why, std::int64_t most_bad);

  const Model& model_;
  const MeshTopology& topology_;
  MeshPlan plan_;
  MeshOptions options_;
  std::vector<double> expected_;     // [n_faces] triangles, by the weights of the plan; empty: it has none
  std::vector<EdgeId> dirty_edges_;  // to be meshed in this round
  std::vector<FaceId> dirty_faces_;
  std::optional<WholeMesh> whole_;  // the last one, on rank 0
  bool is_restored_ = false;
  std::int64_t version_ = 0;  // of patches made in this round
  EdgeMesher edge_mesher_;
  MeshedFaces faces_;
  PairedFaces paired_;      // of faces_
  HopelessFaces hopeless_;  // on rank 0
};

}  // namespace st
