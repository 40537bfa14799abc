// Which limits each face and edge of a model is sampled with.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "features/bodies.h"
#include "features/face_roles.h"
#include "features/lifting_surface.h"
#include "geometry/model/model.h"
#include "sizing/size_limits.h"
#include "sizing/size_rules.h"
#include "sizing/wing_sizes.h"

namespace st {

/// Lifting surfaces, and the bodies around them.
struct Aircraft {
  std::vector<LiftingSurface> wings;
  Bodies bodies;
};

/// Limits per face and edge, by the role of the face.
///
/// Walls take the limits as given. A far field takes its own largest length, 1/30 of the diagonal of the face's box
/// (never less than the walls'): sizes meant for the body would fill it with triangles. A symmetry plane asks for
/// nothing: its sizes come from what it touches. Rules then change faces and the edges of faces, in order; an edge
/// takes the finest of its faces for each limit apart, and after that what rules say of the edge itself.
struct ModelLimits {
  std::vector<std::optional<SamplingLimits>> face;    ///< [n_faces]; nullopt: not sampled
  std::vector<std::optional<SamplingLimits>> edge;    ///< [n_edges]; nullopt: not sampled (degenerate, or between
                                                      ///< symmetry planes only)
  std::vector<std::optional<SamplingLimits>> vertex;  ///< [n_vertices] its max_length is asked for there; nullopt: no
                                                      ///< rule names it
  std::vector<std::uint8_t> edge_is_ruled;            ///< [n_edges] 1: a rule names the edge
  std::vector<std::uint8_t> edge_is_smooth;           ///< [n_edges] 1: the surface goes on smoothly across it
                                                      ///< (features/smooth_edges.h)
  std::vector<std::int32_t> face_wing;  ///< [n_faces] the lifting surface whose chord limits the face; kNone: none
  std::vector<ChordLine> chords;        ///< of these surfaces
  SamplingLimits far;       ///< the walls' limits with max_length = far_length: for what is not sampled but traced
  double min_length = 0;    ///< smallest min_length of all
  bool wants_gaps = false;  ///< some face has gap_cells or wall_cells
  bool is_material_ahead = false;  ///< normals of faces point into the material
  double far_length = 0;           ///< largest max_length of all: the length where nothing asks for less
  double max_aspect = 1;           ///< largest of all

  /// Whether an edge only says where the CAD happens to be split: it requires no length of its own.
  bool is_mere_split(EdgeId e) const {
    return edge_is_smooth[e] && !edge_is_ruled[e] && !(edge[e] && edge[e]->edge_cells);
  }
  /// Limits at which an edge is traced as part of a loop.
  const SamplingLimits& trace(EdgeId e) const { return edge[e] ? *edge[e] : far; }
};

/// Longest side of a far-field triangle over the diagonal of its face's box: keeps the volume inside a spherical far
/// field within 0.5 %.
inline constexpr double kFarLengthPerDiagonal = 1.0 / 30;

/// Length along over length across on faces that belong to no lifting surface, at most.
inline constexpr double kMostAspectOffWings = 16;

/// Bodies around lifting surfaces take the walls' share of their own diagonal as largest length, and 2 pi / alpha
/// lengths around, but are no finer than the wing is between nose and trailing edge (chord_cells). Where a body is
/// thinner around than the chord is long, alpha grows with the root of that ratio, twice at most.
///
/// `far_length` is the largest max_length of all faces. Throws Error(kUsage) for a rule that selects nothing or
/// contradicts itself. `wing_edges`, `aircraft`: what detection found; lengths of chord and span refer to the lifting
/// surface that is nearest to the face or edge.
ModelLimits model_limits(const ModelTables& tables, const FaceRoles& roles, const SamplingLimits& wall,
                         const std::vector<SizeRule>& rules = {}, std::span<const WingEdge> wing_edges = {},
                         const Aircraft& aircraft = {});

}  // namespace st
