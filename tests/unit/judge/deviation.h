// How far a mesh lies from its CAD, as st-check measures it.
#pragma once

#include "judge/chord_error.h"

namespace st::test {

inline SurfaceDeviation measure_deviation(const Model& model, const SurfaceMesh& mesh) {
  DeviationSum sum(model, mesh);
  estimate_chord_error(model, mesh, &sum);
  return sum.deviation();
}

}  // namespace st::test
