// The mesh with its holes filled: what merging the patches of all faces would give.
#include "meshing/hole/hole_merger.h"

#include <algorithm>

#include "unit/mesh/shapes.h"
#include "unit/meshing/hole_case.h"

namespace st::test {
namespace {

class InsertedFills : public testing::TestWithParam<const char*> {};

TEST_P(InsertedFills, are_the_mesh_that_merging_the_patches_gives) {
  const ShapeMesh solid(GetParam(), 0.05);
  const LinearField finer = finer_at_a_corner(solid);
  const Refilled hole(solid, finer);
  const SurfaceMesh inserted = insert_fills(hole.numbering, hole.marks, hole.fills), merged = hole.merged();
  EXPECT_TRUE(shapes::same(inserted, merged));
  EXPECT_EQ(inserted.node_previous, merged.node_previous);
  EXPECT_EQ(inserted.triangle_previous, merged.triangle_previous);
  EXPECT_EQ(inserted.labels.face_name, solid.mesh.labels.face_name);
}

TEST_P(InsertedFills, of_no_holes_are_the_old_mesh) {
  const ShapeMesh solid(GetParam(), 0.1);
  const Refilled none(solid, solid.field, nothing_changes());
  EXPECT_TRUE(shapes::same(insert_fills(none.numbering, none.marks, none.fills), solid.mesh));
}

TEST_P(InsertedFills, leave_faces_out_and_only_their_triangles) {
  const ShapeMesh solid(GetParam(), 0.05);
  const LinearField finer = finer_at_a_corner(solid);
  const Refilled hole(solid, finer);
  const FaceId out = 0;
  const SurfaceMesh whole = insert_fills(hole.numbering, hole.marks, hole.fills),
                    part = insert_fills(hole.numbering, hole.marks, hole.fills, std::span(&out, 1));
  const auto n_out = std::count(whole.triangle_face.begin(), whole.triangle_face.end(), out);
  ASSERT_GT(n_out, 0);
  ASSERT_EQ(part.n_triangles(), whole.n_triangles() - n_out);
  for (TriangleId t = 0; t < part.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(part.node_xyz[part.triangles[t].n[k]] == whole.node_xyz[whole.triangles[n_out + t].n[k]]);
}

INSTANTIATE_TEST_SUITE_P(, InsertedFills, testing::ValuesIn(kSolids),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace st::test
