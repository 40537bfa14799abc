#include "meshing/engine/paired_holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mesh/checks.h"
#include "sizing/paired_field.h"
#include "unit/meshing/mark_holes.h"
#include "unit/meshing/paired_mesh.h"

namespace st {
namespace {

/// A shape with pairs, meshed at one length, and what of it other sizes mark.
struct Remeshed {
  test::PairedMesh before;
  PairedField field;
  HoleMesh old;
  HoleMarker holes;

  Remeshed(const char* shape, double length, const SizeField& other, HoleMarkOptions mark = {})
      : before(shape, UniformField(length)),
        field(other, regions(before), 1e-6),
        old(before.mesh, before.topology.tables(), &before.model),
        holes(before.model, old, {0, static_cast<TriangleId>(before.mesh.triangles.size()), 0}, field,
              with_pairs(std::move(mark)), test::one_rank) {}

  HoleMarkOptions with_pairs(HoleMarkOptions mark) const {
    mark.pairs = &before.pairs;
    return mark;
  }
  static std::vector<PairedRegion> regions(const test::PairedMesh& m) {
    std::vector<PairedRegion> all;
    for (const FacePair& p : m.pairs.pairs())
      all.push_back({m.model.tables().face_box[p.a], m.model.tables().face_box[p.b], p.motion});
    return all;
  }
  std::int64_t n_marked(FaceId f) const {
    const auto first = holes.marks().triangle.begin();
    return std::count(first + old.face_begin[f], first + old.face_begin[f + 1], 1);
  }
  SurfaceMesh filled(MeshOptions options = {}) {
    options.pairs = &before.pairs;
    return mesh_regions(holes, field, HoleOutput::kMesh, options, test::one_rank).mesh;
  }
};

class PairedShape : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(PairedShape, remeshed_for_smaller_and_larger_sizes_has_images_on_all_pairs) {
  const auto& [shape, length] = GetParam();
  for (const double factor : {0.7, 1.6}) {
    const UniformField other(factor * length);
    Remeshed m(shape, length, other);
    const SurfaceMesh mesh = m.filled();
    const double ratio = static_cast<double>(mesh.n_triangles()) / static_cast<double>(m.before.mesh.n_triangles());
    EXPECT_NEAR(ratio * factor * factor, 1, 0.35) << shape;
    m.before.expect_images(mesh);
    EXPECT_TRUE(check_topology(mesh, edges_of(mesh)).passes());
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, PairedShape,
                         testing::Values(std::pair("box", 4.0), std::pair("pie", 1.5), std::pair("passage", 2.0)));

TEST(PairedHoles, are_whole_faces_and_both_of_a_pair) {
  const test::FinerThere finer(4, {0, 20, 10});
  Remeshed m("box", 4, finer);
  for (const FacePair& p : m.before.pairs.pairs())
    for (const FaceId f : {p.a, p.b})
      if (m.n_marked(p.a) + m.n_marked(p.b) > 0) {
        EXPECT_EQ(m.n_marked(f), m.old.face_size(f));
      }
  m.before.expect_images(m.filled());
}

TEST(PairedHoles, leave_edges_that_are_images_of_kept_ones) {
  HoleMarkOptions mark;
  const UniformField finer(2);
  const Remeshed plain("box", 4, finer);
  const FacePair pair = plain.before.pairs.pairs()[0];
  mark.keep_face.assign(6, 0);
  mark.keep_face[pair.a] = mark.keep_face[pair.b] = 1;
  Remeshed m("box", 4, finer, mark);
  EXPECT_EQ(m.n_marked(pair.a) + m.n_marked(pair.b), 0);
  const SurfaceMesh mesh = m.filled();
  m.before.expect_images(mesh);
  EXPECT_EQ(std::ranges::count(mesh.triangle_face, pair.a), m.old.face_size(pair.a));
  EXPECT_GT(2 * mesh.n_triangles(), 3 * m.before.mesh.n_triangles());
}

/// Of a box with pairs: [n_edges] how many segments are marked.
std::vector<std::ptrdiff_t> marked_segments(const Remeshed& m, const std::vector<double>& wanted,
                                            HoleMarkOptions options) {
  options.pairs = &m.before.pairs;
  const HoleMarks marks = test::mark_holes(m.old, wanted, options);
  std::vector<std::ptrdiff_t> n;
  for (EdgeId e = 0; e < m.old.edges.n_edges(); ++e) {
    const auto first = marks.segment.begin() + m.old.edges.first_node(e);
    n.push_back(std::count(first, first + m.old.edges.n_nodes(e), 1));
  }
  return n;
}

TEST(PairedHoles, have_marks_on_all_edges_that_are_images) {
  const UniformField same(4);
  const Remeshed m("box", 4, same);
  std::vector<double> wanted(m.before.mesh.node_xyz.size(), 4);
  wanted[m.old.edge_node[m.old.edges.first_node(0) + 2]] = 0.5;
  const std::vector<std::ptrdiff_t> n = marked_segments(m, wanted, {});
  EXPECT_GT(n[0], 0);
  EXPECT_EQ(std::ranges::count(n, n[0]), 4);
  EXPECT_EQ(std::ranges::count(n, 0), 8);
}

TEST(PairedHoles, have_no_marks_on_edges_that_are_images_of_kept_ones) {
  const UniformField same(4);
  const Remeshed m("box", 4, same);
  HoleMarkOptions mark;
  mark.keep_edge.assign(12, 0);
  mark.keep_edge[5] = 1;
  EXPECT_EQ(std::ranges::count(marked_segments(m, std::vector<double>(m.before.mesh.node_xyz.size(), 2), mark), 0), 4);
}

TEST(PairedHoles, are_images_where_they_are_filled_tile_by_tile) {
  const UniformField finer(0.9);
  Remeshed m("box", 2, finer);
  MeshOptions options;
  options.tile_triangles = 1000;
  m.before.expect_images(m.filled(options));
}

}  // namespace
}  // namespace st
