// Heavy faces and holes as several tasks: cut into tiles, meshed tile by tile, enhanced along the cuts.
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "base/current_work.h"
#include "base/executor.h"
#include "base/share.h"
#include "geometry/model/model.h"
#include "meshing/face/refinements.h"
#include "meshing/face/seam_mesh.h"

namespace st {

/// The size field of a face, with the refinements that reach it.
class FaceField {
 public:
  /// `field` outlives the object.
  FaceField(const SizeField& field, const Refinements& refinements, const Box3& box)
      : FaceField(field, refinements.near(box)) {}
  const SizeField& get() const { return is_refined_ ? refined_ : field_; }  // spares one call for each length

 private:
  FaceField(const SizeField& field, const std::vector<Refinement>& near)
      : field_(field), is_refined_(!near.empty()), refined_(field, near) {}
  const SizeField& field_;
  bool is_refined_;
  RefinedField refined_;
};

/// What is meshed as a whole or in tiles: faces, or holes of faces. Their numbers are those of whoever asks.
struct Regions {
  std::function<FaceId(std::int32_t region)> face;
  std::function<FaceBoundary(std::int32_t region, const Surface& surface)> boundary;
  std::function<std::vector<BoundaryPlace>(const FaceBoundary& boundary)> places;
  bool share_faces = false;  ///< a face may have several
};

/// The regions of one round that are cut: choose(), the cuts, share_cuts(), the tiles, share_places(), then the seams,
/// and joins where a region is wanted as a whole. All tasks are pure functions of the boundary and the sizes. Tiles are
/// the sections of a region (see Piece): each stays on the rank that makes it.
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

  bool is_cut(std::int32_t region) const { return regions_cut_.contains(region); }
  /// Those that are, ascending.
  std::vector<std::int32_t> cut_regions() const;
  /// Expected triangles.
  double weight(std::int32_t tile) const {
    return regions_cut_.at(sections_[tile].region).cut.tiles[sections_[tile].index].weight;
  }

  FaceId face(std::int32_t region) const { return regions_.face(region); }
  /// Of a task for a region, and for a tile of one.
  TaskLabel label(const char* kind, std::int32_t region) const {
    return {kind, regions_.face(region), regions_.share_faces ? region : 0};
  }
  TaskLabel label_of_tile(const char* kind, std::int32_t tile) const {
    return {kind, regions_.face(sections_[tile].region), regions_.share_faces ? tile : sections_[tile].index};
  }

  struct Section {
    std::int32_t region, index;
  };
  /// The tiles of all regions.
  std::int32_t n_sections() const { return static_cast<std::int32_t>(sections_.size()); }
  const Section& section(std::int32_t section) const { return sections_[section]; }
  std::int32_t n_sections_of(std::int32_t region) const {
    return static_cast<std::int32_t>(regions_cut_.at(region).meshes.size());
  }
  /// Local: the mesh of one tile, which stays on this rank: returns where that is, for take_place() on rank 0.
  Bytes compute(std::int32_t tile, int rank);
  void take_place(std::int32_t section, const Bytes& bytes) { unpack(bytes, rank_of_[section]); }
  /// Local, on its rank: the mesh. Likewise what of an earlier run comes to rank 0; returns as compute() does.
  Bytes record(std::int32_t section) const {
    return packed(regions_cut_.at(sections_[section].region).meshes[sections_[section].index]);
  }
  Bytes restore(std::int32_t section, const Bytes& bytes);
  /// Collective, when all tiles were taken: where each is.
  void share_places(const Executor& executor) { share(executor, rank_of_); }
  int rank_of(std::int32_t section) const { return rank_of_[section]; }

  /// Local, by tasks that `answer` belongs to: the triangles about the cuts between the sections of a region. Several
  /// threads may do this for different regions; once for each.
  Piece seams(const Surface& surface, std::int32_t region, const FaceBoundary& boundary, const Executor& executor);
  /// Takes after it the mesh of the whole region; its sections are gone then.
  FaceMesh join(std::int32_t region, const FaceBoundary& boundary, Piece seams, const Executor& executor);
  /// Local: of a section, for a rank that asks for it.
  Bytes answer(const Bytes& request);
  /// Local, on its rank: what is left of it without the band.
  Piece take(std::int32_t section) { return take_part(sections_[section], false); }
  /// Local: nothing is wanted of them any more.
  void drop_sections() {
    for (auto& [region, parts] : regions_cut_) parts.meshes.clear();
  }

 private:
  void drop_stretched();
  std::vector<Piece> gather(std::int32_t region, bool wants_bands, const Executor& executor);
  Piece take_part(const Section& section, bool wants_band);
  SplitPiece& mesh_of(const Section& s) { return regions_cut_.at(s.region).meshes[s.index]; }
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
  std::vector<Section> sections_;
  std::vector<std::int32_t> rank_of_;  // [n_sections] where its mesh is
  struct RegionCut {
    TileCut cut;
    std::vector<SplitPiece> meshes;  // of its sections: those that are here
    std::int32_t first = 0;          // number of its first section among all
  };
  std::map<std::int32_t, RegionCut> regions_cut_;
};

}  // namespace st
