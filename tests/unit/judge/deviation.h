// How far a mesh lies from its CAD, as st-check measures it.
#pragma once

#include "judge/chord_error.h"

namespace st::test {

inline SurfaceDeviation measure_deviation(const Model& model, const SurfaceMesh& mesh) {
  DeviationSum sum(model, mesh);
  estimate_chord_error(model, mesh, &sum);
  return report_deviation(sum.parts(), model.tables().n_faces());
}

}  // namespace st::test
