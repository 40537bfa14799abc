// One wing, its CAD cut into more and more faces: the cuts say nothing about the shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "sizing/octree_field.h"
#include "support/staged.h"

namespace st {
namespace {

struct Sizes {
  std::vector<double> length;  // at the same points for every model
  int n_faces = 0, n_triangles = 0;
};

class CadSplits : public testing::Test {
 protected:
  Sizes sizes_of(const std::string& shape) {
    staged_.make_sizing(shape);
    const nlohmann::json facts = staged_.make_patches();
    if (points_.empty()) choose_points(read_patches(staged_.mesh.output));
    return {lengths(read_sizing(staged_.prolong.output)), read_geometry(staged_.raster.geometry).tables.n_faces(),
            facts.at("triangles")};
  }

  /// 10,000 nodes of a mesh.
  void choose_points(const PatchesArtifact& patches) {
    for (const FacePatch& patch : patches.patches)
      points_.insert(points_.end(), patch.inner_xyz.begin(), patch.inner_xyz.end());
    std::shuffle(points_.begin(), points_.end(), std::mt19937_64(5));
    ASSERT_GE(points_.size(), 10'000u);
    points_.resize(10'000);
  }

  std::vector<double> lengths(const SizingArtifact& sizing) const {
    const std::unique_ptr<OctreeField> owned = sizing.field();
    const OctreeField& field = *owned;
    std::vector<double> result;
    for (const Vec3& x : points_) result.push_back(static_cast<const SizeField&>(field).size(x));
    return result;
  }

  std::vector<Vec3> points_;
  test::StagedModel staged_;
};

TEST_F(CadSplits, do_not_show_in_sizes_and_number_of_triangles) {
  const Sizes whole = sizes_of("wing_of_2");
  ASSERT_EQ(whole.n_faces, 4);
  for (const auto& [shape, n_faces] : {std::pair("wing_of_8", 10), std::pair("wing_of_200", 202)}) {
    const Sizes cut = sizes_of(shape);
    ASSERT_EQ(cut.n_faces, n_faces);
    std::vector<double> difference;
    for (std::size_t i = 0; i < cut.length.size(); ++i)
      difference.push_back(std::abs(cut.length[i] / whole.length[i] - 1));
    std::sort(difference.begin(), difference.end());
    EXPECT_LE(difference[difference.size() * 9 / 10], 0.15) << shape;
    EXPECT_NEAR(static_cast<double>(cut.n_triangles) / whole.n_triangles, 1, 0.1) << shape;  // if cuts counted: 1.79
  }
}

}  // namespace
}  // namespace st
