#include "sizing/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "base/error.h"
#include "sizing/octree_field.h"
#include "unit/sizing/octree_balance.h"
#include "unit/sizing/sampled_field.h"

namespace st {
namespace {

constexpr double kRefinedSlope = 0.2, kRefinedMost = 0.1;

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

/// A field of sources alone, on the octree of some boxes.
class Refined {
 public:
  explicit Refined(const std::vector<SourceSpec>& specs, const std::vector<RasterBox>& boxes = {})
      : sampled_(test::sample_field(boxes, kRefinedSlope, kRefinedMost)) {
    std::vector<SourceTree::Entry> entries;
    for (const SourceSpec& s : specs) entries.push_back({make_source(s, kRefinedSlope), 2});
    tree_ = std::make_unique<SourceTree>(std::move(entries));
    OctreeFieldData data = sampled_->data;
    if (!specs.empty()) data.sources = tree_.get();
    field_ = std::make_unique<OctreeField>(data, nullptr);
  }
  const OctreeField& field() const { return *field_; }
  const RasterOctree& raster() const { return sampled_->raster; }

 private:
  std::shared_ptr<test::SampledField> sampled_;
  std::unique_ptr<SourceTree> tree_;
  std::unique_ptr<OctreeField> field_;
};

TEST(RefineOctree, without_sources_changes_nothing) {
  const Refined r({}, test::sphere_boxes(500));
  const OctreeShape same = refine_octree(r.field());
  EXPECT_EQ(same.leaf_keys, r.raster().shape.leaf_keys);
  EXPECT_EQ(same.node_children, r.raster().shape.node_children);
}

TEST(RefineOctree, keeps_octrees_sound) {
  const Refined r({line_source(), sphere_source({0.3, 0.7, 0.7}, 0.1, 0.001)}, test::sphere_boxes(500));
  const OctreeShape fine = refine_octree(r.field());
  EXPECT_STREQ(test::octree_defect(fine.view()), "");
  EXPECT_GT(fine.leaf_keys.size(), r.raster().shape.leaf_keys.size());
}

TEST(RefineOctree, shows_the_sources_in_every_cell) {
  const Refined r({line_source(), sphere_source({0.3, 0.7, 0.7}, 0.1, 0.004)});
  const ShownOctree shown = show_octree(r.field());
  const OctreeView octree = shown.shape.view();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    const std::int32_t leaf = octree.find_leaf(morton::encode(octree.grid_point(x)));
    const double h = static_cast<const SizeField&>(r.field()).size(x),
                 edge = octree.cell_edge(octree.leaf_levels[leaf]);
    const double ratio = h / shown.length[leaf];
    ASSERT_TRUE((ratio > 0.799 && ratio < 1.5) || 2 * h > 0.999 * edge - kRefinedSlope * edge) << h << " " << edge;
  }
}

TEST(RefineOctree, keeps_cells_inside_a_core_larger_than_their_length) {
  const Refined r({sphere_source({0.5, 0.5, 0.5}, 0.45, 0.01)});
  const OctreeShape fine = refine_octree(r.field());
  EXPECT_LT(fine.leaf_keys.size(), 80000u);  // those at its surface
  const OctreeView octree = fine.view();
  EXPECT_GT(
      octree.cell_edge(octree.leaf_levels[octree.find_leaf(morton::encode(octree.grid_point({0.52, 0.51, 0.53})))]),
      0.06);
}

TEST(RefineOctree, refuses_more_cells_than_allowed) {
  const Refined r({line_source()});
  EXPECT_THROW(refine_octree(r.field(), {2, 1000}), Error);
}

}  // namespace
}  // namespace st
