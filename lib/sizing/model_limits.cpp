#include "sizing/model_limits.h"
#include "geometry/model/edge_faces.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace st {
namespace {

constexpr double kSpare = 1.02;        // segments are some per cent longer than what is requested
constexpr double kLargestTurning = 2;  // angles on small bodies over those of walls

using Limits = std::optional<SamplingLimits>;

/// Nothing asks for nothing.
Limits finest(const Limits& a, const Limits& b) {
  if (!a || !b) return a ? a : b;
  return finest(*a, *b);
}

/// Limits of the faces' insides and of their edges, before the edges' own.
struct FaceLimits {
  std::vector<Limits> surface, curve;
};

class LimitsMaker {
 public:
  LimitsMaker(const ModelTables& t, const FaceRoles& roles, const SamplingLimits& wall,
              const std::vector<SizeRule>& rules, std::span<const WingEdge> wing_edges, const Aircraft& aircraft)
      : t_(t), roles_(roles), wall_(wall), rules_(rules), wings_(aircraft.wings), bodies_(aircraft.bodies) {
    for (const SizeRule& rule : rules)
      targets_.push_back(rule.asks_sizes() ? find_targets(rule, t, wing_edges) : RuleTargets());
  }

  ModelLimits run() {
    set_by_role();
    for (std::size_t r = 0; r < rules_.size(); ++r) apply_to_faces(r);
    collect_edges();
    edge_is_ruled_.assign(edge_.size(), 0);
    for (std::size_t r = 0; r < rules_.size(); ++r)
      for (const EdgeId e : targets_[r].edges) {
        if (!rules_[r].asks_sizes()) continue;
        edge_is_ruled_[e] = 1;
        if (!t_.edge_is_degenerate[e])
          change(
              rules_[r], [&] { return reference_on(rules_[r], e); }, edge_[e]);
      }
    vertex_.resize(t_.n_vertices());
    for (std::size_t r = 0; r < rules_.size(); ++r)
      for (const VertexId v : targets_[r].vertices)
        change(
            rules_[r], [&] { return reference_at(rules_[r], t_.vertex_xyz[v]); }, vertex_[v]);
    return finish();
  }

 private:
  double far_length(std::size_t f) const {
    return std::max(wall_.max_length, kFarLengthPerDiagonal * roles_.own.face_box[f].diagonal());
  }

  void set_by_role() {
    for (std::size_t f = 0; f < roles_.role.size(); ++f) {
      Limits own;
      if (roles_.role[f] != FaceRole::kSymmetry && roles_.role[f] != FaceRole::kInterface) own = wall_;
      if (roles_.role[f] == FaceRole::kFarfield) own->max_length = far_length(f);
      if (t_.is_joined(static_cast<FaceId>(f))) own.reset();
      if (const Body* body = body_of(f); body && own) limit_by_body(*body, *own);
      face_.surface.push_back(own);
    }
    face_.curve = face_.surface;
  }

  const Body* body_of(std::size_t f) const {
    return bodies_.body.empty() || bodies_.of_face[f] == kNone ? nullptr : &bodies_.body[bodies_.of_face[f]];
  }

  /// A body that is thinner around than the chord is long is bent less finely; its tip caps and fillets are not.
  double body_alpha(const Body& body) const {
    if (body.is_wing_piece || !(body.girth > 0)) return wall_.alpha;
    return std::min(0.5 * kPi, wall_.alpha * std::clamp(std::sqrt(body.chord / body.girth), 1.0, kLargestTurning));
  }

  /// A body gets the walls' share of its own diagonal, and as many lengths around as a circle, but is no finer than its
  /// wing between nose and trailing edge.
  void limit_by_body(const Body& body, SamplingLimits& own) const {
    if (!(body.girth > 0)) return;
    const double of_diagonal = wall_.max_length * body.diagonal / roles_.reference_diagonal,
                 around = body.girth * wall_.alpha / (2 * kPi * kSpare);
    const double of_wing = wall_.chord_cells ? body.chord / *wall_.chord_cells : wall_.max_length;
    const double most = std::max({std::min(of_diagonal, around), of_wing, wall_.min_length});
    own.max_along = std::min(own.max_length, of_diagonal);
    own.max_length = std::min(own.max_length, most);
    own.alpha = body_alpha(body);
  }

  void apply_to_faces(std::size_t r) {
    const SizeRule& rule = rules_[r];
    if (!rule.asks_sizes()) return;
    const auto apply = [&](FaceId f) {
      const auto reference = [&] { return reference_at(rule, t_.face_box[f].center()); };
      if (rule.for_surfaces) change(rule, reference, face_.surface[f]);
      if (rule.for_curves) change(rule, reference, face_.curve[f]);
    };
    for (const FaceId f : targets_[r].faces) apply(f);
    if (!rule.selection.empty()) return;
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      if (roles_.role[f] == FaceRole::kWall) apply(f);
  }

  void change(const SizeRule& rule, const std::function<LengthReference()>& reference, Limits& limits) const {
    if (rule.is_sampled == false)
      limits.reset();
    else if (limits || !rule.selection.empty())
      limits = changed_limits(rule, limits.value_or(wall_), reference());
  }

  Vec3 edge_middle(EdgeId e) const {
    return 0.5 * (t_.vertex_xyz[t_.edge_vertices[2 * static_cast<std::size_t>(e)]] +
                  t_.vertex_xyz[t_.edge_vertices[2 * static_cast<std::size_t>(e) + 1]]);
  }

