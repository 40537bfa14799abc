// Sizes along trailing edges and noses.
#include "sizing/wing_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "features/round_tails.h"
#include "features/strip.h"
#include "support/shapes.h"

namespace st {
namespace {

struct Sampled {
  std::vector<RasterBox> boxes;
  std::vector<RasterBox> with(CauseKind kind) const {
    std::vector<RasterBox> own;
    for (const RasterBox& b : boxes)
      if (cause_kind(b.cause) == kind) own.push_back(b);
    return own;
  }
};

Sampled sample(const std::string& shape, const WingSizes& sizes, std::vector<EdgeId> left_out = {}) {
  const Model model = test::make_model(shape);
  const FaceRoles roles = face_roles(model.tables());
  const std::vector<WingEdge> edges = find_wing_edges(model, roles, find_strips(model));
  std::vector<std::uint8_t> is_left_out(static_cast<std::size_t>(model.tables().n_edges()), 0);
  for (const WingEdge& w : edges)
    if (std::find(left_out.begin(), left_out.end(), static_cast<EdgeId>(w.kind)) != left_out.end())
      is_left_out[w.edge] = 1;
  Sampled s;
  std::vector<LiftingSurface> wings = find_lifting_surfaces(model, roles, edges);
  add_round_tails(model, roles, edges, is_left_out, wings);
  for (const LiftingSurface& wing : wings) raster_wing(model, wing, sizes, find_strips(model), is_left_out, s.boxes);
  return s;
}

WingSizes share_of_chord(const std::string& text) { return {parse_length(text, "--edge-size"), 2, {30, {}}, {}, 2}; }

/// Boxes from end to end of a wing of span 30, at x, no more than a length apart.
void expect_run_along(const Sampled& s, double x) {
  std::vector<double> z;
  for (const RasterBox& b : s.boxes)
    if (std::abs(b.center.x - x) < 0.03) z.push_back(b.center.z);
  std::sort(z.begin(), z.end());
  ASSERT_GT(z.size(), 500u);
  EXPECT_LT(z.front(), 0.1);
  EXPECT_GT(z.back(), 29.9);
  for (std::size_t i = 1; i < z.size(); ++i) EXPECT_LE(z[i] - z[i - 1], 0.0505);
}

TEST(WingSizes, run_along_the_trailing_edge_and_the_nose_without_holes) {
  const Sampled s = sample("sharp_wing", share_of_chord("0.5%chord"));
  for (const double x : {0.0, 10.0}) expect_run_along(s, x);
  for (const RasterBox& b : s.boxes)
    EXPECT_NEAR(b.length, b.center.x < 5 ? 0.9 * 0.05 : 0.95 * 0.05, 1e-4)
        << "so that the first triangles beside nose and edge have what was asked for";
}

TEST(WingSizes, are_those_of_noses_along_edges_with_rows) {
  WingSizes sizes = share_of_chord("0.5%chord");
  sizes.stretch.max_aspect = 16;
  for (const RasterBox& b : sample("sharp_wing", sizes).boxes)
    EXPECT_NEAR(b.length, 0.9 * 0.05, 1e-4) << "heights of rows are all that there is";
}

TEST(WingSizes, are_hardly_longer_along_trailing_edges_at_tip_and_root) {
  WingSizes sizes = share_of_chord("0.5%chord");
  sizes.stretch.max_aspect = 16;
  int n_ends = 0, n_between = 0;
  for (const RasterBox& b : sample("sharp_wing", sizes).with(CauseKind::kEdge)) {
    const bool is_end = b.center.z < 1e-6 || b.center.z > 30 - 1e-6;
    ++(is_end ? n_ends : n_between);
    EXPECT_NEAR(b.stretch.along / b.length, is_end ? 1.8 : 16, 0.01) << b.center.z;
  }
  EXPECT_EQ(n_ends, 2);
  EXPECT_GT(n_between, 500);
}

TEST(WingSizes, are_hardly_longer_along_noses_and_sharp_edges_at_a_tip) {
  const Model model = test::make_model("sharp_wing");
  const FaceRoles roles = face_roles(model.tables());
  std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  WingSizes sizes = share_of_chord("0.5%chord");
  sizes.stretch.max_aspect = 16;
  const std::vector<std::uint8_t> is_left_out(static_cast<std::size_t>(model.tables().n_edges()), 0);
  Sampled s;
  raster_wing(model, wings[0], sizes, {}, is_left_out, s.boxes);
  for (const auto& [kind, at_root, at_tip] :
       {std::tuple{CauseKind::kEdge, 1.8, 1.8}, std::tuple{CauseKind::kFace, 3.0, 3.0}}) {
    std::vector<std::pair<double, double>> boxes;  // place, and length along over that across
    for (const RasterBox& b : s.with(kind)) boxes.push_back({b.center.z, b.stretch.along / b.length});
    std::ranges::sort(boxes);
    ASSERT_GT(boxes.size(), 100u);
    EXPECT_NEAR(boxes.front().second, at_root, 0.01);
    EXPECT_NEAR(boxes[boxes.size() / 2].second, 16, 0.01);
    EXPECT_NEAR(boxes.back().second, at_tip, 0.01);
  }
}

TEST(WingSizes, are_hardly_longer_along_noses_that_end_before_their_face_does) {
  const Model model = test::make_model("sharp_wing");
  const FaceRoles roles = face_roles(model.tables());
  std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  for (ChordStation& s : wings.at(0).trailing.at(0).stations)
    s.nose = {s.nose.x + 1, s.nose.y, 1 + s.nose.z * 28 / 30};  // on no edge, and root and tip are oblique
  WingSizes sizes = share_of_chord("0.5%chord");
  sizes.stretch.max_aspect = 16;
  const std::vector<std::uint8_t> is_left_out(static_cast<std::size_t>(model.tables().n_edges()), 0);
  Sampled s;
  raster_wing(model, wings[0], sizes, {}, is_left_out, s.boxes);
  std::vector<std::pair<double, double>> boxes;  // place, and length along over that across
  for (const RasterBox& b : s.with(CauseKind::kFace)) boxes.push_back({b.center.z, b.stretch.along / b.length});
  std::ranges::sort(boxes);
  ASSERT_GT(boxes.size(), 100u);
  EXPECT_NEAR(boxes.front().second, 3, 0.01);
  EXPECT_NEAR(boxes[boxes.size() / 2].second, 16, 0.01);
  EXPECT_NEAR(boxes.back().second, 3, 0.01);
}

TEST(WingSizes, are_finite_where_noses_are_at_one_place) {
  const Model model = test::make_model("sharp_wing");
  const FaceRoles roles = face_roles(model.tables());
  std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  std::vector<ChordStation>& stations = wings.at(0).trailing.at(0).stations;
  ASSERT_GT(stations.size(), 4u);
  for (std::size_t i = 2; i < 5; ++i) stations[i].nose = stations[1].nose;  // as at the apex of a body
  const std::vector<std::uint8_t> is_left_out(static_cast<std::size_t>(model.tables().n_edges()), 0);
  for (const double aspect : {1.0, 16.0}) {
    WingSizes sizes = share_of_chord("0.5%chord");
    sizes.stretch.max_aspect = aspect;
    Sampled s;
    ASSERT_NO_THROW(raster_wing(model, wings[0], sizes, {}, is_left_out, s.boxes)) << aspect;
    for (const RasterBox& b : s.boxes) ASSERT_TRUE(std::isfinite(norm(b.center)) && b.length > 0) << aspect;
  }
}

TEST(WingSizes, run_along_a_trailing_edge_inside_a_face) {
  const Sampled s = sample("closed_wing", share_of_chord("0.5%chord"));
  for (const double x : {-5.0, 5.0}) expect_run_along(s, x);
  EXPECT_TRUE(s.with(CauseKind::kEdge).empty());
  for (const double x : {-5.0, 5.0}) {  // the tail asks by its curvature: half of 0.3 % of the chord at least
    std::vector<double> lengths;
    for (const RasterBox& b : s.boxes)
      if (b.center.x * x > 0) lengths.push_back(b.length);
    const bool is_tail = lengths.at(0) < 0.03;
    for (const double length : lengths) EXPECT_NEAR(length, is_tail ? 0.015 : 0.9 * 0.05, 1e-4) << x;
  }
}

/// A station at each eighth of a circle about z, its chord growing from 10 at x = -radius to 20 at x = radius.
ChordEdge around(const Model& model, EdgeId e, FaceId base) {
  ChordEdge own{e, base, false, 1, {}};
  const auto curve = model.curve(e);
  for (int i = 0; i <= 8; ++i) {
    const Vec3 x = curve->point(curve->t_min() + (curve->t_max() - curve->t_min()) * i / 8);
    own.stations.push_back({.share = i / 8.0, .trailing = x, .chord = 15 + 5 * x.x / std::hypot(x.x, x.y)});
  }
  return own;
}

TEST(WingSizes, follow_the_chord_around_the_base_of_a_ring) {
  const Model model = test::make_model("turned_tube");
  std::vector<Strip> rings = find_rings(model);
  std::erase_if(rings, [&](const Strip& s) { return model.tables().face_type[s.face] != SurfaceType::kPlane; });
  ASSERT_EQ(rings.size(), 2u) << "both ends";
  const std::vector<std::uint8_t> none(static_cast<std::size_t>(model.tables().n_edges()), 0);
  for (const EdgeId e : rings[0].edges) {
    LiftingSurface wing;
    wing.trailing = {around(model, e, rings[0].face)};
    std::vector<RasterBox> boxes;
    raster_wing(model, wing, share_of_chord("1%chord"), rings, none, boxes);
    int n = 0;
    for (const RasterBox& b : boxes) {
      if (cause_kind(b.cause) != CauseKind::kFace) continue;
      ++n;
      const double chord = 15 + 5 * b.center.x / std::hypot(b.center.x, b.center.y);
      EXPECT_NEAR(b.length, 0.01 * chord, 0.01) << "edge " << e + 1;
    }
    EXPECT_GT(n, 100);
  }
}

/// A nose along an arc of radius 20, on a box's face, with a kink at its end.
LiftingSurface bent_nose(double station_angle) {
  LiftingSurface wing;
  ChordEdge edge{.edge = 0, .base = kNone, .is_half = false, .base_width = 0, .stations = {}, .is_inside = false};
  for (int i = 0; i <= 6; ++i) {
    const Vec3 nose{20 * std::cos(i * station_angle), 20 * std::sin(i * station_angle), 0};
    edge.stations.push_back({i / 8.0, 2 * nose, 20, true, false, nose, 0, 0});
  }
  edge.stations.push_back({7 / 8.0, {40, 40, 20}, 20, true, false, edge.stations.back().nose + Vec3{0, 0, 5}, 0, 0});
  edge.stations.push_back({1, {40, 40, 25}, 20, true, false, edge.stations.back().nose + Vec3{0, 0, 5}, 0, 0});
  wing.trailing = {edge};
  return wing;
}

TEST(WingSizes, follow_a_bent_nose_between_stations_and_not_beside_a_kink) {
  const Model model = test::make_model("box");
  const std::vector<std::uint8_t> none(static_cast<std::size_t>(model.tables().n_edges()), 0);
  std::vector<RasterBox> boxes;
  const double angle = radians(12);
  raster_wing(model, bent_nose(angle), share_of_chord("1%chord"), {}, none, boxes);
  double furthest = 0, beside = 0;
  for (const RasterBox& b : boxes) {
    if (cause_kind(b.cause) != CauseKind::kFace) continue;
    const double turned = std::atan2(b.center.y, b.center.x), off = std::abs(std::hypot(b.center.x, b.center.y) - 20);
    if (turned > angle && turned < 5 * angle && b.center.z == 0) furthest = std::max(furthest, off);
    if (b.center.z > 0) beside = std::max(beside, off);
  }
  EXPECT_LT(furthest, 0.002) << "straight pieces leave it by 0.11";
  EXPECT_LT(beside, 1e-9) << "straight where the line has a kink";
}

TEST(WingSizes, end_where_the_wing_runs_into_a_body) {
  double root = 30;
  for (const RasterBox& b : sample("wing_on_body", share_of_chord("0.5%chord")).boxes)
    root = std::min(root, b.center.z);
  EXPECT_GT(root, 3.999);
  EXPECT_LT(root, 4.1);
}

TEST(WingSizes, run_along_the_nose_of_half_a_wing) {
  for (const char* shape : {"half_sharp_wing", "half_blunt_wing"}) {
    const Model model = test::make_model(shape);
    FaceRoles roles = face_roles(model.tables());
    for (FaceId f = 0; f < model.tables().n_faces(); ++f)
      if (model.tables().face_box[f].hi.y < 1e-6) roles.role[f] = FaceRole::kSymmetry;
    const std::vector<std::uint8_t> none(static_cast<std::size_t>(model.tables().n_edges()), 0);
    std::vector<RasterBox> boxes;
    for (const LiftingSurface& wing :
         find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model))))
      raster_wing(model, wing, share_of_chord("0.5%chord"), find_strips(model), none, boxes);
    const auto n_nose = std::count_if(boxes.begin(), boxes.end(), [](const RasterBox& b) { return b.center.x < 0.1; });
    EXPECT_GT(n_nose, 500) << shape;
  }
}

