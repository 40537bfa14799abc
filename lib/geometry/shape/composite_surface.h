// Several surfaces that go on into each other smoothly, as one: a chart whose triangles know their places on them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/shape/chart_surface.h"
#include "geometry/shape/loop_polygons.h"
#include "geometry/shape/member_map.h"
#include "geometry/shape/surface.h"

namespace st {

/// What stands under a chart.
struct CompositeSupport {
  std::vector<std::int32_t> member;            ///< [n_triangles] row of the surfaces
  std::vector<std::array<Vec2, 3>> corner_uv;  ///< [n_triangles] (u,v) of the corners on that surface
  std::vector<std::int32_t> pole;              ///< [n_triangles] PoleCorner::code() or kNone
};

/// x(u,v) = the member's surface at the image of (u,v) by its chart triangle's map: exact places and derivatives of
/// the members. Beside the patch the map of the nearest triangle goes on, up to the bounds of the member. Where two
/// members meet, x jumps by as much as the chart's sides leave the common edge, squared, times the curvature.
class CompositeSurface final : public Surface {
 public:
  /// `bounds`: u_min, u_max, v_min, v_max.
  CompositeSurface(Chart chart, CompositeSupport support, std::vector<std::unique_ptr<Surface>> members,
                   const std::array<double, 4>& bounds);

  Vec3 point(Vec2 uv) const override;
  SurfacePoint evaluate(Vec2 uv) const override;
  SurfacePoint2 evaluate2(Vec2 uv) const override { return evaluate2(place(uv)); }
  /// Of the whole patch: from the nearest facet by steps in tangent planes.
  std::optional<Vec2> exact_foot(Vec3 p) const override;
  std::optional<Vec2> foot_near(Vec3 p, Vec2 guess) const override;
  /// Whether (u,v) is in the chart, but for rounding.
  bool holds(Vec2 uv) const;
  std::unique_ptr<Surface> copy() const override;
  /// The same chart on other evaluators of the same faces.
  std::unique_ptr<CompositeSurface> with_members(std::vector<std::unique_ptr<Surface>> members) const;

  /// A place on a member.
  struct MemberPlace {
    std::int32_t triangle = kNone, member = kNone;
    Vec2 uv, along_u, along_v;  ///< derivatives by the chart's (u,v)
  };
  MemberPlace place(Vec2 uv) const;
  /// Largest length in space over length in (u,v), of the chart's flat triangles.
  double largest_stretch() const;
  /// evaluate2() at a place that place() gave.
  SurfacePoint2 evaluate2(const MemberPlace& at) const;
  std::int32_t n_members() const { return static_cast<std::int32_t>(members_.size()); }
  const Surface& member(std::int32_t i) const { return *members_[i]; }
  /// Around what the chart has of member i, in the (u,v) of that.
  std::vector<LoopSide> rim_of_member(std::int32_t i) const;
  /// Whether its normal is opposite to that of the chart, which is outward.
  bool is_member_turned(std::int32_t i) const;

 private:
  struct Data;
  CompositeSurface(std::shared_ptr<const Data> data, std::vector<std::unique_ptr<Surface>> members,
                   const std::array<double, 4>& bounds);
  std::optional<Vec2> refined(Vec3 p, std::optional<Vec2> start) const;

  std::shared_ptr<const Data> data_;  // copies share it
  std::vector<std::unique_ptr<Surface>> members_;
};

/// Places in a facet where its face is compared with it: weights of its corners.
inline constexpr std::array<std::array<double, 3>, 4> kFacetPlaces{
    {{1 / 3., 1 / 3., 1 / 3.}, {0.8, 0.1, 0.1}, {0.1, 0.8, 0.1}, {0.1, 0.1, 0.8}}};
/// Whether a facet is more than 60 degrees (84 where it is slender) off its face's normal, which has any length.
/// Needles are not.
bool is_turned(Vec3 a, Vec3 b, Vec3 c, Vec3 normal);
/// Whether no facet is turned at its places, and (u,v) stretches by 40 at most there.
bool follows_facets(const CompositeSurface& surface, const Chart& chart);

}  // namespace st
