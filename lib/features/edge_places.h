// Places on the edges of a chain where something is measured.
#pragma once

#include <span>
#include <vector>

#include "features/wing_edges.h"

namespace st {

inline constexpr int kPlacesPerEdge = 24;
inline constexpr double kAlongAxis = 0.5;  ///< cosine between edge and axis at least, to cut square to the axis

/// A place on an edge, before anything is measured there.
struct EdgePlace {
  std::size_t edge = 0;  ///< of the chain
  double share = 0;      ///< of its length, from its start
  double way = 0;        ///< along the edge that it stands for, model unit
  Vec3 x, tangent;
};

/// kPlacesPerEdge in the middles of equal parts of each edge, by edge.
std::vector<EdgePlace> places_along(const Model& model, std::span<const WingEdge> chain);

/// The upper one of two; 0 of nothing.
double median(std::vector<double> values);

}  // namespace st
