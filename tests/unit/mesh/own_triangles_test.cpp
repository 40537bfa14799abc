// What shares of a mesh add up to is what the whole mesh has.
#include "mesh/own_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include "mesh/checks.h"
#include "mesh/conformity.h"
#include "mesh/quality.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

/// A share with all triangles around it, in the order of the whole mesh.
struct Share {
  SurfaceMesh mesh;
  std::vector<NodeId> node_number;
  OwnTriangles own;

  Share(const SurfaceMesh& whole, TriangleId begin, TriangleId end) {
    const auto n_nodes = static_cast<std::size_t>(whole.n_nodes());
    std::vector<char> is_near(n_nodes, 0), is_used(n_nodes, 0);
    for (TriangleId t = begin; t < end; ++t)
      for (const NodeId n : whole.triangles[t].n) is_near[n] = 1;
    std::vector<TriangleId> kept;
    for (TriangleId t = 0; t < static_cast<TriangleId>(whole.n_triangles()); ++t) {
      const auto& n = whole.triangles[t].n;
      if (std::none_of(std::begin(n), std::end(n), [&](NodeId i) { return is_near[i]; })) continue;
      kept.push_back(t);
      for (const NodeId i : n) is_used[i] = 1;
    }
    std::vector<NodeId> here(n_nodes, kNone);
    std::vector<Vec3> points;
    for (NodeId n = 0; n < static_cast<NodeId>(n_nodes); ++n)
      if (is_used[n]) {
        here[n] = static_cast<NodeId>(points.size());
        points.push_back(whole.node_xyz[n]);
        node_number.push_back(n);
      }
    std::vector<Triangle> triangles;
    std::vector<FaceId> faces;
    for (const TriangleId t : kept) {
      const auto& n = whole.triangles[t].n;
      triangles.push_back({{here[n[0]], here[n[1]], here[n[2]]}});
      faces.push_back(whole.triangle_face[t]);
    }
    mesh = shapes::from(std::move(points), std::move(triangles), std::move(faces));
    mesh.labels = whole.labels;
    for (std::size_t i = 0; i < node_number.size(); ++i) {
      mesh.node_entity_dim[i] = whole.node_entity_dim[node_number[i]];
      mesh.node_entity[i] = whole.node_entity[node_number[i]];
    }
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (int k = 0; k < 3; ++k) mesh.corner_uv[3 * i + k] = whole.corner_uv[3 * kept[i] + k];
    const auto first = std::lower_bound(kept.begin(), kept.end(), begin) - kept.begin();
    own = {static_cast<TriangleId>(first), static_cast<TriangleId>(first + end - begin), begin, node_number};
  }
};

