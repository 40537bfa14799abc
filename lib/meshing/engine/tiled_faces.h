// Heavy faces as several tasks: cut into tiles, meshed tile by tile, joined.
#pragma once

#include <map>
#include <vector>

#include "base/current_work.h"
#include "base/executor.h"
#include "geometry/model/model.h"
#include "meshing/face/face_boundary.h"
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

/// Where the boundary's nodes lie on their edges.
std::vector<BoundaryPlace> boundary_places(const FaceBoundary& boundary, const BoundaryNumbering& numbering);

/// The faces of one round that are cut: choose(), the cuts, share_cuts(), the tiles, then the joins. All tasks are pure
/// functions of the boundary and the sizes.
class TiledFaces {
 public:
  /// All references outlive the object. `limit`: of a tile.
  TiledFaces(const Model& model, const BoundaryNumbering& numbering, const SizeField& field,
             const Refinements& refinements, const FaceMeshOptions& options, const WorkLimit& limit)
      : model_(model),
        numbering_(numbering),
        field_(field),
        refinements_(refinements),
        options_(options),
        limit_(limit) {}

  /// Those of `faces` that expect more than one and a half tiles, to be cut; `expected`: triangles by face, [n_faces].
  void choose(const std::vector<FaceId>& faces, const std::vector<double>& expected, double tile_triangles);
  /// They, as tasks: local, the cut of one, packed; and on rank 0, what it packed.
  const std::vector<FaceId>& chosen() const { return chosen_; }
  Bytes cut(std::int32_t i) const;
  void take_cut(std::int32_t i, const Bytes& bytes) { unpack(bytes, chosen_cuts_[i]); }
  /// Collective, when all were taken: every rank has the tiles. Where a face could not be cut it stays whole.
  void share_cuts(const Executor& executor);

  bool is_cut(FaceId f) const { return cuts_.contains(f); }
  std::int32_t n_tiles() const { return static_cast<std::int32_t>(tiles_.size()); }
  /// Expected triangles.
  double weight(std::int32_t tile) const { return cuts_.at(tiles_[tile].face).tiles[tiles_[tile].index].weight; }

  TaskLabel label(std::int32_t tile) const { return {"tile", tiles_[tile].face, tiles_[tile].index}; }
  /// Local: the mesh of one tile, packed; and on rank 0, what it packed.
  Bytes compute(std::int32_t tile) const;
  void take(std::int32_t tile, const Bytes& bytes);

  /// Local, on rank 0, when all tiles were taken: the whole mesh of a face; its tiles are gone after it.
  /// Several threads may join different faces.
  FaceMesh join(const Surface& surface, FaceId f, const FaceBoundary& boundary);

 private:
  struct TileOf {
    FaceId face;
    std::int32_t index;
  };
  TileCut cut_face_of(FaceId f) const;
  FaceField field_of(FaceId f) const { return FaceField(field_, refinements_, model_.tables().face_box[f]); }

  const Model& model_;
  const BoundaryNumbering& numbering_;
  const SizeField& field_;
  const Refinements& refinements_;
  const FaceMeshOptions options_;
  const WorkLimit limit_;
  double tile_triangles_ = 0;
  std::vector<FaceId> chosen_;
  std::vector<TileCut> chosen_cuts_;  // on rank 0; without tiles: could not be cut
  std::map<FaceId, TileCut> cuts_;
  std::vector<TileOf> tiles_;
  std::map<FaceId, std::vector<FaceMesh>> meshes_;  // on rank 0
};

}  // namespace st
