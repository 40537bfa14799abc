// What artifacts keep of lifting surfaces.
#include "sizing/wing_record.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sizing/wing_sizes.h"
#include "support/shapes.h"

namespace st {
namespace {

struct Recorded {
  LiftingSurface wing;
  WingRecord record;
};

Recorded record_of(const std::string& shape, bool is_left_out = false) {
  const Model model = test::make_model(shape);
  const FaceRoles roles = face_roles(model.tables());
  const auto wings = find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  const std::vector<std::uint8_t> left_out(static_cast<std::size_t>(model.tables().n_edges()), is_left_out);
  const WingSizes sizes{parse_length("0.5%chord", "--edge-size"), 4, {30, {}}, {}, 2};
  return {wings.at(0), record_wing(wings.at(0), sizes, left_out)};
}

TEST(WingRecord, has_the_lengths_that_are_asked_for) {
  const auto [wing, record] = record_of("sharp_wing");
  EXPECT_EQ(record.edges, std::vector<EdgeId>{wing.trailing[0].edge});
  EXPECT_EQ(record.faces, wing.faces);
  EXPECT_TRUE(record.bases.empty() && record.has_noses);
  EXPECT_NEAR(record.span, 30, 1e-9);
  EXPECT_GT(record.covered, 0.95);
  EXPECT_EQ(record.base_cells, 0);
  ASSERT_GE(record.stations.size(), 24u);
  for (const WingRecord::Station& s : record.stations) {
    EXPECT_NEAR(s.asked, 0.005 * s.chord, 1e-12);
    EXPECT_NEAR(distance(s.nose, s.trailing), s.chord, 1e-6);
  }
  for (const WingRecord::Station& s : record_of("sharp_wing", true).record.stations)
    EXPECT_EQ(s.asked, 0) << "rules say what it gets";
}

TEST(WingRecord, counts_the_lengths_across_a_base) {
  const WingRecord record = record_of("blunt_wing").record;
  ASSERT_EQ(record.bases.size(), 1u);
  EXPECT_EQ(std::ranges::count(record.faces, record.bases[0]), 0);
  EXPECT_EQ(record.base_cells, 4);
  EXPECT_EQ(record_of("blunt_wing", true).record.base_cells, 0);
}

TEST(WingRecord, of_a_base_in_pieces_beside_each_other_has_all_of_them) {
  LiftingSurface wing;
  wing.faces = {0, 1, 2, 3};
  wing.trailing.push_back({.edge = 0, .base = 2, .stations = {}});
  Strip strip;
  strip.face = 2;
  strip.others = {3};
  const WingSizes sizes{parse_length("0.5%chord", "--edge-size"), 4, {30, {}}, {}, 2};
  const WingRecord record = record_wing(wing, sizes, std::vector<std::uint8_t>(1, 0), {&strip, 1});
  EXPECT_EQ(record.bases, (std::vector<FaceId>{2, 3}));
  EXPECT_EQ(record.faces, (std::vector<FaceId>{0, 1}));
}

TEST(WingRecord, moves_with_its_geometry) {
  const WingRecord before = record_of("sharp_wing").record;
  Similarity frame;
  frame.scale = 2;
  frame.translation = {1, 2, 3};
  const WingRecord after = moved(frame, before);
  EXPECT_EQ(after.span, 2 * before.span);
  EXPECT_EQ(after.stations[3].asked, 2 * before.stations[3].asked);
  EXPECT_EQ(after.stations[3].nose, frame(before.stations[3].nose));
}

}  // namespace
}  // namespace st
