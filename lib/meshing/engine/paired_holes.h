// Periodic faces of a mesh whose holes are filled: one face of each pair is, the other has its image.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/executor.h"
#include "meshing/hole/hole_filler.h"
#include "meshing/topology/periodic_pairs.h"

namespace st {

class PairedHoles {
 public:
  /// All references outlive the object. `pairs`: null where there are none.
  PairedHoles(const Model& model, const HoleMesh& old, const PeriodicPairs* pairs);

  /// Collective. New nodes of the runs, by run: those `make(r)` gives, or images of what their leaders have. Runs of
  /// edges that are images of one another are alike.
  EdgeMesh make_nodes(const std::vector<SegmentRun>& runs, const std::function<EdgeMesh(std::int32_t r)>& make,
                      const Executor& executor) const;
  /// The faces whose holes are filled; the others of a pair have images.
  std::vector<FaceId> filled_of(const std::vector<FaceId>& faces) const;
  /// These (ascending, none that has an image) and their partners, ascending.
  std::vector<FaceId> with_partners(std::vector<FaceId> faces) const;
  /// The partner that has the image of a face; kNone: none.
  FaceId partner_of(FaceId face) const;
  /// Of what fills a whole face, on its partner; without triangles where that has no such mesh. Local.
  Piece image(FaceId face, const Piece& fill, const HoleNumbering& numbering) const;
  /// `keep_edge` ([n_edges], or empty: none), and the edges of all pairs.
  std::vector<char> with_edges_of_pairs(std::vector<char> keep_edge) const;

 private:
  std::optional<std::size_t> pair_of(FaceId face) const;
  EdgeMesh image_of_run(const SegmentRun& run, const std::vector<SegmentRun>& runs, const EdgeMesh& nodes,
                        const std::vector<std::int32_t>& place) const;
  Piece as_fill(const FacePatch& patch, const HoleNumbering& numbering) const;

  const Model& model_;
  const HoleMesh& old_;
  const PeriodicPairs none_;
  const PeriodicPairs& pairs_;
};

}  // namespace st
