// Smooth edges along a ridge, such as the line of a nose: where the surface bends most.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/model/model.h"

namespace st {

/// Marks of `edges` ([n_edges] 1: looked at; two faces use each) those across which the faces bend by a radius much
/// below the edge's length, while within a few radii to both sides the bend flattens out to half: a mesh without nodes
/// along them cuts the ridge off. [n_edges]. Local. Cost: some tens of evaluations per edge.
std::vector<std::uint8_t> find_ridge_edges(const Model& model, const std::vector<std::uint8_t>& edges);

}  // namespace st
