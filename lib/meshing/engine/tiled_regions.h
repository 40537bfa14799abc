// Heavy faces and holes as several tasks: cut into tiles, meshed tile by tile, joined.
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "base/current_work.h"
#include "base/executor.h"
#include "base/share.h"
#include "geometry/model/model.h"
#include "meshing/face/face_tiles.h"
#include "meshing/face/refinements.h"

namespace st {

/// The size field of a face, with the refinements that reach it.
class FaceField {
 public:
  /// `field` outlives the object.
  FaceField(const SizeField& field, const Refinements& refinements, const Box3& box)
      : FaceField(field, refinements.near(box)) {}
  const SizeField& get() const { return is_refined_ ? refined_ : field_; }  // spares one call for each length

 private:
  FaceField(const SizeField& field, std::vector<Refinement> near)
      : field_(field), is_refined_(!near.empty()), refined_(field, std::move(near)) {}
  const SizeField& field_;
  bool is_refined_;
  RefinedField refined_;
};

/// What is meshed as a whole or in tiles: faces, or holes of faces. Their numbers are those of whoever asks.
struct Regions {
  std::function<FaceId(std::int32_t region)> face;
  std::function<FaceBoundary(std::int32_t region, const Surface& surface)> boundary;
  std::function<std::vector<BoundaryPlace>(const FaceBoundary& boundary)> places;
};

/// The regions of one round that are cut: choose(), the cuts, share_cuts(), the tiles, then the joins. All tasks are
/// pure functions of the boundary and the sizes.
class TiledRegions {
 public:
  /// All references outlive the object. `limit`: of a tile.
  TiledRegions(const Model& model, Regions regions, const SizeField& field, const Refinements& refinements,
               const FaceMeshOptions& options, const WorkLimit& limit)
      : model_(model),
        regions_(std::move(regions)),
        field_(field),
        refinements_(refinements),
        options_(options),
        limit_(limit) {}

  /// Those of `regions` (ascending) that expect more than one and a half tiles, to be cut; `expected`: triangles by
  /// region.
  void choose(const std::vector<std::int32_t>& regions, const std::vector<double>& expected, double tile_triangles);
  /// They, as tasks: local, the cut of one, packed; and on rank 0, what it packed.
  const std::vector<std::int32_t>& chosen() const { return chosen_; }
  Bytes cut(std::int32_t i) const;
  void take_cut(std::int32_t i, const Bytes& bytes) { unpack(bytes, chosen_cuts_[i]); }
  /// Collective, when all were taken: every rank has the tiles. Where a region could not be cut it stays whole.
  void share_cuts(const Executor& executor);

  bool is_cut(std::int32_t region) const { return cuts_.contains(region); }
  /// Those that are, ascending.
  std::vector<std::int32_t> cut_regions() const;
  std::int32_t n_tiles() const { return static_cast<std::int32_t>(tiles_.size()); }
  /// Expected triangles.
  double weight(std::int32_t tile) const { return cuts_.at(tiles_[tile].region).tiles[tiles_[tile].index].weight; }

  struct Tile {
    std::int32_t region, index;
  };
  const Tile& tile(std::int32_t tile) const { return tiles_[tile]; }
  /// Local: the mesh of one tile, which stays on this rank: returns where that is, for take_place() on rank 0.
  Bytes compute(std::int32_t tile, int rank);
  void take_place(std::int32_t tile, const Bytes& bytes);
  /// Local, on its rank: the mesh. Likewise what of an earlier run comes to rank 0; returns as compute() does.
  Bytes record(std::int32_t tile) const { return packed(meshes_.at(tiles_[tile].region)[tiles_[tile].index]); }
  Bytes restore(std::int32_t tile, const Bytes& bytes);
  /// Collective, when all were taken: every rank knows where the tiles are.
  void share_places(const Executor& executor) { share(executor, rank_of_); }

  /// Local, by tasks that `answer` belongs to: the whole mesh of a region; its tiles are gone after it. Several threads
  /// may join different regions.
  FaceMesh join(const Surface& surface, std::int32_t region, const FaceBoundary& boundary, const Executor& executor);
  /// Local: a tile for a rank that joins its region.
  Bytes answer(const Bytes& request);

 private:
  TileCut cut_of(std::int32_t region) const;
  FaceField field_of(FaceId f) const { return FaceField(field_, refinements_, model_.tables().face_box[f]); }

  const Model& model_;
  const Regions regions_;
  const SizeField& field_;
  const Refinements& refinements_;
  const FaceMeshOptions options_;
  const WorkLimit limit_;
  double tile_triangles_ = 0;
  std::vector<std::int32_t> chosen_;
  std::vector<TileCut> chosen_cuts_;  // on rank 0; without tiles: could not be cut
  std::map<std::int32_t, TileCut> cuts_;
  std::vector<Tile> tiles_;
  std::vector<std::int32_t> rank_of_;                     // [n_tiles] where its mesh is
  std::map<std::int32_t, std::vector<FaceMesh>> meshes_;  // by region, of its tiles: those that are here
};

}  // namespace st
