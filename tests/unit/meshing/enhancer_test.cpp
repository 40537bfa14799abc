// The enhancer alone: known bad places, and what must never become worse.
#include <gtest/gtest.h>

#include <random>

#include "unit/meshing/face_work.h"

namespace st::test {
namespace {

constexpr int kRounds = 5;

double worst_quality(const Prepared& p) { return MeshView{p.boundary, p.mesh()}.qualities().front(); }

/// A hexagon of side n with nodes on the triangular lattice of spacing 1: all triangles are equilateral.
struct Lattice {
  UniformField field{1};
  FaceBoundary boundary;
  std::vector<Vec2> inner;
  std::optional<Prepared> made;

  static Vec2 at(int i, int j) { return {5 + i + 0.5 * j, 5 + 0.5 * std::sqrt(3.0) * j}; }

  explicit Lattice(int n = 4) {
    std::vector<Vec2> loop;
    const int step[6][2] = {{-1, 1}, {-1, 0}, {0, -1}, {1, -1}, {1, 0}, {0, 1}};
    int i = n, j = 0;
    for (const auto& s : step)
      for (int k = 0; k < n; ++k, i += s[0], j += s[1]) loop.push_back(at(i, j));
    boundary = polygons({loop}, 1);
    for (int a = -n + 1; a < n; ++a)
      for (int b = -n + 1; b < n; ++b)
        if (std::abs(a + b) < n) inner.push_back(at(a, b));
  }
  Prepared& make() {
    made.emplace(kPlane, boundary, field);
    for (const Vec2 uv : inner) EXPECT_NE(made->insert(uv), kNone);
    return *made;
  }
};

TEST(Enhancer, leaves_equilateral_triangles_as_they_are) {
  Lattice lattice;
  Prepared& p = lattice.make();
  const auto nodes = p.work.mesh.nodes;
  const FaceMesh before = p.mesh();
  ASSERT_GT(worst_quality(p), 0.999);
  enhance(p.work, kRounds);
  EXPECT_EQ(p.mesh().corners, before.corners);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_TRUE(p.work.mesh.nodes[i].x == nodes[i].x);
}

TEST(Enhancer, removes_a_needle) {
  Lattice lattice;
  const auto n = static_cast<int>(lattice.inner.size());
  lattice.inner.push_back(Lattice::at(0, 0) + Vec2{0.02, 0.01});
  Prepared& p = lattice.make();
  ASSERT_LT(worst_quality(p), 0.1);
  const BoundaryWatch watch(p);
  enhance(p.work, kRounds);
  EXPECT_EQ(p.n_inner(), n) << "two nodes at one place become one";
  EXPECT_GT(worst_quality(p), 0.95);
  watch.expect_unchanged();
  expect_valid(lattice.boundary, p.mesh());
}

TEST(Enhancer, removes_a_cap) {
  // a node just inside the middle of a boundary segment: no swap helps
  Lattice lattice;
  const auto n = static_cast<int>(lattice.inner.size());
  lattice.inner.push_back(0.5 * (Lattice::at(1, -4) + Lattice::at(2, -4)) + Vec2{0, 0.03});
  Prepared& p = lattice.make();
  ASSERT_LT(worst_quality(p), 0.2);
  const BoundaryWatch watch(p);
  enhance(p.work, kRounds);
  EXPECT_EQ(p.n_inner(), n);
  EXPECT_GT(worst_quality(p), 0.9);
  watch.expect_unchanged();
  expect_valid(lattice.boundary, p.mesh());
}

void swap_an_edge_of(Triangulation& m, std::int32_t node) {
  for (std::size_t i = 0; i < m.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const PlaneTriangle& t = m.triangles[i];
      if (!Prepared::is_inside(t) || t.v[k] != node || !m.can_swap(static_cast<std::int32_t>(i), k)) continue;
      m.swap(static_cast<std::int32_t>(i), k);
      return;
    }
}

TEST(Enhancer, leaves_no_node_of_three_triangles) {
  Lattice lattice;
  Prepared& p = lattice.make();
  const std::int32_t middle = p.insert((1.0 / 3) * (Lattice::at(0, 0) + Lattice::at(1, 0) + Lattice::at(0, 1)));
  for (int swaps = 0; p.valence(middle) > 3 && swaps < 10; ++swaps) swap_an_edge_of(p.work.mesh, middle);
  ASSERT_EQ(p.valence(middle), 3);
  ASSERT_LT(worst_quality(p), 0.65);
  enhance(p.work, kRounds);
  for (std::int32_t i = p.first_inner(); i < static_cast<std::int32_t>(p.work.mesh.nodes.size()); ++i) {
    EXPECT_TRUE(!p.is_there(i) || p.valence(i) >= 5) << i;
  }
  EXPECT_GT(worst_quality(p), 0.9);
}

TEST(Enhancer, thins_out_a_node_of_ten_triangles_that_are_too_small) {
  const UniformField field(1);
  std::vector<Vec2> loop;
  for (int i = 0; i < 12; ++i) loop.push_back(Vec2{5, 5} + 1.6 * Vec2{std::cos(kPi * i / 6), std::sin(kPi * i / 6)});
  const FaceBoundary b = polygons({loop}, 1);
  Prepared p(kPlane, b, field);
  const std::int32_t centre = p.insert({5, 5});
  for (int i = 0; i < 10; ++i)
    ASSERT_NE(p.insert(Vec2{5, 5} + 0.6 * Vec2{std::cos(kPi * i / 5), std::sin(kPi * i / 5)}), kNone);
  ASSERT_EQ(p.valence(centre), 10);
  enhance(p.work, kRounds);
  EXPECT_LE(p.n_inner(), 7) << "of eleven";
  for (std::int32_t i = p.first_inner(); i < static_cast<std::int32_t>(p.work.mesh.nodes.size()); ++i) {
    EXPECT_LE(p.valence(i), 8) << i;
  }
  EXPECT_GT(worst_quality(p), 0.6);
  expect_valid(b, p.mesh());
}

std::vector<Vec2> random_nodes(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(0.5, 9.5);
  std::vector<Vec2> nodes;
  for (int i = 0; i < n; ++i) {
    const double u = at(random), v = at(random);
    nodes.push_back({u, v});
  }
  return nodes;
}

constexpr double kCollapseFloor = 0.35;  // a collapse may leave triangles as bad as this, no worse

TEST(Enhancer, never_makes_the_worst_triangle_worse) {
  std::vector<Vec2> loop;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < 10; ++i) {
      const Vec2 corner[4] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
      loop.push_back(corner[side] + (0.1 * i) * (corner[(side + 1) % 4] - corner[side]));
    }
  const FaceBoundary b = polygons({loop}, 1);
  const UniformField field(1);
  double mean_before = 0, mean_after = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const int rounds : {0, 1, kRounds}) {
      Prepared p(kPlane, b, field);
      for (const Vec2 uv : random_nodes(130, seed)) p.insert(uv);
      const BoundaryWatch watch(p);
      const double before = worst_quality(p);
      mean_before += MeshView{b, p.mesh()}.mean_quality();
      enhance(p.work, rounds);
      EXPECT_GE(worst_quality(p), std::min(before, kCollapseFloor) - 1e-6)
          << "seed " << seed << ", " << rounds << " rounds";
      mean_after += MeshView{b, p.mesh()}.mean_quality();
      watch.expect_unchanged();
      expect_valid(b, p.mesh());
      EXPECT_NEAR((MeshView{b, p.mesh()}.area()), 100, 1e-9);
    }
  }
  EXPECT_GT(mean_after, mean_before + 0.1 * 60) << "over 60 runs";
}

