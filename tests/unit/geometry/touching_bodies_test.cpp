// Solids that touch have common faces and edges after the import.
#include "geometry/import/touching_bodies.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp.hxx>

#include <algorithm>
#include <numeric>

#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;

ImportResult join_broken(const std::string& shape, ImportOptions options = {}) {
  options.join_touching = true;
  return import_broken(shape, options);
}

/// Edges by their number of uses.
std::vector<int> edges_by_uses(const ModelTables& t) {
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  std::vector<int> n(8, 0);
  for (EdgeId e = 0; e < t.n_edges(); ++e) ++n[std::min(7, offsets[e + 1] - offsets[e])];
  return n;
}

double total_area(const ImportResult& r) {
  return std::accumulate(r.tables.face_area.begin(), r.tables.face_area.end(), 0.0);
}

TEST(TouchingBodies, with_a_face_at_one_place_have_it_once_and_named) {
  const ImportResult r = join_broken("touching_boxes");
  EXPECT_EQ(r.tables.n_solids, 2);
  ASSERT_EQ(r.tables.n_faces(), 11);
  EXPECT_EQ(r.tables.n_edges(), 20);
  EXPECT_EQ(edges_by_uses(r.tables)[3], 4);
  EXPECT_NEAR(r.volume, 2000, 1e-6);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(findings_of(r, "bodies that touch joined: 2 bodies have 1 common face").size(), 1u);
  const auto& names = r.tables.labels.face_name;
  EXPECT_EQ(std::count(names.begin(), names.end(), "interface"), 1);
}

TEST(TouchingBodies, are_named_where_they_are_not_joined) {
  for (const char* shape : {"touching_boxes", "offset_boxes", "pin_in_plate", "boxes_along_edge"}) {
    const auto found = findings_of(import_broken(shape), "bodies touch");
    ASSERT_EQ(found.size(), 1u) << shape;
    EXPECT_NE(found[0].detail.find("2 bodies, among them"), std::string::npos) << found[0].detail;
    EXPECT_TRUE(findings_of(join_broken(shape), "bodies touch,").empty()) << shape;
  }
  for (const char* shape : {"two_boxes", "facing_wedges"})
    EXPECT_TRUE(findings_of(test::import_shape(shape), "bodies touch").empty()) << shape;
}

TEST(TouchingBodies, share_the_part_of_a_face_on_which_they_touch) {
  const ImportResult r = join_broken("offset_boxes");
  EXPECT_EQ(r.tables.n_faces(), 12);
  EXPECT_NEAR(total_area(r), 600 + 2 * 40 + 2 * 50 + 20, 1e-6);
  EXPECT_NEAR(r.volume, 1000 + 200, 1e-6);
}

TEST(TouchingBodies, share_curved_faces) {
  const ImportResult r = join_broken("pin_in_plate");
  EXPECT_EQ(r.tables.n_solids, 2);
  const auto& names = r.tables.labels.face_name;
  const auto common = std::find(names.begin(), names.end(), "interface");
  ASSERT_NE(common, names.end());
  EXPECT_NEAR(r.tables.face_area[common - names.begin()], 2 * kPi * 5 * 10, 1e-6);
}

TEST(TouchingBodies, share_an_edge_along_which_they_touch) {
  const ImportResult r = join_broken("boxes_along_edge");
  EXPECT_EQ(r.tables.n_faces(), 12);
  EXPECT_EQ(r.tables.n_edges(), 23);
  EXPECT_EQ(edges_by_uses(r.tables)[4], 1);
}

TEST(TouchingBodies, at_one_place_are_one) {
  const ImportResult r = join_broken("box_twice");
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_NEAR(r.volume, 1000, 1e-6);
}

TEST(TouchingBodies, bound_the_flow_around_them_without_their_common_faces) {
  ImportOptions options;
  options.air.farfield = "box:3";
  const ImportResult r = join_broken("offset_boxes", options);
  EXPECT_EQ(r.tables.n_faces(), 11 + 6);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 0);
}

TEST(TouchingBodies, stay_apart_where_nobody_asks) {
  EXPECT_EQ(import_broken("offset_boxes").tables.n_faces(), 12);
  EXPECT_EQ(import_broken("touching_boxes").tables.n_faces(), 12);
}

TEST(TouchingBodies, that_touch_themselves_along_an_edge_have_it_once_unasked) {
  const ImportResult r = import_broken("pinched_block");
  EXPECT_EQ(r.tables.n_vertices(), 14);
  EXPECT_EQ(r.tables.n_edges(), 23);
  EXPECT_EQ(r.tables.n_faces(), 10);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 1);
  EXPECT_NEAR(r.volume, 10 * (30 * 20 - 50), 1e-6);
  EXPECT_EQ(findings_of(r, "bodies that touch joined").size(), 1u);
}

TEST(TouchingBodies, are_none_where_solids_are_apart_or_cross) {
  for (const char* shape : {"crossing_boxes", "box_in_box"}) {
    const ImportResult r = join_broken(shape);
    EXPECT_TRUE(findings_of(r, "bodies that touch").empty()) << shape;
    EXPECT_EQ(r.tables.n_faces(), 12) << shape;
  }
}

}  // namespace
}  // namespace st
