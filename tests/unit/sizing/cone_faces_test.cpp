#include "sizing/cone_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace st {
namespace {

/// A row of cells of edge 1, the first one's centre at 0; the field grows by 0.2. Of each sample the cone is a point's.
struct CellRow {
  SiteGraph graph;
  std::vector<SiteBeside> beside;
  std::vector<Cone> cones;
  SiteSamples samples;

  explicit CellRow(int n) {
    for (int i = 0; i < n; ++i) {
      ConeCell cell;
      cell.half = 0.5F;
      cell.c[0] = static_cast<float>(i);
      cell.c[1] = cell.c[2] = 0;
      graph.cell.push_back(cell);
      const auto first = static_cast<std::int32_t>(beside.size());
      if (i > 0) beside.push_back({i - 1, 1});
      if (i + 1 < n) beside.push_back({i + 1, 2});
      graph.of_beside.push_back({first, static_cast<std::int32_t>(beside.size())});
      graph.holds_sample.push_back(1);
    }
    graph.beside = beside;
  }
  void add_cone(Vec3 x, float length) {
    LengthSample s;
    s.xyz = x;
    s.length = length;
    cones.emplace_back(s, 0.2F, Vec3{});
  }
  /// The samples that each cell has at first.
  void set_samples(const std::vector<std::vector<std::int32_t>>& of_cell) {
    samples = {};
    for (std::size_t i = 0; i < of_cell.size(); ++i) {
      samples.sample.insert(samples.sample.end(), of_cell[i].begin(), of_cell[i].end());
      samples.first.push_back(static_cast<std::int32_t>(samples.sample.size()));
      samples.at_center.push_back(kNone);
      samples.center_length.push_back(10);
      for (const std::int32_t s : of_cell[i]) {
        const float* c = graph.cell[i].c;
        const auto length = static_cast<float>(cones[s].length_at({c[0], c[1], c[2]}));
        if (length < samples.center_length[i]) samples.center_length[i] = length, samples.at_center[i] = s;
      }
    }
  }
  std::vector<std::int32_t> settled(std::size_t cell) const {
    const SiteSamples all = agree_on_faces(graph, cones, 10, samples);
    std::vector<std::int32_t> own(all.sample.begin() + all.first[cell], all.sample.begin() + all.first[cell + 1]);
    std::sort(own.begin(), own.end());
    return own;
  }
};

using CellSamples = std::vector<std::int32_t>;

TEST(ConeFaces, give_a_cell_what_tells_less_on_its_face) {
  CellRow row(3);
  row.add_cone({0, 0, 0}, 1);
  row.add_cone({0.5, 0.5, 0}, 1.02F);  // wins around the middle of one side of the first face
  row.set_samples({{0, 1}, {0}, {0}});
  EXPECT_EQ(row.settled(1), (CellSamples{0, 1}));
  row.graph.holds_sample = {0, 0, 1};
  EXPECT_EQ(row.settled(1), (CellSamples{0})) << "the model lies elsewhere, and no step passes the slope";
}

TEST(ConeFaces, give_a_cell_what_tells_a_little_less_on_its_face) {
  CellRow row(2);
  row.add_cone({0, 0, 0}, 1);
  row.add_cone({0.5, 0.5, 0}, 1.1397F);  // 0.15 % less at its place
  row.set_samples({{0, 1}, {0}});
  EXPECT_EQ(row.settled(1), (CellSamples{0, 1}));
}

TEST(ConeFaces, leave_out_what_tells_hardly_less) {
  CellRow row(2);
  row.add_cone({0, 0, 0}, 1);
  row.add_cone({0, 0.005, 0}, 1);
  row.set_samples({{0, 1}, {0}});
  EXPECT_EQ(row.settled(1), (CellSamples{0}));
}

TEST(ConeFaces, pass_on_what_was_added) {
  CellRow row(4);
  row.add_cone({0, 0, 0}, 2);
  row.add_cone({-0.4, 0, 0}, 1);
  row.set_samples({{0, 1}, {0}, {0}, {0}});
  for (const std::size_t cell : {1, 2, 3}) EXPECT_EQ(row.settled(cell), (CellSamples{0, 1})) << cell;
}

TEST(ConeFaces, pass_nothing_where_a_link_is_closed) {
  CellRow row(2);
  row.add_cone({0, 0, 0}, 2);
  row.add_cone({1, 0, 0}, 1);
  row.beside[0] = {1, SiteBeside::kAlways};
  row.graph.of_beside[1] = {1, 1};  // no way from the second to the first
  row.set_samples({{0}, {1}});
  EXPECT_EQ(row.settled(0), (CellSamples{0}));
  row.set_samples({{1}, {0}});
  EXPECT_EQ(row.settled(1), (CellSamples{0, 1}));
}

/// Of a block of 2 x 2 x 2 cells, the first one's centre at the same coordinate along each axis.
CellRow cell_block(float from) {
  CellRow block(8);
  block.beside.clear();
  block.graph.of_beside.clear();
  block.graph.holds_sample.assign(8, 0);
  for (int i = 0; i < 8; ++i) {
    const auto first = static_cast<std::int32_t>(block.beside.size());
    for (int k = 0; k < 3; ++k) {
      block.graph.cell[i].c[k] = from + static_cast<float>(i >> k & 1);
      block.beside.push_back({i ^ 1 << k, 1 << (2 * k + 1 - (i >> k & 1))});
    }
    block.graph.of_beside.push_back({first, first + 3});
  }
  block.graph.beside = block.beside;
  return block;
}

/// With a cone at each centre: longer than at the first one by so much after so many steps along the axes.
CellRow rising_block(const std::array<float, 4>& rise, float from = 0) {
  CellRow block = cell_block(from);
  std::vector<std::vector<std::int32_t>> own;
  for (int i = 0; i < 8; ++i) {
    const float* c = block.graph.cell[i].c;
    block.add_cone({c[0], c[1], c[2]}, 1 + rise[(i & 1) + (i >> 1 & 1) + (i >> 2)]);
    own.push_back({i});
  }
  block.set_samples(own);
  return block;
}

TEST(ConeFaces, settle_the_steps_to_centres_across_edges_and_corners) {
  const CellRow steep_across_edges = rising_block({0, 0.19F, 0.38F, 0.38F});
  EXPECT_EQ(steep_across_edges.settled(1), (CellSamples{1})) << "no step across a face passes the slope";
  EXPECT_EQ(steep_across_edges.settled(3), (CellSamples{0, 3}));
  const CellRow steep_across_corner = rising_block({0, 0.19F, 0.28F, 0.47F});
  EXPECT_EQ(steep_across_corner.settled(3), (CellSamples{3})) << "0.28 over the root of 2";
  EXPECT_EQ(steep_across_corner.settled(7), (CellSamples{0, 7}));
}

TEST(ConeFaces, settle_the_steps_to_centres_of_small_cells_in_a_large_cube) {
  constexpr float kFar = 16'383.3F;  // the next centre is 1.001 away, as rounded
  const CellRow steep_across_edges = rising_block({0, 0.19F, 0.38F, 0.38F}, kFar);
  EXPECT_EQ(steep_across_edges.settled(3), (CellSamples{0, 3}));
}

TEST(ConeFaces, settle_the_steps_to_centres_everywhere) {
  CellRow row(3);
  row.graph.holds_sample = {0, 0, 0};
  row.add_cone({0, 0, 0}, 1);
  row.add_cone({0, 0, 0}, 1.3F);
  row.set_samples({{0}, {1}, {1}});
  EXPECT_EQ(row.settled(1), (CellSamples{0, 1}));
  EXPECT_EQ(row.settled(2), (CellSamples{0, 1})) << "once the second cell is lower";
}

TEST(ConeFaces, lists_each_sample_where_it_comes_first_over_all_pieces) {
  SiteSamples kept;
  constexpr std::int32_t kSites = 40'000, kSamples = 9;
  std::vector<std::int32_t> expected;
  for (std::int32_t site = 0; site < kSites; ++site) {
    for (const std::int32_t s : {site * 7 % kSamples, (site / 5'000 + 3) % kSamples}) kept.sample.push_back(s);
    kept.first.push_back(static_cast<std::int32_t>(kept.sample.size()));
    kept.at_center.push_back(kNone);
  }
  kept.sample.back() = kSamples;  // in the last piece alone
  for (const std::int32_t s : kept.sample)
    if (std::ranges::count(expected, s) == 0) expected.push_back(s);
  EXPECT_EQ(used_samples(kept, kSamples + 1), expected);
}

}  // namespace
}  // namespace st
