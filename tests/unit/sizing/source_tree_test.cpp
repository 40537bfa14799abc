#include "sizing/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "sizing/background.h"
#include "unit/sizing/sampled_field.h"

namespace st {
namespace {

constexpr double kTreeSlope = 0.2, kEndless = std::numeric_limits<double>::infinity();

Vec3 random_place(std::mt19937& random, double lo = -0.5, double hi = 1.5) {
  std::uniform_real_distribution<double> uniform(lo, hi);
  return {uniform(random), uniform(random), uniform(random)};
}

/// Of all kinds, some with radii and doublings, some varied.
std::vector<SourceSpec> random_sources(int n, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<SourceSpec> sources;
  for (int i = 0; i < n; ++i) {
    SourceSpec s;
    s.kind = static_cast<SourceKind>(i % 7);
    const Vec3 at = random_place(random, 0, 1);
    for (Vec3& p : s.point) p = at + 0.2 * random_place(random, -1, 1);
    for (SourceSpacing& d : s.spacing)
      d = {0.01 + 0.05 * uniform(random), i % 3 ? 0.1 * uniform(random) : 0, i % 2 ? 0.4 * uniform(random) : 0};
    s.half_axis = {{{0.1, 0.05, 0}, {-0.05, 0.1, 0}, {0, 0, 0.08}}};
    s.extent = 0.1 * uniform(random);
    sources.push_back(s);
  }
  return sources;
}

SourceTree tree_of(const std::vector<SourceSpec>& sources) {
  std::vector<SourceTree::Entry> entries;
  for (const SourceSpec& s : sources)
    entries.push_back(
        {make_source(s, kTreeSlope), pack_cause(CauseKind::kSource, static_cast<std::int32_t>(entries.size()))});
  return SourceTree(std::move(entries));
}

double asked_at(const SizeField& field, Vec3 x) { return field.size(x); }

TEST(SourceTree, takes_the_smallest_of_all_and_names_it) {
  const SourceTree tree = tree_of(random_sources(200));
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 x = random_place(random);
    double least = kEndless;
    std::int32_t first = kNone;
    for (std::int32_t k = 0; k < 200; ++k)
      if (const double h = asked_at(*tree.entry(k).source, x); h < least) least = h, first = k;
    std::int32_t winner = kNone;
    ASSERT_EQ(tree.size_below(x, kEndless, &winner), least);
    ASSERT_EQ(winner, first);
    ASSERT_EQ(tree.size_below(x, 0.5 * least, &winner), 0.5 * least);
    ASSERT_EQ(winner, kNone);
    ASSERT_EQ(tree.size_below(x, least, &winner), least);
  }
}

TEST(SourceTree, bounds_what_is_asked_for_nearby) {
  const SourceTree tree = tree_of(random_sources(60, 3));
  std::mt19937 random(8);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = random_place(random);
    const double radius = 0.001 * std::pow(300, random_place(random, 0, 1).x), bound = tree.least_near(x, radius, 0.3);
    for (int k = 0; k < 20; ++k) {
      const Vec3 d = random_place(random, -1, 1);
      const double share = std::min(1.0, 1 / norm(d));  // moved into the ball
      ASSERT_GE(tree.size_below(x + radius * share * d, 0.3), bound * (1 - 1e-6));
    }
    ASSERT_LE(bound, tree.size_below(x, 0.3));
  }
}

TEST(SourceTree, names_the_few_that_count_nearby) {
  const SourceTree tree = tree_of(random_sources(100, 4));
  std::mt19937 random(12);
  int n_none = 0, n_few = 0, n_many = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 x = random_place(random);
    const double radius = 0.0003 * std::pow(300, random_place(random, 0, 1).x), upper = 0.02 * (1 + i % 9);
    const FewSources near = tree.find_near(x, radius, upper);
    ASSERT_TRUE(near.is_known());
    (near.are_none() ? n_none : near.are_many() ? n_many : n_few) += 1;
    for (int k = 0; k < 20; ++k) {
      const Vec3 d = random_place(random, -1, 1), y = x + radius * std::min(1.0, 1 / norm(d)) * d;
      std::int32_t winner = kNone, by = kNone;
      ASSERT_EQ(tree.size_below(y, upper, near), tree.size_below(y, upper, &winner));
      ASSERT_EQ(tree.size_below(y, upper, near, by), tree.size_below(y, upper));
      ASSERT_EQ(by, winner);
    }
  }
  EXPECT_GT(std::min({n_none, n_few, n_many}), 100);
}

