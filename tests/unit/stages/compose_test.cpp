#include "stages/compose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/log.h"
#include "geometry/model/joined_tables.h"
#include "io/hdf5/artifact.h"
#include "stages/cad_view.h"
#include "stages/stored_model.h"
#include "support/shapes.h"
#include "support/staged.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

GeometryArtifact composed(const std::string& shape, const std::string& word, const std::string& output) {
  const TemporaryDirectory dir;
  test::write_brep(shape, dir / "model.brep");
  ImportStageOptions o;
  o.model = dir / "model.brep";
  o.output = output.empty() ? dir / "geometry.hdf" : output;
  o.composite = word;
  run_import(o);
  return read_geometry(o.output);
}

TEST(Compose, reads_words) {
  EXPECT_FALSE(asks_for_composites("none", "a.step"));
  EXPECT_TRUE(asks_for_composites("harm", "a.step"));
  EXPECT_TRUE(asks_for_composites("smooth", "a.step"));
  EXPECT_ERROR(asks_for_composites("all", "a.step"), kUsage, "none, harm or smooth");
}

TEST(Compose, joins_the_skins_of_a_wing_and_says_so_in_the_artifact) {
  const GeometryArtifact g = composed("wing_of_200", "smooth", "");
  EXPECT_EQ(g.cad.n_faces(), 202);
  EXPECT_EQ(g.tables.n_faces(), 202);
  EXPECT_LE(count_left(g.tables).faces, 4);
  EXPECT_TRUE(g.previous_faces.empty());  // all have the numbers of the CAD
}

TEST(Compose, keeps_the_cad_as_it_is_without_the_option) {
  const GeometryArtifact g = composed("wing_of_8", "none", "");
  EXPECT_TRUE(g.composites.empty());
  EXPECT_EQ(g.tables.n_faces(), 10);
}

TEST(Compose, leaves_a_smooth_edge_where_one_face_would_be_both_sides_of_a_knife_edge) {
  const GeometryArtifact g = composed("drop_prism", "smooth", "");
  ASSERT_EQ(g.composites.size(), 1);
  EXPECT_EQ(g.composites.members(0).size(), 2u);  // of three faces around it
}

TEST(Compose, asks_only_for_edges_that_do_harm) {
  const Model fine = test::make_model("wing_of_200"), coarse = test::make_model("cylinder_of_8");
  const JoinRequest harm = join_request(fine, true), narrow = join_request(coarse, true);  // strips of 0.16
  EXPECT_GT(std::ranges::count_if(harm.urgency, [](double u) { return u > 0; }), 100);
  EXPECT_EQ(std::ranges::count_if(narrow.urgency, [](double u) { return u > 0; }), 8);
  const JoinRequest all = join_request(coarse, false);
  EXPECT_EQ(std::ranges::count(all.may_join, 1), 8);
}

TEST(Compose, sharp_corners_at_poles_do_harm) {
  const GeometryArtifact g = composed("melon", "harm", "");
  ASSERT_EQ(g.composites.size(), 2);  // the skin, and the floor, whose pieces meet in a point of a plane
  EXPECT_EQ(g.composites.member.size(), 12u);
  EXPECT_TRUE(std::ranges::any_of(g.composites.triangle_pole, [](std::int32_t pole) { return pole != kNone; }));
}

TEST(Compose, corners_where_a_hole_touches_an_edge_do_harm) {
  const GeometryArtifact g = composed("plate_of_2_with_touching_hole", "harm", "");
  EXPECT_EQ(g.composites.size(), 2);  // above and below
  EXPECT_EQ(g.composites.member.size(), 4u);
}

