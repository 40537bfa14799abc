#include "geometry/model/passed_vertices.h"

#include <gtest/gtest.h>

#include <numeric>

#include "unit/geometry/joined_models.h"

namespace st {
namespace {

std::vector<VertexId> passed_of(const ImportResult& cad, bool must_end) {
  const Model model(cad.tables, cad.brep);
  const Composites composites = find_composites(model, test::curved_request(model)).composites;
  std::vector<FaceId> part_of(static_cast<std::size_t>(cad.tables.n_faces()));
  std::iota(part_of.begin(), part_of.end(), 0);
  for (const FaceId f : composites.member) part_of[f] = composites.member[0];
  const std::vector<std::uint8_t> ends(static_cast<std::size_t>(cad.tables.n_vertices()), must_end ? 1 : 0);
  return find_passed_vertices(model, composites.joined_edges, part_of, ends);
}

TEST(PassedVertices, are_where_joined_edges_ended_on_a_rim) {
  const ImportResult cad = test::import_shape("wing_of_8");
  EXPECT_EQ(passed_of(cad, false).size(), 7u);  // three on each tip, one on the trailing edge
  EXPECT_TRUE(passed_of(cad, true).empty());
}

TEST(PassedVertices, are_not_beside_edges_with_a_name) {
  ImportResult cad = test::import_shape("wing_of_8");
  for (std::string& name : cad.tables.edge_name) name = "kept";
  EXPECT_TRUE(passed_of(cad, false).empty());
}

}  // namespace
}  // namespace st
