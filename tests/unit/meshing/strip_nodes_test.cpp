// Strips in the mesh: the nodes that their two long edges share.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "features/strip.h"
#include "meshing/topology/small_features.h"
#include "support/tapered_strip.h"

namespace st {
namespace {

TEST(StripNodes, both_edges_get_as_many_nodes_common_ones_where_it_is_narrow) {
  const Model model = test::make_model("wedge_strip");
  const Strip strip = test::tapered_strip();
  const auto kept = model.curve(strip.edges[0]), closed = model.curve(strip.edges[1]);
  const UniformField field(1);
  const EdgeMesh nodes = discretise_curve(*kept, field, {});
  const EdgeMesh twin = mirror_nodes(*kept, nodes, *closed, strip.is_opposed, {0.25});
  const std::size_t n = nodes.node_t.size();
  ASSERT_EQ(twin.node_t.size(), n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = strip.is_opposed ? n - 1 - i : i;
    if (i) {
      EXPECT_GT(twin.node_t[i], twin.node_t[i - 1]);
    }
    const double width = 0.02 + 0.98 * nodes.node_xyz[k].x / 20;
    if (std::abs(width - 0.25) > 0.01) {
      EXPECT_EQ(twin.node_xyz[i] == nodes.node_xyz[k], width < 0.25) << width;
    }
  }
}

}  // namespace
}  // namespace st