/// Five pieces of triangles of six faces, none as another; with holes, folds, triangles that turn, double ones.
SurfaceMesh broken_cube() {
  SurfaceMesh m = shapes::cube(80);
  for (std::int64_t n = 0; n < m.n_nodes(); ++n) m.node_xyz[n].x += 2e-3 * std::sin(0.1 * static_cast<double>(n));
  const auto piece = static_cast<TriangleId>(kTrianglesPerPiece);
  for (const TriangleId t : {piece - 1, 2 * piece, 3 * piece + 70}) std::swap(m.triangles[t].n[1], m.triangles[t].n[2]);
  for (const TriangleId t : {piece, 4 * piece - 3}) m.triangles[t].n[2] = m.triangles[t].n[1];
  for (const TriangleId t : {2 * piece + 500, 60'000}) m.triangles[t] = m.triangles[t - 1];
  for (const NodeId n : {5'000, 15'000, 25'000}) m.node_xyz[n].y += 0.05;
  return m;
}

/// Calls with each of five shares, one a piece, in order.
void for_each_share(const SurfaceMesh& whole, const std::function<void(const Share&)>& visit) {
  const auto n = static_cast<TriangleId>(whole.n_triangles()), piece = static_cast<TriangleId>(kTrianglesPerPiece);
  for (TriangleId begin = 0; begin < n; begin += piece) visit(Share(whole, begin, std::min(n, begin + piece)));
}

void expect_same(const Defects& a, const Defects& b, const char* what) {
  EXPECT_EQ(a.count, b.count) << what;
  ASSERT_EQ(a.first.size(), b.first.size()) << what;
  for (std::size_t i = 0; i < a.first.size(); ++i) {
    EXPECT_EQ(a.first[i].order, b.first[i].order) << what;
    EXPECT_EQ(distance(a.first[i].xyz, b.first[i].xyz), 0) << what;
    EXPECT_EQ(a.first[i].face_a, b.first[i].face_a) << what;
    EXPECT_EQ(a.first[i].face_b, b.first[i].face_b) << what;
  }
}

TEST(OwnTriangles, shares_find_the_same_defects_of_topology) {
  const SurfaceMesh m = broken_cube();
  const TopologyReport whole = check_topology(m, edges_of(m));
  TopologyReport shares;
  for_each_share(m, [&](const Share& s) { shares.add(check_topology(s.mesh, edges_of(s.mesh), {}, s.own)); });
  shares.set_parts(count_parts(m.triangles, m.n_nodes()), m.n_triangles());
  EXPECT_EQ(shares.n_edges, whole.n_edges);
  EXPECT_EQ(shares.euler, whole.euler);
  expect_same(shares.boundary_edges, whole.boundary_edges, "boundary edges");
  expect_same(shares.nonmanifold_edges, whole.nonmanifold_edges, "non-manifold edges");
  expect_same(shares.misoriented_edges, whole.misoriented_edges, "misoriented edges");
  expect_same(shares.repeated_nodes, whole.repeated_nodes, "repeated nodes");
  expect_same(shares.duplicate_triangles, whole.duplicate_triangles, "duplicate triangles");
  expect_same(shares.pinched_nodes, whole.pinched_nodes, "pinched nodes");
  EXPECT_EQ(whole.repeated_nodes.count, 2);
  EXPECT_GT(whole.boundary_edges.count, 0);
  EXPECT_GT(whole.misoriented_edges.count, 0);
}

TEST(OwnTriangles, shares_find_the_same_folds_and_measures) {
  const SurfaceMesh m = broken_cube();
  const ShapeReport whole = check_shape(m, edges_of(m));
  ShapeReport shares;
  std::vector<MeasurePart> parts;
  Box3 box;
  for (const Vec3 p : m.node_xyz) box.add(p);
  for_each_share(m, [&](const Share& s) {
    shares.add(check_shape(s.mesh, edges_of(s.mesh), s.own));
    for (const MeasurePart& part : measure_mesh(s.mesh, box.center(), s.own)) parts.push_back(part);
  });
  expect_same(shares.folds, whole.folds, "folds");
  expect_same(shares.zero_area, whole.zero_area, "triangles without area");
  EXPECT_GT(whole.folds.count, 0);
  const MeshMeasure measured = measure_mesh(m), added = measure_of(parts, m.labels.face_name.size());
  EXPECT_EQ(added.area, measured.area);
  EXPECT_EQ(added.volume, measured.volume);
  EXPECT_EQ(added.face_area, measured.face_area);
}

void expect_same(const QualityStats& a, const QualityStats& b) {
  EXPECT_EQ(a.n_triangles, b.n_triangles);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.p1, b.p1);
  EXPECT_EQ(a.min, b.min);
  EXPECT_EQ(a.n_below_20_deg, b.n_below_20_deg);
  EXPECT_EQ(a.max_angle_deg, b.max_angle_deg);
  EXPECT_EQ(a.histogram, b.histogram);
  EXPECT_EQ(a.angle_histogram, b.angle_histogram);
  EXPECT_EQ(a.worst.triangle, b.worst.triangle);
}

TEST(OwnTriangles, shares_measure_the_same_quality) {
  const SurfaceMesh m = broken_cube();
  const QualityReport whole = measure_quality(m, edges_of(m));
  const TriangleCounts counts = TriangleCounts::of(m);
  QualityParts parts;
  std::size_t n_large = 0;
  for_each_share(m, [&](const Share& s) {
    const QualityParts part = measure_quality(s.mesh, edges_of(s.mesh), TriangleCorners(s.mesh), s.own, counts);
    n_large += part.large_jumps.size();
    parts.add(part, counts);
  });
  const QualityReport shares = report_quality(std::move(parts), counts);
  expect_same(shares.model, whole.model);
  ASSERT_EQ(shares.faces.size(), whole.faces.size());
  for (std::size_t f = 0; f < whole.faces.size(); ++f) expect_same(shares.faces[f], whole.faces[f]);
  expect_same(shares.groups.at(0), whole.groups.at(0));
  EXPECT_EQ(shares.jumps.n_pairs, whole.jumps.n_pairs);
  EXPECT_EQ(shares.jumps.histogram, whole.jumps.histogram);
  EXPECT_EQ(shares.jump_max, whole.jump_max);
  EXPECT_EQ(shares.jump_p999, whole.jump_p999);
  EXPECT_EQ(n_large, whole.large_jumps.size());
  EXPECT_GT(n_large, 0u);
}

TEST(OwnTriangles, shares_compare_the_same_lengths_with_the_requested_ones) {
  SurfaceMesh m = broken_cube();
  for (NodeId n = 0; n < static_cast<NodeId>(m.n_nodes()); ++n) {
    const Vec3 p = m.node_xyz[n];
    if (p.z == 0 || p.z == 1) m.node_entity_dim[n] = 1;  // both lids are strips from boundary to boundary
  }
  const RequestedSize size = [](Vec3 p, int&) { return LocalSize{0.012 + 0.01 * p.z, 0.012 + 0.01 * p.z, {}}; };
  const ConformityReport whole = measure_conformity(m, edges_of(m), size);
  ConformityParts parts;
  std::size_t n_outside = 0;
  for_each_share(m, [&](const Share& s) {
    const ConformityParts part =
        measure_conformity(s.mesh, edges_of(s.mesh), size, {}, s.own, static_cast<std::int64_t>(m.n_triangles()));
    n_outside += part.outside.size();
    parts.add(part, m.n_triangles());
  });
  const ConformityReport shares = report_conformity(std::move(parts), 1, m.labels.face_name.size());
  for (const auto& [a, b] : {std::pair(shares.model, whole.model),
                             {shares.free, whole.free},
                             {shares.inner, whole.inner},
                             {shares.faces.at(4), whole.faces.at(4)}}) {
    EXPECT_EQ(a.n_edges, b.n_edges);
    EXPECT_EQ(a.n_within, b.n_within);
    EXPECT_EQ(a.sum, b.sum);
    EXPECT_EQ(a.histogram, b.histogram);
  }
  EXPECT_EQ(shares.p1, whole.p1);
  EXPECT_EQ(shares.p99, whole.p99);
  EXPECT_EQ(n_outside, whole.outside.size());
  ASSERT_EQ(shares.forced.size(), whole.forced.size());
  ASSERT_FALSE(whole.forced.empty());
  for (std::size_t i = 0; i < whole.forced.size(); ++i) {
    EXPECT_EQ(shares.forced[i].n_edges, whole.forced[i].n_edges);
    EXPECT_EQ(shares.forced[i].min_ratio, whole.forced[i].min_ratio);
  }
}

}  // namespace
}  // namespace st
