// Periodic pairs of groups from a TOML file.
#pragma once

#include <string>
#include <vector>

#include "base/similarity.h"

namespace st {

/// One table [[pair]].
struct PairSpec {
  std::string where;  ///< "FILE:LINE", for messages
  std::string a, b;   ///< groups of faces, parts or names of faces
  Similarity motion;  ///< from a to b
};

/// Reads
///
///   [[pair]]
///   a = "side_1"
///   b = "side_2"               # its faces are the images of those of a
///   rotate = "x 20deg"         # right-handed, about x, y or z, or a direction: "0 0.6 0.8 20deg"
///   at = [0, 0, 0]             # a point on the axis; left out: the origin
///   translate = [0, 0, 10]     # model unit; with rotate: after it
///
/// [[st-mesh.pair]] counts, too; what else an option file may hold is passed over. Throws Error(kUsage) with file and
/// line, Error(kInput) for what cannot be read.
std::vector<PairSpec> read_pair_file(const std::string& path);

}  // namespace st