TEST(WingSizes, lay_cells_across_a_blunt_base) {
  const Sampled s = sample("blunt_wing", share_of_chord("0.5%chord"));
  const std::vector<RasterBox> edges = s.with(CauseKind::kEdge);
  ASSERT_FALSE(edges.empty());
  for (const RasterBox& b : edges) EXPECT_NEAR(b.length, 0.95 * 0.05, 1e-4);
  std::size_t n_base = 0;
  for (const RasterBox& b : s.with(CauseKind::kFace))
    if (b.center.x > 9) {
      EXPECT_NEAR(b.length, 0.5 * 0.0252, 1e-4);
      ++n_base;
    }
  EXPECT_GT(n_base, 1000u);
}

/// The corners of a slot's wall lie before one edge of the base each.
TEST(WingSizes, lie_along_both_noses_before_a_base_where_they_are_apart) {
  const Model model = test::make_model("blunt_wing");
  const FaceRoles roles = face_roles(model.tables());
  const std::vector<Strip> strips = find_strips(model);
  LiftingSurface wing = find_lifting_surfaces(model, roles, find_wing_edges(model, roles, strips)).at(0);
  ASSERT_EQ(wing.trailing.size(), 2u);
  const std::vector<std::uint8_t> none(static_cast<std::size_t>(model.tables().n_edges()), 0);
  const auto n_above = [&](double height) {
    for (ChordStation& s : wing.trailing[1].stations) s.nose.y = height;
    Sampled sampled;
    raster_wing(model, wing, share_of_chord("0.5%chord"), strips, none, sampled.boxes);
    return std::ranges::count_if(sampled.boxes, [](const RasterBox& b) { return b.center.y > 1; });
  };
  EXPECT_GT(n_above(2), 300);
  const std::ptrdiff_t n_of_one = n_above(0.05);
  EXPECT_EQ(n_of_one, 0);
}

