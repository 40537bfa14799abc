// Rounds over the holes of a mesh: marked segments of curves first, then the holes.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "meshing/engine/hole_marker.h"
#include "meshing/engine/mesh_rounds.h"
#include "meshing/engine/paired_holes.h"
#include "meshing/engine/tiled_regions.h"
#include "meshing/hole/hole_filler.h"

namespace st {

class HoleRounds : public MeshRounds {
 public:
  /// All references outlive the object. `holes`: its marks grow.
  HoleRounds(HoleMarker& holes, const SizeField& field, const MeshOptions& options, const Executor& executor,
             MeshResult& result)
      : MeshRounds(field, kHolePolicy, executor, result),
        model_(holes.model()),
        old_(holes.mesh()),
        holes_(holes),
        options_(options),
        paired_(model_, old_, options.pairs) {}

  /// Faces whose holes could not be filled, whole face or not: on every rank. Where there are any, the result has no
  /// mesh.
  const std::vector<FaceId>& failed_faces() const { return failed_faces_; }
  /// [n_edges] 1: stays where these are meshed; empty: none.
  std::vector<char> edges_to_keep() const { return paired_.with_edges_of_pairs(holes_.options().keep_edge); }
  /// Local, on rank 0, after run(), once. Patches of all faces, those that stay included; none of failed faces.
  std::vector<FacePatch> take_patches();

 private:
  void mesh_edges() override;
  std::vector<RefinementPoint> mesh_regions() override;
  void join() override;
  std::vector<RefinementPoint> find_crossings() override;
  void choose_again(std::size_t first_refinement) override;

  void request_curve_lengths();
  std::vector<HoleRim> find_rims(const std::vector<FaceId>& faces) const;
  using MakeMesh = std::function<FaceMesh(const Surface&, const FaceBoundary&, const SizeField&)>;
  std::vector<std::int32_t> fill(const std::vector<HoleRim>& rims);
  double expected_triangles(const HoleRim& rim) const;
  std::vector<double> expected_triangles(const std::vector<HoleRim>& rims) const;
  Regions holes_as_regions(const std::vector<HoleRim>& rims) const;
  Piece fill_tiled(const HoleRim& rim, std::int32_t number, TiledRegions& tiled) const;
  std::string made_from(const std::vector<HoleRim>& rims) const;
  Piece fill_hole(const HoleRim& rim, const MakeMesh& make_mesh) const;
  bool add_image(FaceId face, const Piece& fill);
  void grow(const HoleRim& rim, std::size_t step);
  void renew_surrounded_nodes();

  const Model& model_;
  const HoleMesh& old_;
  HoleMarker& holes_;
  MeshOptions options_;
  PairedHoles paired_;
  EdgeUpdate update_;
  std::optional<HoleNumbering> numbering_;  // of update_
  std::vector<std::vector<Piece>> fills_;   // [n_faces] on rank 0: of its holes; none: as it was, or failed
  std::vector<FacePatch> patches_;          // likewise: of faces with fills
  std::vector<FaceId> failed_faces_;
  std::vector<TriangleId> crossing_;  // triangles of the old mesh that cross new ones, of the last search
};

}  // namespace st
