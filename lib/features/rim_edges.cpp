#include "features/rim_edges.h"

#include <algorithm>

#include "geometry/shape/projection.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kLeastCorner = 40;  // degrees between the normals beside a rim's edge
constexpr double kMostCorner = 130;
constexpr double kOnEdge = 0.002;  // of the chord: a nose on facets lies no further from its edge
constexpr double kAround = 1.6;    // times the distance of two noses: half a circle has pi / 2

}  // namespace

bool RimEdges::is_rim(EdgeId e) {
  if (model_.tables().edge_is_degenerate[e]) return false;
  if (!angles_) angles_.emplace(model_);
  const double turned = angles_->largest_deg(e);
  return turned >= kLeastCorner && turned <= kMostCorner;
}

std::vector<EdgeId> RimEdges::at(const ChordStation& s, double reach) {
  std::vector<EdgeId> edges;
  for (const EdgeId e : model_.tables().edges_of(s.nose_face))
    if (is_rim(e) && closest_point(*model_.curve(e), s.nose).distance <= reach) edges.push_back(e);
  return edges;
}

std::optional<CurvePiece> RimEdges::between(const ChordStation& a, const ChordStation& b) {
  std::optional<CurvePiece> best;
  double least = kOnEdge * std::min(a.chord, b.chord);
  for (const EdgeId e : at(a, least)) {
    auto curve = model_.curve(e);
    const CurveFoot of_a = closest_point(*curve, a.nose), of_b = closest_point(*curve, b.nose);
    const double off = std::max(of_a.distance, of_b.distance);
    if (off > least) continue;
    CurvePiece piece(std::move(curve), of_a.t, of_b.t);
    if (!(piece.length() > 0) || piece.length() > kAround * distance(a.nose, b.nose)) continue;
    least = off;
    best = std::move(piece);
  }
  return best;
}

}  // namespace st
