// A model whose faces and edges end at a plane.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

#include "geometry/import/half_model.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Where a face lies.
enum class PlaneSide {
  kBelow,
  kAbove,
  kIn,   ///< all of it within the tolerance of the plane
  kBoth  ///< on both sides
};

/// [n_faces] by samples; `tolerance` in the unit of the shape.
std::vector<PlaneSide> sides_of(const ImportedShape& model, const SymmetryPlane& plane, double tolerance);

/// Whether all of an edge is within `tolerance` of the plane, at 11 points.
bool lies_in(const TopoDS_Shape& edge, const SymmetryPlane& plane, double tolerance);

/// The shape made of others: solids, shells and loose faces in their order, each of their faces replaced by what stands
/// for it where it is oriented forward. A solid or shell of which nothing is left is gone.
TopoDS_Shape with_faces(const TopoDS_Shape& shape,
                        const std::function<std::vector<TopoDS_Shape>(const TopoDS_Shape&)>& now);

/// Divides every face on both sides of the plane, and its edges, along the plane: the parts have what the face had.
/// Nothing else changes. Returns the number of faces divided. Throws Error(kGeometry) where OpenCASCADE cannot.
int cut_at_plane(ImportedShape& model, const SymmetryPlane& plane, double diagonal, const std::string& path);

}  // namespace st::occt
