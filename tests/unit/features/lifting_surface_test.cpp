// Lifting surfaces: chord and span behind trailing edges.
#include "features/lifting_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/model/edit_model.h"
#include "support/backward_executor.h"
#include "support/shapes.h"

namespace st {
namespace {

std::vector<LiftingSurface> wings_of(const Model& model, const FaceRoles& roles) {
  return find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
}

std::vector<LiftingSurface> wings_of(const std::string& shape) {
  const Model model = test::make_model(shape);
  return wings_of(model, face_roles(model.tables()));
}

void expect_wing_of_chord_10(const LiftingSurface& wing) {
  EXPECT_NEAR(wing.span, 30, 1e-6);
  EXPECT_NEAR(wing.least_chord, 10, 0.02);
  EXPECT_NEAR(wing.largest_chord, 10, 0.02);
  EXPECT_EQ(wing.leading.size(), 1u);
  for (const ChordEdge& edge : wing.trailing)
    for (const ChordStation& s : edge.stations) {
      EXPECT_NEAR(s.trailing.x, 10, 1e-6);
      EXPECT_NEAR(s.chord, 10, 0.02);
      if (s.is_measured) {
        EXPECT_NEAR(s.nose.x, 0, 0.02);
      }
    }
}

TEST(LiftingSurface, comes_in_the_order_of_edges_whichever_chains_are_done_first) {
  constexpr std::size_t kWings = 10;  // more than one task
  Model model = test::make_model("sharp_wing");
  for (std::size_t i = 1; i < kWings; ++i)
    model = append(model, transform(test::make_model(i % 2 ? "blunt_wing" : "sharp_wing"),
                                    {.translation = {0, model.tables().box().hi.y + 20, 0}}));
  const FaceRoles roles = face_roles(model.tables());
  const auto edges = find_wing_edges(model, roles, find_strips(model));
  const auto surfaces = find_lifting_surfaces(model, roles, edges),
             backward = find_lifting_surfaces(model, roles, edges, test::BackwardExecutor());
  ASSERT_EQ(surfaces.size(), kWings);
  ASSERT_EQ(backward.size(), kWings);
  for (std::size_t i = 0; i < kWings; ++i) {
    EXPECT_EQ(surfaces[i].is_blunt, i % 2 == 1) << i;
    EXPECT_EQ(backward[i].trailing[0].edge, surfaces[i].trailing[0].edge) << i;
    EXPECT_EQ(backward[i].faces, surfaces[i].faces) << i;
    if (i > 0) {
      EXPECT_GT(surfaces[i].trailing[0].edge, surfaces[i - 1].trailing[0].edge) << i;
    }
  }
}

TEST(LiftingSurface, has_the_chord_and_the_span_of_a_sharp_wing) {
  const std::vector<LiftingSurface> wings = wings_of("sharp_wing");
  ASSERT_EQ(wings.size(), 1u);
  EXPECT_FALSE(wings[0].is_blunt);
  EXPECT_EQ(wings[0].trailing.size(), 1u);
  EXPECT_EQ(wings[0].faces.size(), 2u) << "upper and lower side";
  expect_wing_of_chord_10(wings[0]);
}

TEST(LiftingSurface, counts_both_sides_of_a_blunt_edge_as_one) {
  const std::vector<LiftingSurface> wings = wings_of("blunt_wing");
  ASSERT_EQ(wings.size(), 1u);
  EXPECT_TRUE(wings[0].is_blunt);
  EXPECT_EQ(wings[0].trailing.size(), 2u);
  EXPECT_EQ(wings[0].trailing[0].base, wings[0].trailing[1].base);
  expect_wing_of_chord_10(wings[0]);
}

TEST(LiftingSurface, of_a_swept_wing_is_cut_as_its_plane_ends_are) {
  for (const char* shape : {"swept_wing", "far_swept_wing"}) {
    const std::vector<LiftingSurface> wings = wings_of(shape);
    ASSERT_EQ(wings.size(), 1u) << shape;
    EXPECT_NEAR(wings[0].least_chord, 10, 0.02) << shape;
    EXPECT_NEAR(wings[0].largest_chord, 10, 0.02) << shape;
  }
}

TEST(LiftingSurface, of_a_swept_wing_is_cut_along_the_flow_though_other_planes_show_more_of_it) {
  const std::vector<LiftingSurface> wings = wings_of("swept_wing_in_box");
  ASSERT_EQ(wings.size(), 1u);
  for (const ChordStation& s : wings[0].trailing.at(0).stations)
    if (s.is_measured && s.share < 0.8) {  // before the box
      EXPECT_NEAR(s.chord, 10, 0.1) << s.share;
    }
}

TEST(LiftingSurface, is_found_in_a_domain) {
  const Model model = test::make_model("wing_in_box");
  FaceRoles roles = face_roles(model.tables());
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    if (model.tables().face_box[f].diagonal() > 50) roles.role[f] = FaceRole::kFarfield;
  EXPECT_EQ(wings_of(model, roles).size(), 1u);
}

TEST(LiftingSurface, is_found_where_a_plane_of_symmetry_cuts_it_in_two) {
  for (const std::string shape : {"half_sharp_wing", "half_blunt_wing"}) {
    const Model model = test::make_model(shape);
    FaceRoles roles = face_roles(model.tables());
    for (FaceId f = 0; f < model.tables().n_faces(); ++f)
      if (model.tables().face_box[f].hi.y < 1e-6) roles.role[f] = FaceRole::kSymmetry;
    const std::vector<LiftingSurface> wings = wings_of(model, roles);
    ASSERT_EQ(wings.size(), 1u) << shape;
    EXPECT_EQ(wings[0].is_blunt, shape == "half_blunt_wing");
    ASSERT_EQ(wings[0].trailing.size(), 1u) << shape;
    EXPECT_EQ(wings[0].trailing[0].is_half, wings[0].is_blunt);
    expect_wing_of_chord_10(wings[0]);
  }
}

TEST(LiftingSurface, of_an_open_skin_does_not_depend_on_its_orientation) {
  const std::vector<LiftingSurface> wings = wings_of("wing_skin");
  ASSERT_EQ(wings.size(), 1u);
  expect_wing_of_chord_10(wings[0]);
}

TEST(LiftingSurface, is_nothing_whose_noses_stay_in_one_place) { EXPECT_TRUE(wings_of("fan").empty()); }

TEST(LiftingSurface, is_no_plate_and_no_plain_body) {
  for (const char* shape : {"thin_plate", "wedge_strip", "box", "cylinder", "cone", "drilled_block", "stepped_box"})
    EXPECT_TRUE(wings_of(shape).empty()) << shape;
}

TEST(LiftingSurface, tapers_as_a_blended_wing_body_does) {
  const std::vector<LiftingSurface> wings = wings_of("tapering_wing");
  ASSERT_EQ(wings.size(), 1u);
  EXPECT_EQ(wings[0].trailing.size(), 3u);
  EXPECT_NEAR(wings[0].largest_chord, 60, 0.5);
  EXPECT_NEAR(wings[0].least_chord, 6, 0.1);
  for (const ChordEdge& edge : wings[0].trailing)
    EXPECT_GT(std::ranges::count_if(edge.stations, [](const ChordStation& s) { return s.is_measured; }), 20);
}

TEST(LiftingSurface, of_a_thin_wing_does_not_take_the_rims_of_its_tips_for_bases) {
  const Model model = test::make_model("thin_wing");
  const FaceRoles roles = face_roles(model.tables());
  const std::vector<WingEdge> edges = find_wing_edges(model, roles, find_strips(model));
  ASSERT_GT(edges.size(), 4u) << "rims look like blunt trailing edges";
  std::vector<UnusedTrailing> unused;
  const std::vector<LiftingSurface> wings = find_lifting_surfaces(model, roles, edges, SerialExecutor(), &unused);
  ASSERT_EQ(wings.size(), 1u);
  EXPECT_EQ(wings[0].trailing.size(), 1u);
  EXPECT_NEAR(wings[0].span, 30, 1e-6);
  ASSERT_EQ(unused.size(), 1u);
  EXPECT_EQ(unused[0].edges.size(), 4u);
  EXPECT_FALSE(unused[0].may_be_wing || unused[0].why.empty());
}

TEST(LiftingSurface, with_a_sharp_nose_is_found_once) {
  const std::vector<LiftingSurface> wings = wings_of("double_wedge");
  ASSERT_EQ(wings.size(), 1u);
  EXPECT_EQ(wings[0].trailing.size(), 1u);
  EXPECT_EQ(wings[0].leading.size(), 1u);
  EXPECT_NEAR(wings[0].median_chord, 10, 1e-6);
}

TEST(LiftingSurface, of_a_sail_lies_between_luff_and_leech) {
  const std::vector<LiftingSurface> wings = wings_of("thin_sail");
  ASSERT_EQ(wings.size(), 1u);
  EXPECT_EQ(wings[0].trailing.size(), 1u);
  EXPECT_EQ(wings[0].leading.size(), 1u);
  EXPECT_NEAR(wings[0].span, 30, 1e-6);
  EXPECT_NEAR(wings[0].least_chord, 10, 0.02);
  EXPECT_NEAR(wings[0].largest_chord, 10, 0.02);
  EXPECT_GT(wings[0].covered(), 0.99);
}

TEST(LiftingSurface, says_why_a_trailing_edge_has_none) {
  for (const char* shape : {"fan", "lens"}) {
    const Model model = test::make_model(shape);
    const FaceRoles roles = face_roles(model.tables());
    const std::vector<WingEdge> edges = find_wing_edges(model, roles, find_strips(model));
    std::vector<UnusedTrailing> unused;
    EXPECT_TRUE(find_lifting_surfaces(model, roles, edges, SerialExecutor(), &unused).empty()) << shape;
    ASSERT_FALSE(unused.empty()) << shape;
    for (const UnusedTrailing& u : unused) EXPECT_FALSE(u.why.empty()) << shape;
  }
}

/// Of chord 8 to 4, from z = 0 to 15, 8 % thick.
double chord_of_canard(double z) { return 8 - 4 * z / 15; }

/// Without the first 6 % of the canard's skin: what is there is folded onto the edge of the rest.
Facets canard_without_its_nose(const Model& model, double deflection) {
  constexpr double kFront = 0.06, kHalf = 0.08 * 0.3325;  // of the chord: half of the thickness there
  Facets facets = make_facets(model, std::vector<std::uint8_t>(static_cast<std::size_t>(model.tables().n_faces()), 1),
                              {.deflection = deflection, .is_exact = true});
  std::vector<int> side(facets.xyz.size(), 0);
  for (std::size_t i = 0; i < side.size(); ++i) {
    Vec3& x = facets.xyz[i];
    const double chord = chord_of_canard(x.z), middle = 4 * x.z / 15;
    if (x.z < 5 || x.x > 10 - (1 - kFront) * chord) continue;
    side[i] = x.y > middle ? 1 : -1;
    x = {10 - (1 - kFront) * chord, middle + side[i] * kHalf * chord, x.z};
  }
  Facets kept = facets;
  kept.triangle.clear(), kept.face.clear();
  for (std::size_t i = 0; i < facets.triangle.size(); ++i) {
    const auto n_front = std::ranges::count_if(facets.triangle[i], [&](std::int32_t n) { return side[n] != 0; });
    if (n_front == 3) continue;
    kept.triangle.push_back(facets.triangle[i]);
    kept.face.push_back(facets.face[i]);
  }
  return kept;
}

TEST(LiftingSurface, has_its_noses_where_facets_miss_them) {
  const Model model = test::make_model("canard_on_body");
  FaceRoles roles = face_roles(model.tables());
  roles.own.deflection = 1e-3 * roles.reference_diagonal;
  roles.own.facets = canard_without_its_nose(model, roles.own.deflection);
  const std::vector<LiftingSurface> wings = wings_of(model, roles);
  ASSERT_EQ(wings.size(), 1u);
  int n_noses = 0;
  for (const ChordStation& s : wings[0].trailing[0].stations) {
    if (!s.is_measured) continue;
    ++n_noses;
    EXPECT_NEAR(s.chord, chord_of_canard(s.trailing.z), 0.01) << s.trailing.z;
    EXPECT_NEAR(s.nose.y, 4 * s.nose.z / 15, 0.02) << s.trailing.z;
  }
  EXPECT_GT(n_noses, 10);
}

TEST(LiftingSurface, with_two_equal_noses_has_the_upper_one_whatever_the_numbers_of_faces) {
  for (const std::string shape : {"wing_with_dented_nose", "wing_with_dented_nose_lower_first"}) {
    const std::vector<LiftingSurface> wings = wings_of(shape);
    ASSERT_EQ(wings.size(), 1u) << shape;
    for (const ChordStation& s : wings[0].trailing[0].stations)
      if (s.is_measured) {
        EXPECT_NEAR(s.nose.z, 0.0125, 0.002) << shape;
      }
  }
}

TEST(LiftingSurface, has_its_noses_on_the_ice_in_front_of_it) {
  const std::vector<LiftingSurface> wings = wings_of("iced_wing");
  ASSERT_EQ(wings.size(), 1u);
  EXPECT_GT(wings[0].covered(), 0.99);
  int n_on_ice = 0;
  for (const ChordStation& s : wings[0].trailing[0].stations) {
    const bool is_iced = s.trailing.z > 10 && s.trailing.z < 20;
    if (!s.is_measured) continue;
    EXPECT_NEAR(s.nose.x, is_iced ? -0.25 : 0, 1e-3) << s.trailing.z;
    n_on_ice += is_iced;
    if (is_iced) {
      EXPECT_TRUE(std::ranges::binary_search(wings[0].faces, s.nose_face));
    }
  }
  EXPECT_GT(n_on_ice, 5);
}

TEST(LiftingSurface, knows_the_chord_near_a_place) {
  const std::vector<LiftingSurface> wings = wings_of("sharp_wing");
  ASSERT_EQ(wings.size(), 1u);
  const NearestChord nearest = wings[0].nearest_chord({5, 2, 15});
  EXPECT_NEAR(nearest.chord, 10, 0.02);
  EXPECT_NEAR(nearest.distance, 2, 0.1);
}

TEST(ChordEdge, is_linear_between_stations) {
  ChordEdge edge;
  edge.stations.resize(3);
  for (std::size_t i = 0; i < 3; ++i) edge.stations[i].share = 0.5 * static_cast<double>(i);
  edge.stations[0].chord = edge.stations[1].chord = 4;
  edge.stations[2].chord = 2;
  EXPECT_EQ(edge.chord_at(0), 4);
  EXPECT_EQ(edge.chord_at(0.25), 4);
  EXPECT_EQ(edge.chord_at(0.75), 3);
  EXPECT_EQ(edge.chord_at(1), 2);
}

}  // namespace
}  // namespace st
