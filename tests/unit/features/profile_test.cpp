// Profiles of wings in cuts through facets.
#include "features/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/shape/chart_surface.h"
#include "support/shapes.h"

namespace st {
namespace {

TEST(Profile, of_a_wing_is_as_thick_as_its_aerofoil) {
  const Model model = test::make_model("sharp_wing");
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(model.tables().n_faces()), 1);
  const Facets facets = make_facets(model, all, {.deflection = 0.01});
  const auto profile = ProfileCutter(facets).cut({10, 0, 15}, {0, 0, 1}, 0.02);
  ASSERT_TRUE(profile);
  EXPECT_NEAR(profile->chord, 10, 0.01);
  EXPECT_NEAR(profile->thickness, 0.12, 0.003);
  EXPECT_FALSE(ProfileCutter(facets).cut({10, 0, 15}, {1, 0, 0}, 0.02)) << "along the edge";
  EXPECT_FALSE(ProfileCutter(facets).cut({20, 0, 15}, {0, 0, 1}, 0.02)) << "off the wing";
}

TEST(Profile, as_a_whole_cut_says_how_thick_it_is_and_whose_its_end_is) {
  const Model model = test::make_model("sharp_wing");
  std::vector<std::uint8_t> own(static_cast<std::size_t>(model.tables().n_faces()), 1);
  const Facets facets = make_facets(model, own, {.deflection = 0.01});
  const ProfileCutter cutter(facets);
  const auto cut = cutter.whole_cut({10, 0, 15}, {0, 0, 1}, 0.02, own);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->chord, 10, 0.01);
  EXPECT_NEAR(cut->thickness, 0.12, 0.003);
  EXPECT_TRUE(cut->is_own);
  const FaceId upper = cutter.nearest_face({5, 0.6, 15}, {0, 0, 1}, 0.1);
  ASSERT_NE(upper, kNone);
  EXPECT_EQ(cutter.nearest_face({5, 5, 15}, {0, 0, 1}, 0.1), kNone);
  std::ranges::fill(own, std::uint8_t{0});
  EXPECT_FALSE(cutter.whole_cut({10, 0, 15}, {0, 0, 1}, 0.02, own)->is_own);
  EXPECT_EQ(cutter.whole_cut({10, 0, 15}, {0, 0, 1}, 0.02, own)->chord, 0);
  EXPECT_FALSE(cutter.whole_cut({20, 0, 15}, {0, 0, 1}, 0.02, own)) << "off the wing";
}

TEST(Profile, has_its_nose_on_the_surface_itself) {
  const Model model = test::make_model("cylinder");
  const ModelTables& t = model.tables();
  const auto side = std::ranges::find(t.face_type, SurfaceType::kCylinder) - t.face_type.begin();
  const Box3 box = t.face_box[static_cast<std::size_t>(side)];
  const double radius = 0.5 * (box.hi.y - box.lo.y);
  const auto surface = model.surface(static_cast<FaceId>(side));
  const Vec3 middle = box.center(), tail = middle + Vec3{0, 5 * radius, 0};
  Profile profile{.normal = {0, 0, 1}, .chord = 6 * radius};
  profile.nose = middle + radius * Vec3{std::sin(0.1), -std::cos(0.1), 0};  // as a facet's corner beside it
  std::optional<Vec2> guess;
  const auto nose = exact_nose(*surface, tail, profile, 0.2 * radius, guess);
  ASSERT_TRUE(nose);
  EXPECT_LT(distance(*nose, middle - Vec3{0, radius, 0}), 1e-5 * radius);
  ASSERT_TRUE(guess);
  EXPECT_LT(distance(surface->point(*guess), *nose), 1e-12 * radius);
  EXPECT_FALSE(exact_nose(*surface, tail, profile, 0.05 * radius, guess)) << "further away than the facets may be";
}

// Of a part of a cylinder whose rim runs across the nose: it ends before it at z = 0, behind it at z = 1.
TEST(Profile, has_no_nose_beyond_the_rim_of_facets) {
  constexpr int kAlong = 20, kAcross = 10;
  Chart chart;
  for (int j = 0; j <= kAcross; ++j)
    for (int i = 0; i <= kAlong; ++i) {
      const double v = 1.0 * j / kAcross, begin = 0.2 - 0.5 * v, u = begin + (1.2 - begin) * i / kAlong;
      chart.normal.push_back({std::sin(u), -std::cos(u), 0});
      chart.x.push_back(chart.normal.back() + Vec3{0, 0, v});
      chart.uv.push_back({u, v});
      if (i == 0 || j == 0) continue;
      const std::int32_t d = j * (kAlong + 1) + i, c = d - 1, b = d - kAlong - 1, a = b - 1;
      chart.corners.push_back({a, b, d});
      chart.corners.push_back({a, d, c});
    }
  const ChartSurface surface(chart);
  const auto nose_at = [&](double z, double beside) {
    Profile profile{.normal = {0, 0, 1}, .chord = 6};
    profile.nose = {std::sin(beside), -std::cos(beside), z};
    std::optional<Vec2> guess;
    return exact_nose(surface, {0, 5, z}, profile, 0.3, guess);
  };
  EXPECT_FALSE(nose_at(0.05, 0.2));
  const auto nose = nose_at(0.9, 0.1);
  ASSERT_TRUE(nose);
  EXPECT_NEAR(nose->x, 0, 0.03);
}

