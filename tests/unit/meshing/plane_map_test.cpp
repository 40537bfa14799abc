#include "meshing/face/plane_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

/// The square [0, 5]^2, along u by a parameter that starts `slow` times as fast as it ends.
class UnevenSheet : public Surface {
 public:
  explicit UnevenSheet(double slow) : slow_(slow) { u_max_ = v_max_ = 1, u_min_ = v_min_ = 0; }
  Vec3 point(Vec2 uv) const override { return evaluate(uv).x; }
  SurfacePoint evaluate(Vec2 uv) const override {
    const double a = 10 * slow_ / (1 + slow_), b = 10 / (1 + slow_);  // dx/du at the ends
    return {{uv.x * (a + 0.5 * (b - a) * uv.x), 5 * uv.y, 0}, {a + (b - a) * uv.x, 0, 0}, {0, 5, 0}};
  }
  SurfacePoint2 evaluate2(Vec2 uv) const override {
    const SurfacePoint p = evaluate(uv);
    return {p.x, p.du, p.dv, {}, {}, {}};
  }

 private:
  double slow_;
};

TEST(PlaneMap, is_one_factor_where_derivatives_are_about_as_long_everywhere) {
  const PlaneMap plane{UnevenSheet(0.5)};
  const Vec2 p = plane.to_plane({0.3, 0.7});
  EXPECT_DOUBLE_EQ(p.x, 0.3 * plane.scale().x);
  EXPECT_DOUBLE_EQ(p.y, 0.7 * 5);
  EXPECT_DOUBLE_EQ(plane.factors({0.1, 0.1}).x, plane.factors({0.9, 0.1}).x);
}

TEST(PlaneMap, follows_the_length_where_derivatives_are_uneven) {
  const UnevenSheet sheet(0.01);
  const PlaneMap plane(sheet);
  for (const double u : {0.0, 0.01, 0.1, 0.5, 0.77, 1.0}) {
    EXPECT_NEAR(plane.to_plane({u, 0}).x, sheet.point({u, 0}).x, 0.02) << u;
    EXPECT_NEAR(plane.factors({u, 0}).x, sheet.evaluate({u, 0}).du.x, 0.2) << u;
  }
  EXPECT_DOUBLE_EQ(plane.to_plane({0, 0.5}).y, 2.5);
}

TEST(PlaneMap, goes_there_and_back) {
  const PlaneMap plane{UnevenSheet(0.001)};
  for (double u = -0.01; u < 1.02; u += 0.0037) {
    const Vec2 uv = plane.to_uv(plane.to_plane({u, 0.25}));
    EXPECT_NEAR(uv.x, u, 1e-13);
    EXPECT_NEAR(uv.y, 0.25, 1e-15);
  }
}

}  // namespace
}  // namespace st
