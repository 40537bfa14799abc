#include "meshing/topology/periodic_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

#include "base/error.h"
#include "geometry/model/bodies.h"
#include "geometry/model/cad_tolerance.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/projection.h"
#include "mesh/pair_match.h"

namespace st {
namespace {

constexpr double kTurns = 1e-9;  // one less the cosine of an angle: below, a motion is none but for its rounding
constexpr int kSamples = 8;      // intervals of an edge

[[noreturn]] void fail(const ModelTables& t, const FacePair& p, const std::string& what) {
  throw Error(ExitCode::kGeometry, fmt::format("pair of {} and {}: {}; correct the motion of the pair, or the CAD",
                                               t.face_label(p.a), t.face_label(p.b), what));
}

std::set<EdgeId> curves_of(const ModelTables& t, FaceId f) {
  std::set<EdgeId> all;
  for (const EdgeId e : t.edges_of(f))
    if (!t.edge_is_degenerate[e]) all.insert(e);
  return all;
}

/// Of an edge of face b from the image of one of face a.
struct EdgeFit {
  double distance = 1e300;
  bool is_opposed = false;
};

EdgeFit fit_of(const Curve& a, const Similarity& motion, const Curve& b) {
  EdgeFit fit{0, false};
  double t[kSamples + 1] = {};
  for (int i = 1; i < kSamples; ++i) {
    const CurveFoot foot = closest_point(b, motion(a.point(a.t_min() + (a.t_max() - a.t_min()) * i / kSamples)));
    t[i] = foot.t;
    fit.distance = std::max(fit.distance, foot.distance);
  }
  fit.is_opposed = t[kSamples - 1] < t[1];
  return fit;
}

/// The point next to `x` that the rotation leaves where it is: d - R d = R x - x, in the plane across the axis.
Vec3 on_axis(const Similarity& motion, Vec3 x) {
  const auto& r = motion.rotation;
  const Vec3 d = motion(x) - x, sine{0.5 * (r[2].y - r[1].z), 0.5 * (r[0].z - r[2].x), 0.5 * (r[1].x - r[0].y)};
  const double one_less_cosine = 0.5 * (3 - r[0].x - r[1].y - r[2].z);
  return one_less_cosine > kTurns ? x + 0.5 * (d + cross(sine, d) / one_less_cosine) : x;
}

/// The face's outside in the middle of one of its edges.
Vec3 outside(const ModelTables& t, const Surface& surface, FaceId f, Vec3 x) {
  return (t.face_is_reversed[f] ? -1.0 : 1.0) * surface_normal(surface, closest_point(surface, x).uv);
}

}  // namespace

bool turns_over(const Model& model, const FacePair& p) {
  const std::set<EdgeId> edges = curves_of(model.tables(), p.a);
  if (edges.empty()) return false;
  const auto curve = model.curve(*edges.begin());
  const Vec3 x = curve->point(0.5 * (curve->t_min() + curve->t_max()));
  const Vec3 a = outside(model.tables(), *model.surface(p.a), p.a, x),
             b = outside(model.tables(), *model.surface(p.b), p.b, p.motion(x));
  return dot(p.motion.rotated(a), b) < 0;
}

PeriodicPairs::PeriodicPairs(const Model& model, std::vector<FacePair> pairs) : pairs_(std::move(pairs)) {
  if (pairs_.empty()) return;
  const ModelTables& t = model.tables();
  std::set<FaceId> used;
  for (const FacePair& p : pairs_) {
    if (p.a == p.b) fail(t, p, "a face is no partner of itself");
    if (!used.insert(p.a).second || !used.insert(p.b).second) fail(t, p, "one of them is in another pair, too");
    match(model, p);
  }
  lead(model);
}

double PeriodicPairs::tolerance(const ModelTables& t, const FacePair& p) const {
  return std::max({cad_tolerance(t, p.a), cad_tolerance(t, p.b), kSamePlace * t.box().diagonal()});
}

void PeriodicPairs::match(const Model& model, const FacePair& p) {
  const ModelTables& t = model.tables();
  const double tolerance = this->tolerance(t, p);
  std::map<VertexId, VertexId> vertex;
  for (const VertexId v : vertices_of(t, p.a)) {
    const Vec3 x = p.motion(t.vertex_xyz[v]);
    const std::set<VertexId> others = vertices_of(t, p.b);
    const auto nearest = std::min_element(others.begin(), others.end(), [&](VertexId i, VertexId j) {
      return distance(x, t.vertex_xyz[i]) < distance(x, t.vertex_xyz[j]);
    });
    const double off = nearest == others.end() ? 1e300 : distance(x, t.vertex_xyz[*nearest]);
    if (off > tolerance)
      fail(
          t, p,
          fmt::format("the image of vertex {} is {:.3g} off the nearest vertex, beyond {:.3g}", v + 1, off, tolerance));
    vertex[v] = *nearest;
  }
  std::map<EdgeId, PairFollower> edge;
  std::set<EdgeId> left = curves_of(t, p.b);
  for (const EdgeId e : curves_of(t, p.a)) {
    const auto curve = model.curve(e);
    const auto ends = std::minmax(vertex[t.edge_vertices[2 * e]], vertex[t.edge_vertices[2 * e + 1]]);
    EdgeFit best;
    EdgeId found = kNone;
    for (const EdgeId other : left) {
      if (std::minmax(t.edge_vertices[2 * other], t.edge_vertices[2 * other + 1]) != ends) continue;
      const EdgeFit fit = fit_of(*curve, p.motion, *model.curve(other));
      if (fit.distance < best.distance) best = fit, found = other;
    }
    if (found == kNone) fail(t, p, fmt::format("no edge has the ends of the image of {}", t.edge_label(e)));
    if (best.distance > tolerance)
      fail(t, p,
           fmt::format("the image of {} is {:.3g} off {}, beyond {:.3g}", t.edge_label(e), best.distance,
                       t.edge_label(found), tolerance));
    left.erase(found);
    edge[e] = {found, p.motion, best.is_opposed};
  }
  if (!left.empty()) fail(t, p, fmt::format("{} has no partner", t.edge_label(*left.begin())));
  if (edge.empty()) fail(t, p, "they have no edges to match");
  turns_over_.push_back(st::turns_over(model, p));
  edge_image_.push_back(std::move(edge));
  vertex_image_.push_back(std::move(vertex));
}

namespace {

using Links = std::vector<std::vector<PairFollower>>;  // by id: where it leads, by one motion

void link(Links& links, std::int32_t from, const PairFollower& to) {
  links[from].push_back(to);
  links[to.leader].push_back({from, to.motion.inverse(), to.is_opposed});
}

/// From each entity of the lowest id to all that it is connected with.
std::vector<PairFollower> leaders_of(const Links& links) {
  std::vector<PairFollower> found(links.size());
  std::vector<char> is_reached(links.size(), 0);
  for (std::size_t first = 0; first < links.size(); ++first) {
    if (std::exchange(is_reached[first], char{1}) != 0) continue;
    std::vector<std::int32_t> front{static_cast<std::int32_t>(first)};
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const PairFollower& to : links[front[i]]) {
        if (std::exchange(is_reached[to.leader], char{1}) != 0) continue;
        const PairFollower& from = found[front[i]];
        found[to.leader] = {static_cast<std::int32_t>(first), from.motion.then(to.motion),
                            from.is_opposed != to.is_opposed};
        front.push_back(to.leader);
      }
  }
  return found;
}

/// Ways from a leader along a link and back, which must leave it where it is.
std::vector<PairFollower> rounds_of(const Links& links, const std::vector<PairFollower>& found) {
  std::vector<PairFollower> rounds;
  for (std::size_t i = 0; i < links.size(); ++i)
    for (const PairFollower& to : links[i]) {
      const PairFollower &from = found[i], &end = found[to.leader];
      rounds.push_back({from.leader == kNone ? static_cast<std::int32_t>(i) : from.leader,
                        from.motion.then(to.motion).then(end.motion.inverse()),
                        (from.is_opposed != to.is_opposed) != end.is_opposed});
    }
  return rounds;
}

[[noreturn]] void fail_round(const std::string& what, double off) {
  throw Error(
      ExitCode::kGeometry,
      fmt::format("the pairs contradict each other at {}: there and back by their motions it is {:.3g} off; give "
                  "motions with all their digits",
                  what, off));
}

}  // namespace

