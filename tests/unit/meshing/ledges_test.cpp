#include "meshing/topology/ledges.h"

#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

std::vector<Strip> ledges(const char* shape, double size) {
  const Model model = make_model(shape);
  const std::vector<MergeLimit> limits(static_cast<std::size_t>(model.tables().n_faces()), MergeLimit{0.05, 0, 0});
  return find_ledges(model, UniformField(size), limits);
}

TEST(Ledges, have_a_strip_for_each_pair_of_edges_beside_each_other) {
  const Model model = make_model("ledge_in_hole");
  const ModelTables& t = model.tables();
  const std::vector<Strip> strips = ledges("ledge_in_hole", 1);
  ASSERT_EQ(strips.size(), 4u);
  for (const Strip& s : strips) {
    EXPECT_EQ(s.face, strips[0].face);
    for (const std::size_t k : {0, 1}) {
      const Vec3
          a = t.vertex_xyz[t.edge_vertices[2 * static_cast<std::size_t>(s.edges[0]) + k]],
          b = t.vertex_xyz[t.edge_vertices[2 * static_cast<std::size_t>(s.edges[1]) + (s.is_opposed ? 1 - k : k)]];
      EXPECT_NEAR(distance(a, b), 0.02 * std::sqrt(2.0), 1e-9);
    }
  }
}

TEST(Ledges, are_narrower_than_the_limit_all_around) { EXPECT_TRUE(ledges("ledge_in_hole", 0.5).empty()); }

TEST(Ledges, are_no_ends_of_walls) { EXPECT_TRUE(ledges("square_pipe", 1).empty()); }

}  // namespace
}  // namespace st::test
