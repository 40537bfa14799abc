#include "geometry/shape/coarse_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "unit/geometry/chart_models.h"

namespace st {
namespace {

Corners lowest_first(Corners c) {
  std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  return c;
}

/// A dome with two holes, 60 x 60 quadrangles.
test::ChartPatch dome_with_holes() {
  test::ChartPatch p = test::sphere_patch(1, 2.4, 1.3, 60);
  std::vector<Corners> kept;
  for (std::size_t t = 0; t < p.corners.size(); ++t) {
    const int i = static_cast<int>(t / 2) % 60, j = static_cast<int>(t / 2) / 60;
    const bool is_hole = j >= 20 && j < 34 && ((i >= 10 && i < 24) || (i >= 36 && i < 50));
    if (!is_hole) kept.push_back(p.corners[t]);
  }
  test::ChartPatch used;
  std::vector<std::int32_t> number(p.x.size(), kNone);
  for (Corners& c : kept)
    for (std::int32_t& n : c) {
      if (number[n] == kNone) {
        number[n] = static_cast<std::int32_t>(used.x.size());
        used.x.push_back(p.x[n]);
      }
      n = number[n];
    }
  used.corners = kept;
  return used;
}

double patch_area(std::span<const Vec3> x, std::span<const Corners> corners) {
  double area = 0;
  for (const Corners& c : corners) area += 0.5 * norm(cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]));
  return area;
}

TEST(CoarsePatch, has_the_topology_and_nearly_the_shape_of_the_fine_one) {
  const test::ChartPatch p = dome_with_holes();
  const PatchTopology fine = find_topology(p.x, p.corners);
  ASSERT_EQ(fine.loops.size(), 3u);
  const CoarsePatch coarse = coarsen(p.x, p.corners, fine, 600);
  EXPECT_LE(coarse.corners.size(), 600u);
  const PatchTopology t = find_topology(coarse.x, coarse.corners);
  EXPECT_TRUE(t.is_manifold && t.n_components == 1 && t.genus == 0);
  ASSERT_EQ(t.loops.size(), 3u);
  EXPECT_NEAR(patch_area(coarse.x, coarse.corners) / patch_area(p.x, p.corners), 1, 0.02);
  EXPECT_NEAR(t.loop_length[t.outer_loop()] / fine.loop_length[fine.outer_loop()], 1, 0.02);
}

/// Puts nodes back, from the last to the first: in place of the fan comes the star.
void expect_way_back(const test::ChartPatch& p, const CoarsePatch& coarse) {
  ASSERT_EQ(coarse.node.size() + coarse.removed.size(), p.x.size());
  std::set<Corners> triangles, fine;
  for (const Corners& c : coarse.corners)
    triangles.insert(lowest_first({coarse.node[c[0]], coarse.node[c[1]], coarse.node[c[2]]}));
  ASSERT_EQ(triangles.size(), coarse.corners.size());
  for (std::size_t i = coarse.removed.size(); i-- > 0;) {
    const RemovedNode& r = coarse.removed[i];
    const auto ring = coarse.ring_of(r);
    const std::int32_t from = r.is_from_end ? ring.back() : ring.front();
    for (std::size_t k = 0; k < ring.size() - (r.is_rim ? 1 : 0); ++k) {
      const std::int32_t a = ring[k], b = ring[(k + 1) % ring.size()];
      if (a != from && b != from) {
        ASSERT_EQ(triangles.erase(lowest_first({from, a, b})), 1u);
      }
      ASSERT_TRUE(triangles.insert(lowest_first({r.node, a, b})).second);
    }
  }
  for (const Corners& c : p.corners) fine.insert(lowest_first(c));
  EXPECT_TRUE(triangles == fine);
}

TEST(CoarsePatch, becomes_the_fine_one_when_its_nodes_come_back) {
  for (const double noise : {0.0, 0.01, 0.03, 0.1}) {  // spacing 0.02 to 0.04
    const test::ChartPatch p = test::with_noise(dome_with_holes(), noise);
    const CoarsePatch coarse = coarsen(p.x, p.corners, find_topology(p.x, p.corners), 300);
    expect_way_back(p, coarse);
    const PatchTopology t = find_topology(coarse.x, coarse.corners);
    EXPECT_TRUE(t.is_manifold && t.n_components == 1 && t.genus == 0 && t.loops.size() == 3) << noise;
  }
}

TEST(CoarsePatch, keeps_corners_and_what_is_coarse_already) {
  const test::ChartPatch plate = test::grid_patch(40, 40, [](double s, double t) {
    return std::pair(Vec3{s, t, 0}, Vec3{0, 0, 1});
  });
  const CoarsePatch coarse = coarsen(plate.x, plate.corners, find_topology(plate.x, plate.corners), 100);
  EXPECT_NEAR(patch_area(coarse.x, coarse.corners), 1, 1e-12);
  const CoarsePatch same = coarsen(plate.x, plate.corners, find_topology(plate.x, plate.corners), 3200);
  EXPECT_TRUE(same.removed.empty() && same.corners == plate.corners);
}

}  // namespace
}  // namespace st
