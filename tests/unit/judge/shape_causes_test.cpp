// Who is to blame for a bad triangle: meshes made well, then broken in one known way.
#include "judge/shape_causes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "geometry/model/edge_angles.h"
#include "judge/cad_corners.h"
#include "support/meshed.h"

namespace st {
namespace {

/// A shape meshed with one length, nothing merged.
struct MeshedShape : test::Meshed {
  MeshedShape(const std::string& shape, double length) : test::Meshed(shape, length, MeshOptions{.merge_below = 0}) {
    std::fill(mesh.node_size.begin(), mesh.node_size.end(), length);
  }
  ShapeCauses causes(double angle_deg = 10) const {
    const ConformityReport sizes = measure_conformity(mesh, edges_of(mesh), [this](Vec3, int&) {
      return LocalSize{mesh.node_size[0], mesh.node_size[0], {}};
    });
    return find_shape_causes(model, mesh, TriangleCorners(mesh), measure_quality(mesh, edges_of(mesh)), &sizes,
                             angle_deg);
  }
  /// An edge between two nodes inside the face, all of whose neighbours are inside, too.
  std::pair<NodeId, NodeId> inner_edge() const {
    std::vector<std::uint8_t> is_near_boundary(mesh.node_xyz.size(), 0);
    for (const Triangle& t : mesh.triangles)
      for (const NodeId n : t.n)
        if (mesh.node_entity_dim[n] < 2)
          for (const NodeId m : t.n) is_near_boundary[m] = 1;
    for (const Triangle& t : mesh.triangles)
      if (!is_near_boundary[t.n[0]] && !is_near_boundary[t.n[1]]) return {t.n[0], t.n[1]};
    return {kNone, kNone};
  }
};

std::int64_t count(const CauseList& list, ShapeCause cause) { return list.count[static_cast<std::size_t>(cause)]; }

TEST(CadCorners, are_the_angles_between_the_edges_inside_the_face) {
  const Model square = test::make_model("square"), wedge = test::make_model("sharp_triangle");
  CadCorners of_square(square, {}), of_wedge(wedge, {});
  for (VertexId v = 0; v < 4; ++v) EXPECT_NEAR(of_square.smallest_deg(0, v), 90, 1e-6);
  std::vector<double> angles;
  for (VertexId v = 0; v < 3; ++v) angles.push_back(of_wedge.smallest_deg(0, v));
  std::sort(angles.begin(), angles.end());
  EXPECT_NEAR(angles[0], degrees(std::atan(0.1)), 1e-6);
  EXPECT_NEAR(angles[1] + angles[0], 90, 1e-6);
  EXPECT_NEAR(angles[2], 90, 1e-6);
}

TEST(CadCorners, know_a_corner_that_points_into_the_face) {
  const Model model = test::make_model("l_face");
  CadCorners corners(model, {});
  int n_reentrant = 0;
  for (VertexId v = 0; v < model.tables().n_vertices(); ++v)
    n_reentrant += std::fabs(corners.smallest_deg(0, v) - 270) < 1e-3;
  EXPECT_EQ(n_reentrant, 1);
}

TEST(CadCorners, are_none_at_a_seam_and_a_pole) {
  const Model model = test::make_model("cone");
  CadCorners corners(model, {});
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    for (VertexId v = 0; v < model.tables().n_vertices(); ++v) EXPECT_GT(corners.smallest_deg(f, v), 89);
}

TEST(ShapeCauses, are_none_on_a_good_mesh) {
  const ShapeCauses c = MeshedShape("square", 1).causes();
  EXPECT_EQ(c.sharp.total(), 0);
  EXPECT_EQ(c.growth.total(), 0);
}

TEST(ShapeCauses, blame_the_corner_of_the_cad_for_the_triangle_in_it) {
  const MeshedShape m("sharp_triangle", 0.5);
  const ShapeCauses c = m.causes();
  ASSERT_GE(count(c.sharp, ShapeCause::kCorner), 1);
  const CausePlace& p = c.sharp.worst[static_cast<std::size_t>(ShapeCause::kCorner)][0];
  EXPECT_LT(norm(p.xyz), 1) << "at the origin";
  ASSERT_NE(p.vertex, kNone);
  EXPECT_LT(norm(m.model.tables().vertex_xyz[p.vertex]), 1e-9);
  EXPECT_GE(c.sharp.total(), 2);
  EXPECT_EQ(count(c.sharp, ShapeCause::kCorner), c.sharp.total()) << "also those beside it, between the same edges";
}

TEST(ShapeCauses, blame_a_short_edge_or_a_strip_of_the_cad) {
  const ShapeCauses c = MeshedShape("stepped_box", 1).causes();
  EXPECT_GE(count(c.sharp, ShapeCause::kShortEdge), 1);
  EXPECT_GE(count(c.sharp, ShapeCause::kStrip), 1);
  EXPECT_GE(count(c.growth, ShapeCause::kShortEdge) + count(c.growth, ShapeCause::kStrip), 1);
  EXPECT_EQ(c.sharp.free(), 0);
  const CausePlace& p = c.sharp.worst[static_cast<std::size_t>(ShapeCause::kShortEdge)][0];
  ASSERT_NE(p.edge, kNone);
}

TEST(ShapeCauses, name_the_edge_beside_and_how_much_it_turns) {
  const ShapeCauses c = MeshedShape("thin_plate", 1).causes();
  ASSERT_GE(c.sharp.total(), 1);
  for (const CausePlace& p : c.sharp.worst[static_cast<std::size_t>(ShapeCause::kStrip)]) {
    ASSERT_NE(p.beside, kNone);
    EXPECT_NEAR(p.beside_deg, 90, 1e-6);
  }
  EXPECT_EQ(c.sharp.n_smooth, 0);
}

TEST(ShapeCauses, count_what_stands_at_smooth_edges) {
  MeshedShape m("wing_of_8", 1);
  const auto is_on = [&](NodeId n) { return m.mesh.node_entity_dim[n] == 1; };
  EdgeAngles edges(m.model);
  std::int64_t n_smooth = 0;
  for (const Triangle& t : m.mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const NodeId a = t.n[k], b = t.n[(k + 1) % 3], c = t.n[(k + 2) % 3];
      if (n_smooth > 0 || !is_on(a) || b != a + 1 || !is_on(b) || m.mesh.node_entity_dim[c] != 2) continue;
      if (m.mesh.node_entity[a] != m.mesh.node_entity[b] || edges.largest_deg(m.mesh.node_entity[a]) > 3) continue;
      m.mesh.node_xyz[c] =
          0.5 * (m.mesh.node_xyz[a] + m.mesh.node_xyz[b]) + 0.02 * (m.mesh.node_xyz[c] - m.mesh.node_xyz[a]);
      ++n_smooth;
    }
  ASSERT_EQ(n_smooth, 1);
  EXPECT_GE(m.causes().sharp.n_smooth, 1);
}

TEST(ShapeCauses, are_free_where_a_node_inside_a_face_lies_badly) {
  MeshedShape m("square", 1);
  const auto [a, b] = m.inner_edge();
  ASSERT_NE(a, kNone);
  m.mesh.node_xyz[a] = 0.06 * m.mesh.node_xyz[a] + 0.94 * m.mesh.node_xyz[b];
  const ShapeCauses c = m.causes();
  EXPECT_EQ(c.sharp.free(), 2) << "the two triangles of the edge";
  EXPECT_EQ(c.sharp.total(), 2);
  EXPECT_GE(c.growth.free(), 2);
  EXPECT_EQ(c.growth.total(), c.growth.free());
  EXPECT_GE(c.lengths.free(), 1);
  const CausePlace& worst = c.lengths.worst[static_cast<std::size_t>(ShapeCause::kFree)][0];
  EXPECT_NEAR(worst.value, 0.06, 0.03);
  EXPECT_LT(distance(worst.xyz, m.mesh.node_xyz[b]), 0.1);
}

TEST(ShapeCauses, blame_the_sizes_where_they_jump) {
  MeshedShape m("square", 1);
  const auto [a, b] = m.inner_edge();
  m.mesh.node_xyz[a] = 0.06 * m.mesh.node_xyz[a] + 0.94 * m.mesh.node_xyz[b];
  m.mesh.node_size[a] = m.mesh.node_size[b] = 0.1;
  const ShapeCauses c = m.causes();
  EXPECT_EQ(count(c.sharp, ShapeCause::kSizeJump), 2);
  EXPECT_EQ(c.sharp.free(), 0);
}

TEST(ShapeCauses, do_not_excuse_an_ear_of_a_smooth_boundary) {
  MeshedShape m("disc", 0.5);  // pull a node inside onto the chord of two of its boundary neighbours: a flat triangle
                               // on three boundary nodes
  EXPECT_EQ(m.causes().sharp.total(), 0);
  // the triangle of a boundary segment and a node inside, which becomes a node of the rim to the eye of the check
  for (TriangleId t = 0; t < m.mesh.n_triangles(); ++t) {
    auto& n = m.mesh.triangles[t].n;
    for (int k = 0; k < 3; ++k) {
      const NodeId p = n[k], q = n[(k + 1) % 3], r = n[(k + 2) % 3];
      if (m.mesh.node_entity_dim[p] != 1 || m.mesh.node_entity_dim[q] != 1 || q != p + 1) continue;
      if (m.mesh.node_entity_dim[q + 1] != 1 || r == q + 1) continue;
      n[(k + 2) % 3] = q + 1;  // now p, q, q + 1 in a row along the circle
      const ShapeCauses c = m.causes(15);
      EXPECT_GE(c.sharp.free(), 1);
      EXPECT_EQ(count(c.sharp, ShapeCause::kStrip), 0);
      return;
    }
  }
  FAIL() << "no such triangle";
}

TEST(ShapeCauses, keep_the_worst_places_first_and_count_all) {
  MeshedShape m("square", 0.5);
  for (NodeId n = 0; n < m.mesh.n_nodes(); ++n)  // squeezed to a tenth: everything inside is sharp
    m.mesh.node_xyz[n].y *= 0.05;
  const ShapeCauses c = m.causes(20);
  const auto& worst = c.sharp.worst[static_cast<std::size_t>(ShapeCause::kFree)];
  EXPECT_GT(c.sharp.free(), 100);
  ASSERT_EQ(worst.size(), CauseList::kMaxPlaces);
  EXPECT_TRUE(std::is_sorted(worst.begin(), worst.end(),
                             [](const CausePlace& a, const CausePlace& b) { return a.value < b.value; }));
}

}  // namespace
}  // namespace st
