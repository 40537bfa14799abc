// Which edges and vertices of periodic faces are images of which.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "geometry/model/model.h"
#include "mesh/edge_mesh.h"
#include "mesh/surface_mesh.h"

namespace st {

/// An edge or vertex that has its nodes from another one.
struct PairFollower {
  std::int32_t leader = kNone;  ///< kNone: it has its own
  Similarity motion;            ///< from the leader
  bool is_opposed = false;      ///< an edge that runs against its leader's image
};

/// The edges and vertices of all pairs. Those that several pairs connect, such as four edges of a cube, have one
/// leader, that of the lowest id. Immutable.
class PeriodicPairs {
 public:
  /// No pair.
  PeriodicPairs() = default;
  /// Matches edges and vertices. Throws Error(kGeometry), naming what is off and how far, where edges of a face are no
  /// images of the other's within their tolerances and 1e-6 of the model's diagonal, where pairs contradict each other,
  /// and where a face is in two pairs. Local.
  PeriodicPairs(const Model& model, std::vector<FacePair> pairs);

  bool empty() const { return pairs_.empty(); }
  const std::vector<FacePair>& pairs() const { return pairs_; }
  /// Empty where there is no pair, else [n_edges], [n_vertices].
  const std::vector<PairFollower>& edges() const { return edges_; }
  const std::vector<PairFollower>& vertices() const { return vertices_; }
  /// The edge of pair `i`'s face b that is the image of an edge of its face a.
  PairFollower edge_image(std::size_t i, EdgeId e) const { return edge_image_[i].at(e); }
  VertexId vertex_image(std::size_t i, VertexId v) const { return vertex_image_[i].at(v); }
  /// Whether the outside of pair `i`'s face b is not the image of that of its face a, as of two sides of a passage.
  bool turns_over(std::size_t i) const { return turns_over_[i] != 0; }
  /// [n_vertices] where the vertices are: followers at the images of their leaders, those on an axis on it.
  const std::vector<Vec3>& vertex_xyz() const { return vertex_xyz_; }
  /// A point of a leader: moved to the axis where pairs turn the edge into itself.
  Vec3 on_own_axis(EdgeId e, Vec3 x) const;
  /// Largest distance of an image from what it is matched with, model unit.
  double tolerance(const ModelTables& tables, const FacePair& pair) const;

 private:
  void match(const Model& model, const FacePair& pair);
  void lead(const Model& model);

  std::vector<FacePair> pairs_;
  std::vector<PairFollower> edges_, vertices_;
  std::vector<std::map<EdgeId, PairFollower>> edge_image_;  // by pair
  std::vector<std::map<VertexId, VertexId>> vertex_image_;  // by pair
  std::vector<char> turns_over_;                            // by pair
  std::vector<Vec3> vertex_xyz_;
  std::map<EdgeId, Similarity> axes_;  // leaders that lie on the axis of a motion, but not to the last digits
};

/// Nodes of a follower's curve, from `t_first` to `t_last`, that are images of those of the same part of its leader;
/// parameters are those of the images' feet. Throws Error(kGeometry), naming both, where they do not follow each other.
EdgeMesh image_nodes(const ModelTables& tables, EdgeId e, const Curve& curve, const PairFollower& follower,
                     const EdgeMesh& leader, double t_first, double t_last);

/// Whether the outside of face b is against the image of that of face a, next to the middle of an edge of `a`. False
/// for a face without edges.
bool turns_over(const Model& model, const FacePair& pair);

/// What is merged elsewhere: edges and strips that have a vertex in common with faces of pairs stay as they are. The
/// pairs are in it.
MergedFeatures without_paired(const MergedFeatures& merged, const PeriodicPairs& pairs, const ModelTables& tables);

}  // namespace st
