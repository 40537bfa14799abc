// Faces that fail, and what is said of them.
#include "meshing/engine/face_rounds.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/meshed.h"

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
  rounds.report();
  ASSERT_EQ(r.failures.size(), 1u);
  const FaceId top = r.failures[0].face;
  EXPECT_GT(box.tables().face_box[top].lo.z, 19.99);
  EXPECT_FALSE(r.failures[0].cause.empty() || r.failures[0].remedy.empty());
  ASSERT_EQ(r.failed_faces.size(), 1u);
  EXPECT_EQ(r.failed_faces[0].face, top);
  EXPECT_FALSE(r.failed_faces[0].xyz.empty());
  for (FaceId f = 0; f < 6; ++f) EXPECT_EQ(r.patches[f].triangles.empty(), f == top) << f;
}

}  // namespace
}  // namespace st
