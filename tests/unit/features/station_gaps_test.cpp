// Stations without a profile: the nose's surface goes on there, or they have none of their own.
#include "features/station_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "features/strip.h"
#include "geometry/model/edge_faces.h"
#include "support/shapes.h"

namespace st {
namespace {

/// A sharp wing of chord 10 along z, its stations, and what cuts it.
struct GapModel {
  Model model = test::make_model("sharp_wing");
  FaceRoles roles = face_roles(model.tables());
  std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  std::vector<std::uint8_t> all = std::vector<std::uint8_t>(static_cast<std::size_t>(model.tables().n_faces()), 1);
  Facets facets = make_facets(model, all, {.deflection = 0.01});
  ProfileCutter cutter = ProfileCutter(facets);
  Vec3 along = {0, 0, 1};

  ChordEdge edge_without(std::size_t from, std::size_t to) const {
    ChordEdge edge = wings.at(0).trailing.at(0);
    for (std::size_t i = from; i < to; ++i) edge.stations[i] = {edge.stations[i].share, edge.stations[i].trailing};
    return edge;
  }
};

TEST(StationGaps, are_closed_on_the_surface_of_the_noses_around) {
  const GapModel m;
  ChordEdge edge = m.edge_without(8, 12);
  close_gaps({m.model, m.cutter, 0.02, m.all}, &m.along, edge);
  for (std::size_t i = 8; i < 12; ++i) {
    EXPECT_TRUE(edge.stations[i].is_measured);
    EXPECT_FALSE(edge.stations[i].is_hidden);
    EXPECT_NEAR(edge.stations[i].nose.x, 0, 1e-6);
    EXPECT_NEAR(edge.stations[i].chord, 10, 1e-6);
  }
}

/// The edge of a plate with this x at both ends, on its lower side.
EdgeId rim_of_plate(const Model& model, double x) {
  const ModelTables& t = model.tables();
  const auto is_there = [&](EdgeId e) {
    return std::ranges::all_of(std::array{0, 1}, [&](int k) {
      const Vec3 end = t.vertex_xyz[t.edge_vertices[2 * e + k]];
      return end.x == x && end.z == 0;
    });
  };
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (is_there(e)) return e;
  return kNone;
}

TEST(StationGaps, are_closed_along_the_corner_of_the_noses_around) {
  const Model model = test::make_model("thin_plate");
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(model.tables().n_faces()), 1);
  const Facets facets = make_facets(model, all, {.deflection = 0.005});
  const ProfileCutter cutter(facets);
  const EdgeId nose = rim_of_plate(model, 0);
  ChordEdge edge{.edge = rim_of_plate(model, 10), .stations = {}};
  for (int i = 0; i < 10; ++i) {
    const double share = 0.05 + 0.1 * i;
    edge.stations.push_back({share, {10, 10 * share, 0}});
    ChordStation& s = edge.stations.back();
    s.nose_face = EdgeFaces(model.tables())[nose][0];
    if (i == 2 || i == 3 || i == 6) s.nose = {0, 10 * share, 0}, s.chord = 10, s.is_measured = true;
  }
  const Vec3 along = {0, 1, 0};
  close_gaps({model, cutter, 0.01, all}, &along, edge);
  for (const ChordStation& s : edge.stations) {
    EXPECT_TRUE(s.is_measured) << s.share;
    EXPECT_LT(distance(s.nose, {0, s.trailing.y, 0}), 1e-9) << s.share;
  }
}

TEST(StationGaps, have_no_nose_where_the_cut_ends_in_another_body) {
  GapModel m;
  const ChordEdge whole = m.edge_without(0, 0);
  m.all[static_cast<std::size_t>(whole.stations[10].nose_face)] = 0;
  const FaceId other = m.wings[0].faces[0] == whole.stations[10].nose_face ? m.wings[0].faces[1] : m.wings[0].faces[0];
  m.all[static_cast<std::size_t>(other)] = 0;
  ChordEdge edge = m.edge_without(8, 12);
  close_gaps({m.model, m.cutter, 0.02, m.all}, &m.along, edge);
  for (std::size_t i = 8; i < 12; ++i) {
    EXPECT_FALSE(edge.stations[i].is_measured);
    EXPECT_TRUE(edge.stations[i].is_hidden);
  }
  LiftingSurface surface = m.wings[0];
  surface.trailing[0] = edge;
  EXPECT_NEAR(surface.covered(), m.wings[0].covered(), 0.01) << "what has no nose of its own does not count";
}

TEST(StationGaps, stay_gaps_where_cuts_say_nothing) {
  const GapModel m;
  ChordEdge edge = m.edge_without(8, 12);
  const Vec3 across = {1, 0, 0};
  close_gaps({m.model, m.cutter, 1e-9, m.all}, &across, edge);
  for (std::size_t i = 8; i < 12; ++i) EXPECT_FALSE(edge.stations[i].is_measured || edge.stations[i].is_hidden);
}

TEST(StationGaps, around_a_tip_run_along_the_chord) {
  const GapModel m;
  LiftingSurface surface = m.wings[0];
  ChordEdge along_span = m.edge_without(8, 12);
  hide_tip(m.model, surface, along_span);
  EXPECT_FALSE(std::ranges::any_of(along_span.stations, &ChordStation::is_hidden));
  EdgeId rim = kNone;  // of the tip, from nose to tail
  for (const EdgeId e : m.model.tables().edges_of(m.wings[0].faces[0])) {
    const auto curve = m.model.curve(e);
    if (std::abs(curve->point(curve->t_max()).z - curve->point(curve->t_min()).z) < 1) rim = e;
  }
  ASSERT_NE(rim, kNone);
  const auto curve = m.model.curve(rim);
  ChordEdge tip{.edge = rim, .stations = {{0.5, curve->point(0.5 * (curve->t_min() + curve->t_max()))}}};
  hide_tip(m.model, surface, tip);
  EXPECT_TRUE(tip.stations[0].is_hidden);
}

TEST(StationGaps, are_told_by_edge_and_length) {
  LiftingSurface wing;
  wing.trailing.resize(1);
  for (const double y : {0, 1, 2, 3, 4, 5})
    wing.trailing[0].stations.push_back(
        {.share = y / 5, .trailing = {0, y, 0}, .is_measured = y == 1 || y == 2, .is_hidden = y == 4});
  const std::vector<UncoveredStretch> open = uncovered_stretches(wing);
  ASSERT_EQ(open.size(), 3u);
  EXPECT_DOUBLE_EQ(open[0].length, 0.5);
  EXPECT_DOUBLE_EQ(open[1].length, 1);
  EXPECT_DOUBLE_EQ(open[2].length, 0.5) << "beyond what has no nose of its own";
}

}  // namespace
}  // namespace st
