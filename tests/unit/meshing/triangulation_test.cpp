#include "meshing/face/triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "base/predicates.h"

namespace st {
namespace {

using Segments = std::vector<std::pair<std::int32_t, std::int32_t>>;

Triangulation with_nodes(const std::vector<Vec2>& points) {
  Triangulation m;
  for (Vec2 p : points) {
    MeshNode n;
    n.p = p;
    m.nodes.push_back(n);
  }
  return m;
}

Segments ring(std::int32_t first, std::int32_t n) {
  Segments s;
  for (std::int32_t i = 0; i < n; ++i) s.push_back({first + i, first + (i + 1) % n});
  return s;
}

Segments joined(Segments a, const Segments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Vec2> random_points(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(0, 1);
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) {
    const double a = x(random), b = x(random);
    points.push_back({a, b});
  }
  return points;
}

double area(const Triangulation& m, const PlaneTriangle& t) {
  const Vec2 a = m.nodes[t.v[0]].p;
  return 0.5 * cross(m.nodes[t.v[1]].p - a, m.nodes[t.v[2]].p - a);
}

double inside_area(const Triangulation& m) {
  double sum = 0;
  for (const PlaneTriangle& t : m.triangles)
    if (t.state != kOutside && t.state != kDead) sum += area(m, t);
  return sum;
}

/// Counter-clockwise triangles that fill the box, neighbours that know each other, edges marked from both sides, a
/// triangle at every node.
void expect_valid(const Triangulation& m) {
  double sum = 0;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const PlaneTriangle& t = m.triangles[i];
    if (t.state == kDead) continue;
    ASSERT_GT(orient2d(m.nodes[t.v[0]].p, m.nodes[t.v[1]].p, m.nodes[t.v[2]].p), 0) << "triangle " << i;
    sum += area(m, t);
    for (int k = 0; k < 3; ++k) {
      if (t.n[k] == kNone) continue;
      const PlaneTriangle& o = m.triangles[t.n[k]];
      ASSERT_NE(o.state, kDead);
      int j = 0;
      while (j < 3 && !(o.v[j] == t.v[(k + 1) % 3] && o.v[(j + 1) % 3] == t.v[k])) ++j;
      ASSERT_LT(j, 3) << "triangle " << i << " edge " << k;
      ASSERT_EQ(o.n[j], static_cast<std::int32_t>(i));
      ASSERT_EQ(o.constrained >> j & 1, t.constrained >> k & 1);
      ASSERT_EQ(o.toggles >> j & 1, t.toggles >> k & 1);
    }
  }
  const Vec2 box = m.nodes[m.n_boundary + 2].p - m.nodes[m.n_boundary].p;
  ASSERT_NEAR(sum, box.x * box.y, 1e-10 * box.x * box.y);
  for (std::size_t i = 0; i < m.nodes.size(); ++i) {
    const std::int32_t t = m.triangle_at(static_cast<std::int32_t>(i));
    if (t == kNone) continue;
    ASSERT_NE(m.triangles[t].state, kDead);
    ASSERT_EQ(m.triangles[t].v[m.index_of(t, static_cast<std::int32_t>(i))], static_cast<std::int32_t>(i));
  }
}

bool has_edge(const Triangulation& m, std::int32_t a, std::int32_t b, bool constrained) {
  for (const PlaneTriangle& t : m.triangles)
    for (int k = 0; k < 3; ++k)
      if (t.state != kDead && t.v[k] == a && t.v[(k + 1) % 3] == b) return !constrained || (t.constrained >> k & 1);
  return false;
}

const std::vector<Vec2> kSquareWithHole{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 2}, {3, 2}, {3, 1}};

TEST(Triangulation, fills_a_polygon_with_a_hole) {
  Triangulation m = with_nodes(kSquareWithHole);
  EXPECT_TRUE(m.build(joined(ring(0, 4), ring(4, 4))).empty());
  expect_valid(m);
  EXPECT_NEAR(inside_area(m), 14, 1e-12);
  for (const auto& [a, b] : joined(ring(0, 4), ring(4, 4))) EXPECT_TRUE(has_edge(m, a, b, true));
}

