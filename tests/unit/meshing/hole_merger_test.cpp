// The mesh with its holes filled: what merging the patches of all faces would give.
#include "meshing/hole/hole_merger.h"

#include <algorithm>
#include <iterator>

#include "base/error.h"
#include "unit/mesh/shapes.h"
#include "unit/meshing/hole_case.h"

namespace st::test {
namespace {

class InsertedFills : public testing::TestWithParam<const char*> {};

TEST_P(InsertedFills, are_the_mesh_that_merging_the_patches_gives) {
  const ShapeMesh solid(GetParam(), 0.05);
  const LinearField finer = finer_at_a_corner(solid);
  const Refilled hole(solid, finer);
  const SurfaceMesh inserted = hole.inserted(), merged = hole.merged();
  EXPECT_TRUE(shapes::same(inserted, merged));
  EXPECT_EQ(inserted.node_previous, merged.node_previous);
  EXPECT_EQ(inserted.triangle_previous, merged.triangle_previous);
  EXPECT_EQ(inserted.labels.face_name, solid.mesh.labels.face_name);
}

TEST_P(InsertedFills, of_no_holes_are_the_old_mesh) {
  const ShapeMesh solid(GetParam(), 0.1);
  const Refilled none(solid, solid.field, nothing_changes());
  EXPECT_TRUE(shapes::same(none.inserted(), solid.mesh));
}

TEST_P(InsertedFills, leave_faces_out_and_only_their_triangles) {
  const ShapeMesh solid(GetParam(), 0.05);
  const LinearField finer = finer_at_a_corner(solid);
  const Refilled hole(solid, finer);
  const FaceId out = 0;
  const SurfaceMesh whole = hole.welded(), part = hole.welded(std::span(&out, 1));
  const auto n_out = std::count(whole.triangle_face.begin(), whole.triangle_face.end(), out);
  ASSERT_GT(n_out, 0);
  ASSERT_EQ(part.n_triangles(), whole.n_triangles() - n_out);
  for (TriangleId t = 0; t < part.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(part.node_xyz[part.triangles[t].n[k]] == whole.node_xyz[whole.triangles[n_out + t].n[k]]);
}

TEST_P(InsertedFills, in_patches_that_have_used_nodes_alone_and_say_what_was_before) {
  const ShapeMesh solid(GetParam(), 0.1);
  const Refilled none(solid, solid.field, nothing_changes());
  const FaceId out = 0;
  const std::vector<FacePatch> patches = none.patches(std::span(&out, 1));
  ASSERT_EQ(patches.size(), none.fills.size());
  for (FaceId f = 0; f < static_cast<FaceId>(patches.size()); ++f) {
    const FacePatch& p = patches[f];
    EXPECT_EQ(p.face, f);
    if (f == out) {
      EXPECT_TRUE(p.triangles.empty() && p.n_boundary == 0 && p.inner_xyz.empty());
      continue;
    }
    EXPECT_EQ(std::ssize(p.triangles), none.holes.face_size(f));
    EXPECT_EQ(p.triangle_previous.front(), none.holes.face_begin[f]);
    ASSERT_EQ(std::ssize(p.inner_previous), none.holes.inner_begin[f + 1] - none.holes.inner_begin[f]);
    for (std::size_t i = 0; i < p.inner_previous.size(); ++i)
      EXPECT_TRUE(p.inner_xyz[i] == solid.mesh.node_xyz[p.inner_previous[i]]);
    EXPECT_TRUE(has_all_uv(p));
  }
}

TEST(FilledPatches, refuse_triangles_with_nodes_inside_another_face) {
  ShapeMesh solid("box");
  solid.mesh.triangles.front().n[0] = static_cast<NodeId>(solid.mesh.n_nodes()) - 1;
  const HoleMesh holes(solid.mesh, solid.model.tables());
  const EdgeUpdate update = update_edges(holes, {}, EdgeMesh::of_edges(0));
  const HoleNumbering numbering(holes, update);
  std::vector<FacePatch> patches(6);
  EXPECT_THROW(add_old_patches(numbering, {}, patches), Error);
}

TEST(FilledPatches, leave_nodes_out_that_no_triangle_has) {
  ShapeMesh solid("box");
  const std::size_t n = solid.mesh.node_xyz.size();
  SurfaceMesh& m = solid.mesh;
  m.node_xyz.push_back({});
  m.node_entity_dim.push_back(static_cast<std::uint8_t>(EntityDim::kFace));
  m.node_entity.push_back(5);
  m.node_t.push_back(0);
  m.node_size.push_back(1);
  const HoleMesh holes(m, solid.model.tables());
  const EdgeUpdate update = update_edges(holes, {}, EdgeMesh::of_edges(0));
  const HoleNumbering numbering(holes, update);
  std::vector<FacePatch> patches(6);
  add_old_patches(numbering, {}, patches);
  EXPECT_EQ(weld_filled(numbering, patches).node_xyz.size(), n);
  EXPECT_EQ(std::ssize(patches[5].inner_xyz), holes.inner_begin[6] - holes.inner_begin[5] - 1);
}

INSTANTIATE_TEST_SUITE_P(, InsertedFills, testing::ValuesIn(kSolids),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace st::test
