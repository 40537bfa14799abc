// Marks: where the request changed, and only there.
#include "meshing/hole_marks.h"

#include "base/error.h"
#include "mesh/checks.h"
#include "mesh/merge.h"
#include "meshing/hole_curves.h"
#include "meshing/hole_filler.h"
#include "meshing/mesh_gaps.h"
#include "unit/meshing/faces.h"

namespace st::test {
namespace {

/// A box meshed with one length everywhere.
struct BoxMesh {
  static constexpr double kLength = 0.1;
  Model model = make_model("box");
  UniformField field{kLength * model.tables().reference_diagonal()};
  SurfaceMesh mesh;

  BoxMesh() {
    const ModelTables& t = model.tables();
    const EdgeMesh edges = discretise_edges(model, field);
    const BoundaryNumbering numbering(t, edges);
    std::vector<FacePatch> patches;
    for (FaceId f = 0; f < t.n_faces(); ++f) patches.push_back(patch(f, numbering));
    OrientationReport report;
    mesh = merge_patches({edges, t.vertex_xyz, t.edge_vertices, patches, t.face_group}, report);
  }

  FacePatch patch(FaceId f, const BoundaryNumbering& numbering) const {
    const auto surface = model.surface(f);
    const FaceBoundary boundary = make_face_boundary(model, *surface, f, numbering);
    const FaceMesh m = mesh_face(*surface, boundary, field, {});
    FacePatch p;
    p.face = f;
    for (const auto& n : boundary.nodes) {
      const auto entity = numbering.entity(n.id);
      p.boundary_dim.push_back(static_cast<std::uint8_t>(entity.dim));
      p.boundary_entity.push_back(entity.entity);
      p.boundary_index.push_back(entity.index);
      ++p.n_boundary;
    }
    for (const auto& n : m.inner) {
      p.inner_xyz.push_back(n.x);
      p.inner_uv.push_back(n.uv);
      p.inner_size.push_back(n.h);
    }
    for (std::size_t i = 0; i < m.corners.size(); i += 3) {
      p.triangles.push_back({{m.corners[i], m.corners[i + 1], m.corners[i + 2]}});
      for (int k = 0; k < 3; ++k)
        p.corner_uv.push_back(m.corners[i + k] < p.n_boundary ? boundary.nodes[m.corners[i + k]].uv : m.inner[m.corners[i + k] - p.n_boundary].uv);
    }
    return p;
  }

  std::vector<double> wanted(const SizeField& f) const {
    std::vector<double> sizes;
    for (Vec3 x : mesh.node_xyz) sizes.push_back(f.size(x));
    return sizes;
  }
};

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

TEST(HoleFiller, fills_a_corner_and_keeps_the_rest_to_the_bit) {
  const BoxMesh box;
  const ModelTables& t = box.model.tables();
  const HoleMesh holes(box.mesh, t);
  const LinearField finer(t.vertex_xyz[0], 0.3 * box.field.min_size(), 0.3);
  std::vector<double> wanted = box.wanted(finer);
  for (double& w : wanted) w = std::min(w, box.field.min_size());
  const HoleMarks marks = mark_holes(holes, wanted, {});
  ASSERT_GT(marks.n_triangles(), 0);
  ASSERT_LT(marks.n_triangles(), box.mesh.n_triangles());
  const std::vector<SegmentRun> runs = marked_runs(holes, marks);
  ASSERT_EQ(runs.size(), 3u) << "one on each edge at the corner";
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

}  // namespace
}  // namespace st::test