TEST(Triangulation, inside_does_not_depend_on_the_direction_of_the_segments) {
  Triangulation m = with_nodes(kSquareWithHole);
  Segments s = joined(ring(0, 4), ring(4, 4));
  for (auto& [a, b] : s) std::swap(a, b);
  EXPECT_TRUE(m.build(s).empty());
  EXPECT_NEAR(inside_area(m), 14, 1e-12);
}

TEST(Triangulation, of_random_points_is_valid_and_delaunay) {
  for (unsigned seed : {1u, 2u, 3u}) {
    Triangulation m = with_nodes(random_points(400, seed));
    ASSERT_TRUE(m.build({}).empty());
    expect_valid(m);
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const PlaneTriangle& t = m.triangles[i];
      for (int k = 0; k < 3; ++k) {
        if (t.n[k] == kNone) continue;
        const PlaneTriangle& o = m.triangles[t.n[k]];
        for (std::int32_t v : o.v) {
          if (v == t.v[0] || v == t.v[1] || v == t.v[2]) continue;
          const Vec2 p = m.nodes[v].p, a = m.nodes[t.v[0]].p - p, b = m.nodes[t.v[1]].p - p, c = m.nodes[t.v[2]].p - p;
          EXPECT_LE(dot(a, a) * cross(b, c) - dot(b, b) * cross(a, c) + dot(c, c) * cross(a, b), 1e-9);
        }
      }
    }
  }
}

TEST(Triangulation, of_a_lattice_is_valid) {  // all points cocircular and collinear with others
  std::vector<Vec2> points;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) points.push_back({0.1 * i, 0.1 * j});
  Triangulation m = with_nodes(points);
  ASSERT_TRUE(m.build({}).empty());
  expect_valid(m);
}

TEST(Triangulation, forces_the_segments_of_a_comb) {
  // long thin teeth: most segments are no Delaunay edges, and points lie between them
  std::vector<Vec2> loop;
  const int teeth = 12;
  for (int i = 0; i < teeth; ++i) {
    loop.push_back({0.1 * i, i % 2 ? 10.0 : 0.1});
  }
  loop.push_back({0.1 * teeth, -1});
  loop.push_back({-0.1, -1});
  std::vector<Vec2> points = loop;
  for (Vec2 p : random_points(200, 7)) points.push_back({2 + 3 * p.x, 12 * p.y - 1});
  Triangulation m = with_nodes(points);
  const Segments s = ring(0, static_cast<std::int32_t>(loop.size()));
  ASSERT_TRUE(m.build(s).empty());
  expect_valid(m);
  double polygon = 0;
  for (const auto& [a, b] : s) {
    EXPECT_TRUE(has_edge(m, a, b, true));
    polygon += 0.5 * cross(points[a], points[b]);
  }
  EXPECT_NEAR(inside_area(m), std::abs(polygon), 1e-10);
}

TEST(Triangulation, forces_a_long_segment_above_nodes_close_to_it) {  // seen from a corner of the box across it
  for (const int n : {3, 5, 9})
    for (const double height : {1e-9, 1e-3, 1.0}) {
      const double length = 6;
      std::vector<Vec2> points{{length, 0}, {0, 0}};
      double expected = 0;
      for (int i = 0; i <= n; ++i) {
        const double depth = height * (i == 0 || i == n ? 1 : 2 + 0.8 * std::cos(2.0 * i));
        points.push_back({length * i / n, -depth});
        if (i > 0) expected -= 0.5 * length / n * (points[i + 1].y + points[i + 2].y);
      }
      Triangulation m = with_nodes(points);
      const std::vector<LoopConflict> conflicts = m.build(ring(0, n + 3));
      ASSERT_TRUE(conflicts.empty()) << n << " " << height;
      expect_valid(m);
      EXPECT_NEAR(inside_area(m), expected, 1e-9 * expected);
    }
}

TEST(Triangulation, forces_random_star_polygons) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> radius(0.05, 1);
    const int n = 60;
    std::vector<Vec2> points;
    for (int i = 0; i < n; ++i) {
      const double r = radius(random), a = 2 * 3.14159265358979 * i / n;
      points.push_back({r * std::cos(a), r * std::sin(a)});
    }
    Triangulation m = with_nodes(points);
    ASSERT_TRUE(m.build(ring(0, n)).empty()) << seed;
    expect_valid(m);
    double polygon = 0;
    for (const auto& [a, b] : ring(0, n)) polygon += 0.5 * cross(points[a], points[b]);
    EXPECT_NEAR(inside_area(m), polygon, 1e-12);
  }
}

