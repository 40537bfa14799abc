// Triangles of two parts that cross, with and without a gap between the parts.
#include "judge/walls_apart.h"

#include <gtest/gtest.h>

#include "mesh/checks.h"
#include "support/meshed.h"

namespace st {
namespace {

using test::Meshed;

CrossingReport crossings_of(const Meshed& m) {
  WallsApart walls(m.model, m.mesh);
  return check_crossings(m.mesh, {{},
                                  [&](const TrianglePair& pair) { return walls.are_apart(pair); },
                                  [&](const TrianglePair& pair) { return walls.are_of_one_body(pair); }});
}

MeshOptions as_before() {
  MeshOptions options;
  options.parts_bodies = false;
  return options;
}

TEST(WallsApart, are_told_from_contacts_where_parts_cross) {
  const CrossingReport c = crossings_of(Meshed("pin_in_bore", 2, as_before()));
  EXPECT_GT(c.walls.count, 0);
  EXPECT_EQ(c.crossings.count, 0) << "of two bodies";
}

TEST(WallsApart, of_one_body_are_crossings) {
  Meshed ball("thin_ball", 2);
  ASSERT_TRUE(crossings_of(ball).passes());
  NodeId inside = 0;  // of the inner sphere: out through the outer one
  while (norm(ball.mesh.node_xyz[inside]) > 9.995) ++inside;
  ball.mesh.node_xyz[inside] = 1.2 * ball.mesh.node_xyz[inside];
  EXPECT_GT(crossings_of(ball).crossings.count, 0);
}

TEST(WallsApart, are_parted_by_shorter_chords) {
  for (const char* shape : {"pin_in_bore", "thin_ball"}) {
    const CrossingReport c = crossings_of(Meshed(shape, 2));
    EXPECT_EQ(c.walls.count + c.contacts.count + c.crossings.count, 0) << shape;
  }
}

TEST(WallsApart, are_no_fault_where_parts_touch) {
  const Meshed m("two_boxes", 4);
  WallsApart walls(m.model, m.mesh);
  EXPECT_FALSE(walls.are_apart({0, static_cast<TriangleId>(m.mesh.n_triangles() - 1), 0})) << "planes have no chords";
}

}  // namespace
}  // namespace st