TEST(FewSources, are_kept_in_one_number) {
  const std::vector<std::int32_t> wide{5, 0, (1 << 20) - 1}, small{5, 0, (1 << 12) - 1, 7, 9};
  for (const auto& ids : {wide, small})
    for (std::size_t n = 0; n <= ids.size(); ++n) {
      const FewSources few = FewSources::from_bits(FewSources(ids.data(), n).bits());
      EXPECT_TRUE(few.is_known());
      EXPECT_FALSE(few.are_many());
      EXPECT_EQ(few.are_none(), n == 0);
      ASSERT_EQ(few.n(), static_cast<int>(n));
      for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(few[static_cast<int>(i)], ids[i]);
    }
  const std::vector<std::int32_t> too_many_wide{1 << 12, 0, 1, 2}, too_many{0, 1, 2, 3, 4, 5}, too_large{1 << 20};
  for (const auto& ids : {too_many_wide, too_many, too_large})
    EXPECT_TRUE(FewSources(ids.data(), ids.size()).are_many());
  EXPECT_FALSE(FewSources().is_known());
}

TEST(SourceTree, grows_by_the_slope_at_most_from_sources_of_any_kind) {
  std::mt19937 random(9);
  for (const SourceSpec& spec : random_sources(42, 5)) {
    const auto source = make_source(spec, kTreeSlope);
    for (int i = 0; i < 500; ++i) {
      const Vec3 a = random_place(random), b = a + 0.1 * random_place(random, -1, 1);
      ASSERT_LE(std::abs(asked_at(*source, a) - asked_at(*source, b)), kTreeSlope * distance(a, b) * (1 + 1e-4) + 1e-6);
    }
  }
}

/// Spacings of its points, by brute force: what a varied line asks for.
TEST(Source, asks_for_the_least_over_all_its_points) {
  std::mt19937 random(10);
  for (const SourceSpec& spec : random_sources(70, 6)) {
    if (spec.kind != SourceKind::kLine) continue;
    const auto source = make_source(spec, kTreeSlope);
    for (int i = 0; i < 100; ++i) {
      const Vec3 x = random_place(random);
      double least = kEndless;
      for (int k = 0; k <= 2000; ++k) {
        const double t = k / 2000.0;
        const auto mix = [t](double a, double b) { return a + t * (b - a); };
        const SourceSpacing &a = spec.spacing[0], &b = spec.spacing[1];
        const SourceSpacing at{mix(a.length, b.length), mix(a.radius, b.radius), mix(a.doubling, b.doubling)};
        const Vec3 p = spec.point[0] + t * (spec.point[1] - spec.point[0]);
        least = std::min(least, grown_length(at, kTreeSlope, distance(x, p)));
      }
      ASSERT_NEAR(asked_at(*source, x), least, 3e-4 * least);
      ASSERT_LE(asked_at(*source, x), least * (1 + 1e-9));
    }
  }
}

/// The two methods of the paper are all that a new type of source needs.
class WallSource final : public SizeSource {
 public:
  WallSource() : SizeSource(kTreeSlope) {}
  using SizeSource::size;
  double min_size() const override { return 0.03; }
  double size(Vec3 x, int&) const override { return 0.03 + kTreeSlope * std::abs(x.z - 0.5); }
};

TEST(SourceTree, takes_a_source_of_another_type) {
  std::vector<SourceTree::Entry> entries;
  for (const SourceSpec& s : random_sources(20)) entries.push_back({make_source(s, kTreeSlope), 4});
  entries.push_back({std::make_unique<WallSource>(), 40});
  const SourceTree with(std::move(entries)), without = tree_of(random_sources(20));
  std::mt19937 random(11);
  int n_walls = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x = random_place(random, -5, 5);
    std::int32_t winner = kNone;
    const double wall = 0.03 + kTreeSlope * std::abs(x.z - 0.5), other = without.size_below(x, kEndless);
    ASSERT_EQ(with.size_below(x, kEndless, &winner), std::min(wall, other));
    n_walls += winner == 20;
  }
  EXPECT_GT(n_walls, 50);
}

SourceSpec stretched_box(Vec3 middle, Vec3 half, double length, double aspect, Vec3 direction) {
  SourceSpec box;
  box.kind = SourceKind::kBox;
  box.point[0] = middle;
  box.half_axis = {{{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}}};
  box.spacing[0].length = length;
  box.aspect = aspect;
  box.direction = direction;
  return box;
}

