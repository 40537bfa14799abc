#include "meshing/engine/paired_faces.h"

#include <gtest/gtest.h>

#include "unit/meshing/paired_mesh.h"

namespace st {
namespace {

using test::FinerThere;
using test::PairedMesh;

TEST(PairedFaces, of_a_box_have_the_same_nodes_on_all_three_pairs) {
  const PairedMesh box("box", FinerThere(6, {0, 0, 0}));
  EXPECT_EQ(box.pairs.pairs().size(), 3u);
  box.expect_matched();
  EXPECT_LT(box.largest_distance(), 1e-9);
}

TEST(PairedFaces, differ_where_they_are_no_pairs) {
  const PairedMesh box("box", FinerThere(6, {0, 0, 0}));
  MeshResult apart =
      mesh_regions(box.model, box.topology, FinerThere(6, {0, 0, 0}), plan_all(box.topology), {}, test::one_rank);
  OrientationReport report;
  const SurfaceMesh mesh = test::merged(box.topology, apart, report);
  EXPECT_FALSE(match_pair(mesh, box.pairs.pairs()[0], pair_tolerance(mesh)).alone.empty());
}

TEST(PairedFaces, of_a_pie_meet_on_the_axis) {
  const PairedMesh pie("pie", FinerThere(2, {0, 0, 5}));
  pie.expect_matched();
  EXPECT_LT(pie.largest_distance(), 1e-9);
}

TEST(PairedFaces, of_a_curved_passage_lie_on_their_own_surfaces) {
  const PairedMesh passage("passage", FinerThere(3, {0, 0, 20}));
  passage.expect_matched();
  EXPECT_LT(passage.largest_distance(), 1e-6);
}

TEST(PairedFaces, have_the_same_nodes_where_faces_are_cut_into_tiles) {
  MeshOptions options;
  options.tile_triangles = 1000;
  const UniformField field(1);
  const PairedMesh box("box", field, options);
  box.expect_matched();
}

TEST(PairedFaces, that_fail_and_are_closed_are_images_as_well) {
  set_verbosity(Verbosity::kQuiet);
  const Model model = test::make_model("two_crossed_loops");
  const PeriodicPairs pairs(model, {{0, 2, {.translation = {0, 0, 5}}}, {1, 3, {.translation = {0, 0, 5}}}});
  const MeshTopology topology = PairedMesh::placed(model, pairs);
  MeshOptions options;
  options.pairs = &pairs;
  MeshResult r = mesh_regions(model, topology, UniformField(2), plan_all(topology), options, test::one_rank);
  ASSERT_EQ(r.failures.size(), 2u);
  for (const FaceFailure& f : r.failures) EXPECT_TRUE(f.is_closed) << f.face;
  OrientationReport report;
  const SurfaceMesh mesh = test::merged(topology, r, report);
  for (const FacePair& p : pairs.pairs()) {
    const PairMatch match = match_pair(mesh, p, pair_tolerance(mesh));
    EXPECT_FALSE(match.nodes.empty());
    EXPECT_TRUE(match.alone.empty());
    EXPECT_TRUE(match.triangles_alone.empty());
  }
}

TEST(PairedFaces, ask_for_smaller_sizes_on_both_sides) {
  const Model box = test::make_model("box");
  const MeshTopology topology(box.tables());
  const PeriodicPairs pairs(box, find_pairs(box));
  EdgeMesh edges;
  MeshedFaces faces(box, topology, test::one_rank, true, edges);
  const PairedFaces paired(box, topology, test::one_rank, &pairs, faces);
  EXPECT_EQ(paired.with_images({{{30, 20, 10}, 1, 0, 0, 0}}).size(), 1u) << "in the middle";
  EXPECT_EQ(paired.with_images({{{0, 20, 10}, 1, 0, 0, 0}}).size(), 2u) << "on a face";
  EXPECT_EQ(paired.with_images({{{0, 0, 0}, 1, 0, 0, 0}}).size(), 8u) << "on a corner";
}

}  // namespace
}  // namespace st
