// Faces in tiles are as good as whole ones.
#include "meshing/face/face_tiles.h"

#include <gtest/gtest.h>

#include "unit/meshing/tiled_faces.h"

namespace st {
namespace {

using test::FaceCase;
using test::MeshView;

constexpr double kTile = 1000;

TileCut cut(const FaceCase& face, const SizeField& field) { return test::cut(face, field, kTile); }

FaceMesh mesh_in_tiles(const FaceCase& face, const TileCut& cut, const SizeField& field) {
  return test::join(face, test::mesh_sections(face, cut, field, test::mesh_tiles(face, cut, field)));
}

/// Face `id` of a shape, with the length that gives about ten tiles.
struct TileCase {
  const char* shape;
  FaceId id = 0;
};

class FaceTiles : public testing::TestWithParam<TileCase> {};

TEST_P(FaceTiles, are_joined_to_a_mesh_as_good_as_that_of_the_whole_face) {
  const double area = test::make_model(GetParam().shape).tables().face_area[GetParam().id];
  const UniformField field(std::sqrt(kTrianglesPerWeight * area / (10 * kTile)));
  const FaceCase face(GetParam().shape, field, GetParam().id);
  const TileCut tiles = cut(face, field);
  ASSERT_GE(tiles.tiles.size(), 8u);
  const FaceMesh whole = face.mesh(field), joined = mesh_in_tiles(face, tiles, field);
  test::expect_valid(face.boundary, joined);
  const MeshView a{face.boundary, whole}, b{face.boundary, joined};
  EXPECT_NEAR(b.area(), a.area(), 2e-3 * a.area());
  EXPECT_GT(b.mean_quality(), a.mean_quality() - 0.003);
  EXPECT_GT(b.qualities().front(), std::min(0.54, a.qualities().front() - 0.02));
  EXPECT_GT(b.conformity(field), a.conformity(field) - 0.01);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FaceTiles,
                         testing::Values(TileCase{"square"}, TileCase{"annulus"}, TileCase{"plate_with_hole"},
                                         TileCase{"sphere"}, TileCase{"cone_side"}, TileCase{"torus"},
                                         TileCase{"cylinder"}, TileCase{"wave"}, TileCase{"stretched"},
                                         TileCase{"periodic_tube"}, TileCase{"closed_tube"}, TileCase{"disc"},
                                         TileCase{"sphere_octant"}, TileCase{"revolution"}),
                         [](const auto& tested) { return std::string(tested.param.shape); });

TEST(TileCut, gives_each_segment_of_the_loops_to_one_tile_and_each_cut_to_two_in_opposite_directions) {
  const UniformField field(0.15);
  const FaceCase face("plate_with_hole", field);
  const TileCut tiles = cut(face, field);
  ASSERT_GE(tiles.tiles.size(), 2u);
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  double expected = 0;
  for (const Tile& tile : tiles.tiles) {
    expected += tile.weight;
    EXPECT_GT(tile.weight, 0.4 * kTile);
    EXPECT_LT(tile.weight, 1.6 * kTile);
    for (const auto& [a, b] : tile.segments) ++uses[{a, b}];
  }
  EXPECT_NEAR(expected, kTrianglesPerWeight * face.area() / (0.15 * 0.15), 0.02 * expected);
  for (const auto& segment : face.boundary.segments) EXPECT_EQ(uses[segment], 1);
  const auto n_boundary = static_cast<std::int32_t>(face.boundary.nodes.size());
  std::set<std::pair<std::int32_t, std::int32_t>> loops(face.boundary.segments.begin(), face.boundary.segments.end());
  for (const auto& [side, n] : uses) {
    EXPECT_EQ(n, 1);
    if (loops.contains(side)) continue;
    EXPECT_TRUE(uses.contains({side.second, side.first}));
    EXPECT_LT(std::max(side.first, side.second) - n_boundary, static_cast<std::int32_t>(tiles.nodes.size()));
  }
}

TEST(TileCut, follows_sizes_that_grow_so_that_tiles_expect_alike) {
  const test::LinearField field({0, 0, 0}, 0.02, 0.05);
  const FaceCase face("square", field);
  const TileCut tiles = cut(face, field);
  ASSERT_GE(tiles.tiles.size(), 4u);
  for (const Tile& tile : tiles.tiles) EXPECT_LT(tile.weight, 2 * kTile);
  test::expect_valid(face.boundary, mesh_in_tiles(face, tiles, field));
}

TEST(TileCut, leaves_light_faces_and_stretched_ones_whole) {
  const UniformField coarse(0.6);
  EXPECT_TRUE(cut(FaceCase("square", coarse), coarse).tiles.empty());
  const test::StretchedField stretched({0.1, 0.4, {1, 0, 0}});
  EXPECT_TRUE(cut(FaceCase("square", stretched), stretched).tiles.empty());
}

/// Stretched around a place alone.
class SpotField : public UniformField {
 public:
  explicit SpotField(Vec3 spot) : UniformField(0.1), spot_(spot) {}
  bool is_stretched() const override { return true; }
  LocalSize local(Vec3 x, int&) const override {
    return distance(x, spot_) < 1 ? LocalSize{0.1, 0.4, {1, 0, 0}} : LocalSize{0.1, 0.1, {}};
  }

 private:
  Vec3 spot_;
};

TEST(TileCut, cuts_faces_that_are_not_stretched_themselves) {
  const SpotField inside({5, 5, 0}), at_edge({0, 5, 0}), elsewhere({5, 5, 30});
  const UniformField even(0.1);
  EXPECT_TRUE(cut(FaceCase("square", inside), inside).tiles.empty());
  EXPECT_TRUE(cut(FaceCase("square", at_edge), at_edge).tiles.empty());
  EXPECT_EQ(cut(FaceCase("square", elsewhere), elsewhere).tiles.size(),
            cut(FaceCase("square", even), even).tiles.size());
}

}  // namespace
}  // namespace st
