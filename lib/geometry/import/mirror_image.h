// A symmetric model of which one half is the image of the other.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>
#include <utility>
#include <vector>

#include "geometry/import/half_model.h"
#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"
#include "geometry/model/mirror.h"

namespace st::occt {

/// What is whose image, as shapes: they keep their places while numbers change.
struct MirrorShapes {
  SymmetryPlane plane;
  std::vector<std::pair<TopoDS_Shape, TopoDS_Shape>> faces, edges, vertices;  ///< twice the same: in the plane

  /// By the numbers that they have in `shape`. Throws Error(kGeometry) when some of them are no longer there.
  Mirror numbers_in(const TopoDS_Shape& shape, const std::string& path) const;
};

/// Divides the model at the plane and gives the faces of the other half the geometry of the kept half's image, so that
/// both are the same to the last bit; names, colours, parts and numbers in the file stay theirs. `plane.side` 0 keeps
/// the half above. Vertices and edges in the plane are common. A finding says how far the faces were from the images.
/// Throws Error(kGeometry) when the model is not symmetric within 1e-5 of `diagonal`, with the places, and when it is
/// on one side of the plane.
MirrorShapes mirror_half(ImportedShape& model, SymmetryPlane plane, double diagonal,
                         std::vector<ImportFinding>& findings, const std::string& path);

}  // namespace st::occt
