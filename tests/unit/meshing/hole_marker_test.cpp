// Marks of a mesh at one rank: the first ones, and those after refinements.
#include "meshing/engine/hole_marker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/meshing/hole_case.h"

namespace st {
namespace {

const SerialExecutor one_rank;

struct Marked {
  const test::ShapeMesh box{"box", 0.05};
  HoleMesh old{box.mesh, box.model.tables()};
  HoleMarker holes;

  explicit Marked(const SizeField* field = nullptr)
      : holes(box.model, old, {0, static_cast<TriangleId>(box.mesh.n_triangles()), 0}, field ? *field : box.field,
              test::nothing_changes(), one_rank) {}
};

TEST(HoleMarker, marks_nothing_where_nothing_changes) {
  const Marked m;
  EXPECT_EQ(m.holes.n_marked_triangles, 0);
  EXPECT_EQ(m.holes.n_marked_segments, 0);
  EXPECT_TRUE(m.holes.dirty_faces().empty());
}

TEST(HoleMarker, marks_what_mark_holes_marks) {
  const test::ShapeMesh box("box", 0.05);
  const test::LinearField finer = test::finer_at_a_corner(box);
  const HoleMesh old(box.mesh, box.model.tables());
  const HoleMarker holes(box.model, old, {0, static_cast<TriangleId>(box.mesh.n_triangles()), 0}, finer, {}, one_rank);
  const HoleMarks marks = test::mark_holes(old, box.wanted(finer), {});
  EXPECT_EQ(holes.marks().triangle, marks.triangle);
  EXPECT_EQ(holes.marks().segment, marks.segment);
  EXPECT_EQ(holes.n_marked_triangles, marks.n_triangles());
  ASSERT_GT(marks.n_triangles(), 0);
  for (const FaceId f : holes.dirty_faces())
    EXPECT_NE(std::count(marks.triangle.begin() + old.face_begin[f], marks.triangle.begin() + old.face_begin[f + 1], 1),
              0);
}

TEST(HoleMarker, marks_again_what_it_is_told_to_and_keeps_its_first_counts) {
  Marked m;
  const std::string hash = m.holes.marks_hash;
  const TriangleId some = m.old.face_begin[3] + m.old.face_size(3) / 2;
  m.holes.mark_again(Refinements(m.box.field), {some});
  EXPECT_TRUE(m.holes.marks().triangle[some]);
  EXPECT_EQ(m.holes.n_marked_triangles, 0);
  EXPECT_EQ(m.holes.marks_hash, hash);
  const std::vector<FaceId>& dirty = m.holes.dirty_faces();
  EXPECT_TRUE(std::find(dirty.begin(), dirty.end(), 3) != dirty.end());
}

TEST(HoleMarker, remembers_what_it_was_told_before) {
  Marked m;
  const TriangleId first = m.old.face_begin[0], second = m.old.face_begin[3];
  m.holes.mark_again(Refinements(m.box.field), {first});
  m.holes.mark_again(Refinements(m.box.field), {second});
  EXPECT_TRUE(m.holes.marks().triangle[first] && m.holes.marks().triangle[second]);
}

TEST(HoleMarker, marks_around_a_refinement) {
  const test::ShapeMesh box("box", 0.05);
  const HoleMesh old(box.mesh, box.model.tables());
  HoleMarker holes(box.model, old, {0, static_cast<TriangleId>(box.mesh.n_triangles()), 0}, box.field, {}, one_rank);
  const TriangleId at = old.face_begin[2] + old.face_size(2) / 2;
  ASSERT_FALSE(holes.marks().triangle[at]);
  Refinements refinements(box.field);
  ASSERT_TRUE(refinements.add({box.mesh.node_xyz[box.mesh.triangles[at].n[0]], 0}, 0.25));
  holes.mark_again(refinements, {});
  EXPECT_TRUE(holes.marks().triangle[at]);
}

TEST(HoleMarker, marks_around_a_refinement_that_reaches_no_edge) {
  const test::ShapeMesh box("box", 0.05);
  const HoleMesh old(box.mesh, box.model.tables());
  HoleMarker holes(box.model, old, {0, static_cast<TriangleId>(box.mesh.n_triangles()), 0}, box.field, {}, one_rank);
  const Vec3 middle = box.model.tables().face_box[2].center();
  NodeId n = old.inner_begin[2];
  for (NodeId k = n; k < old.inner_begin[3]; ++k)
    if (distance(box.mesh.node_xyz[k], middle) < distance(box.mesh.node_xyz[n], middle)) n = k;
  Refinements refinements(box.field);
  ASSERT_TRUE(refinements.add({box.mesh.node_xyz[n], 0}, 0.25));
  for (NodeId k = 0; k < old.inner_begin[0]; ++k)
    ASSERT_GT(distance(box.mesh.node_xyz[k], box.mesh.node_xyz[n]), refinements.all()[0].reach);
  holes.mark_again(refinements, {});
  EXPECT_EQ(holes.dirty_faces(), std::vector<FaceId>{2});
  for (TriangleId t = old.face_begin[2]; t < old.face_begin[3]; ++t)
    if (std::count(box.mesh.triangles[t].n, box.mesh.triangles[t].n + 3, n)) {
      EXPECT_TRUE(holes.marks().triangle[t]) << t;
    }
}

TEST(HoleMarker, grows_a_hole_to_its_face_and_no_further) {
  Marked m;
  m.holes.grow_to_face(4);
  for (TriangleId t = 0; t < m.box.mesh.n_triangles(); ++t)
    EXPECT_EQ(m.holes.marks().triangle[t] != 0, m.box.mesh.triangle_face[t] == 4) << t;
}

}  // namespace
}  // namespace st
