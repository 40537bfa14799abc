#include "geometry/facet/facet_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

TEST(FacetNormals, are_those_of_the_surface_and_differ_across_lines) {
  const FacetMesh mesh = find_smooth_faces(test::drum_facets(36, 2), radians(40));
  for (std::size_t t = 0; t < mesh.corners.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vec3 n = mesh.normal[mesh.corner_normal[t][k]], x = mesh.x[mesh.corners[t][k]];
      const bool is_flank = std::abs(area_normal(mesh, static_cast<std::int32_t>(t)).z) < 1e-9;
      EXPECT_GT(dot(n, is_flank ? Vec3{x.x, x.y, 0} : Vec3{0, 0, x.z > 1 ? 1.0 : -1.0}), 0.999);
    }
}

/// Largest angle between the normals and those of a cylinder along y, at nodes that are not on the grid's rim.
double largest_tilt(const FacetInput& in, const std::function<Vec3(Vec3)>& normal_at) {
  const FacetMesh mesh = find_smooth_faces(in, radians(40));
  double largest = 0;
  for (std::size_t t = 0; t < mesh.corners.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = mesh.x[mesh.corners[t][k]];
      if (x.y > 0.1 && x.y < 5.9 && x.x > -7.9 && x.x < 7.9)
        largest = std::max(largest, angle_between(mesh.normal[mesh.corner_normal[t][k]], normal_at(x)));
    }
  return degrees(largest);
}

TEST(FacetNormals, are_those_of_a_cylinder_in_uneven_facets) {
  const std::vector<double> angle{-1.5, -1.0, -0.9, -0.4, -0.3, 0.2, 0.3, 0.8, 0.9, 1.4};
  const FacetInput in = test::grid_facets(9, 3, [&](int i, int j) {
    return Vec3{8.02 * std::sin(angle[i]), 2.0 * j, 8.02 * std::cos(angle[i])};
  });
  EXPECT_LT(largest_tilt(in, [](Vec3 x) { return normalized(Vec3{x.x, 0, x.z}); }), 1);  // 6 by the facets' angles
}

TEST(FacetNormals, are_those_of_the_plates_where_a_bend_of_three_facets_begins) {
  const double quarter = radians(30);
  const FacetInput in = test::grid_facets(5, 3, [&](int i, int j) {
    if (i == 0) return Vec3{-7, 2.0 * j, 1};
    if (i == 5) return Vec3{1, 2.0 * j, -7};
    return Vec3{std::sin((i - 1) * quarter), 2.0 * j, std::cos((i - 1) * quarter)};
  });
  const auto normal_at = [](Vec3 x) { return normalized(Vec3{std::max(x.x, 0.0), 0, std::max(x.z, 0.0)}); };
  EXPECT_LT(largest_tilt(in, normal_at), 3);  // 7.5 by the facets' angles
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
