#include "meshing/engine/facing_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "meshing/topology/curve_discretiser.h"
#include "support/meshed.h"

namespace st {
namespace {

/// A band of 0.002 about a part of a cylinder, its upper side in two edges, with chords 0.02 away from the curves.
struct Band {
  Model model = test::make_model("banded_pie");
  MeshTopology topology{model.tables()};
  FacingEdges facing = find();

  FacingEdges find() const {
    for (const FacingEdges& f : find_facing_edges(topology, false))
      if (f.leaders.size() == 2 && model.tables().edge_length[f.edge] > 20) return f;
    return {};
  }
  EdgeMesh nodes(EdgeId e, double length) const { return discretise_curve(*model.curve(e), UniformField(length), {}); }
  EdgeMesh across(double length, double own_length) const {
    return facing_nodes(model, UniformField(length), facing, nodes(facing.edge, own_length),
                        [&](EdgeId e) { return nodes(e, length); });
  }
};

TEST(FacingEdges, have_their_nodes_across_from_each_other) {
  const Band band;
  ASSERT_NE(band.facing.edge, kNone);
  const EdgeMesh own = band.across(1.3, 1);
  std::vector<Vec3> others;
  for (const FacingEdges::Leader& l : band.facing.leaders) {
    const EdgeMesh nodes = band.nodes(l.edge, 1.3);
    others.insert(others.end(), nodes.node_xyz.begin(), nodes.node_xyz.end());
  }
  ASSERT_EQ(own.node_t.size() + 1, others.size()) << "the leaders have one vertex in common";
  EXPECT_TRUE(std::is_sorted(own.node_t.begin(), own.node_t.end()));
  for (const Vec3 x : own.node_xyz) {
    double nearest = 1e300;
    for (const Vec3 y : others) nearest = std::min(nearest, distance(x, y));
    EXPECT_NEAR(nearest, 0.002, 1e-9);
  }
}

TEST(FacingEdges, stay_as_they_are_where_chords_are_near_their_curves) {
  const Band band;
  EXPECT_EQ(band.across(0.2, 0.19).node_t, band.nodes(band.facing.edge, 0.19).node_t);
}

/// Long along the span, z.
class SpanField : public UniformField {
 public:
  SpanField() : UniformField(0.02) {}
  bool is_stretched() const override { return true; }
  LocalSize local(Vec3, int&) const override { return {0.02, 1, {0, 0, 1}}; }
};

TEST(FacingEdges, keep_rows_in_step_on_a_base_that_is_narrower_than_its_segments) {
  const Model model = test::make_model("blunt_wing");
  const MeshTopology topology(model.tables());
  const SpanField field;
  const auto nodes = [&](EdgeId e, double length) {
    return discretise_curve(*model.curve(e), UniformField(length), {});
  };
  std::size_t n_bases = 0;
  for (const FacingEdges& f : find_facing_edges(topology, true)) {
    if (f.width > 0.1 || f.leaders.size() != 1) continue;
    ++n_bases;
    const EdgeMesh own = nodes(f.edge, 1), leader = nodes(f.leaders[0].edge, 1.3);
    ASSERT_GT(own.node_t.size(), leader.node_t.size() + 5) << "they differ";
    const auto across = [&](double length) {
      return facing_nodes(model, field, f, own, [&](EdgeId e) { return nodes(e, length); });
    };
    EXPECT_EQ(across(1.3).node_t.size(), leader.node_t.size());
    for (const Vec3 x : across(1.3).node_xyz) {
      double nearest = 1e300;
      for (const Vec3 y : leader.node_xyz) nearest = std::min(nearest, distance(x, y));
      EXPECT_LT(nearest, 1.1 * f.width);
    }
    EXPECT_EQ(across(2).node_t, own.node_t) << "far fewer are no rows";
  }
  EXPECT_EQ(n_bases, 1u);
}

/// Longer along an edge, in thousandths of it, from end to end.
class EvenlyChanging : public SpanField {
 public:
  EvenlyChanging(const Model& model, EdgeId e, double first, double last) : curve_(model.curve(e)) {
    from_ = curve_->point(curve_->t_min());
    way_ = curve_->point(curve_->t_max()) - from_;
    first_ = 0.001 * first * norm(way_);
    last_ = 0.001 * last * norm(way_);
  }
  LocalSize local(Vec3 x, int&) const override {
    return {0.01 * last_, std::lerp(first_, last_, dot(x - from_, way_) / norm2(way_)), normalized(way_)};
  }

