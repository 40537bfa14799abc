// Redoes the marked parts of a mesh on all ranks: curves, then holes, face by face; what crosses is refined and done
// again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"
#include "geometry/model/model.h"
#include "meshing/face/refinements.h"
#include "meshing/hole/hole_filler.h"
#include "sizing/size_field.h"

namespace st {

struct RemesherOptions {
  HoleMarkOptions mark;
  double max_turning_deg = 30;  ///< as ModelMesherOptions
  int enhance_rounds = 5;
  int max_crossing_rounds = 4;  ///< refinements of crossing facets
};

class Remesher {
 public:
  /// `mesh`: the whole mesh on rank 0, at least its `share` on others. It and all other references outlive the object.
  Remesher(const Model& model, const HoleMesh& mesh, const MeshShare& share, const SizeField& field,
           const RemesherOptions& options, const Executor& executor);

  /// Collective. Finds what no longer respects the sizes.
  void analyse();
  /// Collective. Redoes it.
  void run();
  /// Local, on rank 0. Patches of all faces, those that stay included.
  std::vector<FacePatch> all_patches() const;

  // after analyse(), on rank 0
  HoleMarks marks;                                             ///< segments on every rank
  std::int64_t n_marked_triangles = 0, n_marked_segments = 0;  ///< by analyse(): holes that cannot be filled grow later
  std::vector<FaceId> dirty_faces;                             ///< faces with a marked triangle, ascending
  std::string marks_hash;                                      ///< of triangles and segments

  // results, complete on rank 0 only (edges on every rank); new nodes have the length that the field requests as
  // node_request, inner_size
  EdgeMesh edges;
  SurfaceMesh mesh;                  ///< the whole; empty when a face failed
  std::vector<FaceId> failed_faces;  ///< whose holes could not be filled, whole face or not: on every rank
  int n_grown = 0;                   ///< holes that had to grow
  int n_crossing_pairs = 0;          ///< of which one triangle at least is new
  int n_refinements = 0, n_rounds = 0;
  double seconds_analysis = 0, seconds_edges = 0, seconds_faces = 0, seconds_crossing = 0, seconds_merge = 0;

 private:
  void redo_curves();
  void request_curve_lengths();
  void redo_holes();
  std::vector<HoleRim> find_rims(const std::vector<FaceId>& faces) const;
  std::vector<std::int32_t> fill(const std::vector<HoleRim>& rims);
  HoleFill fill_hole(const HoleRim& rim) const;
  void grow(const HoleRim& rim, std::size_t step);
  void renew_surrounded_nodes();
  bool refine_crossings();
  bool accept(const std::vector<RefinementPoint>& places);
  void mark();
  void share_curve_lengths();
  std::vector<double> refined_lengths() const;
  std::vector<TouchedNode> exchange(const std::vector<TouchedNode>& own) const;
  void collect_marks();

  const Model& model_;
  const HoleMesh& old_;
  MeshShare share_;
  const SizeField& field_;
  RemesherOptions options_;
  const Executor& executor_;
  std::vector<double> wanted_;  // [n_nodes] requested lengths, of the nodes that the share needs
  Refinements refinements_;     // of crossings so far
  EdgeUpdate update_;
  std::optional<HoleNumbering> numbering_;    // of update_
  std::vector<std::vector<HoleFill>> fills_;  // [n_faces] on rank 0: of its holes; none: the face is as it was, or
                                              // failed
};

}  // namespace st
