// The edges of a loop from head to tail, none of them lost.
#include "geometry/brep/wire_walk.h"

#include <gtest/gtest.h>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

TEST(WireWalk, loses_no_edge_of_a_loop_that_passes_a_vertex_twice) {
  const ImportResult r = test::import_broken("hourglass");
  ASSERT_EQ(r.tables.n_faces(), 1);
  EXPECT_EQ(r.tables.loop_coedge_offsets, (std::vector<std::int32_t>{0, 6}));
  EXPECT_NEAR(r.tables.face_area[0], 200, 1e-9);
  EXPECT_EQ(r.n_repairs(), 0);
}

TEST(WireWalk, goes_from_head_to_tail) {
  const ImportResult r = test::import_broken("hourglass");
  const Model model(r.tables, r.brep);
  const ModelTables& t = r.tables;
  const auto end = [&](int c, int side) {
    return t.edge_vertices[2 * t.coedge_edge[c] + (side + t.coedge_is_reversed[c]) % 2];
  };
  for (int c = 0; c < 6; ++c) EXPECT_EQ(end(c, 1), end((c + 1) % 6, 0)) << c;
}

}  // namespace
}  // namespace st
