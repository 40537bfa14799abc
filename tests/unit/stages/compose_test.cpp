#include "stages/compose.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/hdf5/artifact.h"
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
  EXPECT_LE(g.tables.n_faces(), 4);
  EXPECT_EQ(g.previous_faces.size(), 2 * static_cast<std::size_t>(g.tables.n_faces()));
}

TEST(Compose, keeps_the_cad_as_it_is_without_the_option) {
  const GeometryArtifact g = composed("wing_of_8", "none", "");
  EXPECT_TRUE(g.composites.empty());
  EXPECT_EQ(g.tables.n_faces(), 10);
}

TEST(Compose, asks_only_for_edges_that_do_harm) {
  const Model fine = test::make_model("wing_of_200"), coarse = test::make_model("cylinder_of_8");
  const JoinRequest harm = join_request(fine, true), narrow = join_request(coarse, true);  // strips of 0.16
  EXPECT_GT(std::ranges::count_if(harm.urgency, [](double u) { return u > 0; }), 100);
  EXPECT_EQ(std::ranges::count_if(narrow.urgency, [](double u) { return u > 0; }), 8);
  const JoinRequest all = join_request(coarse, false);
  EXPECT_EQ(std::ranges::count(all.may_join, 1), 8);
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

}  // namespace
}  // namespace st
