// Readers of CAD files that are loaded when a file needs them: lib/geometry/reader, modules in lib/st beside bin.
#pragma once

#include <string>

#include "geometry/brep/cad_file.h"

namespace st::occt {

/// What a module exports under the name kReadFunction: `file` gets what the file at `path` holds. Throws st::Error and
/// Standard_Failure.
using ReadFunction = void (*)(const std::string& path, CadFile& file);
constexpr char kReadFunction[] = "st_read_cad_file";

/// Loads a module and lets it read the file. Throws Error(kInternal) where the module cannot be loaded.
CadFile read_by_module(const std::string& module, const std::string& path);

}  // namespace st::occt
