// st-check's thresholds: bounds that the user gives. Internal to the check stage.
#pragma once

#include <tuple>

#include "mesh/own_triangles.h"
#include "mesh/quality.h"
#include "stages/check_report.h"

namespace st {

/// Triangles beyond bounds that were asked for.
struct BadTriangles {
  Defects quality, angle;

  /// Those of another share of the mesh.
  void add(const BadTriangles& other) { quality.merge(other.quality), angle.merge(other.angle); }
  static auto fields(auto& b) { return std::tie(b.quality, b.angle); }
};
/// Of a share.
BadTriangles find_bad_triangles(const SurfaceMesh& mesh, const TriangleCorners& corners, const CheckThresholds& asked,
                                const OwnTriangles& own);

/// Adds a check to `f`, whose measures are there, for each bound that is asked for. `tables`: null without a geometry.
void check_thresholds(const BadTriangles& bad, const CheckThresholds& asked, const ModelTables* tables, Findings& f);

}  // namespace st