void PeriodicPairs::lead(const Model& model) {
  const ModelTables& t = model.tables();
  const double same = pair_tolerance(t.box()), most = kSamePlace * t.box().diagonal();
  Links edges(t.n_edges()), vertices(t.n_vertices());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    for (const auto& [e, to] : edge_image_[i]) link(edges, e, to);
    for (const auto& [v, to] : vertex_image_[i]) link(vertices, v, {to, pairs_[i].motion, false});
  }
  edges_ = leaders_of(edges);
  vertices_ = leaders_of(vertices);
  vertex_xyz_ = t.vertex_xyz;
  const auto off = [](const PairFollower& r, Vec3 x) { return distance(r.motion(x), x); };
  const std::vector<PairFollower> rounds = rounds_of(vertices, vertices_);
  for (const PairFollower& r : rounds) {
    Vec3& x = vertex_xyz_[r.leader];
    if (off(r, x) > same && distance(on_axis(r.motion, x), x) <= most) x = on_axis(r.motion, x);
  }
  for (const PairFollower& r : rounds)
    if (const double d = off(r, vertex_xyz_[r.leader]); d > same) fail_round(fmt::format("vertex {}", r.leader + 1), d);
  for (VertexId v = 0; v < t.n_vertices(); ++v)
    if (vertices_[v].leader != kNone) vertex_xyz_[v] = vertices_[v].motion(vertex_xyz_[vertices_[v].leader]);
  for (const PairFollower& r : rounds_of(edges, edges_)) {
    const auto curve = model.curve(r.leader);
    const Vec3 x = curve->point(0.5 * (curve->t_min() + curve->t_max()));
    if (r.is_opposed || distance(on_axis(r.motion, x), x) > most) fail_round(t.edge_label(r.leader), off(r, x));
    if (off(r, x) > same) axes_[r.leader] = r.motion;
  }
}

