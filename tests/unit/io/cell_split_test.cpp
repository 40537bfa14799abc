// Cells of any kind as tetrahedra and triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "io/foreign/cell_file.h"

namespace st {
namespace {

double volume_of(const std::vector<Vec3>& x, const std::array<std::int32_t, 4>& t) {
  return std::abs(dot(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]), x[t[3]] - x[t[0]])) / 6;
}

TEST(SplitCells, fill_every_kind_however_its_nodes_are_numbered) {
  const std::vector<Vec3> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  struct Kind {
    std::int64_t type;
    std::vector<Vec3> corner;
    double volume;
  };
  const std::vector<Kind> kinds{{10, {cube[0], cube[1], cube[2], cube[4]}, 1.0 / 6},
                                {12, cube, 1},
                                {11, {cube[0], cube[1], cube[3], cube[2], cube[4], cube[5], cube[7], cube[6]}, 1},
                                {13, {cube[0], cube[1], cube[2], cube[4], cube[5], cube[6]}, 0.5},
                                {14, {cube[0], cube[1], cube[2], cube[3], cube[4]}, 1.0 / 3}};
  std::mt19937 random(7);
  for (const Kind& kind : kinds)
    for (int round = 0; round < 50; ++round) {
      std::vector<std::int32_t> number(kind.corner.size());
      for (std::size_t k = 0; k < number.size(); ++k) number[k] = static_cast<std::int32_t>(k);
      std::shuffle(number.begin(), number.end(), random);
      std::vector<Vec3> x(number.size());
      for (std::size_t k = 0; k < number.size(); ++k) x[number[k]] = kind.corner[k];
      std::vector<std::array<std::int32_t, 4>> tets;
      split_volume(kind.type, number.data(), tets);
      double volume = 0;
      for (const auto& tet : tets) volume += volume_of(x, tet);
      EXPECT_NEAR(volume, kind.volume, 1e-12) << kind.type;
    }
}

TEST(SplitCells, cut_a_common_side_alike) {
  // two boxes side by side; the lowest node of each is not on the side between them
  const std::array<std::int32_t, 8> first{0, 11, 12, 3, 4, 15, 16, 7};
  for (const auto& second :
       {std::array<std::int32_t, 8>{12, 16, 15, 11, 21, 22, 23, 2}, {15, 11, 12, 16, 21, 22, 23, 2}}) {
    const auto diagonals = [](const std::array<std::int32_t, 8>& corner) {
      std::vector<std::array<std::int32_t, 4>> tets;
      split_volume(12, corner.data(), tets);
      std::array<std::ptrdiff_t, 2> n{};
      for (const auto& tet : tets) {
        n[0] += std::ranges::count(tet, 11) && std::ranges::count(tet, 16);
        n[1] += std::ranges::count(tet, 12) && std::ranges::count(tet, 15);
      }
      return n;
    };
    EXPECT_GT(diagonals(first)[0], 0);
    EXPECT_EQ(diagonals(first)[1], 0);
    EXPECT_GT(diagonals(second)[0], 0);
    EXPECT_EQ(diagonals(second)[1], 0);
  }
}

TEST(SplitCells, quadrilaterals_are_two_triangles_without_overlap) {
  const std::int32_t quad[] = {3, 0, 1, 2}, pixel[] = {3, 0, 2, 1};
  for (const auto& [type, corner] : {std::pair{9, quad}, {8, pixel}}) {
    std::vector<std::array<std::int32_t, 3>> triangles;
    split_surface(type, corner, triangles);
    EXPECT_EQ(triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}})) << type;
  }
}

}  // namespace
}  // namespace st
