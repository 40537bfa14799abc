// What may be merged for meshing, at any size.
#include "meshing/topology/small_features.h"

#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

class MergedSolid : public testing::TestWithParam<const char*> {};

TEST_P(MergedSolid, keeps_two_edges_in_every_loop_whatever_the_sizes) {
  const Model model = make_model(GetParam());
  const ModelTables& t = model.tables();
  for (const double share : {0.1, 1.0, 10.0, 1000.0}) {
    const MergedFeatures merged = find_merged_features(model, UniformField(share * t.reference_diagonal()), 0.2);
    for (LoopId l = 0; l < t.n_loops(); ++l) {
      int n_before = 0, n_left = 0;
      for (const CoedgeId c : t.loop_coedges(l)) {
        if (t.edge_is_degenerate[t.coedge_edge[c]]) continue;
        ++n_before;
        n_left += !std::binary_search(merged.edge.begin(), merged.edge.end(), t.coedge_edge[c]);
      }
      EXPECT_GE(n_left, std::min(n_before, 2)) << "loop " << l << " at " << share;
    }
  }
}

TEST_P(MergedSolid, moves_no_vertex_further_than_the_bound) {
  const Model model = make_model(GetParam());
  const ModelTables& t = model.tables();
  for (double size = t.reference_diagonal(); size < 20 * t.reference_diagonal(); size *= 1.3) {
    const ModelTables meshed = MeshTopology(t, find_merged_features(model, UniformField(size), 0.2)).tables();
    std::map<VertexId, Box3> cluster;
    for (std::size_t i = 0; i < t.edge_vertices.size(); ++i)
      cluster[meshed.edge_vertices[i]].add(t.vertex_xyz[t.edge_vertices[i]]);
    for (const auto& [v, box] : cluster) EXPECT_LE(box.diagonal(), 0.2 * size) << "vertex " << v << " at " << size;
  }
}

INSTANTIATE_TEST_SUITE_P(, MergedSolid,
                         testing::Values("box", "cylinder", "drilled_block", "stepped_box", "thin_plate", "wedge_strip",
                                         "sharp_triangle"),
                         [](const auto& info) { return std::string(info.param); });

TEST(MergedEdges, are_none_when_nothing_is_to_be_merged) {
  EXPECT_TRUE(find_merged_features(make_model("stepped_box"), UniformField(1e3), 0).empty());
}

}  // namespace
}  // namespace st::test
