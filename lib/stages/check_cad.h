// st-check with a geometry: faces, areas, volume and nodes against the CAD. Internal to the check stage.
#pragma once

#include <vector>

#include "stages/check_report.h"

namespace st {

/// Tolerance that the groups of a face give it, 0: none. `of_face`: as face_tolerances() has it.
double group_tolerance(const std::vector<double>& of_face, FaceId f);

/// Adds the checks and what they compare to `f`, whose chords, measure and topology are there. `sewing`: tolerance that
/// the user let st-import sew by, model unit; `area_tolerance`: of a face's area.
void check_against_cad(const SurfaceMesh& mesh, const ModelTables& tables, double sewing, double area_tolerance,
                       Findings& f);

}  // namespace st