TEST(Triangulation, reports_segments_that_cross) {
  Triangulation m = with_nodes({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  const auto conflicts = m.build({{0, 1}, {1, 3}, {3, 2}, {2, 0}});
  ASSERT_EQ(conflicts.size(), 1u);
  const std::set<std::int32_t> named{conflicts[0].node_a, conflicts[0].node_b, conflicts[0].other_a,
                                     conflicts[0].other_b};
  EXPECT_EQ(named, (std::set<std::int32_t>{0, 1, 2, 3}));
}

TEST(Triangulation, reports_a_node_on_a_segment) {
  Triangulation m = with_nodes({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 0}, {3, 2}, {1, 2}});
  const auto conflicts = m.build(joined(ring(0, 4), ring(4, 3)));
  ASSERT_EQ(conflicts.size(), 1u);
  EXPECT_EQ(conflicts[0].other_a, 4);
  EXPECT_EQ(conflicts[0].other_b, 4);
}

TEST(Triangulation, reports_a_node_on_a_segment_behind_others_that_it_crosses) {
  // between 4 and 5 the edge 6-7 is crossed first, then comes node 8
  Triangulation m = with_nodes({{-5, -5}, {15, -5}, {15, 5}, {-5, 5}, {0, 0}, {10, 0}, {2, 0.5}, {2, -0.5}, {5, 0}});
  const auto conflicts = m.build(joined(ring(0, 4), {{4, 5}}));
  ASSERT_EQ(conflicts.size(), 1u);
  EXPECT_EQ(conflicts[0].other_a, 8);
  EXPECT_EQ(conflicts[0].other_b, 8);
}

TEST(Triangulation, reports_two_nodes_at_one_place) {
  Triangulation m = with_nodes({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {4, 4}});
  EXPECT_EQ(m.build(ring(0, 4)).size(), 1u);
}

TEST(Triangulation, a_segment_used_twice_does_not_bound) {
  Triangulation m = with_nodes({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}});
  EXPECT_TRUE(m.build(joined(ring(0, 4), {{0, 4}, {4, 0}})).empty());
  expect_valid(m);
  EXPECT_NEAR(inside_area(m), 16, 1e-12);
  EXPECT_TRUE(has_edge(m, 0, 4, true));
}

TEST(Triangulation, locates_points_but_not_across_a_segment) {
  Triangulation m = with_nodes(kSquareWithHole);
  ASSERT_TRUE(m.build(joined(ring(0, 4), ring(4, 4))).empty());
  std::int32_t start = 0;
  while (m.triangles[start].state == kOutside) ++start;
  int n_found = 0;
  for (Vec2 q : random_points(300, 5)) {
    const Vec2 p{8 * q.x - 2, 8 * q.y - 2};
    const bool is_inside = p.x > 0 && p.x < 4 && p.y > 0 && p.y < 4 && !(p.x > 1 && p.x < 3 && p.y > 1 && p.y < 2);
    const std::int32_t t = m.locate(p, start);
    if (t == kNone) continue;
    ++n_found;
    for (int k = 0; k < 3; ++k)
      EXPECT_GE(orient2d(m.nodes[m.triangles[t].v[k]].p, m.nodes[m.triangles[t].v[(k + 1) % 3]].p, p), 0);
    EXPECT_TRUE(is_inside);
  }
  EXPECT_GT(n_found, 10);
}

/// Random inner nodes in the square with a hole, by cavities in metrics, in turn, that have nothing to do with the
/// plane or each other.
void insert_nodes(Triangulation& m, int n, unsigned seed, const std::vector<Metric>& metrics) {
  for (Vec2 q : random_points(n, seed)) {
    const Vec2 p = 4 * q;
    std::int32_t t = kNone;
    for (std::size_t i = 0; i < m.triangles.size() && t == kNone; ++i) {
      const PlaneTriangle& r = m.triangles[i];
      bool holds = r.state != kOutside;
      for (int k = 0; k < 3; ++k) holds = holds && orient2d(m.nodes[r.v[k]].p, m.nodes[r.v[(k + 1) % 3]].p, p) > 0;
      if (holds) t = static_cast<std::int32_t>(i);
    }
    if (t == kNone || !m.find_cavity(p, metrics[m.nodes.size() % metrics.size()], t)) continue;
    MeshNode node;
    node.p = p;
    m.nodes.push_back(node);
    m.added_node();
    m.fill_cavity(static_cast<std::int32_t>(m.nodes.size()) - 1);
  }
}

