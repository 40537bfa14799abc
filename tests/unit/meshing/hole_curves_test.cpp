// Runs of segments done again between nodes that stay.
#include "meshing/hole/hole_curves.h"

#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

TEST(HoleCurves, leave_an_edge_the_segments_it_needs_counting_those_that_stay) {
  const ShapeMesh box("box", 0.05);
  const HoleMesh holes(box.mesh, box.model.tables());
  const std::int32_t first = holes.edges.edge_offsets[0], last = holes.edges.edge_offsets[1] - 1;
  ASSERT_GE(last - first, 4);
  const UniformField coarse(1e3 * box.field.min_size());
  for (const auto& [n_kept, n_segments] : {std::pair(0, 3), {1, 2}, {2, 1}, {3, 1}}) {
    const EdgeMesh n = discretise_run(holes, {0, first, last - n_kept}, *box.model.curve(0), coarse, {30, 3});
    EXPECT_EQ(static_cast<int>(n.node_t.size()) - 1, n_segments) << n_kept << " stay";
  }
}

TEST(HoleCurves, keep_the_nodes_at_the_ends_of_a_run_to_the_bit_and_give_them_the_sizes_there) {
  ShapeMesh box("box", 0.05);
  for (Vec3& x : box.mesh.node_xyz) x = x + Vec3{1e-7, 2e-7, 3e-7};  // off the curve, as meshes in single precision are
  const HoleMesh holes(box.mesh, box.model.tables());
  const std::int32_t first = holes.edges.edge_offsets[0] + 1, last = first + 2;
  const UniformField fine(0.3 * box.field.min_size());
  const std::vector<SegmentRun> runs{{0, first, last}};
  const EdgeMesh fresh = discretise_run(holes, runs[0], *box.model.curve(0), fine, {30, 1});
  EXPECT_TRUE(fresh.node_xyz.front() == holes.edges.node_xyz[first] &&
              fresh.node_xyz.back() == holes.edges.node_xyz[last]);
  EXPECT_TRUE(fresh.node_t.front() == holes.edges.node_t[first] && fresh.node_t.back() == holes.edges.node_t[last]);

  const EdgeUpdate u = update_edges(holes, runs, fresh);
  ASSERT_EQ(u.edges.edge_offsets[1] - u.edges.edge_offsets[0], holes.edges.edge_offsets[1] -
                                                                   holes.edges.edge_offsets[0] - 2 +
                                                                   static_cast<std::int32_t>(fresh.node_t.size()) - 1);
  EXPECT_EQ(u.old_to_new[first + 1], kNone) << "inside the run";
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(holes.edges.node_t.size()); ++i) {
    const std::int32_t n = u.old_to_new[i];
    if (i == first + 1) continue;
    ASSERT_NE(n, kNone);
    EXPECT_TRUE(u.edges.node_xyz[n] == holes.edges.node_xyz[i]);
    EXPECT_EQ(u.edges.node_previous[n], holes.edge_node[i]);
    EXPECT_EQ(u.edges.node_request[n], holes.edges.node_size[i]);
    EXPECT_EQ(u.edges.node_size[n], i == first || i == last ? fine.min_size() : holes.edges.node_size[i]);
  }
  for (std::int32_t n = u.old_to_new[first] + 1; n < u.old_to_new[last]; ++n)
    EXPECT_EQ(u.edges.node_previous[n], kNone);
}

}  // namespace
}  // namespace st::test