Vec3 PeriodicPairs::on_own_axis(EdgeId e, Vec3 x) const {
  const auto it = axes_.find(e);
  return it == axes_.end() ? x : on_axis(it->second, x);
}

EdgeMesh image_nodes(const ModelTables& tables, EdgeId e, const Curve& curve, const PairFollower& f,
                     const EdgeMesh& leader, double t_first, double t_last) {
  const std::int32_t n = leader.n_nodes(0);
  std::vector<double> t, size;
  std::vector<Vec3> xyz;
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t k = f.is_opposed ? n - 1 - i : i;
    xyz.push_back(f.motion(leader.node_xyz[k]));
    size.push_back(leader.node_size[k]);
    t.push_back(i == 0 ? t_first : i + 1 == n ? t_last : closest_point(curve, xyz[i]).t);
  }
  if (std::ranges::adjacent_find(t, std::greater_equal<>()) != t.end())
    throw Error(ExitCode::kGeometry,
                fmt::format("{}: the nodes of its partner {} do not follow each other on it; correct the pair, or the "
                            "CAD",
                            tables.edge_label(e), tables.edge_label(f.leader)));
  return EdgeMesh::of_curve(std::move(t), std::move(xyz), std::move(size));
}

MergedFeatures without_paired(const MergedFeatures& merged, const PeriodicPairs& pairs, const ModelTables& t) {
  std::vector<char> is_paired(t.n_vertices(), 0);
  for (const FacePair& p : pairs.pairs())
    for (const FaceId f : {p.a, p.b})
      for (const VertexId v : vertices_of(t, f)) is_paired[v] = 1;
  const auto is_free = [&](EdgeId e) {
    return !is_paired[t.edge_vertices[2 * e]] && !is_paired[t.edge_vertices[2 * e + 1]];
  };
  MergedFeatures left;
  left.pairs = pairs.pairs();
  std::copy_if(merged.edge.begin(), merged.edge.end(), std::back_inserter(left.edge), is_free);
  std::set<FaceId> stays;  // all strips of a ledge, or none
  for (std::size_t s = 0; s < merged.strip_face.size(); ++s)
    if (!is_free(merged.strip_kept[s]) || !is_free(merged.strip_closed[s])) stays.insert(merged.strip_face[s]);
  for (std::size_t s = 0; s < merged.strip_face.size(); ++s) {
    if (stays.contains(merged.strip_face[s])) continue;
    left.strip_face.push_back(merged.strip_face[s]);
    left.strip_kept.push_back(merged.strip_kept[s]);
    left.strip_closed.push_back(merged.strip_closed[s]);
    left.strip_is_opposed.push_back(merged.strip_is_opposed[s]);
  }
  return left;
}

}  // namespace st
