#include "meshing/face/tile_seams.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

#include "base/threads.h"
#include "unit/meshing/faces.h"

namespace st {
namespace {

using test::FaceCase;
using test::MeshView;

constexpr double kLength = 0.25, kNear = 0.15;  // of nodes that count as those of a cut, from x = 5

/// The mesh of a square whose first inner nodes are those near x = 5; how many these are.
std::pair<FaceMesh, std::int32_t> with_cut(const FaceCase& face, const SizeField& field) {
  FaceMesh mesh = face.mesh(field);
  const auto n_boundary = static_cast<std::int32_t>(face.boundary.nodes.size());
  std::vector<std::int32_t> order(mesh.inner.size());
  std::iota(order.begin(), order.end(), 0);
  const auto is_near = [&](std::int32_t i) { return std::abs(mesh.inner[i].x.x - 5) < kNear; };
  const auto end = std::stable_partition(order.begin(), order.end(), is_near);
  std::vector<std::int32_t> place(order.size());
  FaceMesh sorted = mesh;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.inner[i] = mesh.inner[order[i]];
    place[order[i]] = static_cast<std::int32_t>(i);
  }
  for (std::int32_t& c : sorted.corners)
    if (c >= n_boundary) c = n_boundary + place[c - n_boundary];
  return {sorted, static_cast<std::int32_t>(end - order.begin())};
}

std::vector<std::int32_t> one_piece(std::int32_t n_cut) { return std::vector<std::int32_t>(n_cut, 0); }

/// With nodes of the cut moved along it.
FaceMesh unevenly(const FaceCase& face, FaceMesh mesh, std::int32_t n_cut) {
  for (std::int32_t i = 0; i < n_cut; ++i) {
    FaceNode& n = mesh.inner[i];
    n.uv.y += (i % 2 ? 0.3 : -0.3) * kLength;
    n.x = face.surface->point(n.uv);
  }
  return mesh;
}

TEST(TileSeams, smooth_pieces_and_the_places_where_they_meet_the_same_on_all_threads) {
  const UniformField field(kLength);
  const FaceCase face("square", field);
  const auto [even, n_cut] = with_cut(face, field);
  std::vector<std::int32_t> pieces;  // one half and the other
  for (std::int32_t i = 0; i < n_cut; ++i) pieces.push_back(even.inner[i].uv.y < 5 ? 0 : 1);
  const FaceMesh uneven = unevenly(face, even, n_cut);
  FaceMesh whole = uneven, mesh[2] = {uneven, uneven};
  improve_seams(*face.surface, {}, face.boundary, field, {}, one_piece(n_cut), whole);
  for (int k = 0; k < 2; ++k) {
    set_thread_count(1 + 2 * k);
    improve_seams(*face.surface, {}, face.boundary, field, {}, pieces, mesh[k]);
  }
  set_thread_count(1);
  test::expect_valid(face.boundary, mesh[0]);
  EXPECT_EQ(mesh[0].corners, mesh[1].corners);
  for (std::size_t i = 0; i < mesh[0].inner.size(); ++i) EXPECT_EQ(mesh[0].inner[i].uv, mesh[1].inner[i].uv);
  const MeshView one{face.boundary, whole}, two{face.boundary, mesh[0]};
  EXPECT_NEAR(two.qualities().front(), one.qualities().front(), 0.1);
  EXPECT_NEAR(two.mean_quality(), one.mean_quality(), 0.005);
}

TEST(TileSeams, take_a_surface_of_its_own_for_each_piece) {
  const UniformField field(kLength);
  const FaceCase face("square", field);
  auto [mesh, n_cut] = with_cut(face, field);
  std::vector<std::int32_t> pieces;
  for (std::int32_t i = 0; i < n_cut; ++i) pieces.push_back(mesh.inner[i].uv.y < 5 ? 0 : 1);
  std::atomic<int> n_made = 0;
  const auto make_surface = [&] {
    ++n_made;
    return face.model.surface(face.id);
  };
  improve_seams(*face.surface, make_surface, face.boundary, field, {}, pieces, mesh);
  EXPECT_EQ(n_made, 3) << "both halves, and where they meet";
}

TEST(TileSeams, smooth_what_is_uneven_at_a_cut_and_leave_the_rest_alone) {
  const UniformField field(kLength);
  const FaceCase face("square", field);
  auto [mesh, n_cut] = with_cut(face, field);
  ASSERT_GT(n_cut, 20);
  for (std::int32_t i = 0; i < n_cut; ++i) {
    FaceNode& n = mesh.inner[i];
    n.uv.y += (i % 2 ? 0.3 : -0.3) * kLength;
    n.x = face.surface->point(n.uv);
  }
  const FaceMesh uneven = mesh;
  mesh.n_folds = 0;
  improve_seams(*face.surface, {}, face.boundary, field, {}, one_piece(n_cut), mesh);
  test::expect_valid(face.boundary, mesh);
  const MeshView before{face.boundary, uneven}, after{face.boundary, mesh};
  EXPECT_GT(after.qualities().front(), before.qualities().front() + 0.1);
  EXPECT_GT(after.mean_quality(), before.mean_quality());
  std::set<std::pair<double, double>> places;
  for (const FaceNode& n : mesh.inner) places.insert({n.x.x, n.x.y});
  for (const FaceNode& n : uneven.inner)
    if (std::abs(n.x.x - 5) > 6 * kLength) {
      EXPECT_TRUE(places.contains({n.x.x, n.x.y})) << n.x.x << ' ' << n.x.y;
    }
}

TEST(TileSeams, count_the_folds_of_the_band_alone) {
  const UniformField field(kLength);
  const FaceCase face("square", field);
  auto [mesh, n_cut] = with_cut(face, field);
  FaceMesh far = mesh;
  for (FaceNode& n : far.inner)
    if (std::abs(n.x.x - 1) < 0.1 && std::abs(n.x.y - 5) < 0.3) n.x.x = n.uv.x = 4 * kLength + 1;
  improve_seams(*face.surface, {}, face.boundary, field, {}, one_piece(n_cut), far);
  EXPECT_EQ(far.n_folds, 0);
}

TEST(TileSeams, count_folds_that_stay_in_the_band) {
  const UniformField field(kLength);
  const FaceCase face("square", field);
  auto [mesh, n_cut] = with_cut(face, field);
  mesh.inner[n_cut / 2].x.x = mesh.inner[n_cut / 2].uv.x = 5 + 3 * kLength;
  FaceMeshOptions options;
  options.enhance_rounds = 0;
  improve_seams(*face.surface, {}, face.boundary, field, options, one_piece(n_cut), mesh);
  EXPECT_GT(mesh.n_folds, 0);
}

TEST(TileSeams, keep_an_edge_that_lies_inside_the_face) {
  const UniformField field(0.5);
  std::vector<Vec2> rim, slit;
  for (int i = 0; i < 20; ++i) rim.push_back({0.5 * i, 0});
  for (int i = 0; i < 20; ++i) rim.push_back({10, 0.5 * i});
  for (int i = 20; i > 0; --i) rim.push_back({0.5 * i, 10});
  for (int i = 20; i > 0; --i) rim.push_back({0, 0.5 * i});
  for (int i = 0; i <= 8; ++i) slit.push_back({3 + 0.5 * i, 5});
  for (int i = 7; i > 0; --i) slit.push_back(slit[i]);
  FaceBoundary boundary = test::polygons({rim, slit}, 0.5);
  for (int i = 9; i < 16; ++i) boundary.nodes[rim.size() + i].id = boundary.nodes[rim.size() + 16 - i].id;
  FaceMesh mesh = mesh_face(test::kPlane, boundary, field, {});
  test::expect_valid(boundary, mesh);
  for (FaceNode& n : mesh.inner)  // the slit would be swapped away
    if (std::abs(n.x.y - 5) < 0.7 && std::abs(n.x.x - 5) < 1.7) n.x.x = n.uv.x += 0.2;
  improve_seams(test::kPlane, {}, boundary, field, {}, one_piece(static_cast<std::int32_t>(mesh.inner.size())), mesh);
  test::expect_valid(boundary, mesh);
}

}  // namespace
}  // namespace st
