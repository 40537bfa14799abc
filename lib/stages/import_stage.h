// st-import: CAD file to geometry artifact.
#pragma once

#include <optional>
#include <string>

#include "base/number_option.h"
#include "stages/summary.h"

namespace st {

struct ImportStageOptions {
  std::string model;  ///< CAD file: STEP, IGES, BREP or FLITE; or facets: STL and other triangulations
  std::string output = "geometry.hdf";
  std::string unit;             ///< convert to this unit; empty: the file's own
  std::string small = "0.01%";  ///< length: edges shorter and faces narrower than this are listed
  std::string sew;              ///< length: largest gap between free edges to close; empty: 0.01% of the diagonal
  std::optional<double> time_limit;
  static constexpr NumberOption kTimeLimit{
      "--time-limit", "SECONDS", "(0, 1e9]",
      "stop reading after this processor time in seconds; default: 30, and 5 per megabyte of the file"};
  std::optional<double> feature_angle;
  static constexpr NumberOption kFeatureAngle{"--feature-angle", "DEGREES", "[1, 180]",
                                              "of facets: faces meet where neighbours turn by more; default: 30"};
  std::string symmetry, mirror, farfield, replace_farfield;  ///< of ImportOptions; empty: none
  std::string flow_domain = "auto";                          ///< of ImportOptions
  std::string groups;                                        ///< groups file (TOML); empty: the groups of the CAD file
  std::string suggest_groups;   ///< groups file to write, as the shape suggests; empty: none
  std::string composite;        ///< faces that meet smoothly are one: "none", "harm" (where the mesh would suffer),
                                ///< "smooth" (all); empty: harm where faces can be joined
  bool unite = false;           ///< of ImportOptions
  bool join = false;            ///< solids that touch get common faces
  bool cap = false;             ///< of ImportOptions
  bool check = false;           ///< report only, write nothing
  bool require_closed = false;  ///< an open model is an error (exit 4)
};

/// Local; reads in a child process, so the caller must have no other threads. Throws Error, also where OpenCASCADE
/// crashes.
StageSummary run_import(const ImportStageOptions& options);

}  // namespace st
