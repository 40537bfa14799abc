// st-export: artifacts in the formats of other programs.
#pragma once

#include <string>
#include <vector>

#include "base/number_option.h"
#include "stages/summary.h"

namespace st {

struct ExportStageOptions {
  std::string artifact, output;
  std::string tolerance = "0.001%";  ///< length: distance of FLITE curves and surfaces from the model
  // of meshes
  std::string format = {};    ///< a suffix, where that of the output is not to decide
  bool ascii = false;         ///< the text form of a format that has both
  bool binary = false;        ///< the binary form
  std::string unit = {};      ///< of the coordinates written; empty: the mesh's
  bool quads = false;         ///< rows of stretched triangles as quadrilaterals
  bool quadratic = false;     ///< nodes on the sides, on the CAD; needs `geometry`
  bool parametric = false;    ///< t of nodes on edges, (u,v) of those on faces
  bool split_groups = false;  ///< one file for each group
  std::string geometry = {};  ///< where the mesh comes from: its edges become lines
  std::string sizing = {};    ///< for .sol: what nodes are asked for
  double feature_angle_deg = 30;
  static constexpr NumberOption kFeatureAngle{"--feature-angle", "DEG", "(0, 180]",
                                              "for .eMesh: sides where the surface turns by at least this"};
};

/// Exports a mesh artifact, a raster/sizing artifact's octree, or a geometry (FLITE .dat), by suffix. Throws
/// Error(kUsage) for what the format cannot hold, Error(kInput), Error(kMismatch), Error(kOutput).
StageSummary run_export(const ExportStageOptions& options);

/// Where one of the files that were written is Gmsh's mesh: "; gmsh -3 takes wing.geo, ... not wing.msh alone".
/// Empty where there is none, or the script as well.
std::string gmsh_hint(const std::vector<std::string>& outputs);

/// Suffixes of meshes.
std::string mesh_suffixes();

}  // namespace st
