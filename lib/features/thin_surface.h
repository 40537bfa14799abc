// Lifting surfaces whose noses are not seen, or that the user declares: chords as far as the part behind an edge is
// thin.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "features/edge_places.h"
#include "features/lifting_surface.h"
#include "features/profile.h"

namespace st {

/// How a model is cut.
struct CutFrame {
  const std::array<Vec3, 3>& axes;  ///< unit
  const ProfileCutter& cutter;
  double reach = 0;  ///< how far from a place the cut may begin, model unit
};

/// The surface behind trailing edges, or behind one leading edge. Declared edges are one wherever a plane cuts; others
/// where they are sharp by 30 degrees at most or their base is narrow, the part behind them is thin on half of their
/// way or more, becomes thicker from there on, and is no longer than twice the way. Faces are not named. Local.
std::optional<LiftingSurface> find_thin_surface(const Model& model, const CutFrame& frame,
                                                const std::vector<WingEdge>& edges);

/// Stations along an edge, its ends included.
ChordEdge chords_along(const Model& model, const WingEdge& edge, const std::function<double(const EdgePlace&)>& chord);

}  // namespace st
