// Marks: where the request changed, and only there.
#include "meshing/hole_marks.h"

#include "base/error.h"
#include "mesh/checks.h"
#include "meshing/hole_curves.h"
#include "meshing/hole_filler.h"
#include "meshing/mesh_gaps.h"
#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

TEST(HoleMarks, with_the_same_sizes_mark_nothing) {
  const BoxMesh box;
  const HoleMesh holes(box.mesh, box.model.tables());
  EXPECT_EQ(mark_holes(holes, box.wanted(box.field), {}).n_triangles(), 0);
}

TEST(HoleMarks, with_half_the_size_mark_everything) {
  const BoxMesh box;
  const HoleMesh holes(box.mesh, box.model.tables());
  const HoleMarks marks = mark_holes(holes, box.wanted(UniformField(0.5 * box.field.min_size())), {});
  EXPECT_EQ(marks.n_triangles(), box.mesh.n_triangles());
  EXPECT_EQ(std::count(marks.segment.begin(), marks.segment.end(), 1), static_cast<std::ptrdiff_t>(holes.segments.size()));
}

TEST(HoleMarks, leave_kept_faces_and_their_edges) {
  const BoxMesh box;
  const HoleMesh holes(box.mesh, box.model.tables());
  HoleMarkOptions options;
  options.keep_face.assign(6, 0);
  options.keep_face[2] = 1;
  const HoleMarks marks = mark_holes(holes, box.wanted(UniformField(0.5 * box.field.min_size())), options);
  EXPECT_EQ(marks.n_triangles(), box.mesh.n_triangles() - holes.face_size(2));
  for (CoedgeId c = box.model.tables().loop_coedge_offsets[2]; c < box.model.tables().loop_coedge_offsets[3]; ++c)
    for (const CadSegment& s : holes.segments)
      if (s.edge == box.model.tables().coedge_edge[c]) {
        EXPECT_FALSE(marks.segment[s.index]);
      }
}

/// Is every node of the triangle one that marked triangles of its face touch?
bool is_enclosed(const HoleMesh& holes, const HoleMarks& marks, TriangleId t) {
  const FaceId f = holes.mesh.triangle_face[t];
  return std::all_of(holes.mesh.triangles[t].n, holes.mesh.triangles[t].n + 3, [&](NodeId n) {
    for (TriangleId i = holes.face_begin[f]; i < holes.face_begin[f + 1]; ++i)
      if (marks.triangle[i] && std::count(holes.mesh.triangles[i].n, holes.mesh.triangles[i].n + 3, n)) return true;
    return false;
  });
}

TEST(HoleMarks, leave_no_triangle_alone_among_marked_ones) {
  const ShapeMesh box("box", 0.03);
  const HoleMesh holes(box.mesh, box.model.tables());
  HoleMarkOptions options;
  options.layers = 1;
  for (TriangleId t = 0; t < box.mesh.n_triangles(); t += 17) options.redo.push_back(t);
  const HoleMarks marks = mark_holes(holes, box.wanted(box.field), options);
  ASSERT_LT(marks.n_triangles(), box.mesh.n_triangles());
  for (TriangleId t = 0; t < box.mesh.n_triangles(); ++t) EXPECT_TRUE(marks.triangle[t] || !is_enclosed(holes, marks, t)) << t;
}

TEST(HoleMarks, take_along_a_segment_between_two_marked_ones) {
  const ShapeMesh box("box", 0.03);
  const HoleMesh holes(box.mesh, box.model.tables());
  const std::int32_t first = holes.edges.edge_offsets[0];
  ASSERT_GT(holes.edges.edge_offsets[1] - first, 8);
  std::vector<double> wanted = box.wanted(box.field);
  for (const int i : {2, 5}) wanted[holes.edge_node[first + i]] *= 0.2;  // 2-3 and 4-5 are too long for that, 3-4 is as it was
  const HoleMarks marks = mark_holes(holes, wanted, {});
  for (int i = 0; i < 8; ++i) EXPECT_EQ(marks.segment[first + i] != 0, i >= 1 && i <= 5) << i;
}

TEST(HoleMarks, leave_the_edges_of_closed_strips) {
  BoxMesh box;
  box.mesh.merged.strip_face = {0};
  box.mesh.merged.strip_kept = {0};
  box.mesh.merged.strip_closed = {2};
  box.mesh.merged.strip_is_opposed = {1};
  const HoleMesh holes(box.mesh, box.model.tables());
  const HoleMarks marks = mark_holes(holes, box.wanted(UniformField(0.5 * box.field.min_size())), {});
  for (const CadSegment& s : holes.segments) EXPECT_EQ(marks.segment[s.index] != 0, s.edge != 0 && s.edge != 2) << s.edge;
}