TEST(WingSizes, lie_along_noses_before_slots) {
  const Model model = test::make_model("sharp_wing");
  const FaceRoles roles = face_roles(model.tables());
  LiftingSurface wing = find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model))).at(0);
  ChordEdge front;
  front.is_inside = true;
  for (const double z : {5.0, 10.0}) {
    const Vec3 x{-3, 0, z};
    front.stations.push_back({z == 5 ? 0.0 : 1.0, x, 10, true, false, x, wing.trailing[0].stations[9].nose_face});
  }
  wing.front = {front};
  const std::vector<std::uint8_t> none(static_cast<std::size_t>(model.tables().n_edges()), 0);
  Sampled s;
  raster_wing(model, wing, share_of_chord("0.5%chord"), {}, none, s.boxes);
  EXPECT_GT(std::ranges::count_if(s.boxes, [](const RasterBox& b) { return b.center.x < -2; }), 90);
  const WingRecord record = record_wing(wing, share_of_chord("0.5%chord"), none);
  EXPECT_EQ(std::ranges::count_if(record.stations, &WingRecord::Station::is_nose_alone), 2);
  EXPECT_NEAR(record.stations.back().asked, 0.05, 1e-12);
}

TEST(WingSizes, do_not_lay_more_cells_across_a_base_than_a_quarter_of_the_edges_length_allows) {
  for (const RasterBox& b : sample("blunt_wing", share_of_chord("4%chord")).with(CauseKind::kFace))
    if (b.center.x > 9) {
      EXPECT_NEAR(b.length, 0.1, 1e-3);
    }
}