Triangulation with_inner_nodes(int n, const std::vector<Metric>& metrics) {
  Triangulation m = with_nodes(kSquareWithHole);
  m.build(joined(ring(0, 4), ring(4, 4)));
  insert_nodes(m, n, 11, metrics);
  return m;
}

TEST(Triangulation, stays_valid_under_insertion_in_any_metric) {
  const Metric plain, flat{1e6, 0, 1}, sheared{2, 1.4, 1}, singular{1, 0, 1e-9};
  for (const std::vector<Metric>& metrics :
       {std::vector{plain}, {flat}, {sheared}, {singular}, {plain, flat, sheared, singular}}) {
    const Triangulation m = with_inner_nodes(300, metrics);
    EXPECT_GT(m.nodes.size(), 200u);
    expect_valid(m);
    EXPECT_NEAR(inside_area(m), 14, 1e-10);
    for (const auto& [a, b] : joined(ring(0, 4), ring(4, 4))) EXPECT_TRUE(has_edge(m, a, b, true));
    for (std::size_t i = m.n_boundary + 4; i < m.nodes.size(); ++i)
      EXPECT_NE(m.triangle_at(static_cast<std::int32_t>(i)), kNone) << "a node was swallowed";
  }
}

/// State and corners' places of all triangles, whatever their numbers.
std::multiset<std::vector<double>> places_of_triangles(const Triangulation& m) {
  std::multiset<std::vector<double>> all;
  for (const PlaneTriangle& t : m.triangles) {
    const int least = static_cast<int>(std::min_element(t.v, t.v + 3,
                                                        [&](std::int32_t a, std::int32_t b) {
                                                          const Vec2 p = m.nodes[a].p, q = m.nodes[b].p;
                                                          return p.x != q.x ? p.x < q.x : p.y < q.y;
                                                        }) -
                                       t.v);
    std::vector<double> places{static_cast<double>(t.state)};
    for (int k = 0; k < 3; ++k) {
      const Vec2 p = m.nodes[t.v[(least + k) % 3]].p;
      places.insert(places.end(), {p.x, p.y});
    }
    all.insert(places);
  }
  return all;
}

/// Mean difference of the numbers of inner nodes at an edge.
double mean_step(const Triangulation& m) {
  double sum = 0;
  int n = 0;
  for (const PlaneTriangle& t : m.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = t.v[k], b = t.v[(k + 1) % 3];
      if (std::min(a, b) < m.n_boundary + 4) continue;
      sum += std::abs(a - b);
      ++n;
    }
  return sum / n;
}

TEST(Triangulation, sorted_along_a_curve_is_the_same_and_numbers_what_is_near_in_a_row) {
  Triangulation m = with_inner_nodes(2000, {Metric{}});
  const auto places = places_of_triangles(m);
  const double step = mean_step(m);
  m.sort_along_curve();
  expect_valid(m);
  EXPECT_EQ(places_of_triangles(m), places);
  EXPECT_LT(mean_step(m), step / 8);
  for (const auto& [a, b] : joined(ring(0, 4), ring(4, 4))) EXPECT_TRUE(has_edge(m, a, b, true));
}

TEST(Triangulation, stays_valid_under_swaps) {
  Triangulation m = with_inner_nodes(300, {Metric{}});
  std::mt19937 random(3);
  int n_swaps = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::int32_t t = static_cast<std::int32_t>(random() % m.triangles.size());
    const int k = static_cast<int>(random() % 3);
    if (m.triangles[t].n[k] == kNone || (m.triangles[t].constrained >> k & 1)) {
      EXPECT_FALSE(m.can_swap(t, k));
      continue;
    }
    if (!m.can_swap(t, k)) continue;
    const std::int32_t a = m.triangles[t].v[k], b = m.triangles[t].v[(k + 1) % 3];
    m.swap(t, k);
    EXPECT_FALSE(has_edge(m, a, b, false));
    ++n_swaps;
  }
  EXPECT_GT(n_swaps, 500);
  expect_valid(m);
  EXPECT_NEAR(inside_area(m), 14, 1e-10);
}

