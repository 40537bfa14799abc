// Faces that fail, and what is said of them.
#include "meshing/engine/face_rounds.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "mesh/checks.h"
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
  ASSERT_EQ(r.attempts.size(), 1u);
  EXPECT_EQ(r.attempts[0].face(), top);
  EXPECT_FALSE(r.attempts[0].patch.inner_xyz.empty());
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

TEST(FaceRounds, close_a_face_whose_loop_crosses_itself) {
  const test::Meshed meshed("crossed_loop", 2);
  const MeshResult& r = meshed.result;
  ASSERT_EQ(r.failures.size(), 1u);
  EXPECT_TRUE(r.failures[0].is_closed);
  EXPECT_FALSE(r.failures[0].is_near) << "half of it is turned over";
  ASSERT_EQ(r.attempts.size(), 1u);
  EXPECT_EQ(r.attempts[0].face(), r.failures[0].face);
  for (const FacePatch& p : r.patches) EXPECT_FALSE(p.triangles.empty());
}

/// Of a damaged surface: that smaller triangles fold as well takes rounds to see.
TEST(FaceRounds, leave_a_face_that_folds_as_it_is_where_that_does_not_matter) {
  MeshOptions options;
  options.mends_faces = false;
  const test::Meshed meshed("folded_sheet", 1, options);
  EXPECT_EQ(meshed.result.n_rounds, 1);
  EXPECT_EQ(meshed.result.n_refinements, 0);
  EXPECT_FALSE(meshed.result.folds.empty());
  EXPECT_TRUE(meshed.result.failures.empty());
}

}  // namespace
}  // namespace st
