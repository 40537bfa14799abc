#include "meshing/engine/dirty_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "meshing/topology/curve_discretiser.h"
#include "support/meshed.h"
#include "support/tapered_strip.h"

namespace st {
namespace {

/// A bar whose narrow faces taper from 1 to 0.02, one of them closed as a strip, meshed with length 0.1.
struct ClosedStrip {
  Model model = test::make_model("wedge_strip");
  Strip strip = test::tapered_strip();
  MeshTopology topology{model.tables(),
                        {.edge = {},
                         .strip_face = {strip.face},
                         .strip_kept = {strip.edges[0]},
                         .strip_closed = {strip.edges[1]},
                         .strip_is_opposed = {strip.is_opposed},
                         .pairs = {}}};
  EdgeMesh edges = plain_edges();

  /// All edges with nodes of length 0.1.
  EdgeMesh plain_edges() const {
    const UniformField field(0.1);
    EdgeMesh all;
    for (EdgeId e = 0; e < model.tables().n_edges(); ++e) all.append(discretise_curve(*model.curve(e), field, {}), 0);
    return all;
  }
  /// At the widest place of the strip, on one of its edges.
  Refinement on(EdgeId e, EdgeId other) const {
    Refinement best;
    double widest = 0;
    for (std::int32_t i = edges.first_node(e); i < edges.first_node(e) + edges.n_nodes(e); ++i) {
      double width = 1e300;
      for (std::int32_t k = edges.first_node(other); k < edges.first_node(other) + edges.n_nodes(other); ++k)
        width = std::min(width, distance(edges.node_xyz[i], edges.node_xyz[k]));
      if (width > widest) widest = width, best = {edges.node_xyz[i], 0.05, 0.1};
    }
    EXPECT_GT(widest, 0.5) << "far from the other edge";
    return best;
  }
};

TEST(DirtyParts, are_both_long_edges_of_a_closed_strip_where_one_is_reached) {
  const ClosedStrip m;
  const auto [kept, closed] = std::pair{m.strip.edges[0], m.strip.edges[1]};
  for (const auto& [e, other] : {std::pair{kept, closed}, std::pair{closed, kept}}) {
    const std::vector<Refinement> places = {m.on(e, other)};
    const DirtyParts alone = find_dirty_parts(MeshTopology(m.model.tables()), m.edges, places, {});
    ASSERT_TRUE(alone.edge[e] && !alone.edge[other]);
    const DirtyParts dirty = find_dirty_parts(m.topology, m.edges, places, {});
    EXPECT_TRUE(dirty.edge[e] && dirty.edge[other]);
    for (FaceId f = 0; f < m.model.tables().n_faces(); ++f) {
      bool has_dirty_edge = false;
      for (const EdgeId of : m.model.tables().edges_of(f)) has_dirty_edge |= dirty.edge[of] != 0;
      EXPECT_TRUE(dirty.face[f] || !has_dirty_edge) << f;
    }
  }
}

TEST(DirtyParts, are_a_leader_with_all_its_followers) {
  const ClosedStrip m;
  const auto [a, b] = std::pair{m.strip.edges[0], m.strip.edges[1]};
  const MeshTopology topology(m.model.tables());
  EdgeId third = 0;
  while (third == a || third == b) ++third;
  const std::vector<std::pair<EdgeId, EdgeId>> followers = {{third, a}, {b, a}};
  const DirtyParts dirty = find_dirty_parts(topology, m.edges, std::vector{m.on(b, a)}, followers);
  EXPECT_TRUE(dirty.edge[a] && dirty.edge[b] && dirty.edge[third]);
}

TEST(DirtyParts, are_edges_whose_lengths_a_refinement_reaches_beside_them) {
  const ClosedStrip m;
  const MeshTopology topology(m.model.tables());
  const Vec3 last = *std::ranges::max_element(m.edges.node_xyz, {}, &Vec3::x);
  for (const double beyond : {0.5, 1.5}) {  // lengths of 0.1 from the model, beyond the reach
    const Vec3 x = last + Vec3{0.05 + 0.1 * beyond, 0, 0};
    const DirtyParts dirty = find_dirty_parts(topology, m.edges, std::vector{Refinement{x, 0.01, 0.05}}, {});
    bool is_near = false;
    for (const Vec3& node : m.edges.node_xyz) is_near |= distance(node, x) < 0.05 + 0.1;
    EXPECT_EQ(std::count(dirty.edge.begin(), dirty.edge.end(), 1) > 0, is_near);
    EXPECT_EQ(is_near, beyond < 1);
  }
}

TEST(DirtyParts, are_none_where_nothing_is_refined) {
  const ClosedStrip m;
  const DirtyParts dirty = find_dirty_parts(m.topology, m.edges, {}, {});
  EXPECT_EQ(std::count(dirty.edge.begin(), dirty.edge.end(), 0), m.model.tables().n_edges());
  EXPECT_EQ(std::count(dirty.face.begin(), dirty.face.end(), 0), m.model.tables().n_faces());
}

}  // namespace
}  // namespace st
