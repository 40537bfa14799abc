#include "meshing/engine/refinement_trials.h"

#include <gtest/gtest.h>

#include "mesh/checks.h"
#include "support/backward_executor.h"
#include "support/meshed.h"

namespace st {
namespace {

TEST(RefinementTrials, give_a_face_up_that_smaller_triangles_do_not_unfold) {
  set_verbosity(Verbosity::kQuiet);
  const Model model = test::make_model("folded_sheet");
  const MeshTopology topology(model.tables());
  const test::BackwardExecutor counted;
  const MeshResult r = mesh_regions(model, topology, UniformField(1), plan_all(topology), {}, counted);
  EXPECT_EQ(r.n_rounds, 3);
  EXPECT_EQ(counted.n_of["face"], 4u) << "once more without what was refined";
  EXPECT_FALSE(r.folds.empty());
  EXPECT_TRUE(r.failures.empty());
}

TEST(RefinementTrials, keep_what_refining_mended_beside_a_face_that_is_given_up) {
  const test::Meshed meshed("folded_sheet_and_pipe", 1);
  EXPECT_FALSE(meshed.result.folds.empty());
  EXPECT_EQ(meshed.result.n_crossing_pairs, 0) << "the pipe lies in the sheet's box, its walls 0.02 apart";
}

TEST(RefinementTrials, take_longer_lengths_where_rounds_refined_more_than_is_needed) {
  const test::Meshed rod("thin_cylinder", 3);
  EXPECT_GT(rod.result.n_rounds, 1);
  EXPECT_TRUE(rod.result.folds.empty() && rod.result.failures.empty());
  EXPECT_EQ(rod.result.n_crossing_pairs, 0);
  EXPECT_TRUE(check_topology(rod.mesh, edges_of(rod.mesh)).is_closed());
  EXPECT_LT(rod.mesh.n_triangles(), 140) << "172 with what the rounds refined";
}

TEST(RefinementTrials, take_longer_lengths_place_by_place) {
  const test::Meshed rod("thin_cylinder", 3), prism("shallow_prism", 3), both("rod_and_shallow_prism", 3);
  EXPECT_EQ(both.mesh.n_triangles(), rod.mesh.n_triangles() + prism.mesh.n_triangles())
      << "the prism needs what was refined";
  EXPECT_EQ(both.result.n_crossing_pairs, 0);
}

TEST(RefinementTrials, keep_what_they_refined_where_bodies_in_contact_may_cross) {
  const test::Meshed pin("thin_pin_in_block", 3);
  EXPECT_GT(pin.result.n_rounds, 1);
  EXPECT_GT(pin.mesh.n_triangles(), 800) << "638 with longer lengths";
}

}  // namespace
}  // namespace st
