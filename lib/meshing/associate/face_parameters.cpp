#include "meshing/associate/face_parameters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/lists_by_key.h"
#include "geometry/shape/projection.h"
#include "geometry/shape/surface_forms.h"

namespace st {
namespace {

constexpr double kSamePoint = 0.02;  // of the range: trimming curves that meet at a corner are no further apart
constexpr int kOrientationSamples = 7;

class FaceParameters {
 public:
  FaceParameters(const AssociationView& view, FaceId face, const std::vector<TriangleId>& triangles,
                 std::vector<Vec2>& corner_uv, std::vector<std::pair<NodeId, double>>& distances)
      : v_(view),
        t_(view.chains.tables),
        face_(face),
        triangles_(triangles),
        surface_(view.model.surface(face)),
        corner_uv_(corner_uv),
        distances_(distances) {}

  void run() {
    list_coedges();
    join_corners();
    place_sides();
    settle_sides();
    walk();
    write();
  }

 private:
  /// Corners of neighbouring triangles at one node: one (u,v), but at poles.
  struct Fan {
    NodeId node = kNone;
    Vec2 uv;
    bool is_known = false;
    std::vector<Vec2> on_sides = {};  ///< by the trimming curves of the sides that bound it
  };

  void list_coedges() {
    for (const CoedgeId c : t_.coedges(face_)) {
      const EdgeId e = t_.coedge_edge[c];
      coedges_[e].push_back(c);
      if (t_.edge_is_degenerate[e]) poles_[v_.chains.vertex_node[t_.edge_vertices[2 * e]]].push_back(c);
    }
    const bool has_seam =
        std::any_of(coedges_.begin(), coedges_.end(), [](const auto& uses) { return uses.second.size() > 1; });
    is_turned_ = has_seam && find_orientation();
  }

  /// Do the triangles run clockwise in (u,v)? By normals.
  bool find_orientation() const {
    double vote = 0;
    for (int i = 0; i < kOrientationSamples; ++i) {
      const auto& n = v_.mesh.triangles[triangles_[triangles_.size() * i / kOrientationSamples]].n;
      const Vec3 a = v_.mesh.node_xyz[n[0]], b = v_.mesh.node_xyz[n[1]], c = v_.mesh.node_xyz[n[2]];
      vote +=
          dot(normalized(cross(b - a, c - a)), surface_normal(*surface_, closest_point(*surface_, (a + b + c) / 3).uv));
    }
    return vote < 0;
  }

  std::int32_t local(TriangleId t) const {
    return static_cast<std::int32_t>(std::lower_bound(triangles_.begin(), triangles_.end(), t) - triangles_.begin());
  }
  NodeId node_of(std::int32_t corner) const { return v_.mesh.triangles[triangles_[corner / 3]].n[corner % 3]; }
  std::int32_t corner_at(TriangleId t, NodeId n) const {
    const auto& nodes = v_.mesh.triangles[t].n;
    return 3 * local(t) + (nodes[0] == n ? 0 : nodes[1] == n ? 1 : 2);
  }

  void join_corners() {
    const auto n_corners = static_cast<std::int32_t>(3 * triangles_.size());
    DisjointSets sets(n_corners);
    for (std::int32_t corner = 0; corner < n_corners; ++corner) {
      const SideId side = 3 * triangles_[corner / 3] + corner % 3;
      const std::int32_t m = v_.edges.edge_of_side[side];
      if (m == kNone || v_.segments.edge[m] != kNone) continue;
      const auto sides = v_.edges.sides_of(m);
      const TriangleId other = sides[sides[0] == side ? 1 : 0] / 3;
      for (const NodeId n : {v_.edges.low[m], v_.edges.high[m]})
        if (!poles_.contains(n)) sets.join(corner_at(triangles_[corner / 3], n), corner_at(other, n));
    }
    fan_of_.resize(n_corners);
    std::vector<std::int32_t> number(n_corners, kNone);
    for (std::int32_t corner = 0; corner < n_corners; ++corner) {
      std::int32_t& fan = number[sets.find(corner)];
      if (fan == kNone) {
        fan = static_cast<std::int32_t>(fans_.size());
        fans_.push_back({node_of(corner), {}});
      }
      fan_of_[corner] = fan;
    }
    corners_of_ = {fans_.size(), [&](const auto& visit) {
                     for (std::int32_t corner = 0; corner < n_corners; ++corner) visit(fan_of_[corner], corner);
                   }};
  }

