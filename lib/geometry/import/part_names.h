// Names of parts in CAD files, and of the bodies of a part.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

#include "geometry/brep/cad_file.h"

namespace st::occt {

/// Whether a name says nothing: one that exporters and OpenCASCADE give where nobody gave one.
bool is_junk(const std::string& name);

/// Names of siblings, each its own: "bolt#1", "bolt#2" where there are several; '/' in them becomes '_', an empty one
/// "unnamed".
std::vector<std::string> numbered_names(std::vector<std::string> names);

/// Names the faces' bodies in a part whose shape has several solids: as `name_of` says, or "body#1". Precondition:
/// part.faces are those of the shape.
void name_bodies(const TopoDS_Shape& shape, const std::function<std::string(const TopoDS_Shape& solid)>& name_of,
                 CadPart& part);

}  // namespace st::occt
