// Periodic faces in the rounds of the mesher: one face of each pair is meshed, the other has its image.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "meshing/engine/meshed_faces.h"
#include "meshing/topology/periodic_pairs.h"

namespace st {

class PairedFaces {
 public:
  /// All references outlive the object. `pairs`: null where there are none.
  PairedFaces(const Model& model, const MeshTopology& topology, const Executor& executor, const PeriodicPairs* pairs,
              MeshedFaces& faces);

  /// The faces that are meshed; the others of a pair have images.
  std::vector<FaceId> meshed_of(const std::vector<FaceId>& faces) const;
  /// [n_faces] both faces of a pair, or none of them.
  void spread(std::vector<char>& is_chosen) const;
  /// Places where sizes become smaller, and their images near faces of pairs: both sides are to ask for the same.
  std::vector<RefinementPoint> with_images(std::vector<RefinementPoint> places) const;
  /// Collective. Gives the second faces of pairs among these (rank 0's) images of what their first faces have, on rank
  /// 0. Returns, there, those that have one now.
  std::vector<FaceId> make_images(const std::vector<FaceId>& faces);
  /// Collective, at the end: images of those of which a patch is another one since the last images.
  void renew_images();

 private:
  struct Image {
    FacePatch patch;
    std::string error;  // empty: none
  };
  Image image(std::size_t pair, const FacePatch& patch) const;
  void take(std::size_t pair, Image&& image);
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
