// Joins faces that share no edges.
#pragma once

#include <optional>
#include <vector>

#include "geometry/import/import.h"
#include "geometry/model/imported_shape.h"

namespace st::occt {

struct SewingLimits {
  double stated_resolution = 0;   ///< tolerance that the file states, 0 when none; unit of the shape
  std::optional<double> largest;  ///< the last tolerance tried, unit of the shape, positive; absent: 1e-4 of the
                                  ///< diagonal
  std::vector<double> of_face;    ///< [n_faces] that the face's group has, unit of the shape, 0: none; or empty
};

/// Sews a model that has free edges; takes the smallest tolerance that closes it, else the one that leaves the fewest
/// free edges. Before that, free edges of two faces that both have a tolerance of their own are joined where they are
/// no further apart than the smaller of the two; where that helps, faces with a tolerance are marked. Faces and
/// attributes stay; those of one shell come together. Where edges stay free, a third face is joined to edges of two
/// (divide_into_rooms()), and whole spline surfaces are divided if that joins more (divide_bare_surfaces()). A model
/// without free edges is not touched.
void sew_if_open(ImportedShape& model, const SewingLimits& limits, std::vector<ImportFinding>& findings);

}  // namespace st::occt
