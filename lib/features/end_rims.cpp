#include <algorithm>
#include <array>
#include <vector>

#include "features/lifting_surface.h"

namespace st {
namespace {

constexpr int kSamples = 5;         // of an edge
constexpr double kNearChord = 0.2;  // of the chord: from the end's chord line at most

/// Measured stations furthest from each other.
std::array<const ChordStation*, 2> end_stations(const LiftingSurface& wing) {
  std::vector<const ChordStation*> all;
  for (const ChordEdge& edge : wing.trailing)
    for (const ChordStation& s : edge.stations)
      if (s.is_measured) all.push_back(&s);
  if (all.empty()) return {nullptr, nullptr};
  const auto furthest_from = [&](const ChordStation* from) {
    return *std::ranges::max_element(all, {}, [&](const auto* s) { return distance(s->trailing, from->trailing); });
  };
  const ChordStation* first = furthest_from(all.front());
  return {first, furthest_from(first)};
}

bool is_near(const Model& model, EdgeId e, const ChordStation& end) {
  const auto curve = model.curve(e);
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 x = curve->point(curve->t_min() + (curve->t_max() - curve->t_min()) * i / (kSamples - 1));
    if (segment_distance(x, end.trailing, end.nose) > kNearChord * end.chord) return false;
  }
  return true;
}

}  // namespace

std::vector<EdgeWithChord> find_end_rims(const Model& model, const LiftingSurface& wing) {
  const ModelTables& t = model.tables();
  const auto ends = end_stations(wing);
  std::vector<EdgeWithChord> rims;
  if (!ends[0] || ends[0] == ends[1]) return rims;
  std::vector<int> n_own(static_cast<std::size_t>(t.n_edges()), 0);
  for (const FaceId f : wing.faces)
    for (const EdgeId e : t.edges_of(f)) ++n_own[e];
  for (const ChordEdge& edge : wing.trailing)
    if (!edge.is_inside) n_own[edge.edge] = 0;
  for (const EdgeId e : wing.leading) n_own[e] = 0;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (n_own[e] != 1 || t.edge_is_degenerate[e]) continue;
    for (const ChordStation* end : ends)
      if (is_near(model, e, *end)) {
        rims.push_back({e, end->chord});
        break;
      }
  }
  return rims;
}

}  // namespace st
