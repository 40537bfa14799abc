// Marks, holes, fills and growth of a whole mesh at one rank.
#include "meshing/engine/remesher.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "mesh/checks.h"
#include "unit/mesh/shapes.h"
#include "unit/meshing/hole_case.h"

namespace st {
namespace {

using test::ShapeMesh;

const SerialExecutor one_rank;

/// A solid's mesh redone for other sizes. `solid` and `field` outlive it.
struct Redone {
  HoleMesh old;
  Remesher remesher;

  Redone(const ShapeMesh& solid, const SizeField& field, const RemesherOptions& options = {})
      : old(solid.mesh, solid.model.tables()),
        remesher(solid.model, old, {0, static_cast<TriangleId>(solid.mesh.n_triangles()), 0, 0}, field, options,
                 one_rank) {
    set_verbosity(Verbosity::kQuiet);
  }
  SurfaceMesh merged_patches() const {
    OrientationReport report;
    return merge_patches({remesher.edges, old.tables.vertex_xyz, old.tables.edge_vertices, remesher.all_patches(),
                          old.tables.face_group},
                         report);
  }
};

/// Sizes of the solid, smaller towards its first vertex.
class FinerCorner : public SizeField {
 public:
  explicit FinerCorner(const ShapeMesh& solid)
      : finer_(test::finer_at_a_corner(solid)), coarse_(solid.field.min_size()) {}
  using SizeField::size;
  double size(Vec3 x, int& hint) const override { return std::min(coarse_, finer_.size(x, hint)); }
  double min_size() const override { return finer_.min_size(); }
  double slope() const override { return finer_.slope(); }

