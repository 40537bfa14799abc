// Polygons become triangles that cover them once.
#include "io/foreign/polygon_split.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace st {
namespace {

using Triples = std::vector<std::array<std::int64_t, 3>>;

Triples split_all(const std::vector<Vec3>& x) {
  std::vector<std::int64_t> corner(x.size());
  std::iota(corner.begin(), corner.end(), 0);
  Triples triangles;
  split_polygon(x, corner, triangles);
  return triangles;
}

double signed_area(const std::vector<Vec3>& x, const std::array<std::int64_t, 3>& t) {
  return 0.5 * cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]).z;
}

TEST(PolygonSplit, CutsTheShorterDiagonalOfAQuadrilateral) {
  const std::vector<Vec3> flat{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 1, 0}};
  const Triples triangles = split_all(flat);
  ASSERT_EQ(triangles.size(), 2u);
  for (const auto& t : triangles) {
    EXPECT_GT(signed_area(flat, t), 0);
    EXPECT_TRUE(std::count(t.begin(), t.end(), 1) == 1 && std::count(t.begin(), t.end(), 3) == 1);
  }
}

TEST(PolygonSplit, CoversADentedPolygonOnce) {
  std::vector<Vec3> star;  // a star of ten corners
  for (int k = 0; k < 10; ++k) {
    const double r = k % 2 == 0 ? 2 : 0.5, angle = k * kPi / 5;
    star.push_back({5 + r * std::cos(angle), r * std::sin(angle), 0});
  }
  const Triples triangles = split_all(star);
  ASSERT_EQ(triangles.size(), 8u);
  double area = 0, wanted = 0;
  for (const auto& t : triangles) {
    EXPECT_GT(signed_area(star, t), 0);
    area += signed_area(star, t);
  }
  for (std::size_t k = 0; k < star.size(); ++k) wanted += 0.5 * cross(star[k], star[(k + 1) % star.size()]).z;
  EXPECT_NEAR(area, wanted, 1e-12);
}

TEST(PolygonSplit, LeavesTheDentOfADartOutside) {
  const std::vector<Vec3> dart{{-1, 0, 0}, {0, -10, 0}, {1, 0, 0}, {0, -1, 0}};
  const Triples triangles = split_all(dart);
  ASSERT_EQ(triangles.size(), 2u);
  for (const auto& t : triangles) EXPECT_NEAR(signed_area(dart, t), 4.5, 1e-12);
}

TEST(PolygonSplit, PassesOverRepeatedCornersAndEndsWhereNothingFits) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}};
  Triples triangles;
  split_polygon(x, std::vector<std::int64_t>{0, 0, 1, 2, 2, 0}, triangles);
  EXPECT_EQ(triangles, (Triples{{0, 1, 2}}));
  split_polygon(x, std::vector<std::int64_t>{0, 1, 0}, triangles);
  EXPECT_EQ(triangles.size(), 1u) << "two corners are no polygon";
  split_polygon(x, std::vector<std::int64_t>{0, 1, 3, 1}, triangles);  // a line there and back
  EXPECT_EQ(triangles.size(), 3u);
}

}  // namespace
}  // namespace st