  const Curve2d& pcurve(CoedgeId c) {
    auto& p = pcurves_[c];
    if (!p) p = v_.model.pcurve(face_, c);
    return *p;
  }

  /// Sides on CAD edges give their corners the (u,v) of the trimming curve.
  void place_sides() {
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(fan_of_.size()); ++corner) {
      const std::int32_t m = v_.edges.edge_of_side[3 * triangles_[corner / 3] + corner % 3];
      if (m == kNone || v_.segments.edge[m] == kNone) continue;
      const EdgeId e = v_.segments.edge[m];
      const std::int32_t i = v_.segments.index[m];
      const EdgeChain& chain = v_.chains.chain[e];
      const bool runs_along = chain.node[i] == node_of(corner);
      const std::int32_t at_end = 3 * (corner / 3) + (corner % 3 + 1) % 3;
      const Curve2d& curve = pcurve(coedge(e, runs_along));
      fans_[fan_of_[corner]].on_sides.push_back(curve.point(chain.t[runs_along ? i : i + 1]));
      fans_[fan_of_[at_end]].on_sides.push_back(curve.point(chain.t[runs_along ? i + 1 : i]));
    }
  }

  /// The use of an edge that has the triangle at its left, as (u,v) has it.
  CoedgeId coedge(EdgeId e, bool runs_along) const {
    const auto& uses = coedges_.at(e);
    for (const CoedgeId c : uses)
      if (uses.size() > 1 && (t_.coedge_is_reversed[c] != 0) == (runs_along == is_turned_)) return c;
    return uses[0];
  }

  /// Of several (u,v) that are the same point their mean. Different ones are a pole without an edge of its own: left to
  /// write().
  void settle_sides() {
    const double ru = surface_->u_max() - surface_->u_min(), rv = surface_->v_max() - surface_->v_min();
    for (Fan& fan : fans_) {
      if (fan.on_sides.empty() || poles_.contains(fan.node)) continue;
      Vec2 sum{}, first = fan.on_sides[0];
      bool agrees = true;
      for (const Vec2 uv : fan.on_sides) {
        sum = sum + uv;
        agrees &= std::abs(uv.x - first.x) <= kSamePoint * ru && std::abs(uv.y - first.y) <= kSamePoint * rv;
      }
      fan.is_known = agrees;
      fan.uv = (1.0 / static_cast<double>(fan.on_sides.size())) * sum;
    }
  }

  bool is_inner(const Fan& fan) const { return fan.on_sides.empty() && !poles_.contains(fan.node); }

  /// Projects the inner nodes, each from a neighbour.
  void walk() {
    std::vector<std::int32_t> queue;
    std::vector<char> is_queued(triangles_.size(), 0);
    const auto push_around = [&](std::int32_t fan) {
      for (const std::int32_t corner : corners_of_[fan])
        if (char& queued = is_queued[corner / 3]; !queued) {
          queued = 1;
          queue.push_back(corner / 3);
        }
    };
    for (std::size_t fan = 0; fan < fans_.size(); ++fan)
      if (fans_[fan].is_known) push_around(static_cast<std::int32_t>(fan));
    for (std::size_t first = 0, at = 0; first < fans_.size(); ++first) {
      for (; at < queue.size(); ++at)
        for (int k = 0; k < 3; ++k) {
          const std::int32_t fan = fan_of_[3 * queue[at] + k];
          if (fans_[fan].is_known || !is_inner(fans_[fan])) continue;
          project(fans_[fan], known_neighbour(queue[at]));
          push_around(fan);
        }
      if (fans_[first].is_known || !is_inner(fans_[first])) continue;
      project(fans_[first], nullptr);  // a face without edges, or only with poles around
      push_around(static_cast<std::int32_t>(first));
    }
  }

