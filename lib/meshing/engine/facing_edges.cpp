#include "meshing/engine/facing_edges.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "features/arc_table.h"
#include "features/strip.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr double kStretched = 2;  // length along over length across, in the middle of an edge
constexpr double kAlike = 0.15;   // between the numbers of segments of stretched edges
constexpr double kNarrow = 1.5;   // segments: a narrower face has rows in step, or angles near 180 degrees
constexpr double kFewest = 0.7;   // of its own segments: an edge along a narrow face takes as many
constexpr double kUneven = 1.5;   // between segments to nearest points and those of equal shares
constexpr double kFitting = 1.4;  // between segments and the lengths asked for: rows keep to them
constexpr double kFree = 0.25;    // of a face's width: chords nearer to their curves do not cross those across

using Facing = std::vector<FacingEdges>;

/// Which edges lead and follow so far.
class Roles {
 public:
  explicit Roles(const MeshTopology& topology) : topology_(topology), role_(topology.tables().n_edges(), kNone) {}

  void add(const StripSides& strip, bool has_rows) {
    strip.across.size() == 1 ? add_pair(strip, has_rows) : add_chain(strip, has_rows);
  }

  Facing take() { return std::move(all_); }

 private:
  static constexpr std::int32_t kLeads = -2;

  /// One that leads already keeps leading; one that follows leads through its leader.
  void add_pair(const StripSides& strip, bool has_rows) {
    EdgeId leader = std::min(strip.single, strip.across[0].edge),
           follower = std::max(strip.single, strip.across[0].edge);
    if (!may_lead(leader) || !may_lead(follower)) return;
    if (!may_follow(follower)) std::swap(leader, follower);
    if (!may_follow(follower) || (role_[leader] >= 0 && !has_rows)) return;
    FacingEdges::Leader first{leader, strip.across[0].is_opposed};
    if (!lead_by_leader(first)) return;
    add({follower, {first}, strip.width});
  }

  /// Where edges lead across several faces: those that the chain's edges follow lead in their place, and the one that
  /// the single edge follows becomes the follower, with all that followed it.
  void add_chain(const StripSides& strip, bool has_rows) {
    FacingEdges facing{strip.single, {}, strip.width};
    for (const StripSides::Side& s : strip.across) {
      if (!may_lead(s.edge) || (role_[s.edge] >= 0 && !has_rows)) return;
      facing.leaders.push_back({s.edge, s.is_opposed});
      if (!lead_by_leader(facing.leaders.back())) return;
    }
    if (has_rows && role_[strip.single] >= 0) {
      FacingEdges::Leader single{strip.single, false};
      if (!lead_by_leader(single)) return;
      facing.edge = single.edge;
      if (single.is_opposed) turn_round(facing.leaders);
    }
    const auto is_own = [&](const FacingEdges::Leader& l) { return l.edge == facing.edge; };
    if (std::ranges::any_of(facing.leaders, is_own)) return;
    if (has_rows ? !may_become_follower(facing.edge) : !may_follow(facing.edge)) return;
    for (FacingEdges& f : all_) {
      if (!is_own(f.leaders[0])) continue;
      const bool is_opposed = f.leaders[0].is_opposed;
      f.leaders = facing.leaders;
      if (is_opposed) turn_round(f.leaders);
    }
    add(std::move(facing));
  }

  /// Instead of an edge that follows, the one that it follows; false: these are several.
  bool lead_by_leader(FacingEdges::Leader& leader) const {
    if (role_[leader.edge] < 0) return true;
    const std::vector<FacingEdges::Leader>& of = all_[role_[leader.edge]].leaders;
    leader = {of[0].edge, of[0].is_opposed != leader.is_opposed};
    return of.size() == 1;
  }

  static void turn_round(std::vector<FacingEdges::Leader>& leaders) {
    std::ranges::reverse(leaders);
    for (FacingEdges::Leader& l : leaders) l.is_opposed = !l.is_opposed;
  }

