// Faces that cannot be meshed are taken out, by name.
#include <gtest/gtest.h>

#include "base/error.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

TEST(LeftOutFaces, are_named_and_the_others_stay) {
  const ImportResult r = test::import_damaged("no_curve_lost");
  const auto found = test::findings_of(r, "face left out");
  ASSERT_EQ(found.size(), 2u);  // the side and the upper end
  EXPECT_FALSE(found[0].is_repair);
  ASSERT_EQ(r.tables.n_faces(), 1);
  EXPECT_NEAR(r.area, 900 * kPi, 1e-3);
  const auto edges = test::findings_of(r, "edge without a curve in space: none can be made");
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_FALSE(edges[0].is_repair);
}

}  // namespace
}  // namespace st
