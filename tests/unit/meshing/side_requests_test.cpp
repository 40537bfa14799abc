#include "meshing/hole/side_requests.h"

#include <gtest/gtest.h>

#include <atomic>

namespace st {
namespace {

/// Asks for 0.1 at x = 0, 0.3 at x = 1, and along y for twice as much. Counts.
class Graded : public UniformField {
 public:
  Graded() : UniformField(0.1) {}
  LocalSize local_on(Vec3 x, Vec3, int&) const override {
    ++n_asked;
    const double length = 0.1 + 0.2 * x.x;
    return {length, 2 * length, {0, 1, 0}};
  }
  mutable std::atomic<int> n_asked = 0;
};

/// Two triangles of the unit square, and a node that none of them has.
SurfaceMesh square() {
  SurfaceMesh mesh;
  mesh.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{{0, 1, 2}}, {{3, 2, 1}}};
  return mesh;
}

constexpr double kAny = 1e300;

TEST(SideRequests, are_lengths_over_what_is_asked_for_at_both_ends) {
  const SurfaceMesh mesh = square();
  const Graded field;
  const SideRequests sides(mesh, 0, 2, {}, field);
  EXPECT_NEAR(sides.ratio(0, 1, kAny, kAny), 1 / 0.2, 1e-12);
  EXPECT_NEAR(sides.ratio(2, 0, kAny, kAny), 1 / 0.2, 1e-12);  // along y
  EXPECT_NEAR(sides.ratio(3, 1, kAny, kAny), 1 / 0.6, 1e-12);
}

TEST(SideRequests, take_the_most_of_each_end_to_that_end) {
  const SurfaceMesh mesh = square();
  const Graded field;
  const SideRequests sides(mesh, 0, 2, {}, field);
  EXPECT_NEAR(sides.ratio(0, 1, kAny, 0.2), 1 / 0.15, 1e-12);
  EXPECT_NEAR(sides.ratio(1, 0, 0.2, kAny), 1 / 0.15, 1e-12);
}

TEST(SideRequests, ask_once_at_each_end_of_a_side) {
  const SurfaceMesh mesh = square();
  const Graded field;
  const SideRequests sides(mesh, 0, 2, {{1, 0}}, field);
  EXPECT_EQ(field.n_asked, 2 * 5);
  sides.ratio(0, 1, kAny, kAny);
  EXPECT_EQ(field.n_asked, 2 * 5);
}

TEST(SideRequests, know_segments_that_no_triangle_of_the_share_has) {
  const SurfaceMesh mesh = square();
  const Graded field;
  const SideRequests sides(mesh, 0, 1, {{4, 0}}, field);
  EXPECT_EQ(field.n_asked, 2 * 4);
  EXPECT_NEAR(sides.ratio(0, 4, kAny, kAny), 1 / 0.1, 1e-12);
}

}  // namespace
}  // namespace st
