// st-metric: edge lengths that make the interpolation error of fields smallest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/number_option.h"
#include "stages/summary.h"

namespace st {

struct MetricStageOptions {
  std::vector<std::string> fields;  ///< scalar fields on one mesh, see read_field_mesh()
  std::string output;               ///< .solb or .sol; the mesh is written beside it
  std::optional<double> nodes;
  static constexpr NumberOption kNodes{"--nodes", "N", "[4, 2e9]",
                                       "nodes of the mesh that the sizes ask for; default: as many as the fields have"};
  double norm = 2;
  static constexpr NumberOption kNorm{"--norm", "P", "[1, 100]",
                                      "norm of the error that is made smallest: 1 heeds weak features, 4 strong ones"};
  double max_aspect = 1;
  static constexpr NumberOption kMaxAspect{"--max-aspect", "F", "[1, 1000]",
                                           "longest over shortest length at a node; 1: one length for all directions"};
  std::optional<double> least, greatest;
  static constexpr NumberOption kLeast{"--lmin", "L", "(0, 1e300]",
                                       "no length is below it, in the unit of the mesh; default: no bound"};
  static constexpr NumberOption kGreatest{
      "--lmax", "L", "(0, 1e300]", "no length is above it, in the unit of the mesh; default: the diagonal of the mesh"};
  std::string group;  ///< name or number: sizes for its cells; empty: for all
  std::string box;    ///< "X Y Z X Y Z", two corners: sizes for the cells that have a node in it; empty: for all
};

/// Local. Throws Error.
StageSummary run_metric(const MetricStageOptions& options);

}  // namespace st
