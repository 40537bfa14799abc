// Which CAD faces become one, and their charts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/model/composites.h"
#include "geometry/model/facets.h"
#include "geometry/model/model.h"

namespace st {

/// What is to be joined.
struct JoinRequest {
  std::vector<std::uint8_t> may_join;  ///< [n_edges] 1: faces on both sides may be one; two coedges of two faces use it
  std::vector<double> urgency;         ///< [n_edges] above 0: to be joined, the largest first; others go with these
  std::vector<std::uint8_t> must_end;  ///< [n_vertices] 1: edges do not go on as one there
  FacetLimits facets;                  ///< of the charts
};

struct FoundComposites {
  Composites composites;
  std::vector<std::string> divided;  ///< composites of which smaller ones were tried, and why
  std::vector<std::string> refused;  ///< faces that stay apart, and why
};

/// Composites, edge by edge, while they are discs with holes that can be laid into a plane; one that cannot is
/// divided. Each chart is compared with the CAD: normals, places along its rim. The same input gives the same bits.
/// Local. Cost: some microseconds per facet and edge, up to a millisecond per facet where faces cannot be projected.
FoundComposites find_composites(const Model& cad, const JoinRequest& request);

}  // namespace st