TEST(Triangulation, stays_valid_under_insertion_where_nothing_is_delaunay) {
  Triangulation m = with_inner_nodes(200, {Metric{}});
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 2000; ++i) {
      const std::int32_t t = static_cast<std::int32_t>(random() % m.triangles.size());
      const int k = static_cast<int>(random() % 3);
      if (m.can_swap(t, k)) m.swap(t, k);
    }
    insert_nodes(m, 10, 100 + round, {Metric{}, Metric{2, 1.4, 1}});
    expect_valid(m);
  }
  EXPECT_NEAR(inside_area(m), 14, 1e-10);
}

TEST(Triangulation, refuses_to_swap_where_the_quadrilateral_is_not_convex) {
  Triangulation m = with_nodes({{0, 0}, {4, 0}, {1, 1}, {0, 4}});  // an arrow head: the diagonal 0-2 is the only one
                                                                   // inside
  ASSERT_TRUE(m.build(ring(0, 4)).empty());
  int n_tried = 0;
  for (std::size_t i = 0; i < m.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const PlaneTriangle& t = m.triangles[i];
      if (std::minmax(t.v[k], t.v[(k + 1) % 3]) != std::minmax<std::int32_t>(0, 2)) continue;
      EXPECT_FALSE(m.can_swap(static_cast<std::int32_t>(i), k));
      ++n_tried;
    }
  EXPECT_EQ(n_tried, 2);
}

TEST(Triangulation, ring_of_a_node_goes_once_around_it) {
  const Triangulation m = with_inner_nodes(100, {Metric{}});
  std::vector<std::int32_t> around, tris;
  for (std::int32_t i = m.n_boundary + 4; i < static_cast<std::int32_t>(m.nodes.size()); ++i) {
    ASSERT_TRUE(m.ring_of(i, around, tris));
    double angle = 0;
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Vec2 a = m.nodes[around[k]].p - m.nodes[i].p, b = m.nodes[around[(k + 1) % around.size()]].p - m.nodes[i].p;
      angle += std::atan2(cross(a, b), dot(a, b));
      const PlaneTriangle& t = m.triangles[tris[k]];
      const int at = m.index_of(tris[k], i);
      EXPECT_EQ(t.v[(at + 1) % 3], around[k]);
      EXPECT_EQ(t.v[(at + 2) % 3], around[(k + 1) % around.size()]);
    }
    EXPECT_NEAR(angle, 2 * kPi, 1e-12);
  }
}

TEST(Triangulation, stays_valid_under_collapses) {
  Triangulation m = with_inner_nodes(300, {Metric{}});
  std::vector<std::int32_t> around, tris;
  int n_collapsed = 0;
  for (std::int32_t i = m.n_boundary + 4; i < static_cast<std::int32_t>(m.nodes.size()); i += 2) {
    ASSERT_TRUE(m.ring_of(i, around, tris));
    const int n = static_cast<int>(around.size());
    for (int c = 0; c < n; ++c) {
      bool is_valid = true;
      for (int k = 0; k < n; ++k)
        if (k != c && (k + 1) % n != c)
          is_valid =
              is_valid && orient2d(m.nodes[around[c]].p, m.nodes[around[k]].p, m.nodes[around[(k + 1) % n]].p) > 0;
      if (!is_valid) continue;
      m.collapse(i, c, around, tris);
      EXPECT_EQ(m.triangle_at(i), kNone);
      ++n_collapsed;
      break;
    }
    expect_valid(m);
  }
  EXPECT_GT(n_collapsed, 100);
  EXPECT_NEAR(inside_area(m), 14, 1e-10);
  for (const auto& [a, b] : joined(ring(0, 4), ring(4, 4))) EXPECT_TRUE(has_edge(m, a, b, true));
}

