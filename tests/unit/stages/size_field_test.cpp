// Size fields of whole models: what they promise at every point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "io/hdf5/sizing_artifact.h"
#include "sizing/neighbours.h"
#include "support/staged.h"

namespace st {
namespace {

struct FieldCase {
  const char* shape;
  bool has_source;
  double cell_per_length;
};
void PrintTo(const FieldCase& c, std::ostream* out) {
  *out << c.shape << (c.has_source ? " with a source" : "") << ", cells of " << c.cell_per_length << " lengths";
}

class SizeFieldOfModel : public testing::TestWithParam<FieldCase> {
 protected:
  void SetUp() override {
    staged_.raster.cell_per_length = GetParam().cell_per_length;
    if (GetParam().has_source) {
      staged_.prolong.sources = {staged_.dir / "sources.toml"};
      std::ofstream(staged_.prolong.sources[0])
          << "[[source]]\ntype = \"point\"\nat = [1, 2, 3]\nlength = \"0.1%\"\nradius = \"2%\"\n";
    }
    staged_.make_sizing(GetParam().shape);
    sizing_ = read_sizing(staged_.prolong.output);
    field_ = sizing_.field();
    octree_ = std::make_unique<OctreeField>(sizing_.field_data(nullptr), nullptr);
  }

  std::int32_t leaf_at(const LengthSample& s) const {
    const OctreeView octree = sizing_.shape.view();
    return octree.find_leaf(morton::encode(octree.grid_point(s.xyz)));
  }
  double edge_at(int leaf) const { return sizing_.shape.view().cell_edge(sizing_.shape.leaf_levels[leaf]); }
  Vec3 random_point() {
    std::uniform_real_distribution<double> uniform(0, 1);
    const OctreeView octree = sizing_.shape.view();
    const auto leaf = static_cast<std::int32_t>(random_() % sizing_.shape.leaf_keys.size());  // as many in fine cells
                                                                                              // as in coarse ones
    const double edge = edge_at(leaf);
    return octree.leaf_center(leaf) +
           edge * Vec3{uniform(random_) - 0.5, uniform(random_) - 0.5, uniform(random_) - 0.5};
  }

  test::StagedModel staged_;
  SizingArtifact sizing_;
  std::unique_ptr<OctreeField> field_;   // of octree and sources
  std::unique_ptr<OctreeField> octree_;  // without sources
  std::mt19937_64 random_{11};
};

INSTANTIATE_TEST_SUITE_P(Models, SizeFieldOfModel,
                         testing::Values(FieldCase{"torus", false, 2}, FieldCase{"torus", false, 4},
                                         FieldCase{"drilled_block", true, 2}, FieldCase{"drilled_block", true, 4},
                                         FieldCase{"thin_plate", false, 2}, FieldCase{"thin_plate", false, 4}));

TEST_P(SizeFieldOfModel, changes_by_the_slope_and_the_cells_at_most) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr int kPairs = 350'000;  // on each of three models
  double worst = 0;
  for (int i = 0; i < kPairs; ++i) {
    int leaf_a = 0, leaf_b = 0;
    const Vec3 a = random_point();
    const double h_a = field_->size(a, leaf_a);
    Vec3 b = random_point();
    if (i % 2) b = a + 2 * edge_at(leaf_a) * Vec3{uniform(random_), uniform(random_), uniform(random_)};
    const double h_b = field_->size(b, leaf_b);
    const double bound = sizing_.slope * (distance(a, b) + edge_at(leaf_a) + edge_at(leaf_b)) * 1.15;
    worst = std::max(worst, std::abs(h_a - h_b) / bound);
  }
  EXPECT_LE(worst, 1);
}

TEST_P(SizeFieldOfModel, differs_from_the_length_at_the_centre_by_the_slope_at_most) {
  const Neighbours neighbours(sizing_.shape.view());
  constexpr double kLeftOut = 0.02;  // samples that lower a length by less may be missing in a cell
  for (int i = 0; i < 200'000; ++i) {
    int leaf = 0;
    const Vec3 x = random_point();
    const double h = octree_->size(x, leaf), own = sizing_.lengths.cells[leaf].length;
    if (sizing_.blanking.colour.empty()) {
      ASSERT_NEAR(h, own, sizing_.slope * distance(x, sizing_.shape.view().leaf_center(leaf)) + kLeftOut * own);
      continue;
    }
    double lo = own, hi = own;
    neighbours.for_each(leaf, [&](std::int32_t other, const CellStep&) {
      lo = std::min<double>(lo, sizing_.lengths.cells[other].length);
      hi = std::max<double>(hi, sizing_.lengths.cells[other].length);
    });
    const double rise = sizing_.slope * 0.87 * edge_at(leaf);
    ASSERT_GE(h, (lo - rise) * (1 - 1e-6));
    ASSERT_LE(h, (hi + rise) * (1 + 1e-6));
  }
}

TEST_P(SizeFieldOfModel, is_nowhere_above_what_was_sampled_there) {
  const RasterArtifact raster = read_raster(staged_.raster.output);
  const SizeField& field = *field_;
  ASSERT_FALSE(raster.samples.empty());
  for (const LengthSample& s : raster.samples)
    ASSERT_LE(field.size(s.xyz), s.length * 1.02);  // a plane tells the parts of a cell
}

TEST(SizeFieldOfOldRaster, is_refused_where_samples_have_no_places) {
  test::StagedModel staged;
  staged.make_raster("box");
  RasterArtifact raster = read_raster(staged.raster.output);
  raster.samples.clear();
  write_raster(staged.raster.output, raster);
  try {
    run_prolong(staged.prolong);
    FAIL() << "taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kInput);
    EXPECT_NE(std::string(e.what()).find("left out the places of its samples; run st-raster again"), std::string::npos);
  }
}

}  // namespace
}  // namespace st