TEST(Compose, narrow_faces_are_no_reason_to_join_at_edges_across_them) {
  ImportResult cad = test::import_shape("cylinder_of_8");
  const Model model(cad.tables, cad.brep);
  const JoinRequest before = join_request(model, true);
  for (EdgeId e = 0; e < cad.tables.n_edges(); ++e)  // as if the strips were short, and the edges between them across
    if (before.urgency[e] > 0) cad.tables.edge_length[e] = 0.05;
  std::ranges::fill(cad.tables.face_width, 0.05);
  const JoinRequest across = join_request(Model(cad.tables, cad.brep), true);
  for (EdgeId e = 0; e < cad.tables.n_edges(); ++e) {
    if (before.urgency[e] > 0) {
      EXPECT_LT(across.urgency[e], before.urgency[e]);
    }
  }
}

TEST(Compose, leaves_narrow_faces_between_edges_that_stay_apart) {
  const Model disc = test::make_model("disc_of_16");
  EXPECT_EQ(std::ranges::count(join_request(disc, true).may_join, 1), 0);
  EXPECT_EQ(std::ranges::count(join_request(disc, false).may_join, 1), 16);
}

TEST(Compose, narrow_faces_go_on_into_narrower_ones_across_their_end) {
  const Model bar = test::make_model("bar_with_sliver_end");
  EXPECT_EQ(std::ranges::count(join_request(bar, true).may_join, 1), 4);
}

TEST(Compose, a_crescent_is_no_narrow_face) {
  const Model plate = test::make_model("crescent_between_bars");
  EXPECT_EQ(std::ranges::count(join_request(plate, true).may_join, 1), 4);  // at two tangent ends, above and below
}

TEST(Compose, says_which_harmful_edges_stay_and_why) {
  set_verbosity(Verbosity::kVerbose);
  testing::internal::CaptureStderr();
  join_request(test::make_model("disc_of_16"), true);
  const std::string said = testing::internal::GetCapturedStderr();
  set_verbosity(Verbosity::kNormal);
  EXPECT_NE(said.find(": its face is narrow between edges that stay"), std::string::npos) << said;
}

TEST(Compose, leaves_groups_and_named_edges_apart) {
  ImportResult cad = test::import_shape("cylinder_of_8");
  const JoinRequest all = join_request(Model(cad.tables, cad.brep), false);
  const auto first = static_cast<EdgeId>(std::ranges::find(all.may_join, 1) - all.may_join.begin());
  cad.tables.edge_name[first] = "kept";
  EXPECT_EQ(std::ranges::count(join_request(Model(cad.tables, cad.brep), false).may_join, 1), 7);
  cad.tables.edge_name[first].clear();
  cad.tables.labels.group_name.push_back("other");
  cad.tables.labels.group_role.push_back("wall");
  for (FaceId f = 0; f < cad.tables.n_faces(); ++f)
    if (cad.tables.face_type[f] != SurfaceType::kPlane) {
      cad.tables.labels.face_group[f] = 1;
      break;
    }
  EXPECT_EQ(std::ranges::count(join_request(Model(cad.tables, cad.brep), false).may_join, 1), 6);
}

TEST(Compose, artifacts_keep_every_bit) {
  const TemporaryDirectory dir;
  GeometryArtifact a = composed("wing_of_8", "smooth", dir / "a.hdf");
  a.previous_faces.clear();  // of the joined faces by now
  write_geometry(dir / "b.hdf", a);
  const GeometryArtifact b = read_geometry(dir / "b.hdf");
  EXPECT_EQ(a.composites.node_uv, b.composites.node_uv);
  EXPECT_EQ(a.composites.triangle_uv, b.composites.triangle_uv);
  EXPECT_EQ(a.composites.rim_t, b.composites.rim_t);
  EXPECT_EQ(a.tables.coedge_edge, b.tables.coedge_edge);
  EXPECT_EQ(a.header.content_hash, b.header.content_hash);
}

/// A wing cut into 4 x 2 pieces, as st-import has it before joining.
GeometryArtifact cut_wing_artifact() {
  ImportResult cad = test::import_shape("wing_of_8");
  GeometryArtifact geometry;
  geometry.header.tool = "st-import";
  geometry.tables = std::move(cad.tables);
  geometry.brep = std::move(cad.brep);
  return geometry;
}

