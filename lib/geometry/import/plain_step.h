// STEP files that hold the shape of one product and say no more of it than its name.
#pragma once

#include <optional>
#include <string>

#include "geometry/brep/cad_file.h"

namespace st::occt {

/// What the reader of documents would make of the file (lib/geometry/reader), without its libraries; nullopt where that
/// one is needed: for colours, layers, names of faces, edges or solids, assemblies, several products or references to
/// other files. Throws Error(kInput) for what cannot be parsed, and Standard_Failure.
std::optional<CadFile> read_plain_step(const std::string& path);

}  // namespace st::occt
