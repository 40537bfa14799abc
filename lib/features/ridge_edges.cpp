#include "features/ridge_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/model/face_coedge.h"

namespace st {
namespace {

constexpr std::array kPlaces = {0.2, 0.4, 0.6, 0.8};  // of the edge
constexpr int kMost = 3;                              // places that must agree
constexpr double kLeastLength = 2;                    // radii: shorter edges are no ridge
constexpr int kSteps = 12;                            // to either side
constexpr double kStep = 0.25;                        // of the radius
constexpr double kFlat = 0.5;                         // of the curvature on the edge: the bend has flattened out

/// Normal curvature along a unit tangent, 0 where the surface is singular.
double curvature_along(const SurfacePoint2& p, Vec3 along) {
  const auto step = tangent_step(p.du, p.dv, along);
  if (!step) return 0;
  const Vec3 second = step->x * step->x * p.duu + 2 * step->x * step->y * p.duv + step->y * step->y * p.dvv;
  return std::abs(dot(second, normalized(cross(p.du, p.dv))));
}

class RidgeFinder {
 public:
  explicit RidgeFinder(const Model& model) : model_(model), t_(model.tables()), uses_(2 * t_.edge_length.size()) {
    std::vector<std::uint8_t> n_uses(t_.edge_length.size(), 0);
    for (FaceId f = 0; f < t_.n_faces(); ++f)
      for (const CoedgeId c : t_.coedges(f))
        if (const auto e = static_cast<std::size_t>(t_.coedge_edge[c]); n_uses[e] < 2)
          uses_[2 * e + n_uses[e]++] = {f, c};
  }

  bool is_ridge(EdgeId e) const {
    int n = 0;
    for (const double share : kPlaces) n += is_ridge(e, share);
    return n >= kMost;
  }

 private:
  bool is_ridge(EdgeId e, double share) const {
    const auto curve = model_.curve(e);
    const double t = curve->t_min() + share * (curve->t_max() - curve->t_min());
    const Vec3 along = normalized(curve->evaluate(t).d1);
    for (const std::size_t k : {0, 1})
      if (!flattens_out(uses_[2 * static_cast<std::size_t>(e) + k], t, along, t_.edge_length[e])) return false;
    return true;
  }

  /// Walks into the face at a right angle to the edge.
  bool flattens_out(const FaceCoedge& use, double t, Vec3 along, double edge_length) const {
    const auto surface = model_.surface(use.face);
    Vec2 uv = model_.pcurve(use.face, use.coedge)->point(t);
    SurfacePoint2 p = surface->evaluate2(uv);
    // the face lies to the left of its loop in (u,v)
    const Vec3 way = t_.coedge_is_reversed[use.coedge] ? -along : along;
    Vec3 into = normalized(cross(cross(p.du, p.dv), way));
    const double curvature = curvature_along(p, into);
    if (!(curvature * edge_length > kLeastLength)) return false;
    for (int i = 0; i < kSteps; ++i) {
      const auto step = tangent_step(p.du, p.dv, (kStep / curvature) * into);
      if (!step) return false;
      uv = uv + *step;
      if (uv.x < surface->u_min() || uv.x > surface->u_max() || uv.y < surface->v_min() || uv.y > surface->v_max())
        return false;
      p = surface->evaluate2(uv);
      into = normalized(cross(cross(p.du, p.dv), way));
      if (curvature_along(p, into) < kFlat * curvature) return true;
    }
    return false;
  }

  const Model& model_;
  const ModelTables& t_;
  std::vector<FaceCoedge> uses_;  // [2*n_edges]
};

}  // namespace

std::vector<std::uint8_t> find_ridge_edges(const Model& model, const std::vector<std::uint8_t>& edges) {
  const RidgeFinder finder(model);
  std::vector<std::uint8_t> is_ridge(edges.size(), 0);
  for (EdgeId e = 0; e < model.tables().n_edges(); ++e)
    if (edges[e]) is_ridge[e] = finder.is_ridge(e);
  return is_ridge;
}

}  // namespace st
