/// STEP with a name on every face, written the same way every time and read back.
#pragma once

#include <TopoDS_Shape.hxx>
#include <map>
#include <string>

#include "patchwork.h"

namespace aircraft {

/// Writes a shape as AP214 with the group name of each ADVANCED_FACE; the header carries no time and no
/// machine.
/// @param unit of the shape and of the file: M or MM.
/// @throws std::runtime_error when the file cannot be written.
void write_step(const std::string& path, const std::string& product, const TopoDS_Shape& shape, const NameTable& names,
                const char* unit = "M");

/// Number of faces per name as an importer finds them. @throws std::runtime_error when the file cannot be read.
std::map<std::string, int> read_face_names(const std::string& path);

}  // namespace aircraft
