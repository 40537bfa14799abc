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
  return check_crossings(m.mesh, {{}, [&](const TrianglePair& pair) { return walls.are_apart(pair); }});
}

MeshOptions as_before() {
  MeshOptions options;
  options.parts_bodies = false;
  return options;
}

TEST(WallsApart, are_a_fault_where_parts_cross_that_the_cad_keeps_apart) {
  const CrossingReport c = crossings_of(Meshed("pin_in_bore", 2, as_before()));
  EXPECT_GT(c.walls.count, 0);
  EXPECT_FALSE(c.passes());
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
