// The outlines of holes: what a worker must know of the old mesh to fill them.
#pragma once

#include <tuple>
#include <vector>

#include "meshing/hole/hole_marks.h"

namespace st {

/// A hole: marked triangles of one face that hang together by nodes of one (u,v). Holes of a face are filled apart from
/// each other.
struct HoleRim {
  struct Side {
    std::int32_t first, second;  ///< of `nodes`, in the direction of the marked triangle
  };

  FaceId face = kNone;
  bool is_whole_face = false;    ///< no triangle of the face stays: the face's loops bound it, and there are no sides
  bool is_turned = false;        ///< the face's triangles run clockwise in (u,v)
  std::vector<FaceNode> nodes;   ///< by node of the old mesh; one with several (u,v) several times
  std::vector<Side> free_sides;  ///< to triangles that stay
  std::vector<Side> cad_sides;   ///< on segments of the face's CAD edges, the two sides of a seam or a slit each
  std::vector<TriangleId> triangles;  ///< marked ones, ascending; on rank 0

  static auto fields(auto& r) {
    return std::tie(r.face, r.is_whole_face, r.is_turned, r.nodes, r.free_sides, r.cad_sides);
  }
};

/// All holes of a face, by their first triangle. Local, about linear in its marked triangles.
std::vector<HoleRim> find_hole_rims(const HoleMesh& mesh, const HoleMarks& marks, FaceId face);

}  // namespace st