TEST(SourceTree, allows_longer_edges_where_all_do) {
  const SourceSpec box = stretched_box({0.5, 0.5, 0.5}, {0.3, 0.2, 0.2}, 0.02, 5, {1, 0, 0});
  SourceSpec second = box;
  second.aspect = 1;
  second.spacing[0].length = 0.05;
  const SourceTree one = tree_of({box}), both = tree_of({box, second});
  const Vec3 x{0.5, 0.5, 0.5};
  const LocalSize large{1, 1, {}};
  EXPECT_NEAR(one.local_below(x, large).in({1, 0, 0}), 0.1, 1e-15);
  EXPECT_NEAR(one.local_below(x, large).in({0, 1, 0}), 0.02, 1e-15);
  EXPECT_NEAR(both.local_below(x, large).in({1, 0, 0}), 0.05, 1e-15);
  EXPECT_NEAR(one.local_below(x, {0.07, 0.07, {}}).in({1, 0, 0}), 0.07, 1e-15);
  EXPECT_NEAR(one.local_below(x, {0.01, 0.3, {1, 0, 0}}).in({1, 0, 0}), 0.1, 1e-15);
  EXPECT_EQ(both.max_aspect(), 5);
}

TEST(SourceTree, intersects_metrics_stretched_sources_and_the_raster_in_any_plane) {
  const SourceSpec box = stretched_box({0.2, 0.2, 0.2}, {1, 1, 1}, 0.03, 8, normalized(Vec3{1, 1, 0}));
  BackgroundMesh mesh;
  mesh.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.node_metric.assign(4, {1 / 0.0004, 1 / 0.04, 1, 0, 0, 0});  // lengths 0.02, 0.2, 1
  mesh.node_size.assign(4, size_of_metric(mesh.node_metric[0]));
  mesh.tets = {{0, 1, 2, 3}};
  std::vector<SourceTree::Entry> entries;
  entries.push_back({make_source(box, kTreeSlope), 0});
  entries.push_back({make_background(mesh, kTreeSlope), 1});
  const SourceTree tree(std::move(entries));
  ASSERT_TRUE(tree.has_metrics());
  const Vec3 x{0.2, 0.2, 0.2};
  const LocalSize upper{0.05, 0.3, {0, 0, 1}};
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 normal = normalized(random_place(random, -1, 1)), u = a_normal_to(normal), v = cross(normal, u);
    const LocalSize all = tree.local_on_below(x, normal, upper);
    double most = 0;
    for (double angle = 0; angle < 3.1; angle += 0.1) {
      const Vec3 way = std::cos(angle) * u + std::sin(angle) * v;
      int hint = 0;
      double least = upper.in(way);
      for (const std::int32_t s : {0, 1}) least = std::min(least, tree.entry(s).source->length_along(x, way, hint));
      ASSERT_LE(all.in(way), (1 + 1e-6) * least) << i << " " << angle;
      most = std::max(most, all.in(way) / least);
    }
    EXPECT_GT(most, 0.6) << "no shorter than it has to be: two intersections take a root of two each";
  }
}

TEST(SourceTree, knows_where_a_length_comes_from) {
  SourceSpec point;
  point.point[0] = {0.3, 0.4, 0.5};
  for (const SourceSpacing& spacing : {SourceSpacing{0.01, 0, 0}, SourceSpacing{0.01, 0.05, 0.3}}) {
    point.spacing[0] = spacing;
    const SourceTree tree = tree_of({point});
    EXPECT_LT(distance(tree.origin(0, {0.9, 0.1, 0.8}), point.point[0]), spacing.radius + 1e-3);
  }
  EXPECT_NEAR(norm(tree_of({point}).gradient(0, {5, 5, 5})), kTreeSlope, 1e-6);
}

/// Sources count in the field exactly and everywhere: beside its cells, also outside the root cube.
TEST(OctreeField, takes_the_smaller_of_octree_and_sources_everywhere) {
  const auto sampled = test::sample_field(test::sphere_boxes(500), kTreeSlope, 0.1);
  const SourceTree tree = tree_of(random_sources(100));
  OctreeFieldData data = sampled->data;
  data.scale = 3;
  const OctreeField plain(data, nullptr);
  data.sources = &tree;
  const OctreeField field(data, nullptr);
  std::mt19937 random(12);
  int n_sources = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 x = random_place(random);
    const double other = asked_at(plain, x), asked = 3 * tree.size_below(x, kEndless);
    ASSERT_DOUBLE_EQ(asked_at(field, x), std::min(other, asked));
    Vec3 gradient;
    std::int32_t cause = kNone;
    int hint = 0;
    ASSERT_EQ(field.size_and_gradient(x, hint, gradient, cause), asked_at(field, x));
    n_sources += asked < other;
    if (asked < other) {
      ASSERT_EQ(cause_kind(cause), CauseKind::kSource);
      ASSERT_EQ(field.explain(x).cause, cause);
      ASSERT_LE(norm(gradient), 3 * kTreeSlope * (1 + 1e-3));
    }
  }
  EXPECT_GT(n_sources, 500);
  EXPECT_EQ(field.min_size(), 3 * std::min(tree.min_size(), plain.min_size() / 3));
}

}  // namespace
}  // namespace st