TEST(Triangulation, forces_a_side_inside_that_no_swap_takes_away) {
  Triangulation m = with_nodes({{0, 0}, {4, 0}, {4, 3}, {0, 3}, {1, 1}, {3, 2.1}, {2, 2}, {2.1, 1}});
  const Segments loop = ring(0, 4);
  ASSERT_TRUE(m.build(loop).empty());
  EXPECT_TRUE(m.force_side(4, 5));
  const auto [t, apex] = m.left_of(4, 5);
  ASSERT_NE(t, kNone);
  EXPECT_GT(orient2d(m.nodes[4].p, m.nodes[5].p, m.nodes[apex].p), 0);
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(m.triangles[t].v[k] == 4 && m.can_swap(t, k));
  EXPECT_FALSE(m.force_side(6, 7));  // it would cross
  EXPECT_NEAR(inside_area(m), 12, 1e-12);
  EXPECT_EQ(m.left_of(0, 2).first == kNone, m.left_of(2, 0).first == kNone);
}

TEST(Triangulation, releases_a_side_that_had_to_stay) {
  Triangulation m = with_nodes({{0, 0}, {4, 0}, {4, 3}, {0, 3}, {1, 1}, {3, 2.1}, {2, 2}, {2.1, 1}});
  ASSERT_TRUE(m.build(ring(0, 4)).empty());
  ASSERT_TRUE(m.force_side(4, 5));
  EXPECT_TRUE(m.is_fixed(4, 5) && m.is_fixed(5, 4));
  m.release_side(4, 5);
  EXPECT_FALSE(m.is_fixed(4, 5) || m.is_fixed(5, 4));
  EXPECT_TRUE(m.force_side(6, 7));
  EXPECT_FALSE(m.is_fixed(4, 5));  // no edge at all
}

/// Does the way from a to b cross the hole of the square?
bool crosses_hole(Vec2 a, Vec2 b) {
  double first = 0, last = 1;
  for (const auto& [from, by, low, high] :
       {std::array{a.x, b.x - a.x, 1.0, 3.0}, std::array{a.y, b.y - a.y, 1.0, 2.0}}) {
    first = std::max(first, std::min((low - from) / by, (high - from) / by));
    last = std::min(last, std::max((low - from) / by, (high - from) / by));
  }
  return first < last;
}

TEST(Triangulation, finds_what_is_seen_straight_from_nodes_and_edges) {
  Triangulation m = with_nodes(kSquareWithHole);
  ASSERT_TRUE(m.build(joined(ring(0, 4), ring(4, 4))).empty());
  insert_nodes(m, 40, 3, {Metric{}});
  const auto expect_seen = [&](std::int32_t t, Vec2 from, Vec2 p) {
    EXPECT_EQ(t != kNone, !crosses_hole(from, p)) << from.x << " " << from.y << ", " << p.x << " " << p.y;
    for (int k = 0; k < 3 && t != kNone; ++k)
      EXPECT_GE(orient2d(m.nodes[m.triangles[t].v[k]].p, m.nodes[m.triangles[t].v[(k + 1) % 3]].p, p), 0);
  };
  for (const Vec2 q : random_points(200, 7)) {
    const Vec2 p{4 * q.x, 4 * q.y}, from{0.5 + 3 * q.y, 0};
    if (p.x > 1 && p.x < 3 && p.y > 1 && p.y < 2) continue;
    for (std::size_t n = 12; n < m.nodes.size(); ++n)
      expect_seen(m.seen_from(static_cast<std::int32_t>(n), p), m.nodes[n].p, p);
    expect_seen(m.seen_left_of(0, 1, from, p), from, p);
  }
}

TEST(Triangulation, finds_the_triangle_in_which_a_way_begins) {
  Triangulation m = with_nodes({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}});
  ASSERT_TRUE(m.build(ring(0, 4)).empty());
  for (const Vec2 p : {Vec2{3, 2.2}, Vec2{1.9, 3}, Vec2{1, 1.5}, Vec2{2.3, 1}}) {
    const std::int32_t t = m.triangle_towards(4, p);
    ASSERT_NE(t, kNone);
    const Vec2 near = m.nodes[4].p + 0.01 * (p - m.nodes[4].p);
    for (int k = 0; k < 3; ++k)
      EXPECT_GE(orient2d(m.nodes[m.triangles[t].v[k]].p, m.nodes[m.triangles[t].v[(k + 1) % 3]].p, near), 0);
  }
}

}  // namespace
}  // namespace st
