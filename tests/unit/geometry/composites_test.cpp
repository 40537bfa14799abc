#include "geometry/model/composites.h"
#include "geometry/shape/member_map.h"

#include <gtest/gtest.h>

#include "geometry/model/joined_tables.h"
#include "unit/geometry/joined_models.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(Composites, contradict_tables_of_another_model) {
  const test::Joined joined("wing_of_8");
  EXPECT_EQ(joined.composites.contradiction(joined.cad.tables), "");
  EXPECT_NE(joined.composites.contradiction(test::import_shape("box").tables), "");
}

TEST(Composites, are_refused_where_a_column_is_damaged) {
  const test::Joined joined("wing_of_8");
  const auto damage = [&](const auto& change) {
    Composites c = joined.composites;
    change(c);
    EXPECT_NE(c.contradiction(joined.cad.tables), "");
    EXPECT_ERROR(Model(joined.cad.tables, joined.cad.brep, c), kInput, "composites");
  };
  damage([](Composites& c) { c.member[0] = 1000; });
  damage([](Composites& c) { c.member_offsets.pop_back(); });
  damage([](Composites& c) { c.joined_edges[0] = -1; });
  damage([](Composites& c) { c.node_uv.pop_back(); });
  damage([](Composites& c) { c.triangle_nodes[0][1] = 100000; });
  damage([](Composites& c) { c.triangle_face[0] = 9; });
  damage([](Composites& c) { c.triangle_uv.pop_back(); });
  damage([](Composites& c) { c.triangle_pole.pop_back(); });
  damage([](Composites& c) { c.triangle_pole[0] = kNPoleCorners; });
  damage([](Composites& c) { c.rim_coedge.pop_back(); });
  damage([](Composites& c) { c.rim_node[0] = -1; });
  damage([](Composites& c) { c.rim_triangle[0] = 100000; });
  damage([](Composites& c) { c.joined_vertices[0] = 1000; });
}

TEST(Composites, name_the_cad_face_of_a_place) {
  const test::Joined joined("wing_of_8");
  const FaceId face = join_tables(joined.cad.tables, joined.composites).face_of[joined.composites.member[0]];
  const Chart chart = joined.composites.chart(0);
  std::vector<Vec2> middles;
  for (const Corners& c : chart.corners)
    middles.push_back((1 / 3.) * (chart.uv[c[0]] + chart.uv[c[1]] + chart.uv[c[2]]));
  EXPECT_EQ(joined.model.cad_faces(face, middles), joined.composites.triangle_face);
  const FaceId tip = face == 0 ? 1 : 0;
  EXPECT_EQ(joined.model.cad_faces(tip, middles).size(), middles.size());
  EXPECT_EQ(joined.model.cad().cad_faces(5, middles)[0], 5);
}

}  // namespace
}  // namespace st
