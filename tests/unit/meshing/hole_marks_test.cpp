// Marks: where the request changed, and only there.
#include "meshing/hole/hole_marks.h"

#include "mesh/quality.h"
#include "unit/meshing/mark_holes.h"
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
  EXPECT_EQ(std::count(marks.segment.begin(), marks.segment.end(), 1),
            static_cast<std::ptrdiff_t>(holes.segments.size()));
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
  for (TriangleId t = 0; t < box.mesh.n_triangles(); ++t)
    EXPECT_TRUE(marks.triangle[t] || !is_enclosed(holes, marks, t)) << t;
}

TEST(HoleMarks, take_along_a_segment_between_two_marked_ones) {
  const ShapeMesh box("box", 0.03);
  const HoleMesh holes(box.mesh, box.model.tables());
  const std::int32_t first = holes.edges.edge_offsets[0];
  ASSERT_GT(holes.edges.edge_offsets[1] - first, 8);
  std::vector<double> wanted = box.wanted(box.field);
  for (const int i : {2, 5})
    wanted[holes.edge_node[first + i]] *= 0.2;  // 2-3 and 4-5 are too long for that, 3-4 is as it was
  const HoleMarks marks = mark_holes(holes, wanted, {});
  for (int i = 0; i < 8; ++i) EXPECT_EQ(marks.segment[first + i] != 0, i >= 1 && i <= 5) << i;
}

/// A metric with one long direction, the same in all planes; or with none.
class OneMetric : public UniformField {
 public:
  OneMetric(double length, double along) : UniformField(length), along_(along) {}
  LocalSize local_on(Vec3, Vec3, int&) const override { return {min_size(), along_, {0, 1, 0}}; }
  bool has_metrics() const override { return true; }
  bool is_stretched() const override { return along_ > min_size(); }
  double longest() const { return along_; }

 private:
  double along_;
};

HoleMarkOptions in_metric(const OneMetric& metric, const SideRequests& along, const ShapeMesh& box) {
  HoleMarkOptions options;
  options.layers = 1;
  options.metrics = &along;
  options.most_along.assign(box.mesh.node_xyz.size(), metric.longest());
  return options;
}

TEST(HoleMarks, of_metrics_take_triangles_whose_sides_fit_but_not_their_shape) {
  ShapeMesh box("box", 0.03);
  const double size = box.field.min_size();
  const OneMetric metric(size / 1.34, 3.2 * size);
  const HoleMesh holes(box.mesh, box.model.tables());
  const auto flat = [&](TriangleId t) {
    Vec3 seen[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = box.mesh.node_xyz[box.mesh.triangles[t].n[k]];
      seen[k] = (1 / metric.min_size()) * Vec3{x.x, x.y * metric.min_size() / metric.longest(), x.z};
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (const double side = distance(seen[k], seen[(k + 1) % 3]); side < 0.7 || side > 1.4) return false;
    return triangle_quality(seen[0], seen[1], seen[2]) < 0.59;
  };
  const SideRequests along(box.mesh, 0, box.mesh.n_triangles(), {}, metric);
  HoleMarkOptions options = in_metric(metric, along, box);
  options.keep_edge.assign(static_cast<std::size_t>(box.model.tables().n_edges()), 1);
  const HoleMarks marks = mark_holes(holes, box.wanted(metric), options);
  int n_flat = 0;
  for (TriangleId t = 0; t < box.mesh.n_triangles(); ++t)
    if (flat(t)) {
      ++n_flat;
      EXPECT_TRUE(marks.triangle[t]) << t;
    }
  EXPECT_GT(n_flat, 20);
}

TEST(HoleMarks, of_metrics_leave_what_was_made_for_them) {
  ShapeMesh box("box", 0.03);
  const double side = box.field.min_size();
  const OneMetric metric(side, 3 * side);
  const SideRequests along(box.mesh, 0, box.mesh.n_triangles(), {}, metric);
  HoleMarkOptions options = in_metric(metric, along, box);
  options.was_stretched = true;
  EXPECT_EQ(mark_holes(HoleMesh(box.mesh, box.model.tables()), box.wanted(metric), options).n_triangles(), 0);
}

TEST(HoleMarks, of_metrics_take_segments_that_hold_rows_apart) {
  const ShapeMesh box("box", 0.03);
  const HoleMesh holes(box.mesh, box.model.tables());
  const OneMetric metric(box.field.min_size() / 1.3, box.field.min_size() / 1.3);
  const HoleMarks as_lengths = mark_holes(holes, box.wanted(metric), {});
  const SideRequests along(box.mesh, 0, box.mesh.n_triangles(), {}, metric);
  const HoleMarks marks = mark_holes(holes, box.wanted(metric), in_metric(metric, along, box));
  EXPECT_EQ(std::ranges::count(as_lengths.segment, 1), 0);
  EXPECT_EQ(std::ranges::count(marks.segment, 1), static_cast<std::ptrdiff_t>(holes.segments.size()));
}

TEST(HoleMarks, leave_the_edges_of_closed_strips) {
  BoxMesh box;
  box.mesh.merged.strip_face = {0};
  box.mesh.merged.strip_kept = {0};
  box.mesh.merged.strip_closed = {2};
  box.mesh.merged.strip_is_opposed = {1};
  const HoleMesh holes(box.mesh, box.model.tables());
  const HoleMarks marks = mark_holes(holes, box.wanted(UniformField(0.5 * box.field.min_size())), {});
  for (const CadSegment& s : holes.segments)
    EXPECT_EQ(marks.segment[s.index] != 0, s.edge != 0 && s.edge != 2) << s.edge;
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
    const bool touches = std::any_of(t.n, t.n + 3, [&](NodeId n) {
      return std::count(box.mesh.triangles[i].n, box.mesh.triangles[i].n + 3, n) > 0;
    });
    EXPECT_EQ(marks.triangle[i] != 0, touches && box.mesh.triangle_face[i] == 3) << i;
  }
}

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
