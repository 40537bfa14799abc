// Tables in which composites are faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/model/composites.h"
#include "geometry/model/model.h"

namespace st {

/// A CAD edge in an edge of joined tables.
struct EdgePiece {
  EdgeId edge = kNone;
  bool is_reversed = false;  ///< passed from its t_max to its t_min
};

/// Tables, and what of the CAD each of their entities is.
struct JoinedTables {
  ModelTables tables;
  std::vector<std::int32_t> composite;             ///< [n_faces] kNone: one CAD face, or part of a lower one
  std::vector<FaceId> face_of;                     ///< [n_faces] the lowest of the composite, else the face itself
  std::vector<EdgePiece> pieces;                   ///< along each edge; none where it is joined or part of a lower one
  std::vector<std::int32_t> piece_offsets;         ///< [n_edges+1]
  std::vector<CoedgeId> coedge_pieces;             ///< CAD coedges along the edge of each coedge
  std::vector<std::int32_t> coedge_piece_offsets;  ///< [n_coedges+1]

  std::span<const EdgePiece> pieces_of(EdgeId e) const {
    return std::span(pieces).subspan(static_cast<std::size_t>(piece_offsets[e]),
                                     static_cast<std::size_t>(piece_offsets[e + 1] - piece_offsets[e]));
  }
  std::span<const CoedgeId> pieces_of_coedge(CoedgeId c) const {
    return std::span(coedge_pieces)
        .subspan(static_cast<std::size_t>(coedge_piece_offsets[c]),
                 static_cast<std::size_t>(coedge_piece_offsets[c + 1] - coedge_piece_offsets[c]));
  }
};

/// All entities keep the numbers of the CAD. A composite is the lowest of its members, and has what the CAD says of
/// that one; its normal points outward. The others have no loops and no area. Edges between members, and the higher
/// ones of those that go on into each other, are degenerate and in no loop. Precondition: `composites` does not
/// contradict `cad`.
JoinedTables join_tables(const ModelTables& cad, const Composites& composites);

struct EntityCounts {
  std::int32_t faces = 0, edges = 0, vertices = 0;
};

/// Of tables: faces with loops, edges in these, and their vertices. The others are part of joined ones.
EntityCounts count_left(const ModelTables& tables);

}  // namespace st
