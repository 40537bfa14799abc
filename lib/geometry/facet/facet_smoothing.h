// Takes the noise of a scan out of facets.
#pragma once

#include "geometry/facet/facet_mesh.h"

namespace st {

struct SmoothedFacets {
  double mean = 0;     ///< way of a node, model unit
  double at_most = 0;  ///< share of nodes that would have gone further
};

/// Moves nodes along the facets' normals, by at most `most` (model unit) each, until facets agree with those around
/// them that lie on the same side of an edge: noise goes, edges and corners stay, and lines along them get even.
/// Normals are those of a guided filter (Zhang and others, 2015, "Guided mesh normal filtering", sections 3 and 4),
/// nodes follow them (Sun and others, 2007, "Fast and effective feature-preserving mesh denoising", section 3.3).
SmoothedFacets smooth_facets(FacetInput& input, double most);

/// What the noise of the nodes is, as a standard deviation along normals (model unit), where facets are rough without
/// order: most neighbours in turn stand out and lie back. Else 0, however much the surface bends.
double find_noise(const FacetInput& input);

}  // namespace st
