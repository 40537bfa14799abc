// The faces of a shape of OpenCASCADE.
#pragma once

#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <vector>

namespace st::occt {

/// Each face once, forward, in the order of TopExp::MapShapes().
inline std::vector<TopoDS_Face> faces_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, TopAbs_FACE, map);
  std::vector<TopoDS_Face> faces;
  for (int f = 1; f <= map.Extent(); ++f) faces.push_back(TopoDS::Face(map(f).Oriented(TopAbs_FORWARD)));
  return faces;
}

}  // namespace st::occt
