#include "meshing/engine/edge_mesher.h"

#include <algorithm>
#include <functional>

#include "base/current_work.h"
#include "base/error.h"
#include "features/strip.h"
#include "geometry/model/cad_tolerance.h"
#include "geometry/shape/projection.h"
#include "meshing/engine/curve_tasks.h"
#include "meshing/face/face_boundary.h"
#include "meshing/topology/curve_discretiser.h"
#include "meshing/topology/small_features.h"

namespace st {
namespace {

constexpr int kSamples = 32;      // of a curve, for its box
constexpr double kMargin = 0.05;  // of the box's diagonal: the curve may leave the box of its samples

Box3 box_of(const Curve& curve) {
  Box3 box;
  for (int i = 0; i <= kSamples; ++i)
    box.add(curve.point(curve.t_min() + (curve.t_max() - curve.t_min()) * i / kSamples));
  const double margin = kMargin * box.diagonal();
  box.lo -= {margin, margin, margin};
  box.hi += {margin, margin, margin};
  return box;
}

}  // namespace

struct EdgeMesher::Fresh {
  EdgeMesh nodes;
  std::vector<EdgeId> place;  // [n_edges] in `nodes`, or kNone

  void add(EdgeId e, const EdgeMesh& of, EdgeId i) {
    place[e] = nodes.n_edges();
    nodes.append(of, i);
  }
};

EdgeMesher::EdgeMesher(const Model& model, const MeshTopology& topology, const SizeField& field,
                       const MeshOptions& options, const Executor& executor)
    : model_(model),
      topology_(topology),
      tables_(topology.tables()),
      field_(field),
      executor_(executor),
      max_turning_deg_(options.max_turning_deg),
      merge_below_(options.merge_below),
      face_tolerance_(face_tolerances(tables_.labels)),
      min_segments_(min_segments_per_edge(tables_)),
      facing_(find_facing_edges(topology, field.is_stretched())),
      pairs_(options.pairs) {
  std::erase_if(facing_, [&](const FacingEdges& f) { return pair_follower(f.edge) != nullptr; });
}

/// Null where the edge has nodes of its own.
const PairFollower* EdgeMesher::pair_follower(EdgeId e) const {
  if (!pairs_ || pairs_->empty()) return nullptr;
  const PairFollower& f = pairs_->edges()[e];
  return f.leader == kNone ? nullptr : &f;
}

std::vector<std::pair<EdgeId, EdgeId>> EdgeMesher::followers() const {
  std::vector<std::pair<EdgeId, EdgeId>> found;
  for (const FacingEdges& f : facing_)
    for (const FacingEdges::Leader& l : f.leaders) found.push_back({f.edge, l.edge});
  for (EdgeId e = 0; e < tables_.n_edges(); ++e)
    if (const PairFollower* f = pair_follower(e)) found.push_back({e, f->leader});
  return found;
}

EdgeMesh EdgeMesher::mesh(const std::vector<EdgeId>& dirty, const Refinements& refinements,
                          const EdgeMesh& present) const {
  std::vector<EdgeId> own;
  std::vector<const MeshTopology::Strip*> strips;
  for (const EdgeId e : dirty) {
    if (topology_.strip_closed_at(e) || pair_follower(e)) continue;
    own.push_back(e);
    if (const auto* strip = topology_.strip_kept_at(e)) strips.push_back(strip);
  }
  const auto make = [&](std::int32_t i) { return make_edge(own[i], refinements); };
  Fresh fresh{make_curve_nodes(static_cast<std::int32_t>(own.size()), make, executor_),
              std::vector<EdgeId>(tables_.n_edges(), kNone)};
  for (EdgeId i = 0; i < fresh.nodes.n_edges(); ++i) fresh.place[own[i]] = i;
  follow_leaders(refinements, present, fresh);
  mirror(strips, fresh);
  follow_pairs(dirty, fresh);
  EdgeMesh next;
  for (EdgeId e = 0; e < tables_.n_edges(); ++e)
    fresh.place[e] == kNone ? next.append(present, e) : next.append(fresh.nodes, fresh.place[e]);
  return next;
}

/// Edges that follow others; their leaders are fresh, too, or as before.
void EdgeMesher::follow_leaders(const Refinements& refinements, const EdgeMesh& present, Fresh& fresh) const {
  std::vector<const FacingEdges*> dirty;
  for (const FacingEdges& f : facing_)
    if (fresh.place[f.edge] != kNone) dirty.push_back(&f);
  const auto nodes_of = [&](EdgeId e) {
    EdgeMesh nodes;
    const EdgeId place = fresh.place[e];
    if (place == kNone && present.n_nodes(e) == 0) return make_edge(e, refinements);  // of another part
    place == kNone ? nodes.append(present, e) : nodes.append(fresh.nodes, place);
    return nodes;
  };
  const auto make = [&](std::int32_t i) {
    EdgeMesh nodes = facing_nodes(model_, field_, *dirty[i], nodes_of(dirty[i]->edge), nodes_of);
    end_at_vertices(dirty[i]->edge, nodes, nodes.n_nodes(0) - 1);
    return nodes;
  };
  const EdgeMesh followed = make_curve_nodes(static_cast<std::int32_t>(dirty.size()), make, executor_);
  for (EdgeId i = 0; i < followed.n_edges(); ++i) fresh.add(dirty[i]->edge, followed, i);
}

/// The closed edges of the strips.
void EdgeMesher::mirror(const std::vector<const MeshTopology::Strip*>& strips, Fresh& fresh) const {
  const auto make = [&](std::int32_t i) {
    EdgeMesh kept;
    kept.append(fresh.nodes, fresh.place[strips[i]->kept]);
    return make_mirrored(*strips[i], kept);
  };
  const EdgeMesh mirrored = make_curve_nodes(static_cast<std::int32_t>(strips.size()), make, executor_);
  for (EdgeId i = 0; i < mirrored.n_edges(); ++i) fresh.add(strips[i]->closed, mirrored, i);
}

/// Edges of periodic faces that are images; their leaders are fresh, too.
void EdgeMesher::follow_pairs(const std::vector<EdgeId>& dirty, Fresh& fresh) const {
  std::vector<EdgeId> images;
  for (const EdgeId e : dirty)
    if (pair_follower(e)) images.push_back(e);
  const auto make = [&](std::int32_t i) {
    EdgeMesh leader;
    leader.append(fresh.nodes, fresh.place[pair_follower(images[i])->leader]);
    return make_image(images[i], leader);
  };
  const EdgeMesh made = make_curve_nodes(static_cast<std::int32_t>(images.size()), make, executor_);
  for (EdgeId i = 0; i < made.n_edges(); ++i) fresh.add(images[i], made, i);
}

/// The parameters are those of the images' feet; the ends are the vertices, which are images themselves.
EdgeMesh EdgeMesher::make_image(EdgeId e, const EdgeMesh& leader) const {
  const auto curve = model_.curve(e);
  EdgeMesh nodes = image_nodes(tables_, e, *curve, *pair_follower(e), leader, curve->t_min(), curve->t_max());
  end_at_vertices(e, nodes, nodes.n_nodes(0) - 1);
  return nodes;
}

void EdgeMesher::end_at_vertices(EdgeId e, EdgeMesh& nodes, int min_segments) const {
  const auto end = [&](int side) { return tables_.vertex_xyz[tables_.edge_vertices[2 * e + side]]; };
  st::end_at_vertices(nodes, end(0), end(1), min_segments);
}

EdgeMesh EdgeMesher::make_edge(EdgeId e, const Refinements& refinements) const {
  const CurrentWork at_edge("edge", e + 1);
  const auto curve = model_.curve(e);
  const RefinedField field(field_, refinements.near(box_of(*curve)));
  EdgeMesh nodes = discretise_curve(*curve, field, {max_turning_deg_, min_segments_[e]});
  if (pairs_)
    for (Vec3& x : nodes.node_xyz) x = pairs_->on_own_axis(e, x);
  end_at_vertices(e, nodes, min_segments_[e]);
  return nodes;
}

/// How far apart the edges of a strip may be and are one all the same, however small the sizes become.
double EdgeMesher::exactness(const MeshTopology::Strip& strip) const {
  if (tables_.edge_vertices[2 * strip.kept] == tables_.edge_vertices[2 * strip.kept + 1])
    return cad_tolerance(tables_, strip.face);
  if (std::ranges::equal_range(topology_.strips(), strip.face, {}, &MeshTopology::Strip::face).size() == 1)
    return strip_exactness(model_, strip.kept, strip.closed, strip.is_opposed);
  constexpr double kSpare = 1.01;  // a ledge, whose corners are one: all of it is closed
  const ModelTables& t = model_.tables();
  double most = 0;
  for (const std::size_t k : {0, 1}) {
    const VertexId a = t.edge_vertices[2 * static_cast<std::size_t>(strip.kept) + k],
                   b = t.edge_vertices[2 * static_cast<std::size_t>(strip.closed) + (strip.is_opposed ? 1 - k : k)];
    most = std::max(most, distance(t.vertex_xyz[a], t.vertex_xyz[b]));
  }
  return kSpare * most;
}

/// The nodes of a strip's other edge follow those of the kept one.
EdgeMesh EdgeMesher::make_mirrored(const MeshTopology::Strip& strip, const EdgeMesh& kept) const {
  const double tolerance = face_tolerance_.empty() ? 0 : face_tolerance_[strip.face];
  EdgeMesh nodes = mirror_nodes(*model_.curve(strip.kept), kept, *model_.curve(strip.closed), strip.is_opposed,
                                {merge_below_, tolerance, exactness(strip)});
  end_at_vertices(strip.closed, nodes, nodes.n_nodes(0) - 1);
  return nodes;
}

}  // namespace st
