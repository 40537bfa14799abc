// st-import: CAD file to geometry artifact.
#pragma once

#include <optional>
#include <string>

#include "base/number_option.h"
#include "geometry/import/import.h"
#include "stages/summary.h"

namespace st {

struct ImportStageOptions {
  std::string model;  ///< CAD file: STEP, IGES, BREP or FLITE; or facets: STL and other triangulations
  std::string output = "geometry.hdf";
  ImportOptions import;  ///< all but the groups and feature_deg; check_only: report, write nothing
  std::optional<double> time_limit;
  static constexpr NumberOption kTimeLimit{
      "--time-limit", "SECONDS", "(0, 1e9]",
      "stop reading after this processor time in seconds; default: 30, and 5 per megabyte of the file"};
  std::optional<double> feature_angle;
  static constexpr NumberOption kFeatureAngle{"--feature-angle", "DEGREES", "[1, 180]",
                                              "of facets: faces meet where neighbours turn by more; default: 30"};
  std::string groups;          ///< groups file (TOML); empty: the groups of the CAD file
  std::string suggest_groups;  ///< groups file to write, as the shape suggests; empty: none
  std::string composite;       ///< faces that meet smoothly are one: "none", "harm" (where the mesh would suffer),
                               ///< "smooth" (all); empty: harm where faces can be joined
};

/// Local; reads in a child process, so the caller must have no other threads. Throws Error, also where OpenCASCADE
/// crashes.
StageSummary run_import(const ImportStageOptions& options);

}  // namespace st
