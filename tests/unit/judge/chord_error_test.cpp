// What chords explain of the difference between a mesh and its CAD.
#include "judge/chord_error.h"

#include <gtest/gtest.h>

#include "mesh/checks.h"
#include "unit/meshing/shape_mesh.h"

namespace st {
namespace {

using test::ShapeMesh;

TEST(ChordError, of_planes_is_nothing) {
  const ShapeMesh box("box");
  const ChordError e = estimate_chord_error(box.model, box.mesh);
  for (FaceId f = 0; f < 6; ++f) {
    EXPECT_NEAR(e.area[f], 0, 1e-9 * box.model.tables().face_area[f]);
    EXPECT_NEAR(e.distance[f], 0, 1e-9);
    EXPECT_NEAR(e.node_distance[f], 0, 1e-9);
    EXPECT_EQ(e.off_surface[f], 0);
  }
}

TEST(ChordError, explains_the_area_that_a_curved_solid_lacks) {
  for (const char* shape : {"sphere", "cylinder", "cone", "torus", "drilled_cylinder"})
    for (const double share : {0.05, 0.1}) {
      const ShapeMesh solid(shape, share);
      const ChordError e = estimate_chord_error(solid.model, solid.mesh);
      const std::vector<double> area = measure_mesh(solid.mesh).face_area;
      for (FaceId f = 0; f < solid.model.tables().n_faces(); ++f) {
        const double missing = std::abs(solid.model.tables().face_area[f] - area[f]);
        EXPECT_LE(missing, 1.2 * e.area[f] + 1e-9) << shape << " " << share << " face " << f;
        EXPECT_LE(e.area[f], 20 * missing + 1e-6 * area[f])
            << shape << " " << share << " face " << f << ": explains too much";
      }
    }
}

TEST(ChordError, of_a_sphere_is_no_less_than_the_height_of_its_longest_chord) {
  const ShapeMesh ball("sphere");
  double longest = 0;
  for (const Triangle& t : ball.mesh.triangles)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, distance(ball.mesh.node_xyz[t.n[k]], ball.mesh.node_xyz[t.n[(k + 1) % 3]]));
  const double height = 10 - std::sqrt(100 - 0.25 * longest * longest);
  const double found = estimate_chord_error(ball.model, ball.mesh).distance[0];
  EXPECT_GT(found, 0.95 * height);
  EXPECT_LT(found, 1.05 * height);
}

TEST(ChordError, says_which_node_is_off_its_surface_and_lets_it_explain_nothing) {
  ShapeMesh ball("sphere");
  const ChordError before = estimate_chord_error(ball.model, ball.mesh);
  const NodeId moved = static_cast<NodeId>(ball.mesh.n_nodes()) - 5;
  const double h = ball.mesh.node_size[moved];
  ball.mesh.node_xyz[moved] = (1 + 0.5 * h / 10) * ball.mesh.node_xyz[moved];
  const ChordError after = estimate_chord_error(ball.model, ball.mesh);
  EXPECT_NEAR(after.node_distance[0], 0.5 * h, 1e-6);
  EXPECT_TRUE(after.node_place[0] == ball.mesh.node_xyz[moved]);
  EXPECT_GT(after.off_surface[0], 0);
  EXPECT_TRUE(after.off_place[0] == ball.mesh.node_xyz[moved]);
  EXPECT_EQ(after.area[0], before.area[0]);
  EXPECT_EQ(before.off_surface[0], 0);

  ball.mesh.node_xyz[moved] = (10 + 0.2 * h) * normalized(ball.mesh.node_xyz[moved]);
  EXPECT_EQ(estimate_chord_error(ball.model, ball.mesh).off_surface[0], 0)
      << "below " << kOffSurface << " of its length";
}

}  // namespace
}  // namespace st
