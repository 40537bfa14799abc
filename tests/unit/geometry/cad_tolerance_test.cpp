#include "geometry/model/cad_tolerance.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

TEST(CadTolerance, is_the_largest_of_the_face_its_edges_and_vertices) {
  ModelTables t = test::make_model("box").tables();
  const EdgeId edge = *t.edges_of(0).begin();
  const VertexId vertex = t.edge_vertices[2 * edge + 1];
  t.face_tolerance[0] = 1;
  EXPECT_EQ(cad_tolerance(t, 0), 1);
  t.edge_tolerance[edge] = 2;
  EXPECT_EQ(cad_tolerance(t, 0), 2);
  t.vertex_tolerance[vertex] = 3;
  EXPECT_EQ(cad_tolerance(t, 0), 3);
  t.face_tolerance[1] = 9;
  EXPECT_EQ(cad_tolerance(t, 0), 3) << "another face's own does not count";
}

}  // namespace
}  // namespace st
