#include "geometry/model/composite_finder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/model/joined_tables.h"
#include "geometry/shape/flatten.h"
#include "unit/geometry/joined_models.h"

namespace st {
namespace {

FoundComposites found(const std::string& shape, const auto& change) {
  const Model model = test::make_model(shape);
  JoinRequest request = test::curved_request(model);
  change(model, request);
  return find_composites(model, request);
}

TEST(FindComposites, keeps_one_cut_of_a_tube) {
  const test::Joined joined("cylinder_of_8");
  EXPECT_EQ(joined.composites.member.size(), 8u);
  EXPECT_EQ(joined.composites.joined_edges.size(), 7u);
  EXPECT_EQ(count_left(joined.model.tables()).faces, 3);
}

TEST(FindComposites, joins_faces_with_seams) {
  const test::Joined joined("cone_on_cylinder");
  EXPECT_EQ(joined.composites.member.size(), 2u);
  EXPECT_EQ(count_left(joined.model.tables()).faces, 3);
}

TEST(FindComposites, lays_ruled_skins_out_without_stretch) {
  const test::Joined joined("wing_of_200");
  ASSERT_EQ(joined.composites.size(), 1);
  const Chart chart = joined.composites.chart(0);
  EXPECT_LE(largest_stretch(chart.x, chart.corners, chart.uv), 1.05);
}

TEST(FindComposites, joins_nothing_that_is_not_asked_for) {
  const FoundComposites none =
      found("wing_of_8", [](const Model&, JoinRequest& r) { std::ranges::fill(r.may_join, 0); });
  EXPECT_TRUE(none.composites.empty());
  const FoundComposites not_urgent =
      found("wing_of_8", [](const Model&, JoinRequest& r) { std::ranges::fill(r.urgency, 0); });
  EXPECT_TRUE(not_urgent.composites.empty());
}

TEST(FindComposites, joins_other_edges_between_the_same_faces) {
  EdgeId urgent = kNone;
  const FoundComposites one = found("wing_of_8", [&](const Model&, JoinRequest& r) {
    std::ranges::fill(r.urgency, 0);
    urgent = static_cast<EdgeId>(std::ranges::find(r.may_join, 1) - r.may_join.begin());
    r.urgency[urgent] = 1;
  });
  EXPECT_EQ(one.composites.member.size(), 2u);
  EXPECT_EQ(one.composites.joined_edges, std::vector<EdgeId>{urgent});
}

TEST(FindComposites, refuses_what_does_not_follow_the_cad) {
  // facets so coarse that the nose is cut off
  const FoundComposites coarse = found("wing_of_2", [](const Model& m, JoinRequest& r) {
    r.facets = {.deflection = m.tables().reference_diagonal(), .angle = radians(170), .is_exact = false};
  });
  EXPECT_FALSE(coarse.refused.empty());
  EXPECT_TRUE(coarse.divided.empty());  // of two faces
}

TEST(FindComposites, divides_what_has_no_place_in_a_plane) {
  const FoundComposites pin = found("disc_with_pin", [](const Model& m, JoinRequest& r) {
    for (EdgeId e = 0; e < m.tables().n_edges(); ++e)
      r.may_join[e] = m.tables().edge_length[e] > 6 && m.tables().edge_length[e] < 19;  // circles around the pin
  });
  ASSERT_EQ(pin.divided.size(), 3u);  // one face less each time
  EXPECT_TRUE(pin.divided[0].starts_with("5 faces (3, 4, 5, 6, 7): ")) << pin.divided[0];
  EXPECT_TRUE(pin.refused.empty());
  EXPECT_EQ(pin.composites.member.size(), 2u);
}

TEST(FindComposites, leaves_out_faces_that_turn_from_their_facets) {
  const FoundComposites coarse = found("wing_of_200", [](const Model& m, JoinRequest& r) {
    r.facets = {.deflection = m.tables().reference_diagonal(), .angle = radians(170), .is_exact = false};
  });
  EXPECT_TRUE(coarse.divided.empty());
  EXPECT_EQ(coarse.refused.size(), 20u);  // along the nose
  for (const std::string& one : coarse.refused) EXPECT_TRUE(one.starts_with("1 face (")) << one;
  EXPECT_EQ(coarse.composites.size(), 2);  // the skins on both sides of it
  EXPECT_EQ(coarse.composites.member.size(), 180u);
}

TEST(FindComposites, is_the_same_each_time) {
  const Composites a = test::Joined("wing_of_200").composites, b = test::Joined("wing_of_200").composites;
  EXPECT_EQ(a.member, b.member);
  EXPECT_EQ(a.node_uv, b.node_uv);
  EXPECT_EQ(a.rim_t, b.rim_t);
}

}  // namespace
}  // namespace st
