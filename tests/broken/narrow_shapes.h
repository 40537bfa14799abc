// Closed B-Reps with faces as narrow as the CAD is exact.
#pragma once

#include <string>
#include <vector>

namespace st::test {

/// Names of all, for write_narrow().
/// - wall_twice: an L of two blocks, 5 x 10 x 0.5 and 5 x 2 x 0.5, whose wall is drawn 2 too long, and back by a face
/// of
///   its own that crosses it, 0.002 beside it at most: tolerances are 0.001. Volume 30, area of what is outside 140.
/// - wall_apart: the same, 0.02 beside it.
/// - pocket_at_rim: a block of 10 x 10 x 2 with a pocket 1 deep, whose rim lies on the block's from y = 3 to 7.
/// - A block of 40 x 20 x 10 whose upper edge is cut off by a face 0.04 * sqrt(2) wide; tolerances are 0.034. Trimming
///   curves of that face's long edges cross each other six times: blend_curves; blend_tip, where the face ends at a
///   point; blend_edges, where the edges do in space, too, and its neighbours' surfaces end up to 0.034 beside them;
///   blend_round, which is round besides. blend_beyond: so do the edges, but tolerances are 0.0001, which is a fault.
std::vector<std::string> narrow_shapes();

/// Writes one as BREP. Throws std::runtime_error for an unknown name.
void write_narrow(const std::string& name, const std::string& path);

}  // namespace st::test
