// Virtual topology for meshing: short edges drawn together, narrow strips closed. The CAD and its ids stay.
#pragma once

#include <span>
#include <vector>

#include "features/strip.h"
#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"
#include "meshing/topology/curve_discretiser.h"
#include "sizing/size_field.h"

namespace st {

/// How far apart features are merged.
struct MergeLimit {
  double below = 0;      ///< of the requested length
  double tolerance = 0;  ///< takes the place of `below` where it is positive, model unit; up to half of the requested
                         ///< length
  double exact = 0;      ///< how exact the CAD is: the limit is no less, up to half of the requested length; model unit
  /// Model unit; `size`: the requested length.
  double at(double size) const;
};

/// Edges between two vertices shorter than `below` times the requested length, and strips narrower than that somewhere
/// and on the mean narrower than the length. On faces whose groups have a tolerance (face_tolerances) that is the
/// limit; an edge between faces of different limits has the smaller. `below` 0: nothing is merged. An edge is not drawn
/// together when a loop would be left with fewer than two edges, or several would move a vertex further than that.
/// Rings, faces between two closed edges, are closed where they are narrower all around than the CAD is exact; ledges
/// (ledges.h) where they are narrower all around than the limit, with a strip for each pair of edges.
/// `strips`: those of the model, by find_strips(); null: they are found. Deterministic, local.
MergedFeatures find_merged_features(const Model& model, const SizeField& field, double below,
                                    const std::vector<Strip>* strips = nullptr);

/// Nodes on the other long edge of a strip for those on the kept one (`nodes`, of this curve alone): as many, at the
/// same shares of the length, in the other edge's own direction. Where the strip is narrower than the limit they are
/// the kept edge's own points.
EdgeMesh mirror_nodes(const Curve& kept, const EdgeMesh& nodes, const Curve& closed, bool is_opposed,
                      const MergeLimit& limit);
/// Finds nodes inside the kept edge in the same way; the points are those of the other curve.
EdgeMesh mirror_nodes(const Curve& kept, std::span<const double> inner_t, const Curve& closed, bool is_opposed);

}  // namespace st