  const Fan* known_neighbour(std::int32_t triangle) const {
    for (int k = 0; k < 3; ++k)
      if (const Fan& fan = fans_[fan_of_[3 * triangle + k]]; fan.is_known) return &fan;
    return nullptr;
  }

  /// From the neighbour's (u,v) a step in its tangent plane.
  Vec2 step(const Fan& from, Vec3 x) const {
    const SurfacePoint p = surface_->evaluate(from.uv);
    const auto step = tangent_step(p.du, p.dv, x - v_.mesh.node_xyz[from.node], 1e-10);
    return step ? within_bounds(from.uv + *step) : from.uv;
  }

  void project(Fan& fan, const Fan* from) {
    const Vec3 x = v_.mesh.node_xyz[fan.node];
    const double enough = v_.tolerance.at(fan.node, t_.face_tolerance[face_]);
    double best = 1e300;
    const auto take = [&](Vec2 uv) {
      const double d = distance(surface_->point(uv), x);
      if (d < best) best = d, fan.uv = uv;
    };
    if (from) {
      const Vec2 guess = step(*from, x);
      if (const auto uv = project_near(*surface_, x, guess)) take(near(*uv, guess));
      for (const Vec2 start : {guess, from->uv})
        if (best > enough) take(descend(x, start));
    }
    if (best > enough) {
      const SurfaceFoot foot = closest_point(*surface_, x);
      take(from ? near(foot.uv, from->uv) : foot.uv);
    }
    if (best > enough) search(x, from ? from->uv : fan.uv, enough, take);
    fan.is_known = true;
    distances_.push_back({fan.node, best});
  }

  /// Levenberg and Marquardt from `uv`, for surfaces where Newton goes astray: kinks, collapsed sides, uneven
  /// parameters.
  Vec2 descend(Vec3 x, Vec2 uv) const {
    constexpr int kSteps = 100;
    double damping = 1e-3;
    SurfacePoint p = surface_->evaluate(uv);
    for (int i = 0; i < kSteps && damping < 1e12; ++i) {
      const Vec3 r = p.x - x;
      Eigen::Matrix2d damped = first_form(p.du, p.dv);
      damped.diagonal() *= 1 + damping;
      const auto step = solve(damped, along_tangents(p.du, p.dv, r), 0);
      if (!step) break;
      const Vec2 next = within_bounds(uv - to_vec2(*step));
      const SurfacePoint q = surface_->evaluate(next);
      if (norm2(q.x - x) < norm2(r)) {
        uv = next, p = q, damping *= 0.2;
      } else {
        damping *= 5;
      }
    }
    return uv;
  }

  /// Last resort on surfaces that fold: descends from the closest places of a fine grid, those near `from` first.
  template <class Take>
  void search(Vec3 x, Vec2 from, double enough, const Take& take) const {
    constexpr int kGrid = 80, kStarts = 24;
    const Vec2 lo{surface_->u_min(), surface_->v_min()}, range{surface_->u_max() - lo.x, surface_->v_max() - lo.y};
    std::vector<std::pair<double, Vec2>> starts;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; j <= kGrid; ++j) {
        const Vec2 uv{lo.x + range.x * i / kGrid, lo.y + range.y * j / kGrid};
        starts.push_back({distance(surface_->point(uv), x), uv});
      }
    const auto by_distance = [](const auto& a, const auto& b) {
      return std::tie(a.first, a.second.x, a.second.y) < std::tie(b.first, b.second.x, b.second.y);
    };
    std::partial_sort(starts.begin(), starts.begin() + kStarts, starts.end(), by_distance);
    starts.resize(kStarts);
    for (auto& [off, uv] : starts) off = std::abs(uv.x - from.x) / range.x + std::abs(uv.y - from.y) / range.y;
    std::sort(starts.begin(), starts.end(), by_distance);
    for (const auto& [off, uv] : starts) {
      const Vec2 foot = descend(x, uv);
      take(foot);
      if (distance(surface_->point(foot), x) <= enough) return;
    }
  }

