#include "sizing/model_limits.h"

#include <algorithm>

namespace st {
namespace {

using Limits = std::optional<SamplingLimits>;

/// The finest of each limit; nothing asks for nothing.
Limits finest(const Limits& a, const Limits& b) {
  if (!a || !b) return a ? a : b;
  SamplingLimits both = *a;
  both.min_length = std::min(a->min_length, b->min_length);
  both.max_length = std::min(a->max_length, b->max_length);
  both.alpha = std::min(a->alpha, b->alpha);
  both.chord = std::min(a->chord, b->chord);
  both.gap_cells = std::max(a->gap_cells, b->gap_cells);
  both.edge_cells = std::max(a->edge_cells, b->edge_cells);
  both.min_length = std::min(both.min_length, both.max_length);
  return both;
}

/// Limits of the faces' insides and of their edges, before the edges' own.
struct FaceLimits {
  std::vector<Limits> surface, curve;
};

class LimitsMaker {
 public:
  LimitsMaker(const ModelTables& t, const FaceRoles& roles, const SamplingLimits& wall,
              const std::vector<SizeRule>& rules, std::span<const WingEdge> wing_edges)
      : t_(t), roles_(roles), wall_(wall), rules_(rules) {
    for (const SizeRule& rule : rules) targets_.push_back(find_targets(rule, t, wing_edges));
  }

  ModelLimits run() {
    set_by_role();
    for (std::size_t r = 0; r < rules_.size(); ++r) apply_to_faces(r);
    collect_edges();
    for (std::size_t r = 0; r < rules_.size(); ++r)
      for (const EdgeId e : targets_[r].edges)
        if (!t_.edge_is_degenerate[e]) change(rules_[r], edge_[e]);
    vertex_.resize(t_.n_vertices());
    for (std::size_t r = 0; r < rules_.size(); ++r)
      for (const VertexId v : targets_[r].vertices) change(rules_[r], vertex_[v]);
    return finish();
  }

 private:
  double far_length(std::size_t f) const {
    return std::max(wall_.max_length, kFarLengthPerDiagonal * t_.face_box[f].diagonal());
  }

  void set_by_role() {
    for (std::size_t f = 0; f < roles_.role.size(); ++f) {
      Limits own;
      if (roles_.role[f] != FaceRole::kSymmetry) own = wall_;
      if (roles_.role[f] == FaceRole::kFarfield) own->max_length = far_length(f);
      face_.surface.push_back(own);
    }
    face_.curve = face_.surface;
  }

  void apply_to_faces(std::size_t r) {
    const SizeRule& rule = rules_[r];
    const auto apply = [&](FaceId f) {
      if (rule.for_surfaces) change(rule, face_.surface[f]);
      if (rule.for_curves) change(rule, face_.curve[f]);
    };
    for (const FaceId f : targets_[r].faces) apply(f);
    if (rule.has_selection()) return;
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      if (roles_.role[f] == FaceRole::kWall) apply(f);
  }

  void change(const SizeRule& rule, Limits& limits) const {
    if (rule.is_sampled == false)
      limits.reset();
    else if (limits || rule.has_selection())
      limits = changed_limits(rule, limits.value_or(wall_), roles_.reference_diagonal, t_.unit_in_m);
  }

  void collect_edges() {
    std::vector<std::int32_t> offsets;
    std::vector<FaceId> faces;
    t_.edge_faces(offsets, faces);
    for (std::size_t e = 0; e < static_cast<std::size_t>(t_.n_edges()); ++e) {
      Limits own;
      for (std::int32_t k = offsets[e]; k < offsets[e + 1]; ++k) own = finest(own, face_.curve[faces[k]]);
      if (offsets[e] == offsets[e + 1]) own = wall_;
      if (t_.edge_is_degenerate[e]) own.reset();
      edge_.push_back(own);
    }
  }

  ModelLimits finish() {
    ModelLimits limits;
    limits.far_length = wall_.max_length;
    limits.min_length = wall_.min_length;
    for (const std::vector<Limits>* all : {&face_.surface, &edge_, &vertex_})
      for (const Limits& own : *all) {
        if (!own) continue;
        limits.far_length = std::max(limits.far_length, own->max_length);
        limits.min_length = std::min(limits.min_length, own->min_length);
      }
    for (const Limits& own : face_.surface) limits.wants_gaps = limits.wants_gaps || (own && own->gap_cells);
    for (const FaceId f : roles_.guessed) limits.far_length = std::max(limits.far_length, far_length(f));
    limits.far = wall_;
    limits.far.max_length = limits.far_length;
    limits.face = std::move(face_.surface);
    limits.edge = std::move(edge_);
    limits.vertex = std::move(vertex_);
    return limits;
  }

  const ModelTables& t_;
  const FaceRoles& roles_;
  const SamplingLimits& wall_;
  const std::vector<SizeRule>& rules_;
  std::vector<RuleTargets> targets_;
  FaceLimits face_;
  std::vector<Limits> edge_, vertex_;
};

}  // namespace

ModelLimits model_limits(const ModelTables& t, const FaceRoles& roles, const SamplingLimits& wall,
                         const std::vector<SizeRule>& rules, std::span<const WingEdge> wing_edges) {
  return LimitsMaker(t, roles, wall, rules, wing_edges).run();
}

}  // namespace st