/// Where the plane crosses two sides of a triangle.
std::vector<Vec3> crossing(const Facets& facets, std::size_t i, Vec3 origin, Vec3 normal) {
  std::vector<Vec3> ends;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = facets.xyz[facets.triangle[i][k]], b = facets.xyz[facets.triangle[i][(k + 1) % 3]];
    const double high = dot(a - origin, normal), low = dot(b - origin, normal);
    if ((high >= 0) != (low >= 0)) ends.push_back(a + high / (high - low) * (b - a));
  }
  return ends;
}

TEST(Profile, begins_on_the_facet_that_is_nearest_of_all) {
  const Model model = test::make_row_of_cubes(40);
  const Facets facets = make_facets(model, std::vector<std::uint8_t>(model.tables().n_faces(), 1), {.deflection = 0.1});
  const ProfileCutter cutter(facets);
  const Box3 box = model.tables().box();
  const double reach = 0.01 * box.diagonal();
  int n_found = 0;
  for (int k = 0; k < 2000; ++k) {
    const auto share = [&](double step) { return std::fmod(step * (k + 1), 1.0); };
    const Vec3 size = box.hi - box.lo,
               at = box.lo + Vec3{share(0.8191725) * size.x, share(0.6710436) * size.y, share(0.5497004) * size.z};
    const Vec3 normal = normalized(Vec3{share(0.31) - 0.5, share(0.47) - 0.5, share(0.73) - 0.5});
    std::vector<double> least(static_cast<std::size_t>(model.tables().n_faces()), 2 * reach);
    for (std::size_t i = 0; i < facets.triangle.size(); ++i)
      if (const std::vector<Vec3> ends = crossing(facets, i, at, normal); ends.size() == 2)
        least[facets.face[i]] = std::min(least[facets.face[i]], segment_distance(at, ends[0], ends[1]));
    const double nearest = std::ranges::min(least);
    const FaceId found = cutter.nearest_face(at, normal, reach);
    ASSERT_EQ(found != kNone, nearest <= reach) << k;
    if (found == kNone) continue;
    EXPECT_NEAR(least[found], nearest, 1e-12 * reach) << k;
    ++n_found;
  }
  EXPECT_GT(n_found, 300);
}

TEST(Profile, ends_where_the_next_face_has_no_facets) {
  const Model model = test::make_model("sharp_wing");
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(model.tables().n_faces()), 1);
  const Facets all = make_facets(model, wanted, {.deflection = 0.01});
  EXPECT_TRUE(ProfileCutter(all).ends_of({10, 0, 15}, {0, 0, 1}, 0.02).empty());
  const auto profile = ProfileCutter(all).cut({10, 0, 15}, {0, 0, 1}, 0.02);
  ASSERT_TRUE(profile);
  wanted[static_cast<std::size_t>(profile->faces[0])] = 0;
  const Facets some = make_facets(model, wanted, {.deflection = 0.01});
  const std::vector<CutPlace> ends = ProfileCutter(some).ends_of({10, 0, 15}, {0, 0, 1}, 0.02);
  ASSERT_EQ(ends.size(), 2u) << "at the trailing edge and at the nose";
  for (const CutPlace& end : ends) {
    EXPECT_EQ(end.face, profile->faces[1]);
    EXPECT_NEAR(std::abs(end.x.x - 5), 5, 0.01);
    EXPECT_NEAR(end.x.z, 15, 1e-9);
  }
}

TEST(Profile, of_a_closed_wing_has_its_tail_at_the_thinner_end) {
  const Model model = test::make_model("closed_wing");
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(model.tables().n_faces()), 1);
  const Facets facets = make_facets(model, wanted, {.deflection = 0.01});
  const ProfileCutter cutter(facets);
  const auto round = cutter.round_profile({0, 1, 15}, {0, 0, 1}, 0.05);
  ASSERT_TRUE(round);
  EXPECT_NEAR(round->tail.x, 5, 0.02);
  EXPECT_NEAR(round->profile.nose.x, -5, 0.02);
  EXPECT_NEAR(round->bluntness, 0.25, 0.05) << "0.4 over 1.6";
  const auto whole = cutter.whole({0, 1, 15}, {0, 0, 1}, 0.05);
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->chord, 10, 0.05);
  EXPECT_NEAR(whole->middle, 2, 0.05);
  EXPECT_FALSE(cutter.round_profile({20, 0, 15}, {0, 0, 1}, 0.05)) << "off the wing";
}

TEST(Profile, that_is_open_has_no_tail_of_its_own) {
  const Model model = test::make_model("wing_of_2");
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(model.tables().n_faces()), 1);
  const Facets all = make_facets(model, wanted, {.deflection = 0.01});
  const auto round = ProfileCutter(all).round_profile({10, 0, 15}, {0, 0, 1}, 0.05);
  ASSERT_TRUE(round);
  wanted[static_cast<std::size_t>(round->profile.faces[0])] = 0;
  const Facets some = make_facets(model, wanted, {.deflection = 0.01});
  EXPECT_FALSE(ProfileCutter(some).round_profile({10, 0, 15}, {0, 0, 1}, 0.05));
}

}  // namespace
}  // namespace st
