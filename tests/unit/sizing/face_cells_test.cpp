#include "sizing/face_cells.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/threads.h"
#include "geometry/shape/analytic.h"
#include "unit/sizing/sampled_field.h"

namespace st {
namespace {

const Frame kCellFrame{{0, 0, 0.9}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

double total(const std::vector<CellArea>& cells) {
  return std::accumulate(cells.begin(), cells.end(), 0.0, [](double sum, const CellArea& c) { return sum + c.area; });
}

TEST(FaceCells, share_out_the_area_of_the_face) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(3000));
  const PlaneSurface plane(kCellFrame, 0, 1, 0, 1);
  EXPECT_NEAR(total(locate_face(plane, {}, raster.shape.view(), 0)), 1, 1e-6);
  EXPECT_NEAR(total(locate_face(plane, {}, raster.shape.view(), 7)), 7, 1e-5);
}

TEST(FaceCells, put_each_part_where_it_lies) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(3000));
  const OctreeView octree = raster.shape.view();
  const PlaneSurface plane(kCellFrame, 0, 1, 0, 1);
  for (const CellArea& c : locate_face(plane, {}, octree, 0)) {
    const double edge = octree.cell_edge(octree.leaf_levels[c.leaf]);
    ASSERT_LE(std::abs(octree.leaf_center(c.leaf).z - 0.9), 0.51 * edge);
    ASSERT_LE(c.area, 1.7 * 1.7 * edge * edge);
  }
}

TEST(FaceCells, respect_the_loops) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(3000));
  const PlaneSurface plane(kCellFrame, 0, 1, 0, 1);
  const LoopPolygons half(
      std::vector<LoopSide>{{{0, 0}, {0.5, 0}}, {{0.5, 0}, {0.5, 1}}, {{0.5, 1}, {0, 1}}, {{0, 1}, {0, 0}}});
  const std::vector<CellArea> cells = locate_face(plane, half, raster.shape.view(), 0);
  EXPECT_NEAR(total(cells), 0.5, 0.03);
  for (const CellArea& c : cells) EXPECT_LT(raster.shape.view().leaf_center(c.leaf).x, 0.6);
}

TEST(FaceCells, give_a_sliver_its_whole_area) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(100));
  const PlaneSurface plane(kCellFrame, 0, 1, 0, 1);
  const double v = 0.123456;
  const LoopPolygons sliver(std::vector<LoopSide>{
      {{0, v}, {1, v}}, {{1, v}, {1, v + 1e-9}}, {{1, v + 1e-9}, {0, v + 1e-9}}, {{0, v + 1e-9}, {0, v}}});
  EXPECT_NEAR(total(locate_face(plane, sliver, raster.shape.view(), 1e-9)), 1e-9, 1e-13);
}

OctreeField field_on(const RasterOctree& raster, const ProlongedLengths& lengths, double scale) {
  return {{raster.shape.view(), lengths.cells, lengths.cause, 0.2, scale}, nullptr};
}

TEST(FaceCells, know_the_plane_of_each_part) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(3000));
  const PlaneSurface plane(kCellFrame, 0, 1, 0, 1);
  for (const CellArea& c : locate_face(plane, {}, raster.shape.view(), 0)) {
    EXPECT_NEAR(c.center[2], 0.9, 1e-6);
    EXPECT_NEAR(std::abs(c.normal[2]), 1, 1e-6);
  }
}

TEST(FaceCells, weigh_area_by_squared_length) {
  const RasterOctree raster = build_octree(test::kUnitBox, {});
  const ProlongedLengths half{{{0.5F, {}, 0.5F}}, {kNone}};
  FaceCells faces;
  faces.append_face(std::vector<CellArea>{{0, 2}, {0, 3}});
  faces.append_face({});
  const std::vector<FaceWeight> weights = face_weights(faces, raster.shape.view(), field_on(raster, half, 1));
  EXPECT_EQ(weights[0].at(1), 5 / 0.25);
  EXPECT_EQ(weights[0].at(2), 5);
  EXPECT_EQ(weights[1].at(1), 0);
  EXPECT_EQ(face_weights(faces, raster.shape.view(), field_on(raster, half, 2))[0].at(1), 5);
}

// The field grows from a wall across the plane: the octree of the areas may be much coarser than that of the field.
TEST(FaceCells, weigh_area_in_a_finer_field_than_their_octree) {
  const RasterOctree coarse = build_octree(test::kUnitBox, std::vector<RasterBox>{{{0.5, 0.5, 0.5}, 0.15F, 0.3F, 0}});
  const auto sampled = test::sample_field(test::wall_boxes(0.01F), 0.2, 1);
  const RasterOctree& fine = sampled->raster;
  const OctreeField field(sampled->data, sampled);
  const PlaneSurface plane(kCellFrame, 0, 1, 0, 1);
  double expected = 0;
  constexpr int n = 1000;
  for (int i = 0; i < n * n; ++i) {
    const double h = static_cast<const SizeField&>(field).size(Vec3{(i % n + 0.5) / n, (i / n + 0.5) / n, 0.9});
    expected += 1 / (h * h) / (n * n);
  }
  for (const RasterOctree* octree : {&coarse, &fine}) {
    FaceCells faces;
    faces.append_face(locate_face(plane, {}, octree->shape.view(), 1));
    EXPECT_NEAR(face_weights(faces, octree->shape.view(), field)[0].uniform / expected, 1,
                octree == &coarse ? 0.2 : 0.04);  // coarse: cells reach beyond the face
  }
}

