// What --pairs asks for: pairs of faces.
#pragma once

#include <string>

#include "meshing/topology/periodic_pairs.h"

namespace st {

/// `option` is "auto" or a file of tables [[pair]]; empty: no pairs. Throws Error as PeriodicPairs, read_pair_file()
/// and find_pairs() do. Local.
PeriodicPairs read_pairs(const std::string& option, const Model& model);

}  // namespace st
