// st-check: is this mesh fit for use?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stages/summary.h"

namespace st {

/// What unattended runs ask of a mesh; nothing set: not asked.
struct CheckThresholds {
  int max_folds = 0;                  ///< folds accepted
  int max_crossings = 0;              ///< crossing pairs of triangles and overlapping neighbours accepted, together
  std::optional<double> min_quality;  ///< [0, 1] of every triangle, 4 sqrt(3) A / (l1^2 + l2^2 + l3^2)
  std::optional<double> min_mean_quality;  ///< [0, 1]
  std::optional<double> min_p1_quality;    ///< [0, 1] first percentile
  std::optional<double> min_angle_deg;     ///< (0, 60] of every triangle
  std::optional<int> max_free_sharp;     ///< >= 0: triangles below list_below_deg that nothing in the CAD forces; needs
                                         ///< the geometry
  std::optional<double> max_jump;        ///< >= 1: sqrt of the area ratio of neighbours, 99.9th percentile
  std::optional<double> min_size_share;  ///< [0, 1] share of edges within 0.7 to 1.4 of the request, those the CAD
                                         ///< forces apart; needs the sizing
  std::string max_deviation;  ///< length: of every triangle's midpoint from its surface; empty: not asked; needs the
                              ///< geometry
  std::optional<double> max_normal_deviation_deg;  ///< (0, 180] of every triangle's normal from its surface's; needs
                                                   ///< the geometry
};

struct CheckStageOptions {
  std::string mesh;      ///< mesh artifact
  std::string geometry;  ///< optional: areas per face, open edges allowed only where the CAD has free edges, deviation
  std::string sizing;    ///< optional: conformity of edge lengths to the sizes
  double area_tolerance = 0.01;  ///< largest relative difference between mesh and CAD area of a face beyond what chords
                                 ///< explain
  CheckThresholds thresholds;
  std::vector<std::string> reports;  ///< JSON files to write: everything, per model, group and face, with histograms
  double list_below_deg = 10;  ///< triangles with a smaller angle are listed by their cause, (0, 60]; with the geometry

  /// Throws Error(kUsage) for a threshold whose geometry or sizing is not given.
  void validate() const;
};

/// Local. Summary code kIncomplete when the mesh does not pass. Throws Error.
StageSummary run_check(const CheckStageOptions& options);

}  // namespace st
