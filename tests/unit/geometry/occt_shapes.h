// Shapes of the tests as OpenCASCADE's own, before any import.
#pragma once

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Shape.hxx>
#include <string>

#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st::test {

/// By the name that write_brep() knows.
inline TopoDS_Shape occt_shape(const std::string& name) {
  const TemporaryDirectory dir;
  write_brep(name, dir / "a.brep");
  TopoDS_Shape shape;
  BRepTools::Read(shape, (dir / "a.brep").c_str(), BRep_Builder());
  return shape;
}

}  // namespace st::test
