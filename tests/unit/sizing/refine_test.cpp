#include "sizing/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "base/error.h"
#include "sizing/octree_field.h"
#include "sizing/prolong.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr double kSlope = 0.2, kMaxLength = 0.1;

SourceSpec sphere_source(Vec3 at, double extent, double length) {
  SourceSpec s;
  s.kind = SourceKind::kSphere;
  s.point[0] = at;
  s.extent = extent;
  s.spacing[0] = {length, 0, 0};
  return s;
}

SourceSpec line_source() {
  SourceSpec s;
  s.kind = SourceKind::kLine;
  s.point = {{{0.1, 0.1, 0.1}, {0.9, 0.3, 0.2}, {}}};
  s.spacing = {{{0.002, 0.01, 0.05}, {0.01, 0.02, 0.2}, {}}};
  return s;
}

struct Refined {
  RasterOctree octree;
  ProlongedLengths lengths;
  std::unique_ptr<OctreeField> field;
};

std::vector<std::unique_ptr<SizeSource>> make_all(const std::vector<SourceSpec>& specs) {
  std::vector<std::unique_ptr<SizeSource>> sources;
  for (const SourceSpec& s : specs) sources.push_back(make_source(s, kSlope));
  return sources;
}

RasterOctree refine(const RasterOctree& raster, const std::vector<std::unique_ptr<SizeSource>>& sources) {
  std::vector<NamedSource> named;
  for (std::size_t i = 0; i < sources.size(); ++i)
    named.push_back({sources[i].get(), pack_cause(CauseKind::kSource, static_cast<std::int32_t>(i))});
  return refine_octree(raster, named, {kMaxLength, 2});
}

Refined refine_and_prolong(const RasterOctree& raster, const std::vector<std::unique_ptr<SizeSource>>& sources) {
  Refined r;
  r.octree = refine(raster, sources);
  r.lengths =
      prolong(Neighbours(r.octree.shape.view()), r.octree.stored_length, r.octree.stored_cause, {kSlope, kMaxLength});
  r.field = std::make_unique<OctreeField>(
      OctreeFieldData{r.octree.shape.view(), r.lengths.cells, r.lengths.cause, kSlope, 1}, nullptr);
  return r;
}

double size_at(const SizeField& field, Vec3 x) { return field.size(x); }

TEST(RefineOctree, without_sources_changes_nothing) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(500));
  const RasterOctree same = refine(raster, {});
  EXPECT_EQ(same.shape.leaf_keys, raster.shape.leaf_keys);
  EXPECT_EQ(same.shape.node_children, raster.shape.node_children);
  EXPECT_EQ(same.stored_length, raster.stored_length);
  EXPECT_EQ(same.stored_cause, raster.stored_cause);
}

TEST(RefineOctree, keeps_octrees_sound) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(500));
  const RasterOctree fine = refine(raster, make_all({line_source(), sphere_source({0.3, 0.7, 0.7}, 0.1, 0.001)}));
  EXPECT_STREQ(octree_defect(fine.shape.view()), "");
  EXPECT_GT(fine.shape.leaf_keys.size(), raster.shape.leaf_keys.size());
  EXPECT_EQ(fine.stored_length.size(), fine.shape.leaf_keys.size());
}

TEST(RefineOctree, follows_the_sources_in_space) {
  const RasterOctree raster = build_octree(test::kUnitBox, {});
  const auto sources = make_all({line_source(), sphere_source({0.3, 0.7, 0.7}, 0.1, 0.004)});
  const Refined r = refine_and_prolong(raster, sources);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    const double wanted = std::min({size_at(*sources[0], x), size_at(*sources[1], x), kMaxLength}),
                 h = size_at(*r.field, x);
    worst = std::max(worst, h / wanted);
    ASSERT_GT(h, 0.5 * wanted);
  }
  EXPECT_LT(worst, 1.6);
  for (int i = 0; i < 1000; ++i) {  // along the line itself
    const Vec3 x = Vec3{0.1, 0.1, 0.1} + uniform(random) * Vec3{0.8, 0.2, 0.1};
    ASSERT_LT(size_at(*r.field, x) / size_at(*sources[0], x), 1.15);
  }
}