  /// It leads only single edges, if any.
  bool may_become_follower(EdgeId e) const {
    if (!may_lead(e) || topology_.strip_kept_at(e) || role_[e] >= 0) return false;
    return std::ranges::none_of(all_, [e](const FacingEdges& f) {
      return f.leaders.size() > 1 && std::ranges::any_of(f.leaders, [e](const auto& l) { return l.edge == e; });
    });
  }

  /// The nodes of closed edges are made last.
  bool may_lead(EdgeId e) const { return !topology_.tables().edge_is_degenerate[e] && !topology_.strip_closed_at(e); }
  bool may_follow(EdgeId e) const { return may_lead(e) && !topology_.strip_kept_at(e) && role_[e] == kNone; }

  void add(FacingEdges facing) {
    role_[facing.edge] = static_cast<std::int32_t>(all_.size());
    for (const FacingEdges::Leader& l : facing.leaders) role_[l.edge] = kLeads;
    all_.push_back(std::move(facing));
  }

  const MeshTopology& topology_;
  std::vector<std::int32_t> role_;  // in all_; kLeads; kNone
  Facing all_;
};

/// Are lengths along the edge that follows long, for those across?
bool is_stretched(const Curve& curve, const SizeField& field) {
  const CurvePoint middle = curve.evaluate(0.5 * (curve.t_min() + curve.t_max()));
  int hint = 0;
  const LocalSize local = field.local_on(middle.x, a_normal_to(middle.d1), hint);
  return local.in(middle.d1) > kStretched * local.length;
}

/// Largest distance of a chord from its curve, about.
double chord_distance(const Curve& curve, const EdgeMesh& nodes) {
  double largest = 0;
  for (std::size_t i = 1; i < nodes.node_t.size(); ++i)
    largest = std::max(largest, distance(curve.point(0.5 * (nodes.node_t[i - 1] + nodes.node_t[i])),
                                         0.5 * (nodes.node_xyz[i - 1] + nodes.node_xyz[i])));
  return largest;
}

/// The leaders with their nodes.
struct Chain {
  std::vector<std::unique_ptr<Curve>> curves;
  std::vector<EdgeMesh> nodes;

  double n_segments() const {
    double n = 0;
    for (const EdgeMesh& edge : nodes) n += static_cast<double>(edge.node_t.size()) - 1;
    return n;
  }
  double chord_distance() const {
    double largest = 0;
    for (std::size_t i = 0; i < curves.size(); ++i)
      largest = std::max(largest, st::chord_distance(*curves[i], nodes[i]));
    return largest;
  }
};

/// The parameter across from x, near a guess; between `last` and the end of the curve.
double foot_of(Vec3 x, const Curve& curve, double guess, double last) {
  const std::optional<double> foot = project_near(curve, x, guess);
  const bool is_nearer = foot && distance(curve.point(*foot), x) < distance(curve.point(guess), x);
  return is_nearer && *foot > last && *foot < curve.t_max() ? *foot : guess;
}

/// At the same shares of the length; `is_exact`: at the nearest points. Empty: not in the order of the leaders' nodes.
EdgeMesh nodes_across(const Chain& chain, const std::vector<FacingEdges::Leader>& leaders, const Curve& curve,
                      bool is_exact) {
  std::vector<ArcTable> arcs;
  double length = 0, before = 0;
  for (const auto& c : chain.curves) length += arcs.emplace_back(*c).length();
  const ArcTable own(curve);
  std::vector<double> t{curve.t_min()}, h{0};
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    const EdgeMesh& nodes = chain.nodes[k];
    const std::size_t n = nodes.node_t.size();
    h.back() = nodes.node_size[leaders[k].is_opposed ? n - 1 : 0];
    for (std::size_t i = 1; i < n; ++i) {
      const std::size_t at = leaders[k].is_opposed ? n - 1 - i : i;
      const double share = arcs[k].share_at(nodes.node_t[at]);
      const double along = i + 1 == n ? 1 : leaders[k].is_opposed ? 1 - share : share;
      const double guess = own.parameter_at(before + along * (arcs[k].length() / length));
      t.push_back(is_exact ? foot_of(nodes.node_xyz[at], curve, guess, t.back()) : guess);
      h.push_back(nodes.node_size[at]);
    }
    before += arcs[k].length() / length;
  }
  t.back() = curve.t_max();
  for (std::size_t i = 1; i < t.size(); ++i)
    if (!(t[i] > t[i - 1])) return {};
  std::vector<Vec3> x;
  for (const double at : t) x.push_back(curve.point(at));
  return EdgeMesh::of_curve(std::move(t), std::move(x), std::move(h));
}

