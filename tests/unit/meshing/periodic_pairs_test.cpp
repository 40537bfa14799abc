#include "meshing/topology/periodic_pairs.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "meshing/topology/pair_search.h"
#include "support/shapes.h"

namespace st {
namespace {

std::string refusal(const Model& model, std::vector<FacePair> pairs) {
  try {
    const PeriodicPairs made(model, std::move(pairs));
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kGeometry);
    return e.what();
  }
  return "";
}

TEST(PeriodicPairs, give_each_edge_and_vertex_of_a_box_one_leader) {
  const Model box = test::make_model("box");
  const PeriodicPairs pairs(box, find_pairs(box));
  int n_leaders = 0, n_followers = 0;
  for (const PairFollower& e : pairs.edges()) ++(e.leader == kNone ? n_leaders : n_followers);
  EXPECT_EQ(n_leaders, 3);
  EXPECT_EQ(n_followers, 9);
  for (VertexId v = 1; v < box.tables().n_vertices(); ++v) EXPECT_EQ(pairs.vertices()[v].leader, 0);
  for (VertexId v = 0; v < box.tables().n_vertices(); ++v)
    EXPECT_LT(distance(pairs.vertex_xyz()[v], box.tables().vertex_xyz[v]), 1e-12);
}

TEST(PeriodicPairs, refuse_a_motion_that_misses_and_say_how_far) {
  const Model box = test::make_model("box");
  std::vector<FacePair> found = find_pairs(box);
  found[0].motion.translation += Vec3{0.5, 0, 0};
  const std::string said = refusal(box, {found[0]});
  EXPECT_NE(said.find("0.5 off"), std::string::npos) << said;
  EXPECT_NE(said.find("pair of face"), std::string::npos) << said;
}

TEST(PeriodicPairs, refuse_a_face_in_two_pairs_and_motions_that_contradict_each_other) {
  const Model box = test::make_model("box");
  std::vector<FacePair> found = find_pairs(box);
  EXPECT_NE(refusal(box, {found[0], found[0]}).find("another pair"), std::string::npos);
  EXPECT_NE(refusal(box, {{0, 0, {}}}).find("no partner of itself"), std::string::npos);
  found[0].motion = rotation_about({0, 0, 1}, 1e-8).then(found[0].motion);
  EXPECT_NE(refusal(box, found).find("contradict"), std::string::npos);
}

TEST(PeriodicPairs, put_vertices_of_the_axis_onto_it) {
  Model pie = test::make_model("pie");
  ModelTables t = pie.tables();
  const std::vector<FacePair> found = find_pairs(pie);
  for (Vec3& x : t.vertex_xyz)
    if (x.x * x.x + x.y * x.y < 1) x += Vec3{1e-6, 2e-6, 0};
  const Model moved(t, pie.brep());
  const PeriodicPairs pairs(moved, found);
  int n = 0;
  for (VertexId v = 0; v < t.n_vertices(); ++v) {
    const Vec3 x = pairs.vertex_xyz()[v];
    if (x.x * x.x + x.y * x.y > 1) continue;
    EXPECT_LT(std::abs(x.x) + std::abs(x.y), 1e-14);
    ++n;
  }
  EXPECT_EQ(n, 2);
}

TEST(PeriodicPairs, heed_the_rounding_of_large_coordinates) {
  std::vector<FacePair> found = find_pairs(test::make_model("pie"));
  for (FacePair& p : found) p.motion = p.motion.about({1e5, 7e4, 0});
  EXPECT_EQ(refusal(test::make_model("pie_off_axis"), found), "");
}

TEST(PeriodicPairs, leave_merged_features_elsewhere_and_drop_their_own) {
  const Model box = test::make_model("box");
  MergedFeatures merged;
  merged.edge = {0};
  const PeriodicPairs pairs(box, find_pairs(box));
  EXPECT_TRUE(without_paired(merged, pairs, box.tables()).edge.empty());
  EXPECT_EQ(without_paired(merged, {}, box.tables()).edge.size(), 1u);
  EXPECT_EQ(without_paired(merged, pairs, box.tables()).pairs.size(), 3u);
}

}  // namespace
}  // namespace st
