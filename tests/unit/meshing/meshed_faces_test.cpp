#include "meshing/engine/meshed_faces.h"

#include <gtest/gtest.h>

#include <utility>

#include "meshing/engine/refinement_policy.h"
#include "support/backward_executor.h"
#include "support/meshed.h"
#include "unit/meshing/put_faces.h"

namespace st {
namespace {

using test::PutFaces;

TEST(MeshedFaces, go_back_to_the_patches_and_outcomes_from_before) {
  PutFaces put("box", 8);
  MeshedFaces& faces = put.faces;
  EXPECT_EQ(faces.n_bad(), 0);
  EXPECT_EQ(faces.sound_faces().size(), 6u);
  const MeshedFaces::State before = faces.state();
  FaceOutcome failed;
  failed.cause = FailureCause::kError;
  failed.n_folds = 2;
  faces.set(3, FacePlace(), failed);
  EXPECT_TRUE(faces.has_holes());
  EXPECT_EQ(faces.n_bad(), 2 + RefinementPolicy::kPerFailure);
  EXPECT_EQ(faces.sound_faces().size(), 5u);
  EXPECT_TRUE(faces.bring({3}).empty());
  faces.go_back(before);
  EXPECT_EQ(faces.n_bad(), 0);
  EXPECT_EQ(packed(faces.bring({3}).at(3)), packed(put.meshed.result.patches[3]));
}

TEST(MeshedFaces, go_back_to_the_crossings_from_before_without_a_search) {
  const test::Meshed meshed("box", 8);
  const test::BackwardExecutor counted;
  EdgeMesh edges;
  MeshedFaces faces(meshed.model, meshed.topology, counted, true, edges);
  faces.set_edges(meshed.result.edges);
  for (const FacePatch& p : meshed.result.patches) faces.put(p.face, FacePatch(p));
  FacePatch crossing = meshed.result.patches[2];
  ASSERT_FALSE(crossing.inner_xyz.empty());
  crossing.inner_xyz[0] = 2 * meshed.model.tables().box().center() - crossing.inner_xyz[0];
  faces.put(2, std::move(crossing));
  faces.search_crossings();
  const int n_pairs = faces.crossings().n_pairs();
  ASSERT_GT(n_pairs, 0);
  const MeshedFaces::PatchState before = faces.patch_state();
  faces.put(2, FacePatch(meshed.result.patches[2]));
  faces.search_crossings();
  ASSERT_EQ(faces.crossings().n_pairs(), 0);
  const std::size_t n_searches = counted.n_of["crossings"];
  ASSERT_GT(n_searches, 0u);
  faces.go_back(before);
  EXPECT_EQ(faces.crossings().n_pairs(), n_pairs);
  EXPECT_EQ(counted.n_of["crossings"], n_searches);
}

TEST(MeshedFaces, find_a_triangle_that_is_turned_over_in_a_face_under_suspicion) {
  PutFaces put("box", 8);
  MeshedFaces& faces = put.faces;
  FaceOutcome outcome;
  outcome.n_folds = 1;
  outcome.wanted = {{put.meshed.model.tables().face_box[2].center(), 1, 0}};
  faces.set(2, faces.place(2), outcome);
  FacePatch turned = put.meshed.result.patches[2];
  std::swap(turned.triangles[0].n[0], turned.triangles[0].n[1]);
  faces.put(2, std::move(turned));
  EXPECT_EQ(faces.suspects(), std::vector<FaceId>{2});
  const MeshedFaces::BadTriangles bad = faces.bad_triangles(faces.bring(faces.suspects()));
  ASSERT_EQ(bad.size(), 1u);
  EXPECT_FALSE(bad.at(2).empty());
  EXPECT_EQ(faces.bad_places().size(), 1u);
}

TEST(MeshedFaces, say_what_was_closed_and_hand_over_every_patch) {
  PutFaces put("box", 8);
  FaceOutcome failed;
  failed.cause = FailureCause::kError;
  failed.error = "no surface here";
  put.faces.set(1, FacePlace(), failed);
  put.faces.close(1, FacePatch(put.meshed.result.patches[1]), true, 0.25);
  EXPECT_FALSE(put.faces.has_holes());
  MeshResult result;
  put.faces.hand_over(PatchesGo::kToRoot, result);
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].cause, "no surface here");
  EXPECT_TRUE(result.failures[0].is_closed);
  EXPECT_EQ(result.failures[0].deviation, 0.25);
  ASSERT_EQ(result.patches.size(), 6u);
  for (const FacePatch& p : result.patches) EXPECT_FALSE(p.triangles.empty());
}

}  // namespace
}  // namespace st
