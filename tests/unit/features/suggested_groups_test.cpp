#include "features/suggested_groups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "support/shapes.h"

namespace st {
namespace {

/// A wing of one face: stations along a straight trailing edge.
LiftingSurface suggested_wing(FaceId face, Vec3 root, Vec3 tip, double chord, Vec3 flow = {1, 0, 0}) {
  LiftingSurface wing;
  ChordEdge edge;
  for (int i = 0; i <= 10; ++i) {
    ChordStation s;
    s.share = 0.1 * i;
    s.trailing = root + (tip - root) * s.share;
    s.chord = chord;
    s.is_measured = true;
    s.nose = s.trailing - flow * chord;
    edge.stations.push_back(s);
  }
  wing.trailing = {edge};
  wing.faces = {face};
  wing.span = distance(root, tip);
  wing.least_chord = wing.median_chord = wing.largest_chord = chord;
  return wing;
}

/// Names by face (from 0) that the surfaces of a model without edges get.
std::map<FaceId, std::string> suggested_names(const std::vector<LiftingSurface>& wings, std::size_t n_faces = 6) {
  ModelTables tables;
  tables.face_is_reversed.resize(n_faces);
  tables.face_box.resize(n_faces);
  tables.face_loop_offsets.assign(n_faces + 1, 0);
  tables.loop_coedge_offsets = {0};
  FaceRoles roles;
  roles.role.assign(n_faces, FaceRole::kWall);
  roles.role[n_faces - 1] = FaceRole::kSymmetry;
  tables.face_box[n_faces - 1].add(Vec3{-9, 0, -9});
  tables.face_box[n_faces - 1].add(Vec3{90, 0, 9});
  const Bodies bodies{{}, std::vector<std::int32_t>(n_faces, kNone)};
  std::map<FaceId, std::string> names;
  for (const SuggestedGroup& g : suggest_groups(tables, roles, wings, bodies))
    for (const FaceId f : g.faces) names[f] = g.name;
  return names;
}

TEST(SuggestedGroups, tell_wing_tailplane_fin_and_symmetry_by_their_place) {
  const auto names =
      suggested_names({suggested_wing(0, {10, 0, 0}, {12, 15, 1}, 4), suggested_wing(1, {30, 0, 0}, {31, 5, 0}, 2),
                       suggested_wing(2, {29, 0, 1}, {31, 0, 7}, 3)});
  EXPECT_EQ(names, (std::map<FaceId, std::string>{{0, "wing"}, {1, "tailplane"}, {2, "fin"}, {5, "symmetry"}}));
}

TEST(SuggestedGroups, tell_canards_flaps_and_leaning_tails) {
  const auto names = suggested_names(
      {suggested_wing(0, {10, 0, 0}, {12, 15, 1}, 4), suggested_wing(1, {1, 0, 0}, {2, 4, 0}, 1.5),
       suggested_wing(2, {10.8, 6, -0.2}, {11.5, 12, -0.2}, 1), suggested_wing(3, {30, 0, 1}, {32, 5, 5}, 3)});
  EXPECT_EQ(names.at(1), "canard");
  EXPECT_EQ(names.at(2), "flap");
  EXPECT_EQ(names.at(3), "v_tail");
}

TEST(SuggestedGroups, take_both_sides_of_a_whole_aircraft_as_its_wing) {
  const auto names =
      suggested_names({suggested_wing(0, {10, 1, 0}, {12, 15, 1}, 4), suggested_wing(1, {10, -1, 0}, {12, -15, 1}, 4)});
  EXPECT_EQ(names.at(0), "wing");
  EXPECT_EQ(names.at(1), "wing");
}

TEST(SuggestedGroups, take_parts_of_a_wing_between_booms_as_the_wing) {
  const auto names =
      suggested_names({suggested_wing(0, {10, 6, 0}, {10, 15, 1}, 4), suggested_wing(1, {10, 1, 0}, {10, 6, 0}, 4.5)});
  EXPECT_EQ(names.at(1), "wing");
}

TEST(SuggestedGroups, tell_blades_by_their_likes_in_other_directions) {
  const auto names = suggested_names({suggested_wing(0, {0, 0, 1}, {0, 0, 6}, 1, {0, 1, 0}),
                                      suggested_wing(1, {0, 0, -1}, {0, 0, -6}, 1, {0, -1, 0})});
  EXPECT_EQ(names.at(0), "blade");
  EXPECT_EQ(names.at(1), "blade");
}

TEST(SuggestedGroups, tell_blades_that_hang_together_from_nacelles) {
  LiftingSurface rotor = suggested_wing(0, {0, 0, 0.3}, {0, 0, 3}, 1, {0.9, 0.43589, 0});
  for (const double angle : {2 * kPi / 3, 4 * kPi / 3}) {
    ChordEdge blade = rotor.trailing[0];
    const auto turned = [&](Vec3 v) {
      return Vec3{v.x, v.y * std::cos(angle) + v.z * std::sin(angle), v.z * std::cos(angle) - v.y * std::sin(angle)};
    };
    for (ChordStation& s : blade.stations) s.trailing = turned(s.trailing), s.nose = turned(s.nose);
    rotor.trailing.push_back(blade);
  }
  EXPECT_EQ(suggested_names({rotor}).at(0), "blade");
}

TEST(SuggestedGroups, take_a_bent_trailing_edge_for_no_ring) {
  LiftingSurface blade = suggested_wing(0, {0, 0, 0}, {1, 0, 0}, 1);
  int i = 0;
  for (ChordStation& s : blade.trailing[0].stations) {
    const double angle = kPi * i++ / 10;
    s.trailing = {0, std::cos(angle), std::sin(angle)};
    s.nose = s.trailing - Vec3{0, 1, 0};
  }
  EXPECT_EQ(suggested_names({blade}).at(0), "wing");
}

TEST(SuggestedGroups, tell_nacelles_by_rings) {
  LiftingSurface ring = suggested_wing(0, {0, 0, 0}, {1, 0, 0}, 3);
  int i = 0;
  for (ChordStation& s : ring.trailing[0].stations) {
    const double angle = 2 * kPi * i++ / 11;
    s.trailing = {5, std::cos(angle), std::sin(angle)};
    s.nose = s.trailing - Vec3{3, 0, 0};
  }
  EXPECT_EQ(suggested_names({ring}).at(0), "nacelle");
}

TEST(SuggestedGroups, know_nothing_of_a_body_without_wings) {
  const Model box = test::make_model("box");
  const FaceRoles roles = face_roles(box);
  EXPECT_TRUE(suggest_groups(box.tables(), roles, {}, find_bodies(box, roles, {})).empty());
}

}  // namespace
}  // namespace st
