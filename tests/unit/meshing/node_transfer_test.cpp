#include "meshing/hole/node_transfer.h"

#include <cmath>

#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

/// Of all nodes of a finer mesh of the shape, none of which is an old one, the largest error.
template <class Field>
double transfer_error(const ShapeMesh& coarse, const ShapeMesh& fine, const Field& field) {
  const HoleMesh old(coarse.mesh, coarse.model.tables());
  SurfaceMesh now = fine.mesh;
  now.node_previous.assign(now.node_xyz.size(), kNone);
  for (std::size_t n = 0; n < now.node_xyz.size(); ++n)
    if (now.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex))
      now.node_previous[n] = old.vertex_node[now.node_entity[n]];
  std::vector<double> values;
  for (const Vec3 x : coarse.mesh.node_xyz) values.push_back(field(x));
  const std::vector<double> got = transfer_values(find_node_stencils(old, now), values, 1);
  double most = 0;
  for (std::size_t n = 0; n < got.size(); ++n) most = std::max(most, std::abs(got[n] - field(now.node_xyz[n])));
  return most;
}

class TransferredField : public testing::TestWithParam<const char*> {};

TEST_P(TransferredField, is_exact_for_constants) {
  const ShapeMesh coarse(GetParam()), fine(GetParam(), 0.04);
  EXPECT_LE(transfer_error(coarse, fine, [](Vec3) { return 7.0; }), 1e-14);
}

TEST_P(TransferredField, is_of_second_order) {
  const ShapeMesh fine(GetParam(), 0.017);
  const double length = fine.model.tables().reference_diagonal();
  const auto wave = [&](Vec3 x) { return std::sin(3 * x.x / length) + std::cos(2 * x.y / length + x.z / length); };
  std::vector<double> error;
  for (const double share : {0.12, 0.06, 0.03})
    error.push_back(transfer_error(ShapeMesh(GetParam(), share), fine, wave));
  EXPECT_LT(error[0], 0.1);
  for (int k = 0; k < 2; ++k) EXPECT_GT(std::log2(error[k] / error[k + 1]), 1.5) << error[k] << " " << error[k + 1];
  EXPECT_GT(std::log2(error[0] / error[2]) / 2, 1.75);
}

INSTANTIATE_TEST_SUITE_P(, TransferredField, testing::Values("box", "sphere", "cylinder", "torus"),
                         [](const auto& info) { return std::string(info.param); });

TEST(TransferValues, keeps_those_of_old_nodes_to_the_bit_and_all_components) {
  const std::vector<NodeStencil> stencils{{{1, 1, 1}, {1, 0, 0}}, {{0, 1, 1}, {0.25, 0.75, 0}}};
  EXPECT_EQ(transfer_values(stencils, std::vector<double>{4, 8, 0.1, 0.2}, 2),
            (std::vector<double>{0.1, 0.2, 1.075, 2.15}));
}

TEST(NodeStencils, of_a_thin_plate_do_not_see_its_other_side) {
  const ShapeMesh coarse("thin_plate", 0.2), fine("thin_plate", 0.05);
  const HoleMesh old(coarse.mesh, coarse.model.tables());
  SurfaceMesh now = fine.mesh;
  now.node_previous.assign(now.node_xyz.size(), kNone);
  for (std::size_t n = 0; n < now.node_xyz.size(); ++n)
    if (now.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex)) now.node_previous[n] = 0;
  const std::vector<NodeStencil> stencils = find_node_stencils(old, now);
  for (std::size_t n = 0; n < stencils.size(); ++n) {
    if (now.node_entity_dim[n] != static_cast<std::uint8_t>(EntityDim::kFace)) continue;
    for (int k = 0; k < 3; ++k)
      if (const NodeId o = stencils[n].n[k]; old.mesh.node_entity_dim[o] == now.node_entity_dim[n]) {
        EXPECT_EQ(old.mesh.node_entity[o], now.node_entity[n]);
      }
  }
}

}  // namespace
}  // namespace st::test
