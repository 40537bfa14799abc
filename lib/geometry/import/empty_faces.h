// Faces whose surface is shrunk to a point or a line, and edges that are a point.
#pragma once

#include <TopoDS_Face.hxx>
#include <optional>
#include <string>
#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

/// Box of a face (forward) without area: smaller than 1e-7 of the model's `diagonal`, or a surface (of a plane face its
/// outline) narrower than 1e-6 of its own;
/// nothing where it has one, or loops that OpenCASCADE cannot tell.
std::optional<Box3> empty_box(const TopoDS_Face& face, double diagonal);

/// Removes faces without area that are in no solid and in no closed shell: points (a wing's tip cap where the wing ends
/// in one) and lines (a cap of a sharp trailing edge), which have neighbours at one place on both sides. Each is a
/// finding with its number and name in the file. Surfaces are sampled, nothing is projected. A plane
/// face alone in the model stays. Throws Error(kGeometry)
/// naming `path` when no face is left.
void remove_empty_faces(ImportedShape& model, std::vector<ImportFinding>& findings, const std::string& path);

/// Takes edges out of their loops that stay within the tolerance of their one vertex and 1e-7 of the model's diagonal,
/// in space and in (u,v) of all their faces: no pole is one. Loops of such edges alone stay. One finding for all.
void remove_null_edges(ImportedShape& model, std::vector<ImportFinding>& findings);

}  // namespace st::occt