/// A point source far smaller than the cell in which the face lies.
TEST(FaceCells, weigh_sources_smaller_than_their_cells) {
  const RasterOctree raster = build_octree(test::kUnitBox, {});
  const ProlongedLengths lengths{{{0.5F, {}, 0.5F}}, {kNone}};
  for (const double least : {0.0005, 0.01, 0.1}) {
    SourceSpec spec;
    spec.point[0] = {0.31, 0.62, 0.9};
    spec.spacing[0].length = least;
    std::vector<SourceTree::Entry> entries;
    entries.push_back({make_source(spec, 0.2), pack_cause(CauseKind::kSource, 0)});
    const SourceTree tree(std::move(entries));
    OctreeFieldData data{raster.shape.view(), lengths.cells, lengths.cause, 0.2, 1};
    data.sources = &tree;
    const OctreeField field(data, nullptr);
    FaceCells faces;
    const double lo = raster.shape.lo.x, edge = raster.shape.edge;
    const auto area_of_cell = static_cast<float>(edge * edge);
    faces.append_face(std::vector<CellArea>{{0, area_of_cell, {0.5F, 0.5F, 0.9F}, {0, 0, 1}}});
    // rings about the source, as far as they lie in the cell
    double expected = 0;
    constexpr int kRings = 4000, kSectors = 720;
    const double growth = std::log(1.5 / 1e-5) / kRings;
    for (int i = 0; i < kRings; ++i)
      for (int k = 0; k < kSectors; ++k) {
        const double r = 1e-5 * std::exp((i + 0.5) * growth), angle = 2 * kPi * k / kSectors;
        const Vec3 x = spec.point[0] + r * Vec3{std::cos(angle), std::sin(angle), 0};
        if (std::min(x.x, x.y) < lo || std::max(x.x, x.y) > lo + edge) continue;
        const double h = std::min(0.5, least + 0.2 * r);
        expected += r * r * growth * (2 * kPi / kSectors) / (h * h);
      }
    double area = 0;
    const FaceWeight w =
        face_weights(faces, raster.shape.view(), field, [&](const SizedPart& part) { area += part.area; })[0];
    EXPECT_NEAR(w.uniform / expected, 1, 0.02) << least;
    EXPECT_NEAR(area / area_of_cell, 1, 1e-6);
  }
}

TEST(FaceCells, weigh_the_same_on_any_number_of_threads) {
  const auto sampled = test::sample_field(test::sphere_boxes(3000), 0.2, 1);
  const RasterOctree& raster = sampled->raster;
  const OctreeField field(sampled->data, sampled);
  FaceCells faces;
  for (const double z : {0.1, 0.5, 0.9}) {
    faces.append_face({});
    faces.append_face(locate_face(PlaneSurface({{0, 0, z}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, 1, 0, 1), {},
                                  raster.shape.view(), 1));
  }
  const auto weigh = [&](int threads, std::vector<double>& areas) {
    set_thread_count(threads);
    const auto visit = [&](const SizedPart& part) { areas.push_back(part.area + part.face); };
    const std::vector<FaceWeight> weights = face_weights(faces, raster.shape.view(), field, visit);
    set_thread_count(1);
    return weights;
  };
  std::vector<double> areas, others;
  const std::vector<FaceWeight> one = weigh(1, areas), three = weigh(3, others);
  EXPECT_EQ(areas, others);
  EXPECT_GT(faces.leaf.size(), 1000u);
  for (std::size_t f = 0; f < one.size(); ++f) {
    EXPECT_EQ(one[f].uniform, three[f].uniform);
    EXPECT_EQ(one[f].uniform > 0, f % 2 == 1);
  }
}

TEST(FaceCells, weigh_gradients_along_the_face_only) {
  // a sample far away, from which lengths grow by 0.1 along x and along z
  const std::vector<RasterBox> far{{Vec3{-1000, 0.5, -1000}, 1, 1, 0}};
  const auto sampled = test::sample_field(far, 0.1 * std::sqrt(2.0), 1e4);
  const RasterOctree& raster = sampled->raster;
  const OctreeField field(sampled->data, sampled);
  FaceCells faces;
  faces.append_face(std::vector<CellArea>{{0, 1, {0.5F, 0.5F, 0.5F}, {0, 0, 1}}});
  const FaceWeight w = face_weights(faces, raster.shape.view(), field)[0];
  EXPECT_NEAR(w.graded / w.uniform, 0.1, 1e-3);
  EXPECT_NEAR(w.steep / w.uniform, 0.01, 2e-4);
  for (const double scale : {0.5, 1.0, 3.0}) {  // the gradient is 0.1 * scale
    const double g = 0.1 * scale;
    EXPECT_NEAR(w.at(scale) * scale * scale / w.uniform, 1 + kTrianglesPerGradient * g + kTrianglesPerGradient2 * g * g,
                1e-3);
  }
}

}  // namespace
}  // namespace st
