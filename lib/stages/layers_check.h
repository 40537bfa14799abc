// Whether layers of prisms can grow from a mesh, as lines of st-check's report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/length.h"
#include "mesh/surface_mesh.h"
#include "stages/check_report.h"

namespace st {

/// What --layers asks for: "2%", "5mm,1.2", "Re=6e6@2.5m,1.2".
struct LayersRequest {
  LengthSpec length;               ///< total height; with a Reynolds number the length that it refers to
  std::optional<double> reynolds;  ///< the height is the turbulent boundary layer's at the end of `length`
  std::optional<double> growth;    ///< of one layer over the one below

  /// Model unit.
  double height(const LengthReference& reference) const;
};

/// Throws Error(kUsage) that says what is wrong.
LayersRequest parse_layers(const std::string& text);

/// Directions, fans, wedges, room. `has_flow_domain`: the mesh bounds the flow, else bodies in it. Percentages are of
/// the walls' diagonal. Throws Error(kUsage) for a unit where the mesh has none.
std::vector<Check> layers_checks(const SurfaceMesh& mesh, bool has_flow_domain, const std::optional<double>& unit_in_m,
                                 const LayersRequest& request);

}  // namespace st
