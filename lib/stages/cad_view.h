// A CAD model as cells to look at: before anything is meshed.
#pragma once

#include <span>
#include <vector>

#include "features/wing_edges.h"
#include "geometry/model/facets.h"
#include "geometry/model/finding.h"
#include "geometry/model/model.h"
#include "io/export/cell_view.h"

namespace st {

/// Faces as triangles, edges as lines, findings of the import as points. Values of each cell: dim (2 face, 1 edge, 0
/// finding), id (of the face or edge; of the finding its number, from 1), group and part (faces; 0: none), wing_edge (1
/// trailing, 2 leading), finding (the kind of a finding, counted from 1 in the order in which kinds appear, at the
/// face or edge that has it and at its place; 0: none). Names of faces, edges, groups, parts and kinds of findings.
/// Faces that OpenCASCADE cannot triangulate are left out. Local; some microseconds per triangle.
CellView view_cad(const Model& model, std::span<const ImportFinding> findings);

/// Facets that the eye takes for the faces, within 0.02 % of the diagonal, of a far field of its own, and 8 degrees.
/// Local; some microseconds per facet.
Facets facets_to_see(const Model& model);
/// Points along a curve, so close that it turns by at most 5 degrees from one to the next, or 257 points.
std::vector<Vec3> line_to_see(const Curve& curve);
/// Leading and trailing edges as st-raster finds them.
std::vector<WingEdge> wing_edges_to_see(const Model& model);

}  // namespace st
