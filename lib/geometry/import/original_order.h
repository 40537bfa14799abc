// Faces of a sewn shape in the order they had before: sewing permutes them, and drops solids.
#pragma once

#include <TopoDS_Shape.hxx>
#include <vector>

namespace st::occt {

/// A compound of the shells of `sewn`, each with its faces in their original order, and of the faces in no shell, by
/// their first original. `images`: of the original faces, in their order, each a face of `sewn`.
TopoDS_Shape in_original_order(const TopoDS_Shape& sewn, const std::vector<TopoDS_Shape>& images);

}  // namespace st::occt
