// Which pieces of a model have edges at one place.
#pragma once

#include <TopoDS_Shape.hxx>
#include <vector>

namespace st::occt {

/// Solids, shells and faces that are in no other one of these, in the order of the shape.
std::vector<TopoDS_Shape> pieces_of(const TopoDS_Shape& shape);

/// Shells of faces that have edges in common, in the order of the faces.
std::vector<TopoDS_Shape> shells_of(const std::vector<TopoDS_Shape>& faces);

/// [pieces] whether a free edge of the piece runs along an edge of any piece, another edge of its own included, or one
/// of another piece runs along an edge of it; or an edge of it that is not free along one of another piece, where both
/// pieces have free edges: within `tolerance` at a third of the edge.
std::vector<char> have_edges_at_one_place(const std::vector<TopoDS_Shape>& pieces, double tolerance);

}  // namespace st::occt
