// Small questions to shapes of OpenCASCADE.
#pragma once

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>
#include <string>
#include <vector>

#include "base/vec.h"
#include "geometry/brep/edge_tolerance.h"

namespace st::occt {

inline Vec3 vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

/// Box of the curves and surfaces, enlarged by tolerances.
Box3 rough_box(const TopoDS_Shape& shape);

/// An edge inside a face (INTERNAL, EXTERNAL) that bounds nothing.
bool is_constraint(const TopoDS_Shape& edge);

/// How often faces use each edge of `edges` (a seam counts twice); fills `edges` with all edges of the shape.
std::vector<int> edge_uses(const TopoDS_Shape& shape, TopTools_IndexedMapOfShape& edges);

/// edge_uses(), and two for each face that has the edge inside: it is on both sides.
std::vector<int> edge_sides(const TopoDS_Shape& shape, TopTools_IndexedMapOfShape& edges);

/// Edges used once, poles left out.
int count_free_edges(const TopoDS_Shape& shape);

/// Four significant digits.
std::string format_number(double x);

}  // namespace st::occt
