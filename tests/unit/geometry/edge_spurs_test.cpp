// Edges that run back beside each other become one.
#include <gtest/gtest.h>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

TEST(EdgeSpurs, become_one_edge_for_all_faces) {
  const ImportResult r = test::import_narrow("wall_twice");
  EXPECT_EQ(r.tables.n_faces(), 10);
  EXPECT_EQ(r.tables.n_edges(), 22) << "two are cut, one is gone";
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, 140, 0.01);
  EXPECT_NEAR(r.volume, 30, 0.003);
  EXPECT_EQ(test::findings_of(r, "face folded back onto its neighbour, merged into face 10").size(), 1u);
  for (VertexId v = 0; v < r.tables.n_vertices(); ++v) EXPECT_LT(r.tables.vertex_tolerance[v], 0.003);
}

TEST(EdgeSpurs, stay_where_edges_run_further_apart_than_the_tolerance) {
  const ImportResult r = test::import_narrow("wall_apart");
  EXPECT_EQ(r.tables.n_faces(), 11);
  EXPECT_EQ(r.tables.n_edges(), 23);
  EXPECT_TRUE(r.is_closed);
  EXPECT_TRUE(test::findings_of(r, "face folded back").empty());
}

}  // namespace
}  // namespace st
