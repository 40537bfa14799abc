// Facets of those walls alone that profiles cross.
#include "features/profile_facets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "base/threads.h"
#include "features/edge_places.h"
#include "features/profile.h"
#include "features/strip.h"
#include "geometry/model/edit_model.h"
#include "support/backward_executor.h"
#include "support/shapes.h"

namespace st {
namespace {

constexpr ProfileLimits kLimits{{.deflection = 0.02}, 0.04};

struct Case {
  Model model;
  FaceRoles roles = face_roles(model.tables());
  std::vector<WingEdge> edges = find_wing_edges(model, roles, find_strips(model));

  explicit Case(const std::string& shape) : model(test::make_model(shape)) {}
  explicit Case(Model&& own) : model(std::move(own)) {}
  Facets facets() const {
    ProfileFacets facets(model, roles, kLimits);
    facets.add_along(edges, SerialExecutor());
    return facets.facets();
  }
  Facets all_facets() const {
    return make_facets(model, std::vector<std::uint8_t>(model.tables().n_faces(), 1), kLimits.facets);
  }
};

std::vector<FaceId> faces_with(const Facets& facets) {
  std::vector<FaceId> faces = facets.face;
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

TEST(ProfileFacets, show_the_same_profiles_as_those_of_all_faces) {
  for (const char* shape : {"wing_on_body", "wing_with_pod", "half_blunt_wing", "tapering_wing", "wing_of_8"}) {
    const Case c(shape);
    const Facets facets = c.facets(), all = c.all_facets();
    const ProfileCutter some(facets), every(all);
    int n_profiles = 0;
    for (const EdgePlace& place : places_along(c.model, c.edges)) {
      if (c.edges[place.edge].kind == WingEdgeKind::kLeading) continue;
      for (const Vec3 normal : {place.tangent, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        if (std::abs(dot(normal, place.tangent)) < kAlongAxis) continue;
        const auto profile = some.cut(place.x, normal, kLimits.reach),
                   other = every.cut(place.x, normal, kLimits.reach);
        ASSERT_EQ(profile.has_value(), other.has_value()) << shape;
        n_profiles += profile.has_value();
        if (!profile) continue;
        EXPECT_NEAR(profile->chord, other->chord, 1e-9) << shape;
        EXPECT_EQ(profile->faces, other->faces) << shape;
      }
    }
    EXPECT_TRUE(n_profiles > 0 || std::string(shape) == "half_blunt_wing") << shape << ": half a profile is none";
    EXPECT_TRUE(std::is_sorted(facets.face.begin(), facets.face.end()));
  }
}

/// Far from each other; cuts ask several times for more walls.
Model make_four_wings() {
  Model wings = test::make_model("wing_with_pod");
  for (const char* shape : {"wing_on_body", "wing_of_8", "wing_of_8"})
    wings = append(wings, transform(test::make_model(shape), {.translation = {0, wings.tables().box().hi.y + 20, 0}}));
  return wings;
}

TEST(ProfileFacets, are_the_same_whatever_task_ends_first) {
  const Case c(make_four_wings());
  ProfileFacets backward(c.model, c.roles, kLimits);
  backward.add_along(c.edges, test::BackwardExecutor());
  const Facets alone = c.facets();
  EXPECT_GT(faces_with(alone).size(), 10u);
  EXPECT_EQ(backward.facets().face, alone.face);
  EXPECT_EQ(backward.facets().triangle, alone.triangle);
  EXPECT_EQ(backward.facets().xyz, alone.xyz);
}

Model make_three_wings() {
  Model wings = test::make_model("wing_of_8");
  for (const double y : {20., 40.})
    wings = append(wings, transform(test::make_model("wing_of_8"), {.translation = {0, y, 0}}));
  return wings;
}

TEST(ProfileFacets, of_bodies_are_made_by_as_many_tasks) {
  const Case c(make_three_wings());
  const test::BackwardExecutor executor;
  ProfileFacets facets(c.model, c.roles, kLimits);
  facets.add_along(c.edges, executor);
  EXPECT_EQ(executor.n_tasks, 3u);
}

TEST(ProfileFacets, of_a_body_do_not_depend_on_others) {
  const Case one("wing_of_8"), three(make_three_wings());
  const auto n_faces = static_cast<FaceId>(one.model.tables().n_faces());
  const Facets alone = one.facets(), together = three.facets();
  ASSERT_GT(alone.face.size(), 0u);
  std::vector<FaceId> expected;
  for (int body = 0; body < 3; ++body)
    for (const FaceId f : alone.face) expected.push_back(f + body * n_faces);
  EXPECT_EQ(together.face, expected);
}

TEST(ProfileFacets, of_bodies_are_known) {
  const Case c(make_three_wings());
  ProfileFacets facets(c.model, c.roles, kLimits);
  facets.add_along(c.edges, SerialExecutor());
  for (const FaceId f : faces_with(facets.facets())) EXPECT_TRUE(facets.knows(f)) << f;
}

TEST(ProfileFacets, go_on_from_an_edge_whose_walls_are_known) {
  const Case c("wing_with_pod");
  ProfileFacets facets(c.model, c.roles, kLimits);
  for (const WingEdge& own : c.edges) facets.add_along({&own, 1}, SerialExecutor());
  EXPECT_EQ(faces_with(facets.facets()), faces_with(c.facets()));
}

TEST(ProfileFacets, are_the_same_on_any_number_of_threads) {
  const Case c(make_four_wings());
  const Facets one = c.facets();
  for (const int n_threads : {2, 7}) {
    set_thread_count(n_threads);
    const Facets many = c.facets();
    set_thread_count(1);
    EXPECT_EQ(many.face, one.face) << n_threads << " threads";
    EXPECT_EQ(many.triangle, one.triangle) << n_threads << " threads";
    EXPECT_EQ(many.xyz, one.xyz) << n_threads << " threads";
  }
}

TEST(ProfileFacets, are_none_of_faces_that_no_profile_crosses) {
  const Case c("sharp_wing");
  const std::vector<FaceId> faces = faces_with(c.facets());
  EXPECT_EQ(faces.size(), 2u) << "upper and lower side; no profile crosses the tips";
  EXPECT_EQ(faces_with(c.all_facets()).size(), 4u);
}

TEST(ProfileFacets, are_none_without_edges) {
  Case c("sharp_wing");
  c.edges.clear();
  EXPECT_TRUE(c.facets().triangle.empty());
}

TEST(ProfileFacets, go_on_where_another_cut_ends) {
  const Case c("sharp_wing");
  ProfileFacets facets(c.model, c.roles, kLimits);
  facets.add_along(c.edges, SerialExecutor());
  const ProfileCutter cutter(facets.facets());
  EXPECT_TRUE(cutter.ends_of({10, 0, 15}, {0, 0, 1}, kLimits.reach).empty());
  const std::vector<CutPlace> ends = cutter.ends_of({10, 0, 15}, normalized(Vec3{0.02, 1, 0}), kLimits.reach);  // along
                                                                                                                // the
                                                                                                                // span
  ASSERT_FALSE(ends.empty());
  EXPECT_TRUE(facets.add_beyond(ends, SerialExecutor()));
  EXPECT_EQ(faces_with(facets.facets()).size(), 4u) << "the tips, too";
  EXPECT_FALSE(facets.add_beyond(ends, SerialExecutor()));
}

TEST(ProfileFacets, are_kept_by_how_closely_they_follow) {
  const Case c("closed_wing");
  FacetStore store(c.model, c.roles);
  ProfileFacets& facets = store.near(0.02, true);
  EXPECT_NEAR(facets.reach() / 0.04, 1, 0.42) << "the nearest step";
  EXPECT_EQ(&store.near(0.021, true), &facets);
  EXPECT_NE(&store.near(0.021, false), &facets);
  EXPECT_NE(&store.near(0.2, true), &facets);
  facets.add_cut(0, {0, 1, 15}, {0, 0, 1}, SerialExecutor());
  const std::size_t n = facets.facets().triangle.size();
  EXPECT_GT(n, 0u);
  facets.add_cut(0, {0, 1, 15}, {0, 0, 1}, SerialExecutor());
  EXPECT_EQ(facets.facets().triangle.size(), n) << "no face has its facets twice";
}

}  // namespace
}  // namespace st