TEST(WingSizes, run_around_tips_where_that_is_asked_for) {
  WingSizes sizes = share_of_chord("0.5%chord");
  const std::size_t before = sample("sharp_wing", sizes).boxes.size();
  sizes.end_size = parse_length("0.1%span", "--end-size");
  const Sampled s = sample("sharp_wing", sizes);
  const auto n = std::ranges::count_if(s.boxes, [](const RasterBox& b) {
    return std::abs(b.length - 0.03) < 1e-6 && (b.center.z < 1e-6 || b.center.z > 30 - 1e-6);
  });
  EXPECT_EQ(static_cast<std::size_t>(n), s.boxes.size() - before);
  EXPECT_GT(n, 4 * 300) << "four sides of ten, one box for each 0.03";
}

TEST(WingSizes, leave_out_what_a_rule_names) {
  const auto trailing = static_cast<EdgeId>(WingEdgeKind::kBluntTrailing),
             leading = static_cast<EdgeId>(WingEdgeKind::kLeading);
  for (const RasterBox& b : sample("blunt_wing", share_of_chord("1%chord"), {trailing}).boxes) EXPECT_LT(b.center.x, 5);
  for (const RasterBox& b : sample("blunt_wing", share_of_chord("1%chord"), {leading}).boxes) EXPECT_GT(b.center.x, 5);
}

