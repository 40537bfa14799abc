// Folded patches are parted along sides.
#include "geometry/facet/facet_cones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "geometry/facet/facet_cuts.h"
#include "geometry/facet/facet_faces.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

/// A sheet of 2 n n triangles, of which node (n/2, n/2) is pulled over its neighbours: some lie on their backs.
FacetInput folded_sheet(int n) {
  return test::grid_facets(n, n, [&](int i, int j) {
    return i == n / 2 && j == n / 2 ? Vec3{i + 2.3, j + 1.1, 0} : Vec3{1.0 * i, 1.0 * j, 0};
  });
}

FacetPatch whole_patch(const FacetInput& input) {
  FacetPatch patch;
  patch.x = input.x, patch.corners = input.corners;
  for (std::size_t t = 0; t < input.corners.size(); ++t) patch.triangles.push_back(static_cast<std::int32_t>(t));
  patch.neighbours = find_neighbours(patch.corners);
  return patch;
}

TEST(FacetCones, PartWhatLiesOnItsBack) {
  const FacetPatch folded = whole_patch(folded_sheet(8));
  EXPECT_TRUE(is_folded(folded));
  const std::vector<std::int32_t> group = part_by_normals(folded);
  for (std::size_t t = 0; t < group.size(); ++t) {
    const Corners& c = folded.corners[t];
    const double up = cross(folded.x[c[1]] - folded.x[c[0]], folded.x[c[2]] - folded.x[c[0]]).z;
    EXPECT_EQ(up > 0, group[t] == group[0]) << t;
  }
  const FacetPatch flat = whole_patch(test::grid_facets(4, 4, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; }));
  EXPECT_FALSE(is_folded(flat));
}

TEST(FacetCones, HalveWhatHasOneNormal) {
  const FacetPatch flat = whole_patch(test::grid_facets(4, 2, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; }));
  const std::vector<std::int32_t> group = part_by_normals(flat);
  EXPECT_EQ(std::count(group.begin(), group.end(), 0), std::count(group.begin(), group.end(), 1));
  FacetPatch one = flat;
  one.corners.resize(1), one.triangles.resize(1), one.neighbours = find_neighbours(one.corners);
  EXPECT_EQ(part_by_normals(one), std::vector<std::int32_t>{0});
}

/// A nose of two long sides that look away from each other, with one row of facets between them at an angle to the
/// upper one.
FacetPatch nose(double angle) {
  const std::array<Vec2, 4> profile{
      {{9, 1}, {0, 1}, {-std::cos(angle), 1 - std::sin(angle)}, {9, 1 - std::sin(angle)}}};
  return whole_patch(test::grid_facets(3, 5, [&](int i, int j) { return Vec3{profile[i].x, 1.0 * j, profile[i].y}; }));
}

TEST(FacetCones, HandAFewFacetsBetweenThemToOne) {
  const auto n_groups = [](const std::vector<std::int32_t>& group) {
    return std::set<std::int32_t>(group.begin(), group.end()).size();
  };
  EXPECT_EQ(n_groups(part_by_normals(nose(radians(75)))), 2u);
  EXPECT_EQ(n_groups(part_by_normals(nose(radians(90)))), 3u) << "they would be folded in either cone";
}

TEST(FacetCones, LeaveTheFacetsOfAFoldedSheet) {
  const FacetInput sheet = folded_sheet(12);
  FacetMesh mesh = find_smooth_faces(sheet, radians(180));
  cut_into_charts(mesh);
  EXPECT_EQ(mesh.corners.size(), sheet.corners.size()) << "no plane cuts a fold away";
  const std::set<std::int32_t> faces(mesh.face.begin(), mesh.face.end());
  EXPECT_GE(faces.size(), 2u);
  EXPECT_LE(faces.size(), 8u);
}

TEST(FacetCones, LeaveNoGapBesideCutsOfOthers) {
  FacetInput torus = test::torus_facets(60, 30);
  for (const std::int32_t n : {400, 900}) torus.x[n] = torus.x[n] + 2.5 * (torus.x[n + 1] - torus.x[n]);
  FacetMesh mesh = find_smooth_faces(torus, radians(180));
  cut_into_charts(mesh);
  EXPECT_GT(mesh.corners.size(), torus.corners.size()) << "nothing was cut beside a fold";
  for (const Corners& c : find_neighbours(mesh.corners)) EXPECT_EQ(std::count(c.begin(), c.end(), kNone), 0);
}

}  // namespace
}  // namespace st
