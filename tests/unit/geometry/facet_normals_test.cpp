#include "geometry/facet/facet_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "geometry/facet/facet_faces.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

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

TEST(FacetNormals, are_those_of_a_cylinder_divided_at_random) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.08, 0.08);  // radians, of 0.39
  std::map<std::pair<int, int>, double> shifted;
  const FacetInput in = test::grid_facets(16, 6, [&](int i, int j) {
    const double angle = kPi / 8 * (i % 16) + shifted.try_emplace({i % 16, j}, shift(random)).first->second;
    return Vec3{7.8 * std::sin(angle), 1.0 * j, 7.8 * std::cos(angle)};
  });
  EXPECT_LT(largest_tilt(in, [](Vec3 x) { return normalized(Vec3{x.x, 0, x.z}); }), 1);  // 1.6 by weights alone
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

}  // namespace
}  // namespace st
