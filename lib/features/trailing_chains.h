// Trailing edges that belong together, and where they run.
#pragma once

#include <span>
#include <vector>

#include "base/box_tree.h"
#include "features/edge_places.h"
#include "features/wing_edges.h"
#include "geometry/model/model.h"

namespace st {

/// The trailing ones of `edges` in sets, each ascending, by first edge: those that meet at vertices, have one base, or
/// go on in about one line across a notch beside one face, no wider than the longer of them. Local.
std::vector<std::vector<WingEdge>> trailing_chains(const Model& model, std::span<const WingEdge> edges);

/// The edges of a chain that meet at vertices and go on there, turning by 45 degrees at most, or have one base; by
/// first edge. Local.
std::vector<std::vector<WingEdge>> lines_of(const Model& model, std::span<const WingEdge> chain);

/// Where the edges of a chain run: straight from place to place.
class ChainLine {
 public:
  /// By edge, as places_along() has them.
  explicit ChainLine(std::span<const EdgePlace> places);

  bool is_near(Vec3 x, double reach) const;

 private:
  struct Piece {
    Vec3 begin, end;
  };
  std::vector<Piece> pieces_;
  BoxTree tree_;
};

}  // namespace st