TEST(HoleMarks, of_a_change_below_the_threshold_are_none_whatever_the_lengths) {
  const BoxMesh box;
  const HoleMesh holes(box.mesh, box.model.tables());
  HoleMarkOptions options;
  options.too_long = 1.001;
  options.too_short = 0.999;
  const std::vector<double> wanted = box.wanted(UniformField(1.05 * box.field.min_size()));
  EXPECT_EQ(mark_holes(holes, wanted, options).n_triangles(), 0);
  options.change = 0.01;
  EXPECT_GT(mark_holes(holes, wanted, options).n_triangles(), 0);
}

TEST(HoleMarks, grow_by_the_triangles_around_within_the_face) {
  const ShapeMesh box("box", 0.03);
  const HoleMesh holes(box.mesh, box.model.tables());
  const std::vector<TriangleId> hole{holes.face_begin[3] + 20};
  HoleMarks marks;
  marks.triangle.assign(box.mesh.triangles.size(), 0);
  marks.triangle[hole[0]] = 1;
  grow_hole(holes, 3, hole, 1, marks);
  const Triangle& t = box.mesh.triangles[hole[0]];
  for (TriangleId i = 0; i < box.mesh.n_triangles(); ++i) {
    const bool touches =
        std::any_of(t.n, t.n + 3, [&](NodeId n) { return std::count(box.mesh.triangles[i].n, box.mesh.triangles[i].n + 3, n) > 0; });
    EXPECT_EQ(marks.triangle[i] != 0, touches && box.mesh.triangle_face[i] == 3) << i;
  }
}

TEST(HoleMesh, refuses_nodes_of_an_edge_out_of_order) {
  BoxMesh box;
  NodeId n = 8;  // the first two nodes inside an edge
  while (box.mesh.node_entity[n] != box.mesh.node_entity[n + 1]) ++n;
  std::swap(box.mesh.node_t[n], box.mesh.node_t[n + 1]);
  EXPECT_THROW(HoleMesh(box.mesh, box.model.tables()), Error);
}

TEST(HoleMesh, refuses_sizes_that_are_no_numbers) {
  BoxMesh box;
  box.mesh.node_size[3] = std::nan("");
  EXPECT_THROW(HoleMesh(box.mesh, box.model.tables()), Error);
}

/// The box's mesh without some of its triangles.
SurfaceMesh without_triangles(SurfaceMesh m, TriangleId begin, TriangleId end) {
  m.triangles.erase(m.triangles.begin() + begin, m.triangles.begin() + end);
  m.triangle_face.erase(m.triangle_face.begin() + begin, m.triangle_face.begin() + end);
  m.triangle_group.erase(m.triangle_group.begin() + begin, m.triangle_group.begin() + end);
  m.corner_uv.erase(m.corner_uv.begin() + 3 * begin, m.corner_uv.begin() + 3 * end);
  return m;
}

TEST(MeshGaps, are_missing_triangles_in_a_face_and_missing_faces) {
  const BoxMesh box;
  const ModelTables& t = box.model.tables();
  const HoleMesh whole(box.mesh, t);
  EXPECT_TRUE(find_open_sides(whole).empty());
  const SurfaceMesh punched = without_triangles(box.mesh, whole.face_begin[2] + 5, whole.face_begin[2] + 6);
  EXPECT_EQ(find_open_sides(HoleMesh(punched, t)).size(), 3u);
  const SurfaceMesh open = without_triangles(box.mesh, whole.face_begin[1], whole.face_begin[2]);
  const HoleMesh holes(open, t);
  EXPECT_GT(find_open_sides(holes).size(), 3u);
  for (const OpenSide& s : find_open_sides(holes)) EXPECT_FALSE(holes.segments_between(s.low, s.high).empty());
}

TEST(MeshGaps, are_none_at_the_rims_of_an_open_model) {
  const ShapeMesh plate("plate_with_hole", 0.04);
  EXPECT_TRUE(find_open_sides(HoleMesh(plate.mesh, plate.model.tables())).empty());
  TriangleId inner = 0;  // off the rims
  while (std::any_of(plate.mesh.triangles[inner].n, plate.mesh.triangles[inner].n + 3, [&](NodeId n) { return plate.mesh.node_entity_dim[n] < 2; }))
    ++inner;
  const SurfaceMesh punched = without_triangles(plate.mesh, inner, inner + 1);
  EXPECT_EQ(find_open_sides(HoleMesh(punched, plate.model.tables())).size(), 3u);
}

