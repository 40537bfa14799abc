#include "geometry/model/chart_alignment.h"

#include <algorithm>
#include <cmath>

namespace st {
namespace {

/// Where the face bends least at the middle of a facet, in the plane of the chart, and how much that counts; nothing
/// where it is singular.
struct Bend {
  Vec2 way;
  double weight = 0;
};

Bend bend_of(const Surface& surface, const std::array<Vec2, 3>& own, const std::array<Vec3, 3>& x,
             const std::array<Vec2, 3>& uv) {
  const SurfacePoint2 p = surface.evaluate2((1.0 / 3) * (own[0] + own[1] + own[2]));
  const Curvature k = principal_curvature(p);
  const Vec2 e = uv[1] - uv[0], f = uv[2] - uv[0];
  const Vec3 a = x[1] - x[0], b = x[2] - x[0];
  const double det = cross(e, f);
  const auto way = tangent_step((f.y * a - e.y * b) / det, (e.x * b - f.x * a) / det, flattest_direction(p, k));
  const double length = way ? norm(*way) : 0;
  if (!(length > 0)) return {};
  return {(1 / length) * *way, norm(cross(a, b)) * (std::abs(k.k1) - std::abs(k.k2))};
}

}  // namespace

void align_chart(const Model& cad, const UvFacets& facets, std::span<const std::int32_t> triangles,
                 std::span<const Vec3> x, std::span<const Corners> corners, std::vector<Vec2>& uv) {
  double cosine = 0, sine = 0;  // of twice the angle, which is the same for both senses of a direction
  std::unique_ptr<Surface> surface;
  FaceId face = kNone;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto t = static_cast<std::size_t>(triangles[i]);
    if (facets.face[t] != face) surface = cad.surface(face = facets.face[t]);
    const auto& [a, b, c] = corners[i];
    const Bend bend = bend_of(*surface, facets.uv[t], {x[a], x[b], x[c]}, {uv[a], uv[b], uv[c]});
    cosine += bend.weight * (bend.way.x * bend.way.x - bend.way.y * bend.way.y);
    sine += bend.weight * 2 * bend.way.x * bend.way.y;
  }
  const double size = std::hypot(cosine, sine);
  if (!(size > 0) || !std::isfinite(size)) return;
  const Vec2 turn{std::sqrt(std::max(0.0, 0.5 + 0.5 * cosine / size)),
                  std::copysign(std::sqrt(std::max(0.0, 0.5 - 0.5 * cosine / size)), sine)};
  for (Vec2& q : uv) q = {dot(turn, q), cross(turn, q)};
}

}  // namespace st
