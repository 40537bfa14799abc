// Sewing that would change a face is taken back.
#include <gtest/gtest.h>

#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

TEST(KeptAreas, a_twisted_band_is_not_sewn_to_itself) {
  const ImportResult r = test::import_damaged("twisted_band");
  const auto found = test::findings_of(r, "repair taken back: sewn, it would have an area of 0 instead of 24");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].is_repair);
  EXPECT_NEAR(r.area, 249, 1);
  EXPECT_EQ(r.edge_uses.n_free, 4);
}

TEST(KeptAreas, what_closes_without_a_change_is_sewn) {
  for (const char* shape : {"loose_box", "closed_tube"})
    EXPECT_TRUE(test::findings_of(test::import_shape(shape), "repair taken back").empty()) << shape;
  const ImportResult r = test::import_broken("gappy_box");
  EXPECT_TRUE(test::findings_of(r, "repair taken back").empty());
}

}  // namespace
}  // namespace st
