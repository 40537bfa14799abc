// How exact the CAD says that it is.
#pragma once

#include "geometry/model/model.h"

namespace st {

/// Largest tolerance of a face, its edges and its vertices, model unit. Linear in its coedges.
double cad_tolerance(const ModelTables& tables, FaceId face);

}  // namespace st
