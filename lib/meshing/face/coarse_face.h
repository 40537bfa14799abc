// A coarse mesh of a heavy face: along its edges the face is cut into tiles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshing/face/face_tiles.h"

namespace st {

/// Its corners: some nodes of the face's boundary, then nodes inside.
class CoarseFace {
 public:
  /// A part of a loop, from one coarse node to the next.
  struct Part {
    std::int32_t begin, second, end;  ///< boundary nodes of the face; the second one comes after `begin`
    std::int32_t from, to;            ///< corners at its ends
  };

  /// `places`: of the boundary's nodes. All outlive the object.
  CoarseFace(const Surface& surface, const FaceBoundary& boundary, std::span<const BoundaryPlace> places,
             const SizeField& field);

  /// Meshes the face with every `step`-th node of its loops, with sizes `step` times as large. False: a loop is open,
  /// the coarse loops cross, or the mesh has folds.
  bool make(std::int32_t step);

  std::int32_t n_triangles() const { return static_cast<std::int32_t>(mesh_.corners.size() / 3); }
  std::int32_t n_on_boundary() const { return static_cast<std::int32_t>(boundary_nodes_.size()); }
  const std::vector<std::int32_t>& corners() const { return mesh_.corners; }
  std::int32_t corner(std::int32_t t, int k) const { return mesh_.corners[3 * static_cast<std::size_t>(t) + k]; }
  const FaceNode& node(std::int32_t corner) const {
    const std::int32_t n = n_on_boundary();
    return corner < n ? boundary_.nodes[boundary_nodes_[corner]] : mesh_.inner[corner - n];
  }
  /// The node of the face's boundary that a corner below n_on_boundary() is.
  std::int32_t boundary_node(std::int32_t corner) const { return boundary_nodes_[corner]; }

  /// Of all loops.
  const std::vector<Part>& parts() const { return parts_; }
  /// Calls visit(a, b) for each segment of the part, boundary nodes of the face.
  template <class Visit>
  void for_each_segment(const Part& part, const Visit& visit) const {
    visit(part.begin, part.second);
    for (std::int32_t i = part.second; i != part.end; i = next_[i]) visit(i, next_[i]);
  }

 private:
  bool follow_loops();
  bool is_kept(std::int32_t node, std::int32_t step) const;
  std::vector<Part> parts_between(const std::vector<char>& is_node) const;
  std::vector<char> coarse_nodes(std::int32_t step) const;

  const Surface& surface_;
  const FaceBoundary& boundary_;
  const std::span<const BoundaryPlace> places_;
  const SizeField& field_;
  std::vector<std::int32_t> next_;  // boundary node after each
  std::vector<char> is_meeting_;    // more than one comes after it
  bool is_closed_;
  FaceMesh mesh_;
  std::vector<std::int32_t> boundary_nodes_;
  std::vector<Part> parts_;
};

}  // namespace st
