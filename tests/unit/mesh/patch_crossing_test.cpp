#include "mesh/patch_crossing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/threads.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

/// A mesh with its triangles by face, one shell unless said otherwise.
struct Patches {
  explicit Patches(SurfaceMesh m, std::vector<std::int32_t> shell = {})
      : mesh(std::move(m)), face_shell(std::move(shell)) {
    if (face_shell.empty()) face_shell.assign(mesh.labels.face_name.size(), 0);
    for (FaceId f = 0; f <= static_cast<FaceId>(face_shell.size()); ++f)
      face_begin.push_back(static_cast<std::int32_t>(
          std::lower_bound(mesh.triangle_face.begin(), mesh.triangle_face.end(), f) - mesh.triangle_face.begin()));
  }
  std::vector<TrianglePair> find(std::span<const char> dirty = {}) const {
    return find_crossing_patches({mesh.node_xyz, mesh.triangles, face_begin, face_shell, dirty});
  }
  std::vector<TrianglePair> find_all() const { return find_crossing_triangles(mesh.node_xyz, mesh.triangles); }

  SurfaceMesh mesh;
  std::vector<std::int32_t> face_shell;
  std::vector<std::int32_t> face_begin;
};

bool same(const std::vector<TrianglePair>& x, const std::vector<TrianglePair>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const TrianglePair& p, const TrianglePair& q) {
    return p.a == q.a && p.b == q.b && p.n_shared == q.n_shared;
  });
}

/// Height field z(x, y) over the unit square, n x n quads, one face.
template <class Height>
SurfaceMesh sheet(int n, const Height& height) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) points.push_back({double(i) / n, double(j) / n, height(double(i) / n, double(j) / n)});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const NodeId a = i * (n + 1) + j, b = a + n + 1;
      triangles.push_back({{a, b, b + 1}});
      triangles.push_back({{a, b + 1, a + 1}});
    }
  return shapes::from(points, triangles);
}

double flat(double, double) { return 0; }

TEST(PatchCrossing, finds_nothing_in_clean_closed_meshes) {
  for (const SurfaceMesh& m : {shapes::cube(20), shapes::sphere(20, {3, 1, 2}), shapes::torus(60, 24)})
    EXPECT_TRUE(Patches(m).find().empty());
}

TEST(PatchCrossing, finds_what_the_full_test_finds_between_faces) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> shift(0.1, 0.9);
  for (int i = 0; i < 20; ++i) {
    const Patches p(shapes::join(shapes::cube(9), shapes::cube(7, {shift(random), shift(random), shift(random)})));
    const auto expected = p.find_all();
    ASSERT_FALSE(expected.empty());
    EXPECT_TRUE(same(p.find(), expected));
  }
}

TEST(PatchCrossing, finds_what_the_full_test_finds_in_a_soup_of_triangles) {
  std::mt19937_64 random(11);
  for (const int n_faces : {1, 5}) {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<FaceId> faces;
    for (int i = 0; i < 400; ++i) points.push_back({double(random() % 9), double(random() % 9), double(random() % 9)});
    for (int i = 0; i < 500; ++i) {
      const auto n = [&] { return static_cast<NodeId>(random() % points.size()); };
      triangles.push_back({{n(), n(), n()}});
      faces.push_back(static_cast<FaceId>(i * n_faces / 500));
    }
    const Patches p(shapes::from(points, triangles, faces));
    const auto is_between_faces = [&](const TrianglePair& q) {
      return p.mesh.triangle_face[q.a] != p.mesh.triangle_face[q.b];
    };
    const auto expected = p.find_all(), found = p.find();
    EXPECT_GT(expected.size(), 1000u);
    EXPECT_TRUE(std::includes(
        expected.begin(), expected.end(), found.begin(), found.end(),
        [](const TrianglePair& x, const TrianglePair& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); }))
        << "a pair that does not cross";
    EXPECT_EQ(std::count_if(found.begin(), found.end(), is_between_faces),
              std::count_if(expected.begin(), expected.end(), is_between_faces));
    EXPECT_GT(10 * found.size(), 9 * expected.size()) << "a part of a face with similar normals is rare in a soup";
  }
}

TEST(PatchCrossing, finds_every_folded_triangle_in_a_large_smooth_face) {
  SurfaceMesh m = sheet(60, flat);
  m.node_xyz[30 * 61 + 30] += {2.5 / 60, 0.3 / 60, 0};  // beyond the nodes beside it
  const Patches p(m);
  const auto found = p.find();
  int n_folded = 0;
  for (TriangleId t = 0; t < m.n_triangles(); ++t) {
    const auto node = [&](int k) { return m.node_xyz[m.triangles[t].n[k]]; };
    if (cross(node(1) - node(0), node(2) - node(0)).z >= 0) continue;
    ++n_folded;
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const TrianglePair& q) { return q.a == t || q.b == t; }))
        << t;
  }
  EXPECT_GT(n_folded, 0);
}

/// One face along the loop of a trochoid: it crosses itself.
SurfaceMesh ribbon(int n) {
  SurfaceMesh m = sheet(n, flat);
  for (Vec3& p : m.node_xyz) {
    const double angle = 5.2 * (p.x - 0.5);
    p = {angle - 2 * std::sin(angle), p.y, 1 - 2 * std::cos(angle)};
  }
  return m;
}

TEST(PatchCrossing, finds_a_face_that_turns_back_through_itself) {
  const Patches p(ribbon(40));
  const auto expected = p.find_all();
  ASSERT_FALSE(expected.empty());
  EXPECT_TRUE(same(p.find(), expected));
}