  static bool needs_wing(const SizeRule& rule) {
    return (rule.lmin && rule.lmin->is_of_wing()) || (rule.lmax && rule.lmax->is_of_wing()) ||
           (rule.chord && rule.chord->is_of_wing());
  }

  /// Of the lifting surface whose edge it is; else of the nearest one.
  LengthReference reference_on(const SizeRule& rule, EdgeId e) const {
    if (!needs_wing(rule)) return {roles_.reference_diagonal, t_.unit_in_m};
    const auto is_own = [&](const ChordEdge& edge) { return edge.edge == e; };
    for (const LiftingSurface& wing : wings_)
      for (const std::vector<ChordEdge>* edges : {&wing.trailing, &wing.declared_leading})
        if (const auto own = std::ranges::find_if(*edges, is_own); own != edges->end())
          return {roles_.reference_diagonal, t_.unit_in_m, own->chord_at(0.5), wing.span};
    return reference_at(rule, edge_middle(e));
  }

  /// Chord and span of the lifting surface that is nearest.
  LengthReference reference_at(const SizeRule& rule, Vec3 place) const {
    LengthReference reference{roles_.reference_diagonal, t_.unit_in_m};
    if (!needs_wing(rule)) return reference;
    double nearest = -1;
    for (std::size_t w = 0; w < wings_.size(); ++w) {
      const NearestChord own = wings_[w].nearest_chord(place);
      if (nearest >= 0 && own.distance >= nearest) continue;
      nearest = own.distance;
      reference.chord = own.chord;
      reference.span = wings_[w].span;
    }
    return reference;
  }

  void collect_edges() {
    const EdgeFaces faces_at(t_);
    for (EdgeId e = 0; e < t_.n_edges(); ++e) {
      Limits own;
      for (const FaceId f : faces_at[e]) own = finest(own, face_.curve[f]);
      if (faces_at[e].empty()) own = wall_;
      if (own && own->alpha == wall_.alpha)  // bent as the body is that ends there
        for (const FaceId f : faces_at[e])
          if (const Body* body = body_of(f)) own->alpha = std::max(own->alpha, body_alpha(*body));
      if (t_.edge_is_degenerate[e]) own.reset();
      edge_.push_back(own);
    }
  }

  ModelLimits finish() {
    limit_stretch();
    ModelLimits limits;
    limits.far_length = wall_.max_length;
    limits.min_length = wall_.min_length;
    limits.max_aspect = wall_.max_aspect;
    for (const std::vector<Limits>* all : {&face_.surface, &edge_, &vertex_})
      for (const Limits& own : *all) {
        if (!own) continue;
        limits.far_length = std::max(limits.far_length, own->max_length);
        limits.min_length = std::min(limits.min_length, own->min_length);
        limits.max_aspect = std::max(limits.max_aspect, own->max_aspect);
      }
    for (const Limits& own : face_.surface)
      limits.wants_gaps = limits.wants_gaps || (own && (own->gap_cells || own->wall_cells));
    limits.is_material_ahead = is_material_ahead(t_, roles_);
    limits.far = wall_;
    limits.far.max_length = limits.far_length;
    limit_by_chord(limits);
    limits.edge_is_ruled = std::move(edge_is_ruled_);
    limits.face = std::move(face_.surface);
    limits.edge = std::move(edge_);
    limits.vertex = std::move(vertex_);
    return limits;
  }

  /// Of faces off lifting surfaces, where no rule says otherwise.
  void limit_stretch() {
    std::vector<char> is_of_wing(face_.surface.size(), 0);
    for (const LiftingSurface& wing : wings_)
      for (const FaceId f : wing.faces) is_of_wing[f] = 1;
    for (std::size_t f = 0; f < face_.surface.size(); ++f)
      if (Limits& own = face_.surface[f]; own && !is_of_wing[f] && own->max_aspect == wall_.max_aspect)
        own->max_aspect = std::min(own->max_aspect, kMostAspectOffWings);
  }

  /// Faces of lifting surfaces whose largest length nobody has set.
  void limit_by_chord(ModelLimits& limits) const {
    limits.face_wing.assign(face_.surface.size(), kNone);
    if (!wall_.chord_cells) return;
    for (std::size_t w = wings_.size(); w-- > 0;) {
      for (const FaceId f : wings_[w].faces)
        if (face_.surface[f] && face_.surface[f]->max_length == wall_.max_length)
          limits.face_wing[f] = static_cast<std::int32_t>(w);
      for (const ChordEdge& trailing : wings_[w].trailing)
        for (const ChordStation& s : trailing.stations)
          if (s.is_measured) limits.chords.push_back({s.nose, s.trailing, s.chord, static_cast<std::int32_t>(w)});
    }
  }

  const ModelTables& t_;
  const FaceRoles& roles_;
  const SamplingLimits& wall_;
  const std::vector<SizeRule>& rules_;
  std::span<const LiftingSurface> wings_;
  const Bodies& bodies_;
  std::vector<std::uint8_t> edge_is_ruled_;
  std::vector<RuleTargets> targets_;
  FaceLimits face_;
  std::vector<Limits> edge_, vertex_;
};

}  // namespace

ModelLimits model_limits(const ModelTables& t, const FaceRoles& roles, const SamplingLimits& wall,
                         const std::vector<SizeRule>& rules, std::span<const WingEdge> wing_edges,
                         const Aircraft& aircraft) {
  return LimitsMaker(t, roles, wall, rules, wing_edges, aircraft).run();
}

}  // namespace st
