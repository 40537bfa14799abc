// Small faces folded back onto a neighbour become part of it.
#include <gtest/gtest.h>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

TEST(FoldedSlivers, are_merged_into_the_neighbour_that_they_lie_on) {
  const ImportResult r = test::import_broken("folded_sliver");
  ASSERT_EQ(r.tables.n_faces(), 1);
  EXPECT_NEAR(r.area, 40 - 4.75, 1e-6) << "covered once, up to the sliver's free edges";
  EXPECT_EQ(r.edge_uses.n_free, 6);
  EXPECT_EQ(test::findings_of(r, "face folded back onto its neighbour, merged into face 1").size(), 1u);
  EXPECT_TRUE(test::findings_of(r, "faces cross").empty());
}

TEST(FoldedSlivers, are_none_where_the_face_is_large) {
  const ImportResult r = test::import_broken("folded_flap");
  EXPECT_EQ(r.tables.n_faces(), 2);
  EXPECT_TRUE(test::findings_of(r, "face folded back").empty());
}

}  // namespace
}  // namespace st