TEST(Compose, says_both_numbers_of_faces) {
  GeometryArtifact geometry = cut_wing_artifact();
  const FaceId n = geometry.tables.n_faces();
  const std::string said = compose(geometry, false);
  const EntityCounts left = count_left(geometry.tables);
  EXPECT_LT(left.faces, n);
  EXPECT_EQ(geometry.cad.n_faces(), n);
  EXPECT_NE(said.find(std::to_string(left.faces) + " faces and "), std::string::npos) << said;
}

TEST(Compose, says_that_nothing_is_joined) {
  ImportResult cad = test::import_shape("box");
  GeometryArtifact geometry;
  geometry.tables = std::move(cad.tables);
  geometry.brep = std::move(cad.brep);
  EXPECT_EQ(compose(geometry, false), "no faces joined");
}

TEST(Compose, keeps_vertices_of_groups) {
  const GeometryArtifact plain = cut_wing_artifact();
  for (VertexId v = 0; v < plain.tables.n_vertices(); ++v) {
    GeometryArtifact geometry = plain;
    geometry.tables.labels.vertex_groups.push_back({"tap", "", "{}", {v}});
    compose(geometry, false);
    ASSERT_EQ(geometry.tables.labels.vertex_groups.size(), 1u);
    ASSERT_EQ(geometry.tables.labels.vertex_groups[0].ids.size(), 1u) << v;
    const VertexId now = geometry.tables.labels.vertex_groups[0].ids[0];
    EXPECT_TRUE(geometry.tables.vertex_xyz[now] == plain.tables.vertex_xyz[v]);
  }
}

TEST(Compose, findings_mark_the_face_that_theirs_is_in) {
  GeometryArtifact geometry = cut_wing_artifact();
  const FaceId n = geometry.tables.n_faces();
  for (FaceId f = 0; f < n; ++f)
    geometry.findings.push_back({FindingKind::kSliverFace, "face " + std::to_string(f + 1) + " \"S\"", {}, 0.1});
  compose(geometry, false);
  const TemporaryDirectory folder;
  const std::string path = folder / "geometry.hdf";
  write_geometry(path, geometry);
  GeometryArtifact read = read_geometry(path);
  EXPECT_EQ(read.header.schema_version, 2);
  for (FaceId f = 0; f < n; ++f) EXPECT_EQ(read.findings[f].entity, "face " + std::to_string(f + 1) + " \"S\"");
  const std::vector<ImportFinding> skin = {read.findings[3]};
  const CellView view = view_cad(stored_model(read, path).cad(), skin);
  std::set<std::int32_t> marked;
  for (std::size_t i = 0; i < view.types.size(); ++i)
    if (view.values[5].second[i] > 0 && view.values[0].second[i] == 2) marked.insert(view.values[1].second[i]);
  EXPECT_EQ(marked, (std::set<std::int32_t>{4}));
}

TEST(Compose, damaged_records_of_joined_faces_are_no_loop_without_end) {
  GeometryArtifact geometry = cut_wing_artifact();
  compose(geometry, false);
  const auto damage = [&](const auto& change) {
    Composites c = geometry.composites;
    change(c);
    EXPECT_NE(c.contradiction(geometry.cad), "");
  };
  EXPECT_EQ(geometry.composites.contradiction(geometry.cad), "");
  damage([&](Composites& c) {
    for (VertexId v = 0; v < geometry.cad.n_vertices(); ++v) c.joined_vertices.push_back(v);
  });
  damage([](Composites& c) { c.joined_edges.clear(); });
  damage([](Composites& c) { c.member[1] = c.member[0]; });
  damage([](Composites& c) { c.rim_t[1] = c.rim_t[0]; });
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  damage([&](Composites& c) { c.rim_t[1] = nothing; });
  damage([&](Composites& c) { c.uv_bounds[1] = nothing; });
  damage([&](Composites& c) { c.node_xyz[1].y = nothing; });
  damage([&](Composites& c) { c.triangle_uv[1][2].x = nothing; });
}

}  // namespace
}  // namespace st
