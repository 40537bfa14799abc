#include "geometry/model/select_tables.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

TEST(SelectTables, gathers_rows_and_numbers_them) {
  EXPECT_EQ(gather(std::vector<int>{1, 2, 3, 4, 5, 6}, {2, 0}, 2), (std::vector<int>{5, 6, 1, 2}));
  EXPECT_EQ(places({3, 1}, 4), (std::vector<std::int32_t>{kNone, 1, kNone, 0}));
}

TEST(SelectTables, take_edges_with_their_vertices) {
  const ModelTables cad = test::import_shape("box").tables;
  ModelTables part;
  const EdgeId e = 5;
  const std::vector<VertexId> ends{cad.edge_vertices[2 * e], cad.edge_vertices[2 * e + 1]};
  select_faces(cad, {2}, part);
  select_edges(cad, {e}, ends, part);
  EXPECT_EQ(part.edge_vertices, (std::vector<VertexId>{0, 1}));
  EXPECT_EQ(part.vertex_xyz[1], cad.vertex_xyz[ends[1]]);
  EXPECT_EQ(part.face_area, std::vector<double>{cad.face_area[2]});
}

}  // namespace
}  // namespace st
