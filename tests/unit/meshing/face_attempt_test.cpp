// What is kept of a face that could not be meshed.
#include "meshing/face/face_attempt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/log.h"
#include "support/meshed.h"

namespace st {
namespace {

/// A meshed model, so that its edges have nodes.
struct MeshedEdges : test::Meshed {
  BoundaryNumbering numbering;

  explicit MeshedEdges(const std::string& shape) : test::Meshed(shape, 2), numbering(topology, result.edges) {}
};

double length_of(const FaceAttempt& f) {
  double length = 0;
  for (std::size_t s = 0; s < f.segment_loop.size(); ++s)
    length += distance(f.patch.inner_xyz[f.segment_nodes[2 * s]], f.patch.inner_xyz[f.segment_nodes[2 * s + 1]]);
  return length;
}

TEST(FaceAttempt, has_every_segment_of_its_loops_with_loop_and_edge) {
  const MeshedEdges m("plate_with_hole");
  const auto surface = m.model.surface(0);
  const FaceAttempt f = describe_attempt(m.numbering, 0, make_face_boundary(m.model, *surface, 0, m.numbering), {});
  EXPECT_NEAR(length_of(f), 200 + 16 * kPi, 1) << "the rectangle and the hole";
  EXPECT_EQ(std::set<std::int32_t>(f.segment_loop.begin(), f.segment_loop.end()), (std::set<std::int32_t>{0, 1}));
  EXPECT_EQ(std::set<EdgeId>(f.segment_edge.begin(), f.segment_edge.end()).size(), 5u);
  for (std::size_t s = 0; s < f.segment_loop.size(); ++s) {
    const double t = m.model.tables().edge_length[f.segment_edge[s]];
    EXPECT_LT(distance(f.patch.inner_xyz[f.segment_nodes[2 * s]], f.patch.inner_xyz[f.segment_nodes[2 * s + 1]]), t)
        << "a segment of another edge";
  }
  for (std::size_t i = 0; i < f.patch.inner_xyz.size(); ++i)
    EXPECT_LT(distance(surface->point(f.patch.inner_uv[i]), f.patch.inner_xyz[i]), 1e-6);
}

TEST(FaceAttempt, has_a_seam_twice) {
  const MeshedEdges m("cylinder");
  for (FaceId face = 0; face < 3; ++face) {
    const auto surface = m.model.surface(face);
    if (surface->type() != SurfaceType::kCylinder) continue;
    const FaceAttempt f =
        describe_attempt(m.numbering, face, make_face_boundary(m.model, *surface, face, m.numbering), {});
    EXPECT_NEAR(length_of(f), 2 * 30 + 2 * 20 * kPi, 2);
  }
}

TEST(FaceAttempt, without_trimming_curves_has_the_nodes_of_its_edges_and_no_uv) {
  const MeshedEdges m("plate_with_hole");
  const FaceAttempt f = describe_attempt(m.numbering, 0, {}, {});
  EXPECT_NEAR(length_of(f), 200 + 16 * kPi, 1);
  for (const Vec2 uv : f.patch.inner_uv) EXPECT_TRUE(std::isnan(uv.x) && std::isnan(uv.y));
  EXPECT_EQ(f.patch.inner_uv.size(), f.patch.inner_xyz.size());
}

TEST(FaceAttempt, keeps_the_triangles_so_far_and_drops_those_that_reach_nowhere) {
  const MeshedEdges m("square");
  const auto surface = m.model.surface(0);
  const FaceBoundary boundary = make_face_boundary(m.model, *surface, 0, m.numbering);
  FaceMesh mesh = mesh_face(*surface, boundary, m.field, {});
  const std::size_t n_triangles = mesh.corners.size() / 3;
  mesh.corners.insert(mesh.corners.end(), {0, 1, kNone});
  mesh.refinement.push_back({{1, 2, 3}, 1});
  const FaceAttempt f = describe_attempt(m.numbering, 0, boundary, mesh);
  ASSERT_EQ(f.patch.triangles.size(), n_triangles);
  double area = 0;
  for (const Triangle& t : f.patch.triangles)
    area += 0.5 * norm(cross(f.patch.inner_xyz[t.n[1]] - f.patch.inner_xyz[t.n[0]],
                             f.patch.inner_xyz[t.n[2]] - f.patch.inner_xyz[t.n[0]]));
  EXPECT_NEAR(area, 100, 1e-9);
  ASSERT_EQ(f.places.size(), 1u);
  EXPECT_TRUE(f.places[0] == (Vec3{1, 2, 3}));
}

TEST(FaceAttempt, survives_the_way_between_ranks) {
  const MeshedEdges m("plate_with_hole");
  const auto surface = m.model.surface(0);
  const FaceBoundary boundary = make_face_boundary(m.model, *surface, 0, m.numbering);
  const FaceAttempt f = describe_attempt(m.numbering, 0, boundary, mesh_face(*surface, boundary, m.field, {}));
  const Bytes bytes = packed(f);
  Unpacker unpacker(bytes);
  FaceAttempt g;
  unpacker.get(g);
  EXPECT_TRUE(unpacker.is_empty());
  EXPECT_EQ(g.segment_nodes, f.segment_nodes);
  EXPECT_EQ(g.segment_edge, f.segment_edge);
  EXPECT_EQ(g.patch.inner_size, f.patch.inner_size);
  EXPECT_EQ(g.patch.triangles.size(), f.patch.triangles.size());
}

}  // namespace
}  // namespace st