  Vec2 within_bounds(Vec2 uv) const {
    return {std::clamp(uv.x, surface_->u_min(), surface_->u_max()),
            std::clamp(uv.y, surface_->v_min(), surface_->v_max())};
  }

  /// The same point, as few periods from `there` as the bounds allow.
  Vec2 near(Vec2 uv, Vec2 there) const {
    const auto shifted = [](double x, double goal, double period, double lo, double hi) {
      if (!(period > 0)) return x;
      const double y = x + period * std::round((goal - x) / period), slack = 0.01 * (hi - lo);
      return y >= lo - slack && y <= hi + slack ? y : x;
    };
    return {shifted(uv.x, there.x, surface_->u_period(), surface_->u_min(), surface_->u_max()),
            shifted(uv.y, there.y, surface_->v_period(), surface_->v_min(), surface_->v_max())};
  }

  void write() {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      Vec2 sum{};
      int n = 0;
      for (int k = 0; k < 3; ++k)
        if (const Fan& fan = fans_[fan_of_[3 * i + k]]; fan.is_known) sum = sum + fan.uv, ++n;
      const Vec2 middle =
          n ? (1.0 / n) * sum
            : Vec2{0.5 * (surface_->u_min() + surface_->u_max()), 0.5 * (surface_->v_min() + surface_->v_max())};
      for (int k = 0; k < 3; ++k) {
        const Fan& fan = fans_[fan_of_[3 * i + k]];
        corner_uv_[3 * triangles_[i] + k] = fan.is_known ? fan.uv : at_pole(fan, middle);
      }
    }
  }

  /// On the pole's trimming curve, or of the fan's own (u,v), the one nearest to a triangle.
  Vec2 at_pole(const Fan& fan, Vec2 middle) {
    const double ru = surface_->u_max() - surface_->u_min(), rv = surface_->v_max() - surface_->v_min();
    std::pair<double, Vec2> best{1e300, {}};
    const auto take = [&](Vec2 uv) {
      const double d = std::abs(uv.x - middle.x) / ru + std::abs(uv.y - middle.y) / rv;
      if (d < best.first) best = {d, uv};
    };
    if (const auto pole = poles_.find(fan.node); pole != poles_.end()) {
      for (const CoedgeId c : pole->second) {
        const EdgeId e = t_.coedge_edge[c];
        const Vec2 a = pcurve(c).point(t_.edge_range[2 * e]), d = pcurve(c).point(t_.edge_range[2 * e + 1]) - a;
        const Vec2 scaled{d.x / ru, d.y / rv}, towards{(middle.x - a.x) / ru, (middle.y - a.y) / rv};
        const double length2 = dot(scaled, scaled);
        take(a + (length2 > 0 ? std::clamp(dot(towards, scaled) / length2, 0.0, 1.0) : 0.0) * d);
      }
      return best.second;
    }
    for (const Vec2 uv : fan.on_sides) take(uv);
    return best.second;
  }

  const AssociationView& v_;
  const ModelTables& t_;
  FaceId face_;
  const std::vector<TriangleId>& triangles_;
  std::unique_ptr<Surface> surface_;
  std::vector<Vec2>& corner_uv_;
  std::vector<std::pair<NodeId, double>>& distances_;
  bool is_turned_ = false;
  std::map<EdgeId, std::vector<CoedgeId>> coedges_;
  std::map<CoedgeId, std::unique_ptr<Curve2d>> pcurves_;
  std::map<NodeId, std::vector<CoedgeId>> poles_;  // degenerate edges of the face at a node
  std::vector<Fan> fans_;
  std::vector<std::int32_t> fan_of_;  // by corner: 3 * place in triangles_ + k
  ListsByKey<> corners_of_;           // by fan
};

}  // namespace

void find_face_parameters(const AssociationView& view, FaceId face, const std::vector<TriangleId>& triangles,
                          std::vector<Vec2>& corner_uv, std::vector<std::pair<NodeId, double>>& distances) {
  FaceParameters(view, face, triangles, corner_uv, distances).run();
}

}  // namespace st
