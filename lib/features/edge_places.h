// Places on the edges of a chain where something is measured.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "features/wing_edges.h"

namespace st {

inline constexpr int kPlacesPerEdge = 24;
inline constexpr double kAlongAxis = 0.5;     ///< cosine between edge and axis at least, to cut square to the axis
inline constexpr double kMeasured = 0.5;      ///< of the way along the edges of a surface, at least
inline constexpr double kLeastSpan = 0.5;     ///< of a surface, over its median chord
inline constexpr double kWidestBase = 0.06;   ///< of the chord
inline constexpr double kClearlyMore = 1.25;  ///< way with profiles square to the edge over that square to an axis
inline constexpr double kAlongChord = 0.9;    ///< cosine between an edge around a tip or a root and the chord, at least
inline constexpr double kOutlier = 1.4;       ///< chord over what is usual around
inline constexpr double kBeforeNose = 0.1;    ///< of the chord: how far before a nose ice, and its edges, may lie

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

/// Chords of the places of one edge, up to four to either side of `i`, that have one, its own included.
template <class Measured>
std::vector<double> chords_around(std::span<const std::optional<Measured>> of_edge, std::size_t i) {
  constexpr std::size_t kAround = 4;
  std::vector<double> chords;
  for (std::size_t j = i < kAround ? 0 : i - kAround; j < std::min(i + kAround + 1, of_edge.size()); ++j)
    if (of_edge[j]) chords.push_back(of_edge[j]->chord);
  return chords;
}

inline bool is_outlier(double chord, double usual) { return chord > kOutlier * usual || chord * kOutlier < usual; }

}  // namespace st
