#include "meshing/face/row_shape.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(IsUpright, refuses_folded_and_slanted_quadrilaterals) {
  const auto at = [](double x, double y) {
    MeshNode n;
    n.p = {x, y};
    n.x = {x, y, 0};
    n.normal = {0, 0, 1};
    return n;
  };
  EXPECT_TRUE(is_upright(at(0, 0), at(3, 0), at(3, 1), at(0, 1)));
  EXPECT_FALSE(is_upright(at(0, 0), at(3, 0), at(5, 1), at(2, 1)));
  EXPECT_FALSE(is_upright(at(0, 0), at(3, 0), at(0, 1), at(3, 1)));
}

}  // namespace
}  // namespace st