 private:
  std::unique_ptr<Curve> curve_;
  Vec3 from_, way_;
  double first_, last_;
};

TEST(FacingEdges, of_wide_faces_follow_others_where_that_fits_the_lengths_asked_for) {
  const Model model = test::make_model("wedge_strip");
  const MeshTopology topology(model.tables());
  const std::vector<FacingEdges> all = find_facing_edges(topology, true);
  ASSERT_FALSE(all.empty());
  for (const FacingEdges& f : all) {
    ASSERT_EQ(f.leaders.size(), 1u);
    const auto nodes = [&](EdgeId e, const SizeField& field) { return discretise_curve(*model.curve(e), field, {}); };
    const double length = model.tables().edge_length[f.edge];
    const auto follow = [&](const SizeField& field) {
      return facing_nodes(model, field, f, nodes(f.edge, field),
                          [&](EdgeId e) { return nodes(e, UniformField(length / 1100)); });
    };
    const std::size_t n = nodes(f.leaders[0].edge, UniformField(length / 1100)).node_t.size();
    EXPECT_EQ(follow(EvenlyChanging(model, f.edge, 1, 1)).node_t.size(), n) << "for 1,000 of its own";
    const EvenlyChanging tapered(model, f.edge, 1.6, 0.5);
    EXPECT_EQ(follow(tapered).node_t, nodes(f.edge, tapered).node_t) << "about as many, 1.7 times too long at one end";
  }
}

TEST(FacingEdges, are_found_on_the_narrowest_faces_first) {
  const Model model = test::make_model("banded_pie");
  const MeshTopology topology(model.tables());
  for (const bool has_rows : {false, true}) {
    const std::vector<FacingEdges> found = find_facing_edges(topology, has_rows);
    EXPECT_GT(found.size(), 1u);
    EXPECT_TRUE(std::ranges::is_sorted(found, {}, &FacingEdges::width)) << has_rows;
  }
}

TEST(FacingEdges, of_strips_beside_each_other_follow_one_that_is_in_halves) {
  const Model model = test::make_model("layered_bar");
  const std::vector<FacingEdges> all = find_facing_edges(MeshTopology(model.tables()), true);
  const auto follows = [&](EdgeId e) { return std::ranges::any_of(all, [e](const auto& f) { return f.edge == e; }); };
  std::size_t n_chains = 0;
  for (const FacingEdges& f : all) {
    for (const FacingEdges::Leader& l : f.leaders) EXPECT_FALSE(follows(l.edge));
    if (f.leaders.size() == 1) continue;
    ++n_chains;
    const ModelTables& t = model.tables();
    const auto begin = [&](EdgeId e, bool is_end) { return t.vertex_xyz[t.edge_vertices[2 * e + is_end]]; };
    for (std::size_t i = 0; i < 2; ++i) {
      const FacingEdges::Leader& l = f.leaders.at(i);
      EXPECT_LT(distance(begin(f.edge, i == 1), begin(l.edge, (i == 1) != l.is_opposed)), 0.5);
    }
  }
  EXPECT_EQ(n_chains, 4u) << "on two sides both edges of the whole strips";
}

TEST(FacingEdges, leave_no_folds_on_a_band_between_one_edge_and_two) {
  const test::Meshed band("banded_pie", 1.3, {.merge_below = 0});
  EXPECT_TRUE(band.result.failures.empty());
  EXPECT_TRUE(band.result.folds.empty());
  EXPECT_EQ(band.result.n_crossing_pairs, 0);
  EXPECT_EQ(band.result.n_rounds, 1) << "nothing had to be refined";
}

}  // namespace
}  // namespace st
