#include "meshing/engine/edge_mesher.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/strip.h"
#include "meshing/engine/mesh_plan.h"
#include "meshing/topology/curve_discretiser.h"
#include "support/meshed.h"

namespace st {
namespace {

/// All edges of a model, by the lengths of a field.
struct Edges {
  const Model& model;
  const MeshTopology& topology;
  const SizeField& field;
  EdgeMesher mesher{model, topology, field, {}, test::one_rank};

  EdgeMesh again(const std::vector<EdgeId>& dirty, const Refinements& refined, const EdgeMesh& present) const {
    return mesher.mesh(dirty, refined, present);
  }
  EdgeMesh all() const { return again(plan_all(topology).edges, Refinements(field), {}); }
};

TEST(EdgeMesher, makes_dirty_edges_anew_and_leaves_the_others_as_they_are) {
  set_verbosity(Verbosity::kQuiet);
  const Model box = test::make_model("box");
  const MeshTopology topology(box.tables());
  const UniformField field(4);
  const Edges edges{box, topology, field};
  const EdgeMesh before = edges.all();
  Refinements refined(field);
  ASSERT_TRUE(refined.add({box.tables().vertex_xyz[box.tables().edge_vertices[0]], 1, 0}, 0.01));
  const EdgeMesh after = edges.again({0}, refined, before);
  ASSERT_EQ(after.n_edges(), before.n_edges());
  EXPECT_GT(after.n_nodes(0), before.n_nodes(0));
  for (EdgeId e = 1; e < after.n_edges(); ++e) EXPECT_EQ(after.n_nodes(e), before.n_nodes(e)) << e;
  EXPECT_TRUE(edges.mesher.followers().empty()) << "nothing is narrow";
}

/// Stretched along z; the length along grows a little with y.
class GrowingStretch : public UniformField {
 public:
  using UniformField::UniformField;
  LocalSize local(Vec3 x, int&) const override { return {min_size(), std::max(0.5, 1 + 2 * x.y), {0, 0, 1}}; }
  bool is_stretched() const override { return true; }
};

TEST(EdgeMesher, gives_the_two_long_edges_of_a_narrow_face_opposite_nodes_where_lengths_are_stretched) {
  set_verbosity(Verbosity::kQuiet);
  const Model wing = test::make_model("blunt_wing");
  const std::vector<Strip> strips = find_strips(wing);
  ASSERT_FALSE(strips.empty());
  const MeshTopology topology(wing.tables());
  const GrowingStretch field(0.05);
  const EdgeMesh edges = Edges{wing, topology, field}.all();
  const auto [a, b] = std::pair{strips[0].edges[0], strips[0].edges[1]};
  const std::int32_t n = edges.n_nodes(a);
  ASSERT_EQ(edges.n_nodes(b), n);
  EXPECT_GT(n, 10);
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t k = strips[0].is_opposed ? n - 1 - i : i;
    const Vec3 x = edges.node_xyz[edges.first_node(a) + i], y = edges.node_xyz[edges.first_node(b) + k];
    EXPECT_NEAR(x.z, y.z, 1e-6);
  }
  const EdgeMesh own = discretise_curve(*wing.curve(b), field, {});
  EXPECT_NE(static_cast<std::int32_t>(own.node_t.size()), n) << "would not have been opposite anyway";
}

}  // namespace
}  // namespace st
