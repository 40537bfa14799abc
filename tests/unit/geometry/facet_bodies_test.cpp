#include "geometry/facet/facet_bodies.h"

#include <gtest/gtest.h>

#include "geometry/facet/facet_faces.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

TEST(FacetBodies, hang_together_and_tell_inside_from_outside) {
  FacetInput in = test::sphere_facets(12, 2), cube = test::cube_facets();
  const auto n = static_cast<std::int32_t>(in.x.size()), n_sphere = static_cast<std::int32_t>(in.corners.size());
  for (const Vec3 x : cube.x) in.x.push_back(x + Vec3{5, 0, 0});
  cube.corners.pop_back();
  for (const Corners& c : cube.corners) in.corners.push_back({n + c[0], n + c[1], n + c[2]});
  in.part.resize(in.corners.size(), 0);
  const FacetMesh mesh = find_smooth_faces(in, radians(30));
  const auto bodies = find_bodies(mesh);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(static_cast<std::int32_t>(bodies[0].triangles.size()), n_sphere);
  EXPECT_FALSE(bodies[0].is_open);
  EXPECT_TRUE(bodies[1].is_open);
  EXPECT_EQ(bodies[1].box.lo.x, 5);
  EXPECT_NEAR(std::abs(winding(mesh, bodies[0], {0.3, 0.1, -0.5})), 1, 1e-9);
  EXPECT_NEAR(winding(mesh, bodies[0], {2.5, 0.1, -0.5}), 0, 1e-9);
}

}  // namespace
}  // namespace st