/// Where the sides around a node are much shorter than the size, the mesh grows from them.
void expect_sizes_of_sides(const FaceBoundary& b) {
  std::vector<double> length(b.nodes.size(), 0), n(b.nodes.size(), 0);
  for (const auto& [i, j] : b.segments)
    for (const std::int32_t k : {i, j})
      if (const double l = distance(b.nodes[i].x, b.nodes[j].x); l > 0) length[k] += l, ++n[k];
  for (std::size_t i = 0; i < n.size(); ++i) EXPECT_LE(0.6 * b.nodes[i].h * n[i], 1.0001 * length[i]);
}

/// A solid whose sizes fall towards its first vertex (at a seam, a pole or an apex where it has one), as at a corner.
class HoleFiller : public testing::TestWithParam<const char*> {};

TEST_P(HoleFiller, fills_a_corner_and_keeps_the_rest_to_the_bit) {
  const ShapeMesh box(GetParam(), 0.05);
  const ModelTables& t = box.model.tables();
  const HoleMesh holes(box.mesh, t);
  const LinearField finer(t.vertex_xyz[0], 0.3 * box.field.min_size(), 0.3);
  std::vector<double> wanted = box.wanted(finer);
  for (double& w : wanted) w = std::min(w, box.field.min_size());
  const HoleMarks marks = mark_holes(holes, wanted, {});
  ASSERT_GT(marks.n_triangles(), 0);
  ASSERT_LT(marks.n_triangles(), box.mesh.n_triangles());
  const std::vector<SegmentRun> runs = marked_runs(holes, marks);
  if (GetParam() == std::string("box")) {
    ASSERT_EQ(runs.size(), 3u) << "one on each edge at the corner";
  }
  std::vector<CurveNodes> fresh;
  for (const SegmentRun& r : runs) fresh.push_back(discretise_run(holes, r, *box.model.curve(r.edge), finer, {30, 1}));
  const EdgeUpdate update = update_edges(holes, runs, fresh);
  const HoleNumbering numbering(holes, update);
  std::vector<FacePatch> patches;
  std::vector<std::vector<HoleFill>> by_face;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    std::vector<HoleFill> fills;
    for (const HoleRim& rim : find_hole_rims(holes, marks, f)) {
      const auto surface = box.model.surface(f);
      const FaceBoundary boundary = make_hole_boundary(box.model, *surface, rim, marks, numbering, finer);
      expect_sizes_of_sides(boundary);
      FaceMesh fill = mesh_face(*surface, boundary, finer, {});
      ASSERT_EQ(fill.cause, "");
      fills.push_back(make_hole_fill(rim, boundary, std::move(fill)));
    }
    patches.push_back(make_hole_patch(f, marks, numbering, fills));
    by_face.push_back(std::move(fills));
  }
  OrientationReport report;
  const SurfaceMesh after = merge_patches({update.edges, t.vertex_xyz, t.edge_vertices, patches, t.face_group}, report);
  EXPECT_TRUE(check_topology(after).passes());
  EXPECT_EQ(check_shape(after).folds.count, 0);
  EXPECT_NEAR(measure_mesh(after).area, measure_mesh(box.mesh).area, 0.02 * measure_mesh(box.mesh).area);
  EXPECT_GT(after.n_triangles(), box.mesh.n_triangles());
  std::int64_t n_kept = 0;
  for (std::size_t i = 0; i < after.triangles.size(); ++i) {
    const TriangleId previous = after.triangle_previous[i];
    if (previous == kNone) continue;
    ++n_kept;
    for (int k = 0; k < 3; ++k) {
      const NodeId n = after.triangles[i].n[k], old = box.mesh.triangles[previous].n[k];
      EXPECT_EQ(after.node_previous[n], old);
      EXPECT_TRUE(after.node_xyz[n] == box.mesh.node_xyz[old]);
    }
  }
  EXPECT_EQ(n_kept, box.mesh.n_triangles() - marks.n_triangles());
}

INSTANTIATE_TEST_SUITE_P(, HoleFiller, testing::ValuesIn(kSolids), [](const auto& info) { return std::string(info.param); });

TEST(HoleMarks, leave_the_segments_of_kept_edges_and_redo_the_triangles_beside_them) {
  const BoxMesh box;
  const HoleMesh holes(box.mesh, box.model.tables());
  HoleMarkOptions options;
  options.keep_edge.assign(12, 0);
  options.keep_edge[3] = 1;
  const HoleMarks marks = mark_holes(holes, box.wanted(UniformField(0.5 * box.field.min_size())), options);
  EXPECT_EQ(marks.n_triangles(), box.mesh.n_triangles());
  for (const CadSegment& s : holes.segments)
    EXPECT_EQ(marks.segment[s.index] != 0, s.edge != 3) << "edge " << s.edge + 1;
}

}  // namespace
}  // namespace st::test
