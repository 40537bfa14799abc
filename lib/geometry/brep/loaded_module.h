// Parts of this program that are loaded when they are needed, with what they take along of OpenCASCADE: modules of
// lib/geometry/reader, in lib/st beside bin.
#pragma once

#include <string>

namespace st::occt {

/// A function of a module, which stays loaded. Throws Error(kInternal) where the module cannot be loaded.
void* function_of_module(const std::string& module, const char* name);

}  // namespace st::occt
