// The B-Rep behind a Model.
#pragma once

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <cstddef>
#include <vector>

#include "geometry/model/model.h"

namespace st {

struct Model::Impl {
  TopoDS_Shape shape;
  TopTools_IndexedMapOfShape faces, edges;  ///< TopExp order of `shape`: the order of ids
};

namespace occt {

/// The bytes from which Model reads `shape` again.
std::vector<std::byte> brep_bytes(const TopoDS_Shape& shape);

}  // namespace occt
}  // namespace st