TEST(Enhancer, moves_a_node_only_where_its_triangles_stay_fair) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  const UniformField field(0.8);
  int n_moved = 0;
  for (int i = 0; i < 300; ++i) {
    const int n = 5 + i % 3;
    std::vector<Vec2> loop;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * kPi * (k + 0.4 * share(random)) / n, radius = 1 + 1.5 * share(random);
      loop.push_back(Vec2{5, 5} + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    const FaceBoundary b = polygons({loop}, 0.8);
    Prepared p(kPlane, b, field);
    const double u = 4.5 + share(random), v = 4.5 + share(random);
    const std::int32_t node = p.insert({u, v});
    if (node == kNone || p.valence(node) != n) continue;
    const double before = worst_quality(p);
    enhance(p.work, kRounds);
    EXPECT_GE(worst_quality(p), std::min(before, p.is_there(node) ? 0.6 : kCollapseFloor) - 1e-6) << i;
    n_moved += p.is_there(node) && distance(p.work.mesh.nodes[node].x, {u, v, 0}) > 1e-3;
  }
  EXPECT_GT(n_moved, 50);
}

TEST(Enhancer, repairs_random_nodes) {
  std::vector<double> worst;
  int n_nodes = 0, n_irregular = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Lattice lattice;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.45, 0.45);
    for (Vec2& uv : lattice.inner) {
      const double du = shift(random), dv = shift(random);
      uv = uv + Vec2{du, dv};
    }
    Prepared& p = lattice.make();
    enhance(p.work, kRounds);
    worst.push_back(worst_quality(p));
    for (std::int32_t i = p.first_inner(); i < static_cast<std::int32_t>(p.work.mesh.nodes.size()); ++i)
      if (p.is_there(i)) ++n_nodes, n_irregular += p.valence(i) != 6;
  }
  EXPECT_LT(n_irregular, 0.35 * n_nodes);
  EXPECT_GT(*std::min_element(worst.begin(), worst.end()), 0.5);
}

