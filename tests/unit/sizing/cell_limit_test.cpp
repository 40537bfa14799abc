// What octree and sampling may grow to, and what is said when they would grow further.
#include "sizing/cell_limit.h"

#include <gtest/gtest.h>

#include <functional>

#include "geometry/shape/analytic.h"
#include "sizing/octree_nodes.h"
#include "sizing/raster_curve.h"
#include "sizing/raster_face.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

using test::kUnitBox;

const Frame kFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const TooManyCells& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    return e.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(CellLimit, names_cells_memory_limit_and_what_to_do) {
  EXPECT_EQ(refusal([] { require_cells(1000, 1000); }), "");
  const std::string text = refusal([] { require_cells(2e12, 1000); });
  EXPECT_TRUE(has(text, "2e+12 cells") && has(text, "1.2e+05 GB") && has(text, "at most 1000") &&
              has(text, "--max-cells"))
      << text;
}

TEST(CellLimit, of_the_octree_is_exact) {
  const std::vector<RasterBox> boxes = test::sphere_boxes(3000);
  const NodeLevels nodes = split_cells(kUnitBox, boxes);
  const std::uint64_t n = count_leaves(nodes);
  EXPECT_EQ(n, make_shape(kUnitBox, nodes).leaf_keys.size());
  EXPECT_EQ(refusal([&] { split_cells(kUnitBox, boxes, n); }), "");
  EXPECT_TRUE(has(refusal([&] { split_cells(kUnitBox, boxes, n - 1); }), "cells"));
}

TEST(CellLimit, stops_the_sampling_of_a_curve_and_of_a_face) {
  const EllipseCurve circle(kFrame, 10, 10, 0, 2 * kPi);
  const AxialSurface sphere(SurfaceType::kSphere, kFrame, 10, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  SamplingLimits limits{1e-6, 1, radians(1e-3), 2};
  limits.max_samples = 500;
  std::vector<RasterBox> boxes;
  EXPECT_TRUE(has(refusal([&] { raster_curve(circle, limits, 0, boxes); }), "more than 500 samples"));
  boxes.clear();
  EXPECT_TRUE(has(refusal([&] { raster_face(sphere, LoopPolygons(), limits, 0, boxes); }), "more than 500 samples"));
  EXPECT_LE(boxes.size(), 501u);
}

TEST(CellLimit, of_samples_is_known_before_any_is_made) {
  EXPECT_EQ(refusal([] { require_room_for(1e6, 1000000); }), "");
  const std::string text = refusal([] { require_room_for(3e8, 1000000); });
  EXPECT_TRUE(has(text, "at least 3e+08 samples") && has(text, "room for 1e+06") && has(text, "--lmax")) << text;
  const AxialSurface sphere(SurfaceType::kSphere, kFrame, 10, 0, 0, 2 * kPi, -kPi / 2, kPi / 2);
  ModelTables tables;
  tables.face_area = {400 * kPi};
  ModelLimits limits;
  for (const double cell_per_length : {1.0, 2.0, 4.0})
    for (const double length : {20.0, 1.0, 0.1}) {
      limits.face = {SamplingLimits{length, length, radians(90), cell_per_length}};
      std::vector<RasterBox> boxes;
      raster_face(sphere, LoopPolygons(), *limits.face[0], 0, boxes);
      const double least = least_samples(tables, limits), found = static_cast<double>(boxes.size());
      EXPECT_LE(least, found) << length;
      EXPECT_TRUE(length >= 1 || least > 0.1 * found) << cell_per_length;
    }
}

TEST(CellLimit, is_estimated_below_what_sampling_makes) {
  ModelTables tables;
  tables.vertex_xyz = {{0, 0, 0}, {1, 1, 0}};
  tables.face_area = {1};
  tables.face_box = {{{0, 0, 0}, {1, 1, 0}}};
  ModelLimits limits;
  for (const double length : {0.1, 0.02, 0.005}) {
    limits.face = {SamplingLimits{length, length, radians(10), 2}};
    const double estimate = least_cells(tables, limits);
    std::vector<RasterBox> boxes;
    for (double x = 0; x <= 1; x += length)
      for (double y = 0; y <= 1; y += length)
        boxes.push_back({{x, y, 0}, static_cast<float>(length), static_cast<float>(length), 0});
    const double n = static_cast<double>(count_leaves(split_cells(tables.face_box[0], boxes)));
    EXPECT_LT(estimate, n) << length;
    EXPECT_GT(estimate, 0.01 * n) << length;
  }
}

TEST(CellLimit, counts_samples_that_ask_for_more_than_the_deepest_level) {
  const float deepest = static_cast<float>(1.02 / kCoordinateEnd);
  const auto box = [](float edge, float length) { return RasterBox{{0.5, 0.5, 0.5}, 0.5F * edge, length, 0}; };
  const DepthLimit none = find_depth_limit(kUnitBox, std::vector<RasterBox>{box(1.1F * deepest, 1e-9F)});
  EXPECT_EQ(none.n_samples, 0u);
  EXPECT_NEAR(none.smallest_cell, deepest, 1e-12);
  DepthLimit two = find_depth_limit(
      kUnitBox, std::vector<RasterBox>{box(0.9F * deepest, 3e-7F), box(0.1F, 1e-9F), box(0.1F * deepest, 5e-8F)});
  EXPECT_EQ(two.n_samples, 2u);
  EXPECT_FLOAT_EQ(two.smallest_length, 5e-8F);
  two.add(none);
  EXPECT_EQ(two.n_samples, 2u);
}

}  // namespace
}  // namespace st
