#include "sizing/end_stretch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/box_tree.h"
#include "geometry/shape/projection.h"
#include "sizing/line_stretch.h"

namespace st {
namespace {

constexpr double kMostAcross = 0.7;  // cosine: a side that lies further along the stretch does not end it

constexpr double kAhead = 0.9;    // cosine: a side that lies so far along the stretch
constexpr double kOutward = 0.3;  // cosine to the way out of an edge: a tip's face, not that of a hub

bool lies_across(Vec3 side, Vec3 direction) { return std::abs(dot(side, direction)) <= kMostAcross; }

/// The sides at which a face ends.
class EndSides {
 public:
  EndSides(std::span<const SpaceSide> sides, const std::function<bool(CoedgeId)>& ends) {
    std::copy_if(sides.begin(), sides.end(), std::back_inserter(sides_),
                 [&](const SpaceSide& s) { return ends(s.coedge); });
    tree_ = tree_of(sides_);
  }

  /// Along the nearest one across `direction` (zero: of all) that is nearer than `reach`; zero: none is.
  Vec3 near(Vec3 x, double reach, Vec3 direction) const {
    Vec3 end;
    double nearest2 = reach * reach;
    tree_.visit_near(
        x, [&](std::int32_t, double d2) { return d2 < nearest2; },
        [&](std::int32_t i) {
          const double d2 = norm2(sides_[i].nearest_to(x) - x);
          if (!(d2 < nearest2) || !lies_across(sides_[i].along, direction)) return;
          nearest2 = d2;
          end = sides_[i].along;
        });
    return end;
  }

 private:
  std::vector<SpaceSide> sides_;
  BoxTree tree_;
};

}  // namespace

bool is_tip(const Model& model, bool is_material_ahead, const ChordEdge& trailing, std::size_t k) {
  const ModelTables& t = model.tables();
  const VertexId own = t.edge_vertices[2 * static_cast<std::size_t>(trailing.edge) + k];
  const auto is_at = [&](EdgeId e) { return t.edge_vertices[2 * e] == own || t.edge_vertices[2 * e + 1] == own; };
  const auto curve = model.curve(trailing.edge);
  const Vec3 ahead = normalized(curve->evaluate(k == 0 ? curve->t_min() : curve->t_max()).d1),
             out = k == 0 ? -ahead : ahead;
  bool faces_out = false;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const auto edges = t.edges_of(f);
    if (std::ranges::none_of(edges, is_at)) continue;
    if (std::ranges::any_of(edges, [&](EdgeId e) { return is_at(e) && t.edge_is_degenerate[e]; })) return false;
    if (std::ranges::count(edges, trailing.edge) > 0) continue;
    const auto surface = model.surface(f);
    const Vec3 n = surface_normal(*surface, closest_point(*surface, t.vertex_xyz[own]).uv);
    faces_out |= dot((t.face_is_reversed[f] != 0) != is_material_ahead ? -n : n, out) > kOutward;
  }
  return faces_out;
}

bool ends_inside(const Model& model, FaceId face, Vec3 x, double reach) {
  return std::ranges::none_of(model.tables().edges_of(face), [&](EdgeId e) {
    return !model.tables().edge_is_degenerate[e] && closest_point(*model.curve(e), x).distance <= reach;
  });
}

double most_aspect_at(Vec3 end, Vec3 direction) {
  return end != Vec3{} && lies_across(end, direction) ? kEndAspect : std::numeric_limits<double>::infinity();
}

void bound_stretch_by_widths(std::span<const SpaceSide> sides, std::size_t first, std::vector<RasterBox>& boxes) {
  const std::span own = std::span(boxes).subspan(first);
  const BoxTree tree = tree_of(sides);
  for (RasterBox& box : own) {
    if (!(box.stretch.along > kLeastStretch * box.length)) continue;
    const Vec3 way(box.stretch.direction);
    std::array<double, 2> free{box.stretch.along, box.stretch.along};  // behind and ahead
    tree.visit_near(
        box.center, [&](std::int32_t, double d2) { return d2 < free[0] * free[0] || d2 < free[1] * free[1]; },
        [&](std::int32_t i) {
          const Vec3 to = sides[i].nearest_to(box.center) - box.center;
          const double along = dot(to, way);
          if (!lies_across(sides[i].along, way) || std::abs(along) < kAhead * norm(to)) return;
          double& room = free[along > 0 ? 1 : 0];
          room = std::min(room, std::abs(along));
        });
    const double width = free[0] + free[1];
    if (width < box.stretch.along)
      box.stretch.along = static_cast<float>(width > kLeastStretch * box.length ? width : 0);
  }
}

void bound_stretch_at_ends(std::span<const SpaceSide> sides, const std::function<bool(CoedgeId)>& ends,
                           std::size_t first, std::vector<RasterBox>& boxes, std::vector<GapPatch>& patches) {
  const EndSides of_face(sides, ends);
  for (RasterBox& box : std::span(boxes).subspan(first)) {
    const double most = kEndAspect * box.length;
    if (box.stretch.along > most && of_face.near(box.center, 2 * box.half, Vec3(box.stretch.direction)) != Vec3{})
      box.stretch.along = static_cast<float>(most);
  }
  for (GapPatch& p : patches)
    if (p.stretch.max_aspect > kEndAspect)
      p.end = of_face.near(p.shape.x, std::hypot(p.shape.s_hi - p.shape.s_lo, p.shape.t_hi - p.shape.t_lo), p.way);
}

}  // namespace st
