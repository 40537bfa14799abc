// Redoes the marked parts of a mesh on all ranks: curves, then holes, face by face.
#pragma once

#include <vector>

#include "comm/communicator.h"
#include "geometry/model.h"
#include "meshing/hole_filler.h"
#include "sizing/size_field.h"

namespace st {

struct RemesherOptions {
  HoleMarkOptions mark;
  double max_turning_deg = 30;   ///< as ModelMesherOptions
  int enhance_rounds = 3;
};

class Remesher {
 public:
  /// `mesh` and all other references outlive the object.
  Remesher(const Model& model, const HoleMesh& mesh, const SizeField& field, const RemesherOptions& options, const Communicator& comm);

  /// Collective. Finds what no longer respects the sizes.
  void analyse();
  /// Collective. Redoes it.
  void run();

  HoleMarks marks;                     ///< after analyse(), on every rank
  std::int64_t n_marked_triangles = 0, n_marked_segments = 0;   ///< by analyse(): holes that cannot be filled grow later
  std::vector<FaceId> dirty_faces;     ///< faces with a marked triangle, ascending, on every rank

  // results, complete on rank 0 only (edges on every rank)
  EdgeMesh edges;
  std::vector<FacePatch> patches;      ///< by face
  std::vector<FaceId> failed_faces;    ///< whose holes could not be filled, whole face or not: on every rank
  int n_grown = 0;                     ///< holes that had to grow
  double seconds_edges = 0, seconds_faces = 0;

 private:
  void redo_curves();
  std::vector<FaceId> fill(const std::vector<FaceId>& faces);
  Bytes compute_face(FaceId f) const;
  void share_edges();

  const Model& model_;
  const HoleMesh& mesh_;
  const SizeField& field_;
  RemesherOptions options_;
  const Communicator& comm_;
  std::vector<SegmentRun> runs_;
  EdgeUpdate update_;
};

}  // namespace st
