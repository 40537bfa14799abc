// Outlines of holes.
#include "meshing/hole/hole_rim.h"

#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

struct MarkedBox {
  ShapeMesh box{"box", 0.03};
  HoleMesh holes{box.mesh, box.model.tables()};
  HoleMarks marks;

  MarkedBox() {
    marks.triangle.assign(box.mesh.triangles.size(), 0);
    marks.segment.assign(holes.edges.node_t.size(), 0);
  }
  bool has_node(TriangleId t, NodeId n) const {
    return std::count(box.mesh.triangles[t].n, box.mesh.triangles[t].n + 3, n) > 0;
  }
  int n_common(TriangleId a, TriangleId b) const {
    int n = 0;
    for (const NodeId i : box.mesh.triangles[a].n) n += has_node(b, i);
    return n;
  }
  bool is_inside(TriangleId t) const {
    return std::all_of(box.mesh.triangles[t].n, box.mesh.triangles[t].n + 3,
                       [&](NodeId n) { return n >= holes.inner_begin[0]; });
  }
  /// The first triangle of the face off its edges.
  TriangleId inside(FaceId f) const {
    TriangleId t = holes.face_begin[f];
    while (!is_inside(t)) ++t;
    return t;
  }
};

TEST(HoleRims, of_nothing_marked_are_none) {
  const MarkedBox b;
  EXPECT_TRUE(find_hole_rims(b.holes, b.marks, 0).empty());
}

TEST(HoleRims, of_one_triangle_are_its_three_sides_in_its_direction) {
  MarkedBox b;
  const TriangleId t = b.inside(2);
  b.marks.triangle[t] = 1;
  const std::vector<HoleRim> rims = find_hole_rims(b.holes, b.marks, 2);
  ASSERT_EQ(rims.size(), 1u);
  const HoleRim& rim = rims[0];
  EXPECT_FALSE(rim.is_whole_face);
  EXPECT_EQ(rim.face, 2);
  EXPECT_EQ(rim.triangles, std::vector<TriangleId>{t});
  EXPECT_EQ(rim.nodes.size(), 3u);
  EXPECT_TRUE(rim.cad_sides.empty());
  ASSERT_EQ(rim.free_sides.size(), 3u);
  std::set<std::pair<NodeId, NodeId>> sides, wanted;
  for (const HoleRim::Side& s : rim.free_sides) sides.insert({rim.nodes[s.first].id, rim.nodes[s.second].id});
  for (int k = 0; k < 3; ++k) wanted.insert({b.box.mesh.triangles[t].n[k], b.box.mesh.triangles[t].n[(k + 1) % 3]});
  EXPECT_EQ(sides, wanted);
  for (const FaceNode& n : rim.nodes) EXPECT_TRUE(n.x == b.box.mesh.node_xyz[n.id]);
}

TEST(HoleRims, of_two_neighbours_leave_out_the_side_between_them) {
  MarkedBox b;
  const TriangleId t = b.inside(1);
  TriangleId other = b.holes.face_begin[1];
  while (b.n_common(t, other) != 2) ++other;
  b.marks.triangle[t] = b.marks.triangle[other] = 1;
  const std::vector<HoleRim> rims = find_hole_rims(b.holes, b.marks, 1);
  ASSERT_EQ(rims.size(), 1u);
  EXPECT_EQ(rims[0].free_sides.size() + rims[0].cad_sides.size(), 4u);
  EXPECT_EQ(rims[0].nodes.size(), 4u);
}

TEST(HoleRims, of_triangles_that_touch_in_a_node_are_one_and_of_others_two_by_their_first_triangle) {
  for (const int common : {1, 0}) {
    MarkedBox b;
    const TriangleId t = b.inside(4);
    TriangleId other = b.holes.face_begin[5] - 1;
    while (b.n_common(t, other) != common) --other;
    b.marks.triangle[t] = b.marks.triangle[other] = 1;
    const std::vector<HoleRim> rims = find_hole_rims(b.holes, b.marks, 4);
    ASSERT_EQ(rims.size(), common ? 1u : 2u);
    EXPECT_EQ(rims[0].triangles.front(), std::min(t, other));
  }
}

TEST(HoleRims, have_sides_on_cad_edges_apart) {
  MarkedBox b;
  TriangleId t = b.holes.face_begin[0];
  while (!(b.box.mesh.triangles[t].n[0] < b.holes.inner_begin[0] &&
           b.box.mesh.triangles[t].n[1] < b.holes.inner_begin[0] &&
           !b.holes.segments_between(b.box.mesh.triangles[t].n[0], b.box.mesh.triangles[t].n[1]).empty() &&
           b.box.mesh.triangles[t].n[2] >= b.holes.inner_begin[0]))
    ++t;
  b.marks.triangle[t] = 1;
  const HoleRim rim = find_hole_rims(b.holes, b.marks, b.box.mesh.triangle_face[t]).at(0);
  ASSERT_EQ(rim.cad_sides.size(), 1u);
  EXPECT_EQ(rim.free_sides.size(), 2u);
  EXPECT_EQ(rim.nodes[rim.cad_sides[0].first].id, b.box.mesh.triangles[t].n[0]);
}

TEST(HoleRims, of_a_whole_face_say_so_and_have_no_sides) {
  MarkedBox b;
  std::fill(b.marks.triangle.begin() + b.holes.face_begin[3], b.marks.triangle.begin() + b.holes.face_begin[4], 1);
  const std::vector<HoleRim> rims = find_hole_rims(b.holes, b.marks, 3);
  ASSERT_EQ(rims.size(), 1u);
  EXPECT_TRUE(rims[0].is_whole_face);
  EXPECT_TRUE(rims[0].free_sides.empty() && rims[0].cad_sides.empty() && rims[0].nodes.empty());
  EXPECT_EQ(static_cast<TriangleId>(rims[0].triangles.size()), b.holes.face_size(3));
  EXPECT_TRUE(find_hole_rims(b.holes, b.marks, 2).empty()) << "of another face";
}

TEST(HoleRims, around_an_island_have_its_sides_too) {
  MarkedBox b;  // everything but one triangle goes
  const TriangleId island = b.inside(0);
  std::fill(b.marks.triangle.begin() + b.holes.face_begin[0], b.marks.triangle.begin() + b.holes.face_begin[1], 1);
  b.marks.triangle[island] = 0;
  const HoleRim rim = find_hole_rims(b.holes, b.marks, 0).at(0);
  EXPECT_FALSE(rim.is_whole_face);
  EXPECT_EQ(rim.free_sides.size(), 3u);
  std::size_t n_boundary = 0;
  for (const CadSegment& s : b.holes.segments)
    for (CoedgeId c = b.box.model.tables().loop_coedge_offsets[0]; c < b.box.model.tables().loop_coedge_offsets[1]; ++c)
      n_boundary += b.box.model.tables().coedge_edge[c] == s.edge;
  EXPECT_EQ(rim.cad_sides.size(), n_boundary);
}

}  // namespace
}  // namespace st::test
