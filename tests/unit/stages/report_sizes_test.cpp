#include "stages/report_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sizing/neighbours.h"

namespace st {
namespace {

/// The unit cube as a root of two levels: eight leaves, the first of them cut into eight again.
SizingArtifact two_levels() {
  SizingArtifact s;
  s.shape.lo = {0, 0, 0};
  s.shape.edge = 1;
  const auto key = [](std::uint64_t octant, int level) { return octant << (3 * (kMaxLevel - level)); };
  for (std::uint64_t k = 0; k < 8; ++k) s.shape.leaf_keys.push_back(key(k, 2)), s.shape.leaf_levels.push_back(2);
  for (std::uint64_t k = 1; k < 8; ++k) s.shape.leaf_keys.push_back(key(k, 1)), s.shape.leaf_levels.push_back(1);
  s.shape.node_children = {1, ~8, ~9, ~10, ~11, ~12, ~13, ~14, ~0, ~1, ~2, ~3, ~4, ~5, ~6, ~7};
  for (std::size_t leaf = 0; leaf < 15; ++leaf) {
    const float h = leaf < 8 ? 0.01F * static_cast<float>(leaf + 1) : 0.5F;
    s.lengths.cells.push_back({h, {0, 0, 0}, h});
    s.lengths.cause.push_back(leaf < 8 ? pack_cause(CauseKind::kFace, 0) : kNone);
  }
  s.scale = 2;
  s.model.edge_name = {"", "TE"};
  s.model.labels.face_name = {"WING", ""};
  return s;
}

/// Likewise, with a sample of a face near the origin and one of an edge further along y.
SizingArtifact two_samples() {
  SizingArtifact s = two_levels();
  s.numbers.far_length = 0.1;
  const Neighbours neighbours(s.shape.view());
  const std::vector<LengthSample> samples{{{0.1, 0.1, 0.1}, 0.02F, pack_cause(CauseKind::kFace, 0)},
                                          {{0.2, 0.7, 0.2}, 0.02F, pack_cause(CauseKind::kEdge, 1)}};
  s.cones = spread_cones(neighbours, samples, std::vector<float>(2, 0.2F), s.numbers.far_length, nullptr);
  return s;
}

/// Volume of the cells, of the root's.
double volume(const SliceCells& cells) {
  double sum = 0;
  for (const std::uint8_t level : cells.level) sum += std::pow(0.125, level);
  return sum;
}

TEST(SliceCells, fill_the_root_with_the_lengths_of_the_field) {
  const SliceCells cells = slice_cells(two_levels(), 100);
  ASSERT_EQ(cells.level.size(), 15U);
  EXPECT_EQ(cells.corner.size(), 45U);
  EXPECT_DOUBLE_EQ(volume(cells), 1);
  EXPECT_FLOAT_EQ(*std::min_element(cells.length.begin(), cells.length.end()), 0.02F);
  EXPECT_EQ(cells.corner[3 * 1], kCoordinateEnd / 4);  // the second octant lies one step along x
  EXPECT_EQ(cells.corner[3 * 1 + 1], 0U);
}

TEST(SliceCells, leave_out_what_is_blanked) {
  SizingArtifact s = two_levels();
  s.blanking.colour.assign(15, CellColour::kFlow);
  s.blanking.colour[14] = CellColour::kBlanked;
  EXPECT_DOUBLE_EQ(volume(slice_cells(s, 100)), 7.0 / 8);
}

TEST(SliceFrame, lies_where_the_octree_was_moved_to) {
  SizingArtifact s = two_levels();
  s.frame = parse_similarity("scale 2; translate 1 2 3", "--transform");
  const auto frame = slice_frame(s);
  EXPECT_EQ(frame["origin"].dump(), "[1.0,2.0,3.0]");
  EXPECT_EQ(frame["axes"][1].dump(), "[0.0,2.0,0.0]");
}

TEST(TriangleCauses, tell_the_own_face_from_edges_and_other_faces) {
  SurfaceMesh mesh;
  const auto add = [&](Vec3 at, FaceId face) {
    const auto n = static_cast<NodeId>(mesh.node_xyz.size());
    for (const Vec3 d : {Vec3{0, 0, 0}, Vec3{0.01, 0, 0}, Vec3{0, 0.01, 0}}) mesh.node_xyz.push_back(at + d);
    mesh.triangles.push_back({{n, n + 1, n + 2}});
    mesh.triangle_face.push_back(face);
  };
  add({0.1, 0.1, 0.1}, 0);
  add({0.1, 0.1, 0.1}, 1);
  add({0.2, 0.7, 0.2}, 0);
  add({0.7, 0.7, 0.7}, 0);
  add({0.1, 0.1, 0.1}, 0);
  const TriangleCauses causes = triangle_causes(two_samples(), mesh);
  EXPECT_EQ(causes.index, (std::vector<std::uint16_t>{0, 1, 2, 3, 0}));
  const auto reason = [&](int i) { return static_cast<SizeReason>(causes.list[i]["reason"].get<int>()); };
  EXPECT_EQ(reason(0), SizeReason::kOwnFace);
  EXPECT_EQ(reason(1), SizeReason::kOtherFace);
  EXPECT_EQ(reason(2), SizeReason::kEdge);
  EXPECT_EQ(reason(3), SizeReason::kNone);
  EXPECT_EQ(causes.list[0]["text"], "face 1 \"WING\"");
}

}  // namespace
}  // namespace st
