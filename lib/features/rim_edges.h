// Noses on the rims of plates and holes: corners of the CAD before a trailing edge.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "features/arc_table.h"
#include "features/lifting_surface.h"
#include "geometry/model/edge_angles.h"

namespace st {

/// Of a curve, from one place to another.
class CurvePiece {
 public:
  /// Between two parameters.
  CurvePiece(std::unique_ptr<Curve> curve, double from_t, double to_t)
      : curve_(std::move(curve)), arc_(*curve_), from_(arc_.share_at(from_t)), to_(arc_.share_at(to_t)) {}
  /// Model unit.
  double length() const { return std::abs(to_ - from_) * arc_.length(); }
  /// `share`: of the piece, in [0, 1].
  Vec3 at(double share) const { return curve_->point(arc_.parameter_at(from_ + share * (to_ - from_))); }

 private:
  std::unique_ptr<Curve> curve_;
  ArcTable arc_;
  double from_, to_;
};

/// A rim's edge is a corner like that of a base. For one thread.
class RimEdges {
 public:
  /// `model` outlives it.
  explicit RimEdges(const Model& model) : model_(model) {}
  /// Edges of the nose's face which are a rim's and no further from the nose than `reach`, model unit. Cost: a search
  /// of each edge of the face.
  std::vector<EdgeId> at(const ChordStation& s, double reach);
  /// The part of such an edge between two noses that lie on it; nullopt: there is none, or the edge goes far around.
  std::optional<CurvePiece> between(const ChordStation& a, const ChordStation& b);

 private:
  bool is_rim(EdgeId e);

  const Model& model_;
  std::optional<EdgeAngles> angles_;  // made when one is asked for
};

}  // namespace st
