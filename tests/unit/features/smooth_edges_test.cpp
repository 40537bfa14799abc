// Edges across which the surface goes on smoothly.
#include "features/smooth_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace st {
namespace {

std::ptrdiff_t count_smooth(const std::string& shape) {
  const std::vector<std::uint8_t> is_smooth = find_smooth_edges(test::make_model(shape));
  return std::count(is_smooth.begin(), is_smooth.end(), 1);
}

TEST(SmoothEdges, are_none_of_a_box) { EXPECT_EQ(count_smooth("box"), 0); }

TEST(SmoothEdges, are_the_seams_of_a_torus) { EXPECT_EQ(count_smooth("torus"), 2); }

TEST(SmoothEdges, are_all_cuts_of_a_wing_but_not_its_rims_and_trailing_edge) {
  const Model model = test::make_model("wing_of_8");
  const std::vector<std::uint8_t> is_smooth = find_smooth_edges(model);
  const ModelTables& t = model.tables();
  ASSERT_EQ(t.n_faces(), 10);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const Vec3 a = t.vertex_xyz[t.edge_vertices[2 * e]], b = t.vertex_xyz[t.edge_vertices[2 * e + 1]];
    const bool is_rim = a.z == b.z && (a.z == 0 || a.z == 30);
    const bool is_trailing = std::min(a.x, b.x) > 9.99;
    EXPECT_EQ(is_smooth[e] != 0, !is_rim && !is_trailing) << "edge " << e + 1;
  }
}

TEST(SmoothEdges, are_told_apart_half_way) {
  const Model model = test::make_model("cylinder");
  const ModelTables& t = model.tables();
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  int n_smooth = 0;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const auto begin = faces.begin() + offsets[e];
    const bool is_smooth = is_smooth_half_way(model, e, {begin, faces.begin() + offsets[e + 1]}, radians(30));
    EXPECT_EQ(is_smooth, *begin == *(begin + 1)) << "the seam alone";
    n_smooth += is_smooth;
  }
  EXPECT_EQ(n_smooth, 1);
}

}  // namespace
}  // namespace st
