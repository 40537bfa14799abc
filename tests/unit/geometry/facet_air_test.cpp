#include "geometry/import/facet_air.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/facet/facet_faces.h"
#include "unit/geometry/facet_inputs.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

using occt::FarField;
using occt::SymmetryPlane;

const SymmetryPlane kMiddle{1, 0, 0};
const FarField kBox{FarField::Kind::kBox, 2}, kSphere{FarField::Kind::kSphere, 2};

struct Air {
  FacetMesh mesh;
  std::vector<std::string> part_name;
  std::vector<ImportFinding> findings;

  Air(const FacetInput& input, const std::optional<SymmetryPlane>& plane, const std::optional<FarField>& far)
      : mesh(find_smooth_faces(input, radians(30))), part_name(input.part_name) {
    make_flow_domain(mesh, part_name, plane, far, findings);
  }

  double volume() const {
    double sum = 0;
    for (std::int32_t t = 0; t < mesh.n_triangles(); ++t)
      sum += dot(mesh.x[mesh.corners[t][0]], area_normal(mesh, t)) / 6;
    return sum;
  }
  bool is_closed() const {
    const auto neighbours = find_neighbours(mesh.corners);
    return std::all_of(neighbours.begin(), neighbours.end(), [](const Corners& c) {
      return std::all_of(c.begin(), c.end(), [](std::int32_t t) { return t != kNone; });
    });
  }
  std::vector<std::int32_t> triangles_of(const std::string& name) const {
    std::vector<std::int32_t> own;
    for (std::int32_t t = 0; t < mesh.n_triangles(); ++t)
      if (part_name[mesh.part[t]] == name) own.push_back(t);
    return own;
  }
};

FacetInput both(FacetInput a, const FacetInput& b) {
  const auto n = static_cast<std::int32_t>(a.x.size());
  a.x.insert(a.x.end(), b.x.begin(), b.x.end());
  for (const Corners& c : b.corners) a.corners.push_back({c[0] + n, c[1] + n, c[2] + n});
  a.part.insert(a.part.end(), b.part.begin(), b.part.end());
  return a;
}

TEST(FacetAir, is_closed_and_has_the_volume_of_the_fluid) {
  const double radius = 1, diagonal = 2 * std::sqrt(3.0), half = 2 * diagonal;
  const FacetInput ball = test::sphere_facets(24, radius, {0.1, 0.23, 0});
  const double body = Air(ball, std::nullopt, std::nullopt).volume();
  const Air whole(ball, std::nullopt, kBox), cut(ball, kMiddle, kBox), round(ball, kMiddle, kSphere);
  for (const Air* air : {&whole, &cut, &round}) EXPECT_TRUE(air->is_closed());
  EXPECT_NEAR(whole.volume(), std::pow(2 * half, 3) - body, 0.01);
  const double above = Air(ball, kMiddle, std::nullopt).volume();
  EXPECT_NEAR(above, kPi * (std::pow(1.23, 2) * (3 - 1.23)) / 3, 0.05);
  EXPECT_NEAR(cut.volume(), std::pow(2 * half, 3) / 2 - above, 0.01);
  EXPECT_NEAR(round.volume(), 2.0 / 3 * kPi * std::pow(half, 3) - above, 0.003 * std::pow(half, 3));
  EXPECT_EQ(cut.findings.size(), 1U);
  EXPECT_EQ(cut.findings[0].kind, FindingKind::kCutAtSymmetry);
}

TEST(FacetAir, has_the_body_first_and_flat_symmetry_planes) {
  const Air air(test::torus_facets(48, 24), SymmetryPlane{0, 0.31, -1}, kBox);
  EXPECT_TRUE(std::is_sorted(air.mesh.face.begin(), air.mesh.face.end()));
  EXPECT_EQ(air.triangles_of("farfield").size(), 10U);
  const auto plane = air.triangles_of("symmetry");
  ASSERT_FALSE(plane.empty());
  for (const std::int32_t t : plane)
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(air.mesh.x[air.mesh.corners[t][k]].x, 0.31);
      EXPECT_EQ(air.mesh.normal[air.mesh.corner_normal[t][k]].x, 1);
    }
  for (std::int32_t t = 0; t < air.mesh.n_triangles(); ++t)
    for (const std::int32_t n : air.mesh.corners[t]) EXPECT_LE(air.mesh.x[n].x, 0.31);
}

TEST(FacetAir, takes_half_a_body_open_or_closed_at_the_plane) {
  FacetInput cube = test::cube_facets();  // a side of it lies in x = 0
  const double air = Air(cube, SymmetryPlane{0, 0, 0}, kBox).volume();
  const auto in_plane = [&](const Corners& c) {
    return std::all_of(c.begin(), c.end(), [&](std::int32_t n) { return cube.x[n].x == 0; });
  };
  std::erase_if(cube.corners, in_plane);
  cube.part.resize(cube.corners.size());
  for (Corners& c : cube.corners) std::swap(c[0], c[1]);  // and inside out
  const Air open(cube, SymmetryPlane{0, 0, 0}, kBox);
  EXPECT_TRUE(open.is_closed());
  EXPECT_NEAR(open.volume(), air, 1e-9);
  EXPECT_NEAR(Air(cube, SymmetryPlane{0, 0, 0}, std::nullopt).volume(), 1, 1e-12);
  EXPECT_ERROR(Air(cube, SymmetryPlane{1, 0.5, 0}, kBox), kGeometry, "open away from the symmetry plane: 3 sides");
  EXPECT_ERROR(Air(cube, std::nullopt, kBox), kGeometry, "the facets are open: 4 sides");
}

TEST(FacetAir, reaches_far_out) {
  const Air air(test::sphere_facets(24), kMiddle, FarField{FarField::Kind::kSphere, 1000});
  EXPECT_TRUE(air.is_closed());
}

TEST(FacetAir, leaves_out_what_no_flow_reaches) {
  const FacetInput nested = both(test::sphere_facets(16, 3), test::sphere_facets(12, 1, {0.5, 0.1, 0}));
  for (const auto& plane : {std::optional<SymmetryPlane>(), std::optional(kMiddle)}) {
    const Air air(nested, plane, kSphere), alone(test::sphere_facets(16, 3), plane, kSphere);
    EXPECT_NEAR(air.volume(), alone.volume(), 1e-9 * alone.volume());
    ASSERT_FALSE(air.findings.empty());
    EXPECT_EQ(air.findings[0].kind, FindingKind::kInnerBodyLeftOut);
  }
  const FacetInput beside = both(test::sphere_facets(16, 3), test::sphere_facets(12, 1, {4.5, 0.1, 0}));
  EXPECT_TRUE(Air(beside, std::nullopt, kBox).findings.empty());
}

TEST(FacetAir, says_where_bodies_cross_in_the_plane) {
  const FacetInput crossing = both(test::sphere_facets(16, 3), test::sphere_facets(16, 2, {3, 0, 0.2}));
  EXPECT_ERROR(Air(crossing, kMiddle, kBox), kGeometry, "outlines in the symmetry plane cross");
  EXPECT_ERROR(Air(test::sphere_facets(8, 1, {0, 9, 0}), kMiddle, kBox), kGeometry, "does not touch");
  EXPECT_ERROR(Air(test::sphere_facets(8, 1, {0, 9, 0}), SymmetryPlane{1, 0, -1}, kBox), kGeometry, "other side");
}

}  // namespace
}  // namespace st
