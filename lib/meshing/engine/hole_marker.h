// What of a mesh no longer respects the sizes, found on all ranks, and found again when sizes were refined.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"
#include "geometry/model/model.h"
#include "meshing/face/refinements.h"
#include "meshing/hole/hole_marks.h"
#include "sizing/size_field.h"

namespace st {

class HoleMarker {
 public:
  /// Collective. Marks. `mesh`: the whole mesh on rank 0, at least its `share` on others. It and all other references
  /// outlive the object.
  HoleMarker(const Model& model, const HoleMesh& mesh, const MeshShare& share, const SizeField& field,
             HoleMarkOptions options, const Executor& executor);

  /// Collective. Marks again: for the sizes with these refinements, and those triangles of `redo` (rank 0's count).
  void mark_again(const Refinements& refinements, std::vector<TriangleId> redo);
  /// Local, on rank 0. A hole of the face grows by some layers of triangles, or to the whole face.
  void grow(FaceId face, std::span<const TriangleId> hole, int layers) { grow_hole(mesh_, face, hole, layers, marks_); }
  void grow_to_face(FaceId face);

  const Model& model() const { return model_; }
  const HoleMesh& mesh() const { return mesh_; }
  const HoleMarkOptions& options() const { return options_; }
  /// Triangles on rank 0, segments on every rank.
  const HoleMarks& marks() const { return marks_; }
  /// On rank 0: those with a marked triangle, ascending; holes that grew do not count.
  const std::vector<FaceId>& dirty_faces() const { return dirty_faces_; }

  // of the first marking, on rank 0: before holes grew or sizes were refined
  std::int64_t n_marked_triangles = 0, n_marked_segments = 0;
  std::string marks_hash;  ///< of triangles and segments
  double seconds = 0;

 private:
  void request_lengths(const SizeField& field);
  const SideRequests& request_along_sides(const SizeField& metrics);
  bool has_long_edges() const;
  double squeezed_length(NodeId a, NodeId b) const;
  bool has_marks(FaceId f) const;
  std::vector<char> faces_without_stretch() const;
  std::vector<LocalSize> refined_sizes(const Refinements& refinements) const;
  void mark(const std::vector<LocalSize>& wanted);
  std::vector<TouchedNode> exchange(const std::vector<TouchedNode>& own) const;
  void collect_marks();
  void mark_pairs();

  const Model& model_;
  const HoleMesh& mesh_;
  MeshShare share_;
  HoleMarkOptions options_;
  const Executor& executor_;
  std::optional<SideRequests> along_sides_;  // of metrics
  std::vector<LocalSize> wanted_;            // [n_nodes] requested lengths, of the nodes that the share needs
  bool is_stretched_ = false;
  HoleMarks marks_;
  std::vector<FaceId> dirty_faces_;
};

}  // namespace st
