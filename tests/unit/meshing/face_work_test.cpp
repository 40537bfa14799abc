#include "meshing/face/face_work.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/meshing/faces.h"

namespace st {
namespace {

struct WorkOnPlane {
  WorkOnPlane() {
    work.set_surface(test::kPlane);
    work.field = &field;
  }
  MeshNode node(Vec2 uv) {
    MeshNode n;
    n.p = work.plane.to_plane(uv);
    work.evaluate(n);
    work.ask_sizes(n);
    return n;
  }

  UniformField field{0.5};
  FaceWork work;
};

TEST(FaceWork, evaluates_and_asks_at_the_place_of_a_node) {
  WorkOnPlane plane;
  const MeshNode n = plane.node({2, 3});
  EXPECT_NEAR(distance(n.x, {2, 3, 0}), 0, 1e-12);
  EXPECT_NEAR(distance(n.normal, {0, 0, 1}), 0, 1e-12);
  EXPECT_EQ(n.h, 0.5);
  EXPECT_EQ(n.request, 0.5);
  EXPECT_EQ(norm(n.squeeze), 0);
}

TEST(FaceWork, asks_how_many_nodes_are_a_runaway_where_the_boundary_explains_no_more) {
  WorkOnPlane plane;
  int n_asked = 0;
  plane.work.max_nodes = 2;
  plane.work.find_max_nodes = [&] { return ++n_asked, std::size_t{3}; };
  plane.work.mesh.nodes.resize(1);
  EXPECT_FALSE(plane.work.is_runaway());
  EXPECT_EQ(n_asked, 0);
  plane.work.mesh.nodes.resize(2);
  EXPECT_FALSE(plane.work.is_runaway());
  plane.work.mesh.nodes.resize(3);
  EXPECT_TRUE(plane.work.is_runaway());
  EXPECT_EQ(n_asked, 1);
}

TEST(FaceWork, measures_edges_and_circles_in_space) {
  WorkOnPlane plane;
  plane.work.mesh.nodes = {plane.node({0, 0}), plane.node({3, 0}), plane.node({0, 4})};
  EXPECT_NEAR(plane.work.edge_length2<false>(1, 2), 25, 1e-9);
  EXPECT_NEAR(plane.work.way_along<false>(plane.work.mesh.nodes[1], plane.work.mesh.nodes[2]), 5, 1e-9);
  PlaneTriangle t{{0, 1, 2}, {kNone, kNone, kNone}};
  EXPECT_NEAR(plane.work.circumradius2<false>(t), 6.25, 1e-9);
  EXPECT_NEAR(plane.work.circumradius2<true>(t), 6.25, 1e-9);
}

TEST(FaceWork, takes_a_normal_from_inside_where_the_surface_is_singular) {
  const test::FaceCase cone("cone_side", UniformField(0.3));
  FaceWork work;
  work.set_surface(*cone.surface);
  for (const FaceNode& b : cone.boundary.nodes) {
    MeshNode n{b};
    n.p = work.plane.to_plane(b.uv);
    work.evaluate(n);
    EXPECT_NEAR(norm(work.reliable_normal(n)), 1, 1e-9);
  }
}

}  // namespace
}  // namespace st
