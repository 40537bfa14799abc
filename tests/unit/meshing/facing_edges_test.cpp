#include "meshing/engine/facing_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(FacingEdges, leave_no_folds_on_a_band_between_one_edge_and_two) {
  const test::Meshed band("banded_pie", 1.3, {.merge_below = 0});
  EXPECT_TRUE(band.result.failures.empty());
  EXPECT_TRUE(band.result.folds.empty());
  EXPECT_EQ(band.result.n_crossing_pairs, 0);
  EXPECT_EQ(band.result.n_rounds, 1) << "nothing had to be refined";
}

}  // namespace
}  // namespace st
