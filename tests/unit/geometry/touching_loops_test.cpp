// Loops of a face that lie on each other become one.
#include <gtest/gtest.h>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

TEST(TouchingLoops, become_one_where_they_lie_on_each_other) {
  const ImportResult r = test::import_narrow("pocket_at_rim");
  const ModelTables& t = r.tables;
  EXPECT_EQ(t.n_faces(), 11);
  EXPECT_EQ(t.n_edges(), 25) << "one edge less, between the pocket and the side";
  EXPECT_EQ(t.loops(5).size(), 1);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.volume, 200 - 28.0 / 3, 1e-6);
  const std::vector<ImportFinding> found = test::findings_of(r, "loops rebuilt from their edges");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].size, 4, 1e-9);
}

}  // namespace
}  // namespace st
