#include "geometry/facet/facet_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

std::int32_t count_faces(const FacetMesh& mesh) { return 1 + *std::max_element(mesh.face.begin(), mesh.face.end()); }

TEST(FacetFaces, are_parted_where_facets_turn_sharply) {
  EXPECT_EQ(count_faces(find_smooth_faces(test::cube_facets(), radians(40))), 6);
  EXPECT_EQ(count_faces(find_smooth_faces(test::cube_facets(), radians(91))), 1);
  EXPECT_EQ(count_faces(find_smooth_faces(test::drum_facets(30, 2), radians(40))), 3);
  EXPECT_EQ(count_faces(find_smooth_faces(test::sphere_facets(12), radians(40))), 1);
}

TEST(FacetFaces, are_parted_between_parts) {
  FacetInput sphere = test::sphere_facets(12);
  for (std::size_t t = 0; t < sphere.part.size() / 2; ++t) sphere.part[t] = 1;
  EXPECT_EQ(count_faces(find_smooth_faces(sphere, radians(40))), 2);
}

TEST(FacetFaces, are_not_parted_by_needles) {
  FacetInput in;
  in.x = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 1e-6}, {0.5, 1, 0}, {0.5, -1, 0}};  // a needle that stands upright
  in.corners = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 4}};
  in.part.assign(4, 0);
  in.part_name = {""};
  EXPECT_EQ(count_faces(find_smooth_faces(in, radians(20))), 1);
}

// Of a wing of span 10: a needle along the trailing edge, of which the lower side has a node 0.003 before it.
TEST(FacetFaces, end_at_the_trailing_edge_that_a_needle_lies_along) {
  FacetInput in;
  in.x = {{1, 0, 0}, {1, 10, 0}, {0.997, 6, -0.0003}, {0, 5, 0.1}, {0, 0, -0.1}, {0, 10, -0.1}};
  in.corners = {{0, 1, 3}, {1, 0, 2}, {2, 0, 4}, {2, 4, 5}, {1, 2, 5}};
  in.part.assign(in.corners.size(), 0);
  in.part_name = {""};
  const FacetMesh mesh = find_smooth_faces(in, radians(40));
  EXPECT_EQ(count_faces(mesh), 2);
  for (const std::size_t t : {2, 3, 4}) EXPECT_EQ(mesh.face[t], mesh.face[1]);
}

// A cone whose tip is one facet: that turns by 37 degrees from those around, and these by 18 from each other.
TEST(FacetFaces, are_not_parted_around_a_single_facet) {
  FacetInput in;
  for (int k = 0; k < 12; ++k) in.x.push_back({std::cos(k * kPi / 6), std::sin(k * kPi / 6), 0});
  for (int j = 0; j < 3; ++j) in.x.push_back({0.1 * in.x[4 * j].x, 0.1 * in.x[4 * j].y, 0.7});
  for (int k = 0; k < 12; ++k) {
    const int tip = 12 + (k + 2) / 4 % 3;
    in.corners.push_back({k, (k + 1) % 12, tip});
    if (k % 4 == 2) in.corners.push_back({k, tip, 12 + (tip - 12 + 2) % 3});
  }
  in.corners.push_back({12, 13, 14});
  in.part.assign(in.corners.size(), 0);
  in.part_name = {""};
  const FacetMesh mesh = find_smooth_faces(in, radians(30));
  EXPECT_EQ(count_faces(mesh), 1);
  for (const auto& is_line : mesh.is_line) EXPECT_EQ(is_line[1] + is_line[2], 0);
}

// A plate with a crease of 60 degrees that fades out.
FacetInput creased(int n_creased) {
  FacetInput in = test::grid_facets(100, 4, [=](int i, int j) {
    return Vec3{0.02 * i, 0.02 * (j - 2), j == 2 && i >= 1 && i <= n_creased ? 0.010 : 0.0};
  });
  return in;
}

TEST(FacetLines, that_end_inside_a_face_stay_where_they_are_long) {
  const auto n_lines = [](const FacetMesh& m) {
    std::ptrdiff_t n = 0;
    const auto neighbours = find_neighbours(m.corners);
    for (std::size_t t = 0; t < m.corners.size(); ++t)
      for (int k = 0; k < 3; ++k) n += m.is_line[t][k] && neighbours[t][k] != kNone;
    return n;
  };
  EXPECT_GE(n_lines(find_smooth_faces(creased(30), radians(40))), 2 * 26);
  EXPECT_EQ(n_lines(find_smooth_faces(creased(1), radians(40))), 0);
}

}  // namespace
}  // namespace st
