#include "geometry/model/chart_alignment.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

TEST(ChartAlignment, has_u_where_faces_bend_least) {
  constexpr double kRadius = 10;
  const Model model = test::make_model("drilled_cylinder");
  const ModelTables& t = model.tables();
  FaceId f = 0;
  while (t.face_type[f] != SurfaceType::kCylinder || t.face_area[f] < 1000) ++f;
  const UvFacets facets =
      make_uv_facets(model, std::vector<std::uint8_t>(static_cast<std::size_t>(t.n_faces()), 1),
                     {.deflection = 1e-3 * t.reference_diagonal(), .angle = radians(12), .is_exact = true});
  std::vector<std::int32_t> triangles;
  std::vector<Corners> corners;
  std::vector<Vec2> uv(facets.x.size());
  const Vec2 turn{std::cos(0.7), std::sin(0.7)};
  for (std::int32_t i = facets.face_offsets[f]; i < facets.face_offsets[f + 1]; ++i) {
    triangles.push_back(i);
    corners.push_back(facets.corners[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 rolled{kRadius * facets.uv[i][k].x, facets.uv[i][k].y};
      uv[facets.corners[i][k]] = {dot(turn, rolled), cross(turn, rolled)};
    }
  }
  align_chart(model, facets, triangles, facets.x, corners, uv);
  ASSERT_GT(corners.size(), 10u);
  for (const Corners& c : corners)  // its axis is z
    EXPECT_NEAR(std::abs(uv[c[1]].x - uv[c[0]].x), std::abs(facets.x[c[1]].z - facets.x[c[0]].z), 1e-6);
}

}  // namespace
}  // namespace st
