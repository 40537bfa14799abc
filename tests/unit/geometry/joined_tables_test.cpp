#include "geometry/model/joined_tables.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/geometry/consistent_model.h"
#include "unit/geometry/joined_models.h"

namespace st {
namespace {

TEST(JoinTables, keeps_tables_and_evaluators_consistent) {
  for (const char* shape : {"wing_of_2", "wing_of_8", "wing_of_200", "cylinder_of_8"}) {
    SCOPED_TRACE(shape);
    test::expect_consistent(test::Joined(shape).model, 2e-5);
  }
}

TEST(JoinTables, leaves_no_cut_of_a_wing) {
  const test::Joined joined("wing_of_200");
  const ModelTables &t = joined.model.tables(), &cad = joined.cad.tables;
  EXPECT_EQ(cad.n_faces(), 202);
  EXPECT_EQ(t.n_faces(), 202);
  const EntityCounts left = count_left(t);
  EXPECT_EQ(left.faces, 3);  // skin and two tips
  EXPECT_EQ(left.edges, 3);  // trailing edge and two rims
  EXPECT_EQ(left.vertices, 2);
  double area = 0, cad_area = 0;
  for (const double a : t.face_area) area += a;
  for (const double a : cad.face_area) cad_area += a;
  EXPECT_NEAR(area, cad_area, 1e-12 * cad_area);
  EXPECT_EQ(t.volume, cad.volume);
}

TEST(JoinTables, leave_nothing_of_what_is_in_a_lower_face_or_edge) {
  const test::Joined joined("wing_of_8");
  const ModelTables &t = joined.model.tables(), &cad = joined.cad.tables;
  const JoinedTables tables = join_tables(cad, joined.composites);
  std::vector<int> n_uses(static_cast<std::size_t>(t.n_edges()), 0);
  for (const EdgeId e : t.coedge_edge) ++n_uses[e];
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    EXPECT_EQ(t.loops(f).empty(), tables.face_of[f] != f);
    EXPECT_EQ(t.face_area[f] > 0, tables.face_of[f] == f);
  }
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    EXPECT_EQ(n_uses[e] == 0, tables.pieces_of(e).empty());
    EXPECT_EQ(t.edge_is_degenerate[e] != 0, tables.pieces_of(e).empty());
  }
}

TEST(JoinTables, of_nothing_are_those_of_the_cad) {
  const ImportResult cad = test::import_shape("wing_of_8");
  Composites none;
  none.member_offsets = none.node_offsets = none.triangle_offsets = none.rim_offsets = {0};
  const JoinedTables joined = join_tables(cad.tables, none);
  EXPECT_EQ(joined.tables.coedge_edge, cad.tables.coedge_edge);
  EXPECT_EQ(joined.tables.coedge_is_reversed, cad.tables.coedge_is_reversed);
  EXPECT_EQ(joined.tables.edge_vertices, cad.tables.edge_vertices);
  EXPECT_EQ(joined.tables.face_area, cad.tables.face_area);
  EXPECT_EQ(joined.tables.vertex_xyz.size(), cad.tables.vertex_xyz.size());
}

TEST(JoinTables, know_the_cad_behind_each_face_and_edge) {
  const test::Joined joined("wing_of_8");
  const JoinedTables tables = join_tables(joined.cad.tables, joined.composites);
  ASSERT_EQ(tables.face_of.size(), 10u);
  for (FaceId f = 0; f < 10; ++f) {
    const bool is_skin = joined.cad.tables.face_type[f] != SurfaceType::kPlane;
    EXPECT_EQ(tables.composite[tables.face_of[f]] != kNone, is_skin);
    EXPECT_EQ(tables.face_of[f], is_skin ? joined.composites.members(0).front() : f);
  }
  for (EdgeId e = 0; e < tables.tables.n_edges(); ++e)
    for (const EdgePiece& p : tables.pieces_of(e)) EXPECT_GE(p.edge, e);  // the lowest gives the number
  double length = 0, cad_length = 0;
  for (EdgeId e = 0; e < tables.tables.n_edges(); ++e)
    for (const EdgePiece& p : tables.pieces_of(e)) cad_length += joined.cad.tables.edge_length[p.edge];
  for (const double l : tables.tables.edge_length) length += l;
  EXPECT_NEAR(length, cad_length, 1e-12 * length);
}

TEST(JoinTables, end_edges_where_they_must) {
  const ImportResult cad = test::import_shape("wing_of_8");
  const Model model(cad.tables, cad.brep);
  JoinRequest request = test::curved_request(model);
  std::ranges::fill(request.must_end, 1);
  const Composites composites = find_composites(model, request).composites;
  EXPECT_TRUE(composites.joined_vertices.empty());
  const Model joined(cad.tables, cad.brep, composites);
  EXPECT_EQ(count_left(joined.tables()).faces, 3);
  EXPECT_EQ(count_left(joined.tables()).edges, 10);  // four along each rim, two along the trailing edge
  test::expect_consistent(joined, 2e-5);
}

}  // namespace
}  // namespace st