/// Are all segments about as long as the sizes ask for?
bool fits(const EdgeMesh& nodes, const SizeField& field) {
  int hint = 0;
  for (std::size_t i = 1; i < nodes.node_xyz.size(); ++i) {
    const Vec3 a = nodes.node_xyz[i - 1], b = nodes.node_xyz[i];
    const double ratio = distance(a, b) / field.length_along(0.5 * (a + b), b - a, hint);
    if (!(ratio < kFitting && ratio * kFitting > 1)) return false;
  }
  return true;
}

/// Are the segments of one about as long as those of the other, one by one?
bool are_alike(const EdgeMesh& a, const EdgeMesh& b) {
  if (a.node_xyz.size() != b.node_xyz.size()) return false;
  for (std::size_t i = 1; i < a.node_xyz.size(); ++i) {
    const double ratio = distance(a.node_xyz[i - 1], a.node_xyz[i]) / distance(b.node_xyz[i - 1], b.node_xyz[i]);
    if (!(ratio < kUneven && ratio * kUneven > 1)) return false;
  }
  return true;
}

}  // namespace

std::vector<FacingEdges> find_facing_edges(const MeshTopology& topology, bool has_rows) {
  Roles roles(topology);
  std::vector<StripSides> strips = find_strip_sides(topology.tables());
  // the narrowest need it most
  std::stable_sort(strips.begin(), strips.end(),
                   [](const StripSides& a, const StripSides& b) { return a.width < b.width; });
  for (const StripSides& strip : strips) roles.add(strip, has_rows);
  return roles.take();
}

EdgeMesh facing_nodes(const Model& model, const SizeField& field, const FacingEdges& facing, const EdgeMesh& own,
                      const std::function<EdgeMesh(EdgeId)>& nodes_of) {
  Chain chain;
  for (const FacingEdges::Leader& l : facing.leaders) {
    chain.curves.push_back(model.curve(l.edge));
    chain.nodes.push_back(nodes_of(l.edge));
    if (chain.nodes.back().node_t.size() < 2) return own;
  }
  const auto curve = model.curve(facing.edge);
  const double n_own = static_cast<double>(own.node_t.size()) - 1, n = chain.n_segments();
  const bool has_rows = field.is_stretched() && std::min(n, n_own) >= 2 && is_stretched(*curve, field);
  const bool is_narrow = has_rows && facing.width * n_own < kNarrow * ArcTable(*curve).length();
  const bool is_wide = field.is_stretched() && chain.nodes.size() == 1 && !is_narrow;
  const auto is_facing = [&] {
    if (is_narrow) return n >= kFewest * n_own;
    if (is_wide) return has_rows && std::abs(n_own - n) <= std::max(1.0, kAlike * n);
    return std::max(chord_distance(*curve, own), chain.chord_distance()) > kFree * facing.width;
  };
  if (!is_facing()) return own;
  EdgeMesh across = nodes_across(chain, facing.leaders, *curve, !is_wide);
  if (is_narrow) {  // nearest points crowd where ends lean
    EdgeMesh even = nodes_across(chain, facing.leaders, *curve, false);
    if (across.n_edges() == 0 || !are_alike(across, even)) across = std::move(even);
  }
  const bool is_own = across.n_edges() == 0 || (is_wide && !fits(across, field));
  return is_own ? own : across;
}

}  // namespace st
