// Mends facets as files have them: gaps, duplicates, orientation.
#pragma once

#include <vector>

#include "geometry/facet/facet_mesh.h"
#include "geometry/model/finding.h"

namespace st {

/// Joins nodes at free sides (join_gaps()); divides facets at nodes that lie as close to such a
/// side (split_sides_at_nodes()); drops facets that then have no three nodes, and
/// those whose nodes another one has; drops unused nodes. Parts without a name that joined nodes connect are one part,
/// if no node was of two parts before. Turns facets so that neighbours agree, each connected part as most of its area
/// is, and closed parts that are inside out, but for those within the box of another one. Returns what was done. Throws
/// Error(kGeometry) for facets of one side alone (a Moebius strip), and where none is left.
std::vector<ImportFinding> repair_facets(FacetInput& input);

}  // namespace st
