#include "base/sparse.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(SolveSparse, gives_both_columns) {
  const std::vector<SparseEntry> matrix{{0, 0, 2}, {0, 1, 1}, {1, 1, 4}, {1, 0, -1}};
  const auto x = solve_sparse(matrix, std::vector<Vec2>{{4, 1}, {7, 4}});
  ASSERT_TRUE(x);
  EXPECT_NEAR((*x)[0].x, 1, 1e-15);
  EXPECT_NEAR((*x)[1].x, 2, 1e-15);
  EXPECT_NEAR((*x)[0].y, 0, 1e-15);
  EXPECT_NEAR((*x)[1].y, 1, 1e-15);
}

TEST(SolveSparse, refuses_what_is_singular) {
  EXPECT_FALSE(solve_sparse(std::vector<SparseEntry>{{0, 0, 1}}, std::vector<Vec2>{{1, 1}, {1, 1}}));
}

TEST(SymmetricSolver, adds_entries_of_one_place_and_is_used_again) {
  SymmetricSolver solver;
  for (const double scale : {1.0, 4.0}) {
    const std::vector<SparseEntry> matrix{
        {0, 0, scale}, {0, 0, scale}, {0, 1, scale}, {1, 0, scale}, {1, 1, 3 * scale}};
    const auto x = solver.solve(matrix, std::vector<double>{4 * scale, 7 * scale});
    ASSERT_TRUE(x);
    EXPECT_NEAR((*x)[0], 1, 1e-14);
    EXPECT_NEAR((*x)[1], 2, 1e-14);
  }
}

}  // namespace
}  // namespace st