TEST(Enhancer, moves_no_node_in_no_rounds) {
  Lattice lattice;
  for (std::size_t i = 0; i < lattice.inner.size(); ++i)
    lattice.inner[i] = lattice.inner[i] + Vec2{0.3 * (i % 3), 0.2 * (i % 2)};
  Prepared& p = lattice.make();
  const auto nodes = p.work.mesh.nodes;
  const int n = p.n_inner();
  enhance(p.work, 0);
  EXPECT_EQ(p.n_inner(), n);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_TRUE(p.work.mesh.nodes[i].x == nodes[i].x);
}

TEST(Enhancer, does_not_collapse_the_ring_of_a_narrow_part) {
  for (const bool is_kept : {false, true}) {
    Lattice lattice;
    Prepared& p = lattice.make();
    const std::int32_t extra = p.insert(Lattice::at(0, 0) + Vec2{0.3, 0.2});
    for (MeshNode& n : p.work.mesh.nodes) n.is_kept = is_kept;
    const int n = p.n_inner();
    ASSERT_TRUE(p.is_there(extra));
    enhance(p.work, kRounds);
    EXPECT_EQ(p.n_inner(), is_kept ? n : n - 1);
  }
}

class EnhancerOnFace : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(EnhancerOnFace, folds_nothing_and_joins_no_twins_of_a_seam) {
  const auto [shape, length] = GetParam();
  const UniformField field(length);
  const FaceCase face(shape, field);
  Prepared p(*face.surface, face.boundary, field);
  advance_front(p.work);
  const MeshView before{face.boundary, p.mesh()};
  const double mean_before = before.mean_quality(), worst_before = before.qualities().front();
  const std::int64_t euler = before.euler();
  const BoundaryWatch watch(p);
  enhance(p.work, kRounds);
  watch.expect_unchanged();
  const FaceMesh mesh = p.mesh();
  expect_valid(face.boundary, mesh);
  const MeshView after{face.boundary, mesh};
  EXPECT_EQ(after.euler(), euler);
  EXPECT_GT(after.mean_quality(), mean_before);
  EXPECT_GE(after.qualities().front(), std::min(worst_before, kCollapseFloor) - 1e-6);
  EXPECT_GT(p.worst_cosine(), 0) << "no triangle against the surface";
  for (const auto& n : mesh.inner)
    EXPECT_LE(distance(n.x, face.surface->point(n.uv)), 1e-9) << "smoothed nodes stay on the surface";
}

INSTANTIATE_TEST_SUITE_P(, EnhancerOnFace,
                         testing::Values(std::pair{"sphere", 1.5}, std::pair{"torus", 2.0}, std::pair{"cone_side", 1.2},
                                         std::pair{"periodic_tube", 1.5}, std::pair{"wave", 1.0},
                                         std::pair{"stretched", 0.6}, std::pair{"annulus", 1.0},
                                         std::pair{"sphere", 5.0}, std::pair{"periodic_tube", 4.0},
                                         std::pair{"cone_side", 4.0}),
                         [](const auto& info) {
                           return info.param.first + std::string("_") + std::to_string(info.index);
                         });

}  // namespace
}  // namespace st::test
