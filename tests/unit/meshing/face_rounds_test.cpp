// Faces that fail, and what is said of them.
#include "meshing/engine/face_rounds.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "features/strip.h"
#include "mesh/checks.h"
#include "meshing/topology/curve_discretiser.h"
#include "support/backward_executor.h"
#include "support/meshed.h"
#include "unit/meshing/no_number.h"

namespace st {
namespace {

/// Cannot be asked inside the side z = 20 of the box 60 x 40 x 20.
class NoSizeOnTop : public UniformField {
 public:
  using SizeField::size;
  using UniformField::UniformField;
  double size(Vec3 x, int& hint) const override {
    if (x.z > 19.999 && x.x > 0.01 && x.x < 59.99 && x.y > 0.01 && x.y < 39.99)
      throw Error(ExitCode::kInternal, "no size here");
    return UniformField::size(x, hint);
  }
};

TEST(FaceRounds, name_a_face_that_failed_with_its_cause_and_mesh_the_others) {
  set_verbosity(Verbosity::kQuiet);
  const Model box = test::make_model("box");
  const MeshTopology topology(box.tables());
  const NoSizeOnTop field(4);
  MeshResult r;
  FaceRounds rounds(box, topology, field, plan_all(topology), {}, test::one_rank, r);
  rounds.run();
  rounds.report(PatchesGo::kToRoot);
  ASSERT_EQ(r.failures.size(), 1u);
  const FaceId top = r.failures[0].face;
  EXPECT_GT(box.tables().face_box[top].lo.z, 19.99);
  EXPECT_FALSE(r.failures[0].cause.empty() || r.failures[0].remedy.empty());
  ASSERT_EQ(r.failed_faces.size(), 1u);
  EXPECT_EQ(r.failed_faces[0].face, top);
  EXPECT_FALSE(r.failed_faces[0].xyz.empty());
  for (FaceId f = 0; f < 6; ++f) EXPECT_EQ(r.patches[f].triangles.empty(), f == top) << f;
}

TEST(FaceRounds, leave_out_a_face_with_numbers_that_are_none_and_name_it) {
  set_verbosity(Verbosity::kQuiet);
  const Model window = test::window_without_a_number();
  const MeshTopology topology(window.tables());
  const MeshResult r = mesh_regions(window, topology, UniformField(1), plan_all(topology), {}, test::one_rank);
  ASSERT_EQ(r.failures.size(), 1u);
  EXPECT_EQ(r.failures[0].face, 0);
  EXPECT_FALSE(r.failures[0].is_closed);
  EXPECT_TRUE(r.patches[0].triangles.empty());
}

TEST(FaceRounds, give_a_face_up_that_smaller_triangles_do_not_unfold) {
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

TEST(FaceRounds, keep_what_refining_mended_beside_a_face_that_is_given_up) {
  const test::Meshed meshed("folded_sheet_and_pipe", 1);
  EXPECT_FALSE(meshed.result.folds.empty());
  EXPECT_EQ(meshed.result.n_crossing_pairs, 0) << "the pipe lies in the sheet's box, its walls 0.02 apart";
}

TEST(FaceRounds, take_longer_lengths_where_rounds_refined_more_than_is_needed) {
  const test::Meshed rod("thin_cylinder", 3);
  EXPECT_GT(rod.result.n_rounds, 1);
  EXPECT_TRUE(rod.result.folds.empty() && rod.result.failures.empty());
  EXPECT_EQ(rod.result.n_crossing_pairs, 0);
  EXPECT_TRUE(check_topology(rod.mesh, edges_of(rod.mesh)).is_closed());
  EXPECT_LT(rod.mesh.n_triangles(), 140) << "172 with what the rounds refined";
}

TEST(FaceRounds, take_longer_lengths_place_by_place) {
  const test::Meshed rod("thin_cylinder", 3), prism("shallow_prism", 3), both("rod_and_shallow_prism", 3);
  EXPECT_EQ(both.mesh.n_triangles(), rod.mesh.n_triangles() + prism.mesh.n_triangles())
      << "the prism needs what was refined";
  EXPECT_EQ(both.result.n_crossing_pairs, 0);
}

TEST(FaceRounds, keep_what_they_refined_where_bodies_in_contact_may_cross) {
  const test::Meshed pin("thin_pin_in_block", 3);
  EXPECT_GT(pin.result.n_rounds, 1);
  EXPECT_GT(pin.mesh.n_triangles(), 800) << "638 with longer lengths";
}

TEST(FaceRounds, close_a_face_whose_loop_crosses_itself) {
  const test::Meshed meshed("crossed_loop", 2);
  const MeshResult& r = meshed.result;
  ASSERT_EQ(r.failures.size(), 1u);
  EXPECT_TRUE(r.failures[0].is_closed);
  EXPECT_FALSE(r.failures[0].is_near) << "half of it is turned over";
  ASSERT_EQ(r.failed_faces.size(), 1u);
  EXPECT_EQ(r.failed_faces[0].face, r.failures[0].face);
  for (const FacePatch& p : r.patches) EXPECT_FALSE(p.triangles.empty());
}

TEST(FaceRounds, leave_no_fold_where_the_surface_is_folded) {
  const test::Meshed meshed("crumpled", 0.5);
  ASSERT_TRUE(meshed.result.failures.empty());
  const ShapeReport shape = check_shape(meshed.mesh, edges_of(meshed.mesh));
  EXPECT_EQ(shape.folds.count, 0);
  EXPECT_EQ(shape.zero_area.count, 0);
}

/// Stretched along z; the length along grows a little with y.
class GrowingStretch : public UniformField {
 public:
  using UniformField::UniformField;
  LocalSize local(Vec3 x, int&) const override { return {min_size(), std::max(0.5, 1 + 2 * x.y), {0, 0, 1}}; }
  bool is_stretched() const override { return true; }
};

TEST(FaceRounds, give_the_two_long_edges_of_a_narrow_face_opposite_nodes_where_lengths_are_stretched) {
  set_verbosity(Verbosity::kQuiet);
  const Model wing = test::make_model("blunt_wing");
  const std::vector<Strip> strips = find_strips(wing);
  ASSERT_FALSE(strips.empty());
  const MeshTopology topology(wing.tables());
  const GrowingStretch field(0.05);
  MeshResult r;
  FaceRounds rounds(wing, topology, field, plan_all(topology), {}, test::one_rank, r);
  rounds.run();
  const auto [a, b] = std::pair{strips[0].edges[0], strips[0].edges[1]};
  const std::int32_t n = r.edges.n_nodes(a);
  ASSERT_EQ(r.edges.n_nodes(b), n);
  EXPECT_GT(n, 10);
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t k = strips[0].is_opposed ? n - 1 - i : i;
    const Vec3 x = r.edges.node_xyz[r.edges.first_node(a) + i], y = r.edges.node_xyz[r.edges.first_node(b) + k];
    EXPECT_NEAR(x.z, y.z, 1e-6);
  }
  const EdgeMesh own = discretise_curve(*wing.curve(b), field, {});
  EXPECT_NE(static_cast<std::int32_t>(own.node_t.size()), n) << "would not have been opposite anyway";
}

}  // namespace
}  // namespace st
