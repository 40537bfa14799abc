// Marks, holes, fills and growth of a whole mesh at one rank.
#include "meshing/engine/hole_rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>

#include "base/error.h"
#include "base/log.h"
#include "mesh/checks.h"
#include "meshing/engine/mesh_regions.h"
#include "meshing/face/face_patch.h"
#include "support/backward_executor.h"
#include "unit/mesh/shapes.h"
#include "unit/meshing/hole_case.h"
#include "unit/meshing/no_number.h"

namespace st {
namespace {

using test::ShapeMesh;

const SerialExecutor one_rank;

/// A solid's mesh and what of it other sizes mark. `solid` and `field` outlive it.
struct Marked {
  HoleMesh old;
  const SizeField& field;
  HoleMarker holes;

  Marked(const ShapeMesh& solid, const SizeField& f, const HoleMarkOptions& options = {})
      : old(solid.mesh, solid.model.tables()),
        field(f),
        holes(solid.model, old, {0, static_cast<TriangleId>(solid.mesh.n_triangles()), 0}, field, options, one_rank) {
    set_verbosity(Verbosity::kQuiet);
  }
  MeshResult fill(HoleOutput output = HoleOutput::kMesh, const MeshOptions& o = {}, const Executor& on = one_rank) {
    return mesh_regions(holes, field, output, o, on);
  }
  SurfaceMesh merged(const MeshResult& r) const {
    OrientationReport report;
    return merge_patches(
        {r.edges, old.tables.vertex_xyz, old.tables.edge_vertices, r.patches, old.tables.labels.face_group}, report);
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

class RefilledSolid : public testing::TestWithParam<const char*> {};

TEST_P(RefilledSolid, for_the_same_sizes_is_the_same_to_the_bit) {
  const ShapeMesh solid(GetParam());
  Marked m(solid, solid.field, test::nothing_changes());
  EXPECT_EQ(m.holes.n_marked_triangles, 0);
  EXPECT_TRUE(m.holes.dirty_faces().empty());
  EXPECT_TRUE(shapes::same(m.fill().mesh, solid.mesh));
}

TEST_P(RefilledSolid, for_a_finer_corner_is_closed_and_unchanged_elsewhere_to_the_bit) {
  const ShapeMesh solid(GetParam(), 0.05);
  const FinerCorner field(solid);
  Marked m(solid, field);
  const std::vector<char> marked = m.holes.marks().triangle;
  ASSERT_GT(m.holes.n_marked_triangles, 0);
  ASSERT_LT(m.holes.n_marked_triangles, solid.mesh.n_triangles());
  const MeshResult r = m.fill();
  EXPECT_TRUE(r.failures.empty());
  const SurfaceMesh& after = r.mesh;
  EXPECT_TRUE(check_topology(after, edges_of(after)).passes());
  EXPECT_TRUE(check_shape(after, edges_of(after)).passes());
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
  if (r.n_grown == 0 && r.n_rounds == 1) {
    for (TriangleId t = 0; t < solid.mesh.n_triangles(); ++t) EXPECT_EQ(stays[t] != 0, marked[t] == 0) << t;
  }
  for (NodeId n = 0; n < after.n_nodes(); ++n) {
    if (after.node_previous[n] == kNone) {
      EXPECT_EQ(after.node_size[n], field.size(after.node_xyz[n])) << "new nodes have the length asked for";
    }
  }
  std::vector<char> is_held(solid.mesh.node_xyz.size(), 0);
  for (TriangleId t = 0; t < solid.mesh.n_triangles(); ++t)
    for (const NodeId n : solid.mesh.triangles[t].n) is_held[n] |= stays[t];
  for (NodeId n = 0; n < after.n_nodes(); ++n) {
    const NodeId before = after.node_previous[n];
    if (before == kNone || after.node_entity_dim[n] == 2) continue;
    EXPECT_EQ(after.node_size[n], is_held[before] ? solid.mesh.node_size[before] : field.size(after.node_xyz[n]))
        << "nodes on edges keep their length while an old triangle has them";
  }
  Marked again(solid, field);
  EXPECT_TRUE(shapes::same(after, again.merged(again.fill(HoleOutput::kPatches))))
      << "what st-merge would make of the patches";
}

TEST_P(RefilledSolid, in_tiles_is_closed_and_the_same_in_whatever_order_they_are_done) {
  const ShapeMesh solid(GetParam(), 0.05);
  const test::LinearField fine(solid.model.tables().vertex_xyz[0], 0.03 * solid.field.min_size(), 0.05);
  MeshOptions tiles, whole;
  tiles.tile_triangles = 1000;
  whole.tile_triangles = 0;
  const test::BackwardExecutor backward, counted;
  Marked forward(solid, fine), again(solid, fine), uncut(solid, fine);
  const MeshResult r = forward.fill(HoleOutput::kMesh, tiles);
  EXPECT_TRUE(r.failures.empty());
  EXPECT_EQ(r.n_grown, 0);
  EXPECT_TRUE(check_topology(r.mesh, edges_of(r.mesh)).passes());
  EXPECT_TRUE(check_shape(r.mesh, edges_of(r.mesh)).passes());
  EXPECT_TRUE(shapes::same(r.mesh, again.fill(HoleOutput::kMesh, tiles, backward).mesh));
  const MeshResult one_by_one = uncut.fill(HoleOutput::kMesh, whole, counted);
  EXPECT_GT(backward.n_tasks, counted.n_tasks + 3) << "tiles, of " << r.mesh.n_triangles();
  EXPECT_NEAR(r.mesh.n_triangles(), one_by_one.mesh.n_triangles(), 0.05 * one_by_one.mesh.n_triangles());
}

TEST_P(RefilledSolid, done_again_as_a_whole_is_what_st_mesh_makes) {
  const ShapeMesh solid(GetParam());
  HoleMarkOptions options = test::nothing_changes();
  for (TriangleId t = 0; t < solid.mesh.n_triangles(); ++t) options.redo.push_back(t);
  Marked m(solid, solid.field, options);
  EXPECT_EQ(m.holes.n_marked_triangles, solid.mesh.n_triangles());
  const SurfaceMesh after = m.fill().mesh;
  EXPECT_TRUE(after.node_xyz == solid.mesh.node_xyz);
  EXPECT_TRUE(after.corner_uv == solid.mesh.corner_uv);
  ASSERT_EQ(after.n_triangles(), solid.mesh.n_triangles());
  for (TriangleId t = 0; t < after.n_triangles(); ++t)
    EXPECT_TRUE(std::equal(after.triangles[t].n, after.triangles[t].n + 3, solid.mesh.triangles[t].n)) << t;
}

INSTANTIATE_TEST_SUITE_P(, RefilledSolid, testing::ValuesIn(test::kSolids),
                         [](const auto& info) { return std::string(info.param); });

/// Fine at two places of the side z = 20 of the box 60 x 40 x 20.
class TwoSpots : public test::LinearField {
 public:
  using SizeField::size;
  TwoSpots(double length, double slope, double elsewhere)
      : LinearField({15, 20, 20}, length, slope), other_({45, 20, 20}, length, slope), elsewhere_(elsewhere) {}
  double size(Vec3 x, int& hint) const override {
    return std::min({LinearField::size(x, hint), other_.size(x, hint), elsewhere_});
  }

 private:
  test::LinearField other_;
  double elsewhere_;
};

TEST(HolesInTiles, of_one_face_have_different_names) {
  const ShapeMesh solid("box", 0.008);
  const TwoSpots fine(0.03 * solid.field.min_size(), 0.04, solid.field.min_size());
  Marked marked(solid, fine);
  MeshOptions tiles;
  tiles.tile_triangles = 500;
  const test::BackwardExecutor named;
  const MeshResult r = marked.fill(HoleOutput::kMesh, tiles, named);
  EXPECT_TRUE(r.failures.empty());
  EXPECT_EQ(named.n_of["hole join"], 2u) << "triangles: " << r.mesh.n_triangles();
}

/// Inside the side z = 20 of the box 60 x 40 x 20.
bool is_on_top(Vec3 x) { return x.z > 19.999 && x.x > 0.01 && x.x < 59.99 && x.y > 0.01 && x.y < 39.99; }

/// Cannot be asked at some places once it is armed.
class FailingField : public FinerCorner {
 public:
  explicit FailingField(const ShapeMesh& solid, std::function<bool(Vec3)> fails = is_on_top)
      : FinerCorner(solid), fails_(std::move(fails)) {}
  double size(Vec3 x, int& hint) const override {
    if (is_armed && n_failures_left && fails_(x)) {
      --n_failures_left;
      throw Error(ExitCode::kInternal, "no size here");
    }
    return FinerCorner::size(x, hint);
  }
  bool is_armed = false;
  mutable int n_failures_left = 1000;

 private:
  std::function<bool(Vec3)> fails_;
};

/// What st-remesh makes where no hole of a face can be filled and then the face as a whole can.
MeshResult fill_after_failures(const ShapeMesh& solid, FailingField& field, const HoleMarkOptions& options) {
  field.is_armed = true;
  field.n_failures_left = 0;
  int n_tries = 0;
  {  // with holes that grow to the whole face
    Marked m(solid, field, options);
    field.n_failures_left = 1000;
    MeshResult ignored;
    HoleRounds(m.holes, field, {}, one_rank, ignored).run();
    n_tries = 1000 - field.n_failures_left;
  }
  field.n_failures_left = 0;
  Marked m(solid, field, options);
  field.n_failures_left = n_tries;
  MeshResult r = m.fill();
  EXPECT_EQ(field.n_failures_left, 0);
  EXPECT_TRUE(r.failures.empty());
  return r;
}

/// The face all of whose nodes are at this height.
FaceId face_at(const ShapeMesh& box, double z) {
  for (FaceId f = 0; f < 6; ++f)
    if (box.model.tables().face_box[f].lo.z > z - 1e-3 && box.model.tables().face_box[f].hi.z < z + 1e-3) return f;
  return kNone;
}

/// The triangle at the node inside the face that is nearest to a place.
TriangleId triangle_near(const ShapeMesh& box, const HoleMesh& old, FaceId f, Vec3 x) {
  NodeId nearest = old.inner_begin[f];
  for (NodeId n = nearest; n < old.inner_begin[f + 1]; ++n)
    if (distance(box.mesh.node_xyz[n], x) < distance(box.mesh.node_xyz[nearest], x)) nearest = n;
  TriangleId t = old.face_begin[f];
  while (std::count(box.mesh.triangles[t].n, box.mesh.triangles[t].n + 3, nearest) == 0) ++t;
  return t;
}

TEST(HoleRounds, grow_a_hole_to_the_whole_face_before_they_name_the_face_as_failed) {
  const ShapeMesh box("box", 0.05);
  FailingField field(box);
  const FaceId top = face_at(box, 20);
  ASSERT_NE(top, kNone);
  HoleMarkOptions options;
  options.redo = {triangle_near(box, HoleMesh(box.mesh, box.model.tables()), top, {30, 20, 20})};
  Marked m(box, field, options);
  field.is_armed = true;
  MeshResult result;
  HoleRounds rounds(m.holes, field, {}, one_rank, result);
  rounds.run();
  EXPECT_EQ(rounds.failed_faces(), std::vector<FaceId>{top});
  EXPECT_GE(result.n_grown, 3) << "by a few layers, by more, to the whole face";
  EXPECT_EQ(result.mesh.n_triangles(), 0);
  for (TriangleId t = m.old.face_begin[top]; t < m.old.face_begin[top + 1]; ++t)
    EXPECT_TRUE(m.holes.marks().triangle[t]);
}

TEST(HoleRounds, hand_a_failed_face_on_to_be_meshed_as_a_whole) {
  const ShapeMesh box("box", 0.05);
  FailingField field(box);
  const FaceId top = face_at(box, 20);
  HoleMarkOptions options;
  options.redo = {triangle_near(box, HoleMesh(box.mesh, box.model.tables()), top, {30, 20, 20})};
  const MeshResult r = fill_after_failures(box, field, options);
  EXPECT_TRUE(check_topology(r.mesh, edges_of(r.mesh)).passes());
  NodeId n_kept = 0;
  for (NodeId n = 0; n < r.mesh.n_nodes(); ++n) {
    const NodeId before = r.mesh.node_previous[n];
    if (before == kNone) continue;
    ++n_kept;
    EXPECT_TRUE(r.mesh.node_xyz[n] == box.mesh.node_xyz[before]);
  }
  EXPECT_GT(n_kept, box.mesh.n_nodes() / 4) << "other faces stay";
  const auto key = [](Vec3 x) { return std::tuple(x.x, x.y, x.z); };
  std::map<std::tuple<double, double, double>, NodeId> on_edges;
  for (NodeId n = 0; n < box.mesh.n_nodes(); ++n)
    if (box.mesh.node_entity_dim[n] < 2) on_edges[key(box.mesh.node_xyz[n])] = n;
  for (NodeId n = 0; n < r.mesh.n_nodes(); ++n) {
    const auto same = on_edges.find(key(r.mesh.node_xyz[n]));
    if (same != on_edges.end() && r.mesh.node_entity_dim[n] < 2) {
      EXPECT_EQ(r.mesh.node_previous[n], same->second) << "what stays on an edge keeps its number";
    }
  }
}

TEST(HoleRounds, keep_the_numbers_of_vertices_between_edges_that_change_with_a_failed_face) {
  const ShapeMesh plate("plate_with_hole", 0.05);
  FailingField field(plate, [](Vec3 x) {
    return x.x > 0.01 && x.x < 59.99 && x.y > 0.01 && x.y < 39.99 && distance(x, {30, 20, 0}) > 8.1;
  });
  const MeshResult r = fill_after_failures(plate, field, {});
  NodeId n_vertices = 0, n_new_on_edges = 0;
  for (NodeId n = 0; n < r.mesh.n_nodes(); ++n) {
    const NodeId before = r.mesh.node_previous[n];
    n_new_on_edges += r.mesh.node_entity_dim[n] == 1 && before == kNone;
    if (r.mesh.node_entity_dim[n] > 0) continue;
    ++n_vertices;
    ASSERT_NE(before, kNone);
    EXPECT_TRUE(r.mesh.node_xyz[n] == plate.mesh.node_xyz[before]);
  }
  EXPECT_EQ(n_vertices, plate.model.tables().n_vertices());
  for (EdgeId e = 0; e < r.edges.n_edges(); ++e) {
    const std::int32_t first = r.edges.first_node(e), last = first + r.edges.n_nodes(e) - 1;
    EXPECT_TRUE(r.edges.node_previous[first] != kNone && r.edges.node_previous[last] != kNone) << e;
  }
  EXPECT_GT(n_new_on_edges, 10);
}

TEST(HoleRounds, redo_old_triangles_that_new_ones_cross) {
  const ShapeMesh pipe("thin_pipe", 0.03);
  const ModelTables& t = pipe.model.tables();
  const UniformField coarse(4);  // its chords cut through the wall
  const HoleMesh old(pipe.mesh, t);
  const auto outer =
      static_cast<FaceId>(std::max_element(t.face_area.begin(), t.face_area.end()) - t.face_area.begin());
  HoleMarkOptions options = test::nothing_changes();
  for (TriangleId i = old.face_begin[outer]; i < old.face_begin[outer + 1]; ++i) options.redo.push_back(i);
  Marked m(pipe, coarse, options);
  MeshResult result;
  HoleRounds rounds(m.holes, coarse, {}, one_rank, result);
  rounds.run();
  ASSERT_GT(result.n_rounds, 1) << "new triangles crossed old ones";
  const std::vector<TriangleId>& redone = m.holes.options().redo;
  ASSERT_GT(redone.size(), options.redo.size());
  for (std::size_t i = options.redo.size(); i < redone.size(); ++i) {
    EXPECT_NE(pipe.mesh.triangle_face[redone[i]], outer);
    EXPECT_TRUE(m.holes.marks().triangle[redone[i]]);
  }
}

/// A node inside a face that triangles which go and such that stay have in common; moves its (u,v) there by `move`.
void misplace_rim_node(ShapeMesh& box, const std::vector<char>& marked, const std::function<Vec2(Vec2)>& move) {
  std::vector<char> goes(box.mesh.node_xyz.size(), 0), remains(box.mesh.node_xyz.size(), 0);
  for (std::size_t i = 0; i < marked.size(); ++i)
    for (const NodeId n : box.mesh.triangles[i].n) (marked[i] ? goes : remains)[n] = 1;
  NodeId around = 0;
  while (!(goes[around] && remains[around] && box.mesh.node_entity_dim[around] == 2)) ++around;
  for (std::size_t c = 0; c < box.mesh.corner_uv.size(); ++c)
    if (box.mesh.triangles[c / 3].n[c % 3] == around) box.mesh.corner_uv[c] = move(box.mesh.corner_uv[c]);
}

TEST(HoleRounds, grow_a_hole_whose_fill_would_fold) {
  ShapeMesh box("box", 0.05);
  const HoleMesh old(box.mesh, box.model.tables());
  HoleMarkOptions options = test::nothing_changes();
  options.redo = {triangle_near(box, old, face_at(box, 20), {30, 20, 20})};
  Vec2 middle;
  for (int k = 0; k < 3; ++k) middle = middle + 1.0 / 3 * box.mesh.corner_uv[3 * options.redo[0] + k];
  misplace_rim_node(box, Marked(box, box.field, options).holes.marks().triangle,
                    [&](Vec2 uv) { return uv + 2.0 * (uv - middle); });  // over triangles that stay
  const MeshResult r = Marked(box, box.field, options).fill();
  EXPECT_GT(r.n_grown, 0);
  EXPECT_TRUE(r.failures.empty());
  EXPECT_TRUE(check_topology(r.mesh, edges_of(r.mesh)).passes());
  EXPECT_TRUE(check_shape(r.mesh, edges_of(r.mesh)).passes());
  EXPECT_NEAR(measure_mesh(r.mesh).area, 8800, 1e-6);
}

TEST(HoleRounds, grow_a_hole_whose_outline_crosses_itself_and_close_the_mesh) {
  ShapeMesh box("box", 0.05);
  const FinerCorner field(box);
  misplace_rim_node(box, Marked(box, field).holes.marks().triangle, [](Vec2 uv) { return uv + Vec2{25, 25}; });
  const MeshResult r = Marked(box, field).fill();
  EXPECT_GT(r.n_grown, 0);
  EXPECT_TRUE(r.failures.empty());
  EXPECT_TRUE(check_topology(r.mesh, edges_of(r.mesh)).passes());
  EXPECT_TRUE(check_shape(r.mesh, edges_of(r.mesh)).passes());
}

TEST(HoleRounds, leave_out_a_face_whose_fill_has_numbers_that_are_none_and_name_it) {
  const ShapeMesh sound("tube_window", 0.05);
  const Model window = test::window_without_a_number();
  const HoleMesh old(sound.mesh, window.tables());
  const FinerCorner field(sound);
  HoleMarker holes(window, old, {0, static_cast<TriangleId>(sound.mesh.n_triangles()), 0}, field, {}, one_rank);
  const MeshResult r = mesh_regions(holes, field, HoleOutput::kPatches, {}, one_rank);
  ASSERT_EQ(r.failures.size(), 1u);
  EXPECT_EQ(r.failures[0].face, 0);
  for (const FacePatch& p : r.patches) EXPECT_TRUE(has_numbers_only(p));
}

}  // namespace
}  // namespace st