TEST(WingSizes, take_other_lengths_and_a_floor) {
  const auto asked = [](const RasterBox& b) { return b.length / (b.center.x < 5 ? 0.9 : 0.95); };
  for (const RasterBox& b : sample("sharp_wing", share_of_chord("1%span")).boxes) EXPECT_NEAR(asked(b), 0.3, 1e-4);
  for (const RasterBox& b : sample("sharp_wing", share_of_chord("0.2")).boxes) EXPECT_NEAR(asked(b), 0.2, 1e-6);
  WingSizes sizes = share_of_chord("0.1%chord");
  sizes.least = parse_length("0.25", "--lmin");
  for (const RasterBox& b : sample("sharp_wing", sizes).boxes) EXPECT_NEAR(b.length, 0.25, 1e-6);
}

TEST(WingSizes, tell_where_a_floor_makes_them_larger) {
  const Model model = test::make_model("sharp_wing");
  const FaceRoles roles = face_roles(model.tables());
  const std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  ASSERT_EQ(wings.size(), 1u);
  WingSizes sizes = share_of_chord("0.1%chord");
  EXPECT_FALSE(most_raised(wings[0], sizes));
  sizes.least = parse_length("0.005", "--lmin");
  EXPECT_FALSE(most_raised(wings[0], sizes));
  sizes.least = parse_length("0.25", "--lmin");
  ASSERT_TRUE(most_raised(wings[0], sizes));
  EXPECT_NEAR(most_raised(wings[0], sizes)->asked, 0.01, 1e-4);
  EXPECT_EQ(most_raised(wings[0], sizes)->floor, 0.25);
}

TEST(ChordLimit, passes_over_none_that_is_nearest) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto vec = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  std::vector<ChordLine> lines;
  for (int i = 0; i < 60; ++i) lines.push_back({vec(), vec(), 1.0 + i, 0});
  const ChordLimit limit(lines, 0, 1);
  EXPECT_EQ(limit.least(), 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x = 2 * vec();
    const auto nearest = std::min_element(lines.begin(), lines.end(), [&](const ChordLine& a, const ChordLine& b) {
      return segment_distance(x, a.nose, a.trailing) < segment_distance(x, b.nose, b.trailing);
    });
    ASSERT_EQ(limit.at(x), nearest->chord);
  }
}

TEST(ChordLimit, is_a_share_of_the_nearest_chord_of_its_own_surface) {
  const std::vector<ChordLine> lines = {
      {{0, 0, 0}, {4, 0, 0}, 4, 0}, {{0, 0, 9}, {2, 0, 9}, 2, 0}, {{0, 0, 5}, {1, 0, 5}, 1, 1}};
  const ChordLimit limit(lines, 0, 20);
  EXPECT_DOUBLE_EQ(limit.at({1, 0, 1}), 0.2);
  EXPECT_DOUBLE_EQ(limit.at({1, 0, 6}), 0.1);
  EXPECT_EQ(ChordLimit(lines, 7, 20).at({}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace st