TEST(PatchCrossing, finds_the_same_in_faces_that_are_tested_in_parts) {
  const SurfaceMesh flat_one = sheet(110, flat);  // 24,200 triangles
  const auto dip = [](double x, double y) { return 0.05 - 0.1 * x * y; };
  for (const SurfaceMesh& m : {ribbon(110), shapes::join(flat_one, sheet(20, dip)),
                               shapes::join(sheet(20, dip), flat_one), shapes::join(flat_one, sheet(107, dip))}) {
    const Patches p(m);
    const auto expected = p.find_all();
    ASSERT_FALSE(expected.empty());
    EXPECT_TRUE(same(p.find(), expected));
  }
}

TEST(PatchCrossing, finds_sheets_of_the_same_direction_that_dip_into_each_other) {
  SurfaceMesh m = shapes::join(sheet(30, flat), sheet(23, [](double x, double y) { return 0.05 - 0.1 * x * y; }));
  const Patches p(m);
  const auto expected = p.find_all();
  ASSERT_FALSE(expected.empty());
  EXPECT_TRUE(same(p.find(), expected));
}

TEST(PatchCrossing, finds_neighbours_folded_flat_onto_each_other) {
  const Patches p(shapes::from({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}}, {{{0, 1, 2}}, {{1, 0, 3}}}, {0, 1}));
  const auto found = p.find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].n_shared, 2);
}

TEST(PatchCrossing, leaves_different_shells_alone_but_not_loose_faces) {
  const SurfaceMesh m = shapes::join(shapes::cube(4), shapes::cube(4, {0.55, 0.55, 0.55}));
  std::vector<std::int32_t> shell(12, 0);
  std::fill(shell.begin() + 6, shell.end(), 1);
  EXPECT_TRUE(Patches(m, shell).find().empty());
  EXPECT_FALSE(Patches(m, std::vector<std::int32_t>(12, kNone)).find().empty());
}

TEST(PatchCrossing, with_a_mask_lists_exactly_the_pairs_with_a_dirty_face) {
  const Patches p(shapes::join(shapes::join(shapes::cube(6), shapes::cube(5, {0.55, 0.5, 0.45})),
                               shapes::sphere(6, {1, 1, 0}, 0.6)));
  const auto all = p.find();
  for (FaceId dirty = 0; dirty < static_cast<FaceId>(p.face_shell.size()); ++dirty) {
    std::vector<char> mask(p.face_shell.size(), 0);
    mask[dirty] = 1;
    std::vector<TrianglePair> expected;
    for (const TrianglePair& q : all)
      if (p.mesh.triangle_face[q.a] == dirty || p.mesh.triangle_face[q.b] == dirty) expected.push_back(q);
    EXPECT_TRUE(same(p.find(mask), expected)) << dirty;
  }
  EXPECT_TRUE(p.find(std::vector<char>(p.face_shell.size(), 0)).empty());
}

TEST(PatchCrossing, ignores_triangles_without_area_and_faces_without_triangles) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0.5, -1, 1}, {0.5, 1, -1}, {0.5, 1, 1}, {0, 3, 0}};
  const std::vector<Triangle> triangles{{{0, 1, 2}}, {{1, 1, 6}}, {{3, 4, 5}}};
  EXPECT_TRUE(Patches(shapes::from(points, triangles, {0, 0, 2})).find().empty());
  const std::vector<std::int32_t> no_face{0};
  EXPECT_TRUE(find_crossing_patches({{}, {}, no_face, {}}).empty());
}

TEST(PatchCrossing, finds_the_same_with_several_threads) {
  SurfaceMesh m = shapes::torus(90, 40);
  for (TriangleId t = 0; t < static_cast<TriangleId>(m.triangles.size()); ++t) m.triangle_face[t] = t / 60;
  m.labels.face_name.assign(m.triangle_face.back() + 1, "");
  for (std::size_t n = 0; n < m.node_xyz.size(); n += 7) m.node_xyz[n] += Vec3{0.3, -0.2, 0.4};
  const Patches patches(m);
  const std::vector<TrianglePair> one = patches.find();
  EXPECT_GT(one.size(), 100u);
  for (int run = 0; run < 20; ++run) {
    set_thread_count(2 + run % 7);
    const std::vector<TrianglePair> several = patches.find();
    set_thread_count(1);
    ASSERT_TRUE(same(one, several)) << run;
  }
}

TEST(PatchCrossing, survives_many_triangles_in_the_same_place) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i < 50; ++i) {
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) points.push_back(p);
    triangles.push_back({{3 * i, 3 * i + 1 + i % 2, 3 * i + 2 - i % 2}});  // every other one turned over
  }
  EXPECT_EQ(Patches(shapes::from(points, triangles)).find().size(), 50u * 49 / 2);
}

TEST(PatchCrossing, finds_faces_whose_boxes_only_touch) {
  // face 0 ends in a corner at x = 1, which lies on face 1, all of which lies at x = 1
  const Patches p(shapes::from({{-9, 0, 0}, {1, 0.3, 0}, {-9, 0.2, 0.1}, {1, 0, -1}, {1, 1, -1}, {1, 0.3, 1}},
                               {{{0, 1, 2}}, {{3, 4, 5}}}, {0, 1}));
  EXPECT_EQ(p.find_all().size(), 1u);
  EXPECT_TRUE(same(p.find(), p.find_all()));
}

}  // namespace
}  // namespace st