 private:
  test::LinearField finer_;
  double coarse_;
};

class RemeshedSolid : public testing::TestWithParam<const char*> {};

TEST_P(RemeshedSolid, for_the_same_sizes_is_the_same_to_the_bit) {
  const ShapeMesh solid(GetParam());
  RemesherOptions options;
  options.mark = test::nothing_changes();
  Redone r(solid, solid.field, options);
  r.remesher.analyse();
  EXPECT_EQ(r.remesher.n_marked_triangles, 0);
  EXPECT_TRUE(r.remesher.dirty_faces.empty());
  r.remesher.run();
  EXPECT_TRUE(shapes::same(r.remesher.mesh, solid.mesh));
}

TEST_P(RemeshedSolid, for_a_finer_corner_is_closed_and_unchanged_elsewhere_to_the_bit) {
  const ShapeMesh solid(GetParam(), 0.05);
  const FinerCorner field(solid);
  Redone r(solid, field);
  r.remesher.analyse();
  const std::vector<char> marked = r.remesher.marks.triangle;
  ASSERT_GT(r.remesher.n_marked_triangles, 0);
  ASSERT_LT(r.remesher.n_marked_triangles, solid.mesh.n_triangles());
  r.remesher.run();
  EXPECT_TRUE(r.remesher.failed_faces.empty());
  const SurfaceMesh& after = r.remesher.mesh;
  EXPECT_TRUE(check_topology(after).passes());
  EXPECT_TRUE(check_shape(after).passes());
  EXPECT_GT(after.n_triangles(), solid.mesh.n_triangles());
  std::vector<char> stays(solid.mesh.triangles.size(), 0);
  for (TriangleId i = 0; i < after.n_triangles(); ++i) {
    const TriangleId t = after.triangle_previous[i];
    if (t == kNone) continue;
    stays[t] = 1;
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(after.node_xyz[after.triangles[i].n[k]] == solid.mesh.node_xyz[solid.mesh.triangles[t].n[k]]) << t;
      EXPECT_TRUE(after.corner_uv[3 * i + k] == solid.mesh.corner_uv[3 * t + k]) << t;
    }
  }
  if (r.remesher.n_grown == 0 && r.remesher.n_rounds == 1) {
    for (TriangleId t = 0; t < solid.mesh.n_triangles(); ++t) EXPECT_EQ(stays[t] != 0, marked[t] == 0) << t;
  }
  for (NodeId n = 0; n < after.n_nodes(); ++n) {
    if (after.node_previous[n] == kNone) {
      EXPECT_EQ(after.node_size[n], field.size(after.node_xyz[n])) << "new nodes have the length asked for";
    }
  }
  EXPECT_TRUE(shapes::same(after, r.merged_patches())) << "what st-merge would make of the patches";
}

TEST_P(RemeshedSolid, done_again_as_a_whole_is_what_st_mesh_makes) {
  const ShapeMesh solid(GetParam());
  RemesherOptions options;
  options.mark = test::nothing_changes();
  for (TriangleId t = 0; t < solid.mesh.n_triangles(); ++t) options.mark.redo.push_back(t);
  Redone r(solid, solid.field, options);
  r.remesher.analyse();
  EXPECT_EQ(r.remesher.n_marked_triangles, solid.mesh.n_triangles());
  r.remesher.run();
  const SurfaceMesh& after = r.remesher.mesh;
  EXPECT_TRUE(after.node_xyz == solid.mesh.node_xyz);
  EXPECT_TRUE(after.corner_uv == solid.mesh.corner_uv);
  ASSERT_EQ(after.n_triangles(), solid.mesh.n_triangles());
  for (TriangleId t = 0; t < after.n_triangles(); ++t)
    EXPECT_TRUE(std::equal(after.triangles[t].n, after.triangles[t].n + 3, solid.mesh.triangles[t].n)) << t;
}

INSTANTIATE_TEST_SUITE_P(, RemeshedSolid, testing::ValuesIn(test::kSolids),
                         [](const auto& info) { return std::string(info.param); });

/// Cannot be asked inside the side z = 20 of the box 60 x 40 x 20 once it is armed.
class FailingField : public FinerCorner {
 public:
  using FinerCorner::FinerCorner;
  double size(Vec3 x, int& hint) const override {
    if (is_armed && x.z > 19.999 && x.x > 0.01 && x.x < 59.99 && x.y > 0.01 && x.y < 39.99)
      throw Error(ExitCode::kInternal, "no size here");
    return FinerCorner::size(x, hint);
  }
  bool is_armed = false;
};

/// The face all of whose nodes are at this height.
FaceId face_at(const ShapeMesh& box, double z) {
  for (FaceId f = 0; f < 6; ++f)
    if (box.model.tables().face_box[f].lo.z > z - 1e-3 && box.model.tables().face_box[f].hi.z < z + 1e-3) return f;
  return kNone;
}

TEST(Remesher, grows_a_hole_to_the_whole_face_before_it_names_the_face_as_failed) {
  const ShapeMesh box("box", 0.05);
  FailingField field(box);
  RemesherOptions options;
  const FaceId top = face_at(box, 20);
  ASSERT_NE(top, kNone);
  Redone r(box, field, options);
  // one triangle in the middle of the top, and what the corner asks for
  NodeId middle = r.old.inner_begin[top];
  for (NodeId n = middle; n < r.old.inner_begin[top + 1]; ++n)
    if (distance(box.mesh.node_xyz[n], {30, 20, 20}) < distance(box.mesh.node_xyz[middle], {30, 20, 20})) middle = n;
  TriangleId at = r.old.face_begin[top];
  while (std::count(box.mesh.triangles[at].n, box.mesh.triangles[at].n + 3, middle) == 0) ++at;
  options.mark.redo = {at};
  Remesher remesher(box.model, r.old, {0, static_cast<TriangleId>(box.mesh.n_triangles()), 0, 0}, field, options,
                    one_rank);
  remesher.analyse();
  field.is_armed = true;
  remesher.run();
  EXPECT_EQ(remesher.failed_faces, std::vector<FaceId>{top});
  EXPECT_GE(remesher.n_grown, 3) << "by a few layers, by more, to the whole face";
  EXPECT_EQ(remesher.mesh.n_triangles(), 0);
  for (TriangleId t = r.old.face_begin[top]; t < r.old.face_begin[top + 1]; ++t)
    EXPECT_TRUE(remesher.marks.triangle[t]);
}

TEST(Remesher, grows_a_hole_whose_outline_crosses_itself_and_closes_the_mesh) {
  ShapeMesh box("box", 0.05);
  const FinerCorner field(box);
  std::vector<char> marked;
  {
    Redone r(box, field);
    r.remesher.analyse();
    marked = r.remesher.marks.triangle;
  }
  // a node inside a face between triangles that go and such that stay
  std::vector<char> goes(box.mesh.node_xyz.size(), 0), remains(box.mesh.node_xyz.size(), 0);
  for (std::size_t i = 0; i < marked.size(); ++i)
    for (const NodeId n : box.mesh.triangles[i].n) (marked[i] ? goes : remains)[n] = 1;
  NodeId around = 0;
  while (!(goes[around] && remains[around] && box.mesh.node_entity_dim[around] == 2)) ++around;
  for (std::size_t c = 0; c < box.mesh.corner_uv.size(); ++c)
    if (box.mesh.triangles[c / 3].n[c % 3] == around) box.mesh.corner_uv[c] = box.mesh.corner_uv[c] + Vec2{25, 25};
  Redone r(box, field);
  r.remesher.analyse();
  r.remesher.run();
  EXPECT_GT(r.remesher.n_grown, 0);
  EXPECT_TRUE(r.remesher.failed_faces.empty());
  EXPECT_TRUE(check_topology(r.remesher.mesh).passes());
  EXPECT_TRUE(check_shape(r.remesher.mesh).passes());
}

}  // namespace
}  // namespace st
