// A triangulated patch with parameters in the plane, as a surface: geometry without CAD.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/shape/chart_topology.h"
#include "geometry/shape/surface.h"

namespace st {

/// A patch in the plane, as flatten() makes it.
struct Chart {
  std::vector<Vec3> x;           ///< [n_nodes] model unit
  std::vector<Vec3> normal;      ///< [n_nodes] unit, outward, of what facets stand for; empty: no evaluate2()
  std::vector<Vec2> uv;          ///< [n_nodes] model unit; triangles are counter-clockwise there
  std::vector<Corners> corners;  ///< [n_triangles] counter-clockwise seen from outside
};

/// The larger singular value of the map of a chart's triangle into space.
double stretch(const Chart& c, const Corners& n);

/// x(u,v) on the flat facets: in each triangle the affine map of its corners. evaluate() is exact there, and its
/// derivatives jump between triangles. Outside the patch its nearest point in the plane stands for (u,v).
/// evaluate2() is of the surface that the facets stand for, at the same place: tangents across the normal between the
/// nodes' normals, and second derivatives by the change of these, averaged at nodes by area (Rusinkiewicz 2004).
class ChartSurface final : public Surface {
 public:
  explicit ChartSurface(Chart chart);
  ~ChartSurface() override;

  Vec3 point(Vec2 uv) const override { return evaluate(uv).x; }
  SurfacePoint evaluate(Vec2 uv) const override;
  SurfacePoint2 evaluate2(Vec2 uv) const override;
  /// Of the whole patch.
  std::optional<Vec2> exact_foot(Vec3 p) const override;
  std::optional<Vec2> foot_near(Vec3 p, Vec2 guess) const override;
  /// Whether (u,v) is in the patch, but for rounding.
  bool holds(Vec2 uv) const;
  std::unique_ptr<Surface> copy() const override;

  /// The triangle that holds (u,v), or the nearest one, and the barycentric coordinates of its nearest point. Depends
  /// on (u,v) alone, not on former calls.
  struct Place {
    std::int32_t triangle = kNone;
    std::array<double, 3> weight{};
  };
  Place locate(Vec2 uv) const;

  /// No way inside a triangle is longer in space than so many times the way in (u,v); but for needles, whose plane is
  /// none of the patch's.
  double largest_stretch() const;

 private:
  struct Data;
  explicit ChartSurface(std::shared_ptr<const Data> data);
  std::shared_ptr<const Data> data_;  // copies share it
};

}  // namespace st
