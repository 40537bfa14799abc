// Tiles without the triangles about the cuts, and these on their own.
#include "meshing/face/seam_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/threads.h"
#include "unit/meshing/tiled_faces.h"

namespace st {
namespace {

using test::FaceCase;
using test::MeshView;
using test::Sections;

constexpr double kTile = 1000;

/// A square of so many tiles.
struct SquareInTiles {
  explicit SquareInTiles(double n_tiles, const char* shape = "square")
      : field(std::sqrt(kTrianglesPerWeight * test::make_model(shape).tables().face_area[0] / (n_tiles * kTile))),
        face(shape, field),
        cut(test::cut(face, field, kTile)),
        meshes(test::mesh_tiles(face, cut, field)) {}

  std::int32_t n_boundary() const { return static_cast<std::int32_t>(face.boundary.nodes.size()); }
  Sections sections(const FaceMeshOptions& options = {}) const {
    return test::mesh_sections(face, cut, field, meshes, options);
  }

  UniformField field;
  FaceCase face;
  TileCut cut;
  std::vector<FaceMesh> meshes;
};

using Corners = std::array<std::array<double, 2>, 3>;

/// Triangles by the places of their corners.
std::multiset<Corners> places_of(const FaceBoundary& boundary, const FaceMesh& mesh) {
  std::multiset<Corners> all;
  const auto n = static_cast<std::int32_t>(boundary.nodes.size());
  for (std::size_t t = 0; t < mesh.corners.size(); t += 3) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t c = mesh.corners[t + k];
      const Vec2 uv = c < n ? boundary.nodes[c].uv : mesh.inner[c - n].uv;
      corners[k] = {uv.x, uv.y};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.insert(corners);
  }
  return all;
}

class SeamMeshes : public testing::TestWithParam<int> {};

TEST_P(SeamMeshes, and_sections_are_the_triangles_of_all_tiles_when_nothing_is_enhanced) {
  const SquareInTiles square(GetParam());
  FaceMeshOptions options;
  options.enhance_rounds = 0;
  const FaceMesh joined = test::join(square.face, square.sections(options));
  EXPECT_EQ(joined.cause, FailureCause::kNone);
  std::multiset<Corners> tiles;
  for (std::size_t i = 0; i < square.cut.tiles.size(); ++i)
    tiles.merge(places_of(tile_boundary(square.face.boundary, square.cut, square.cut.tiles[i]), square.meshes[i]));
  EXPECT_TRUE(places_of(square.face.boundary, joined) == tiles);
  test::expect_valid(square.face.boundary, joined);
}

TEST_P(SeamMeshes, are_the_same_on_any_number_of_threads) {
  const SquareInTiles square(GetParam());
  FaceMesh mesh[2];
  for (int k = 0; k < 2; ++k) {
    set_thread_count(1 + 2 * k);
    mesh[k] = test::join(square.face, square.sections());
  }
  set_thread_count(1);
  test::expect_valid(square.face.boundary, mesh[0]);
  EXPECT_EQ(mesh[0].corners, mesh[1].corners);
  for (std::size_t i = 0; i < mesh[0].inner.size(); ++i) EXPECT_EQ(mesh[0].inner[i].uv, mesh[1].inner[i].uv);
}

TEST_P(SeamMeshes, leave_sections_whose_nodes_are_each_of_one_of_them) {
  const SquareInTiles square(GetParam());
  const Sections all = square.sections();
  std::size_t n_nodes = static_cast<std::size_t>(all.seams.n_own());
  for (const Piece& s : all.sections) {
    n_nodes += static_cast<std::size_t>(s.n_own());
    ASSERT_EQ(s.boundary.size(), s.number.size());
    for (std::size_t i = 0; i < s.number.size(); ++i)
      EXPECT_EQ(s.boundary[i].uv, square.face.boundary.nodes[s.number[i]].uv);
  }
  const auto expect_owned = [&](const std::vector<InnerNode>& owner, const FaceMesh& mesh, std::int32_t n_own) {
    for (std::size_t i = 0; i < owner.size(); ++i) {
      const Piece& s = all.sections.at(owner[i].section);
      EXPECT_LT(owner[i].number, s.n_own());
      EXPECT_EQ(s.mesh.inner.at(owner[i].number).uv, mesh.inner[n_own + i].uv);
    }
  };
  for (const Piece& s : all.sections) expect_owned(s.owner, s.mesh, s.n_own());
  expect_owned(all.seams.owner, all.seams.mesh, all.seams.n_own());
  EXPECT_EQ(n_nodes, test::join(square.face, all).inner.size());
}

INSTANTIATE_TEST_SUITE_P(Tiles, SeamMeshes, testing::Values(5, 30));

TEST(SeamMeshes, improve_cuts_between_many_tiles) {
  const SquareInTiles square(30);
  ASSERT_GE(square.cut.tiles.size(), 25u);
  const FaceMesh joined = test::join(square.face, square.sections());
  const FaceMesh whole = square.face.mesh(square.field);
  const MeshView a{square.face.boundary, whole}, b{square.face.boundary, joined};
  EXPECT_GT(b.mean_quality(), a.mean_quality() - 0.005);
  EXPECT_GT(b.qualities().front(), std::min(0.54, a.qualities().front() - 0.02));
}

TEST(SeamMeshes, say_of_the_first_tile_that_failed_why) {
  for (const double n_tiles : {5, 30}) {
    SquareInTiles square(n_tiles);
    square.meshes[1] = {};
    square.meshes[1].cause = FailureCause::kTooManyNodes;
    EXPECT_EQ(square.sections().seams.mesh.cause, FailureCause::kTooManyNodes);
  }
}

TEST(SeamMeshes, see_a_tile_that_is_missing) {
  for (const double n_tiles : {5, 30}) {
    SquareInTiles square(n_tiles);
    square.meshes.back() = {};
    EXPECT_NE(square.sections().seams.mesh.cause, FailureCause::kNone);
  }
}

TEST(SeamMeshes, see_an_edge_across_the_face_that_two_tiles_have) {
  SquareInTiles square(5);
  std::vector<Piece> bands;
  for (std::size_t t = 0; t < square.meshes.size(); ++t)
    bands.push_back(split_tile(square.face.boundary, square.cut, static_cast<std::int32_t>(t), square.meshes[t]).band);
  const SurfaceMaker none;
  const FaceMeshOptions options;
  const SeamMaker maker{*square.face.surface, none, square.face.boundary, square.cut, square.field, options};
  EXPECT_EQ(maker.run(bands).mesh.cause, FailureCause::kNone);
  const std::int32_t a = square.face.boundary.nodes[3].id, b = square.face.boundary.nodes[9].id;
  for (int i = 0; i < 4; ++i) bands[i % 2].sides.push_back({std::min(a, b), std::max(a, b)});
  EXPECT_EQ(maker.run(bands).mesh.cause, FailureCause::kNarrowPart);
}

TEST(SeamMeshes, carry_folds_of_tiles) {
  for (const double n_tiles : {5, 30}) {
    SquareInTiles square(n_tiles);
    square.meshes[2].n_folds = 7;
    EXPECT_EQ(square.sections().seams.mesh.n_folds, 7);
  }
}

}  // namespace
}  // namespace st
