// Periodic faces in the rounds of the mesher: one face of each pair is meshed, the other has its image.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "meshing/engine/meshed_faces.h"
#include "meshing/topology/periodic_pairs.h"

namespace st {

/// The image of a patch of a pair's face a as one of its face b.
struct PairImage {
  FacePatch patch;
  std::string error;  ///< empty: none; else it is no mesh of that face
};

/// `numbering`: of the edges of both faces. `is_sound`: the patch is a mesh without faults, so that its image has to
/// lie on the surface. Local.
PairImage image_on_pair(const Model& model, const PeriodicPairs& pairs, std::size_t pair, const FacePatch& patch,
                        const BoundaryNumbering& numbering, bool is_sound = true);

/// Places where sizes become smaller, and their images near faces of pairs: both sides are to ask for the same.
std::vector<RefinementPoint> with_images(std::vector<RefinementPoint> places, const PeriodicPairs& pairs,
                                         const ModelTables& tables);

class PairedFaces {
 public:
  /// All references outlive the object. `pairs`: null where there are none.
  PairedFaces(const Model& model, const MeshTopology& topology, const Executor& executor, const PeriodicPairs* pairs,
              MeshedFaces& faces);

  /// The faces that are meshed; the others of a pair have images.
  std::vector<FaceId> meshed_of(const std::vector<FaceId>& faces) const;
  /// [n_faces] both faces of a pair, or none of them.
  void spread(std::vector<char>& is_chosen) const;
  std::vector<RefinementPoint> with_images(std::vector<RefinementPoint> places) const {
    return st::with_images(std::move(places), pairs_, tables_);
  }
  /// Collective. Gives the second faces of pairs among these (rank 0's) images of what their first faces have, on rank
  /// 0. Returns, there, those that have one now.
  std::vector<FaceId> make_images(const std::vector<FaceId>& faces);
  /// Collective, at the end: images of those of which a patch is another one since the last images.
  void renew_images();

 private:
  void take(std::size_t pair, PairImage&& image);
  using Versions = std::array<std::int64_t, 2>;
  Versions versions(std::size_t pair) const;

  const Model& model_;
  const ModelTables& tables_;
  const Executor& executor_;
  const PeriodicPairs none_;
  const PeriodicPairs& pairs_;
  MeshedFaces& faces_;
  std::vector<Versions> made_of_;  // by pair: versions() after its last image, on rank 0
};

}  // namespace st
