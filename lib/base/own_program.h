// The file of the program that runs.
#pragma once

#include <string>

namespace st {

/// Absolute path of the running program's file, without links; where no /proc is mounted, from how it was started.
/// A relative start is seen from the working folder, which no tool changes. Never throws; "" where nothing is known.
std::string own_program();

}  // namespace st
