// Models as FLITE geometry: Ferguson curves and surfaces through points of theirs.
#pragma once

#include <string>

#include "geometry/flite/flite_file.h"
#include "geometry/model/model.h"

namespace st {

struct FliteExport {
  FliteFile file;
  double tolerance = 0;  ///< asked for (model unit)
  double deviation = 0;  ///< reached: largest distance found between Ferguson curves and surfaces and those of the
                         ///< model
  std::string worst;     ///< "face 7 "WING"", "edge 3": where
  int n_faces = 0, n_divided = 0;  ///< of the model, and those of them that became several regions
};

/// Regions in the order of the faces: closed faces in two halves, faces divided where they have kinks
/// (divide_for_flite). An edge is a segment, a closed edge two. `tolerance`: model unit, > 0.
FliteExport make_flite(const Model& model, double tolerance);

}  // namespace st
