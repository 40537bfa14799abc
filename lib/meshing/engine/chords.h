// Chords: edges of triangles between two nodes on boundaries that are no segments of these.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/node_key.h"
#include "meshing/face/face_boundary.h"
#include "meshing/face/face_patch.h"

namespace st {

/// A triangle of a face.
struct Facet {
  FaceId face = kNone;
  std::int32_t index = 0;  ///< in the patch of the face
};

/// An edge of a triangle between two nodes on boundaries that is no segment of these.
struct Chord {
  NodeKey a, b;  ///< a < b
  Facet facet;
};

/// Segments of the CAD edges, as pairs of nodes.
class BoundarySegments {
 public:
  explicit BoundarySegments(const BoundaryNumbering& numbering);
  /// a < b.
  bool contain(NodeKey a, NodeKey b) const;

 private:
  std::vector<std::pair<NodeKey, NodeKey>> at_ends_;  // all but those between two nodes inside one edge, sorted
};

/// The chords of a patch, or of a section whose triangles begin with this one.
std::vector<Chord> find_chords(const BoundarySegments& segments, const FacePatch& patch, std::int64_t first = 0);

/// Pairs of triangles of two faces about one chord: an edge between the same two nodes on boundaries inside both faces,
/// sorted, at least one face fresh. Two faces along common edges, too flat for a node inside, lie on each other there.
/// `chords`: of all faces, in any order.
std::vector<std::pair<Facet, Facet>> find_repeated_chords(std::vector<Chord> chords,
                                                          std::span<const char> face_is_fresh);

}  // namespace st