TEST(RefineOctree, keeps_cells_inside_a_core_larger_than_their_length) {
  const RasterOctree raster = build_octree(test::kUnitBox, {});
  const Refined r = refine_and_prolong(raster, make_all({sphere_source({0.5, 0.5, 0.5}, 0.45, 0.01)}));
  EXPECT_LT(r.octree.shape.leaf_keys.size(), 80000u);  // those at its surface
  EXPECT_GT(r.field->explain({0.52, 0.51, 0.53}).cell_edge, 0.06);
  EXPECT_FLOAT_EQ(static_cast<float>(size_at(*r.field, {0.52, 0.51, 0.53})), 0.01F);
}

TEST(RefineOctree, takes_the_smaller_of_raster_and_source) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(2000));
  const RasterOctree fine = refine(raster, make_all({sphere_source({0.5, 0.5, 0.1}, 0.1, 0.02)}));
  std::size_t from = 0, n_sources = 0;
  for (std::size_t i = 0; i < fine.shape.leaf_keys.size(); ++i) {
    while (from + 1 < raster.shape.leaf_keys.size() && raster.shape.leaf_keys[from + 1] <= fine.shape.leaf_keys[i])
      ++from;
    ASSERT_LE(fine.stored_length[i], raster.stored_length[from]);
    if (fine.stored_length[i] < raster.stored_length[from]) {
      ++n_sources;
      ASSERT_EQ(cause_kind(fine.stored_cause[i]), CauseKind::kSource);
    }
  }
  EXPECT_GT(n_sources, 100u);
}

TEST(RefineOctree, does_not_depend_on_the_order_of_sources) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(500));
  const auto sources =
      make_all({line_source(), sphere_source({0.3, 0.7, 0.7}, 0.1, 0.004), sphere_source({0.4, 0.7, 0.7}, 0.1, 0.004)});
  std::vector<NamedSource> named;
  for (int i = 0; i < 3; ++i)
    named.push_back({sources[static_cast<std::size_t>(i)].get(), pack_cause(CauseKind::kSource, i)});
  const RasterOctree a = refine_octree(raster, named, {kMaxLength, 2});
  std::reverse(named.begin(), named.end());
  const RasterOctree b = refine_octree(raster, named, {kMaxLength, 2});
  EXPECT_EQ(a.shape.leaf_keys, b.shape.leaf_keys);
  EXPECT_EQ(a.stored_length, b.stored_length);
  EXPECT_EQ(a.stored_cause, b.stored_cause);
}

TEST(RefineOctree, interpolates_a_background_mesh) {
  BackgroundMesh mesh;  // the unit cube in six tetrahedra around the diagonal 0-7
  for (int i = 0; i < 8; ++i) {
    mesh.node_xyz.push_back({static_cast<double>(i & 1), static_cast<double>(i >> 1 & 1), static_cast<double>(i >> 2)});
    const double length = 0.02 + 0.05 * (i & 1);
    mesh.node_size.push_back({length, length, {}});
  }
  mesh.tets = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  const Refined r = refine_and_prolong(build_octree(test::kUnitBox, {}), make_sources(mesh));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.02, 0.98);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    ASSERT_NEAR(size_at(*r.field, x), 0.02 + 0.05 * x.x, 0.008);
  }
}

TEST(RefineOctree, refuses_more_cells_than_allowed) {
  const RasterOctree raster = build_octree(test::kUnitBox, {});
  const auto sources = make_all({line_source()});
  const std::vector<NamedSource> named{{sources[0].get(), 0}};
  EXPECT_THROW(refine_octree(raster, named, {kMaxLength, 2, 1000}), Error);
}

}  // namespace
}  // namespace st
