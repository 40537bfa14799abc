#include "geometry/model/facet_shape.h"

#include <gtest/gtest.h>

#include "geometry/facet/facet_cuts.h"
#include "geometry/facet/facet_faces.h"
#include "geometry/facet/facet_model.h"
#include "geometry/model/facets.h"
#include "unit/geometry/facet_inputs.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class ShapeOfFacets : public ::testing::Test {
 protected:
  ShapeOfFacets() {
    FacetMesh mesh = find_smooth_faces(test::drum_facets(24, 3), radians(40));
    cut_into_charts(mesh);
    made_ = make_facet_model(mesh, {""}, radians(40));
  }
  FacetModel made_;
};

TEST_F(ShapeOfFacets, fits_its_tables) {
  EXPECT_EQ(made_.shape.contradiction(made_.tables), "");
  EXPECT_EQ(made_.shape.chart(0).x.size(), static_cast<std::size_t>(made_.shape.nodes(0).size()));
}

TEST_F(ShapeOfFacets, is_refused_where_it_contradicts_its_tables) {
  const auto refused = [&](const auto& change) {
    FacetShape changed = made_.shape;
    change(changed);
    return changed.contradiction(made_.tables);
  };
  EXPECT_EQ(refused([](FacetShape& s) { s.node_uv.pop_back(); }), "nodes of its faces");
  EXPECT_EQ(refused([](FacetShape& s) { s.triangle_nodes[0][1] = 999; }), "triangles of its faces");
  EXPECT_EQ(refused([](FacetShape& s) { s.triangle_nodes[0][1] = -1; }), "triangles of its faces");
  EXPECT_EQ(refused([](FacetShape& s) { s.edge_xyz.pop_back(); }), "points of its edges");
  EXPECT_EQ(refused([](FacetShape& s) { s.coedge_nodes[0] = 999; }), "nodes of its loops");
  EXPECT_EQ(refused([](FacetShape& s) { s.coedge_node_offsets[1] -= 1; }), "nodes of its loops");
  FacetShape changed = made_.shape;
  changed.node_uv.pop_back();
  EXPECT_ERROR(Model(made_.tables, std::move(changed)), kInput, "st-import");
}

TEST_F(ShapeOfFacets, gives_its_own_facets_with_common_nodes) {
  const std::size_t n_faces = made_.tables.face_area.size(), n = made_.shape.triangle_nodes.size();
  const Model model(std::move(made_.tables), std::move(made_.shape));
  const Facets facets = make_facets(model, std::vector<std::uint8_t>(n_faces, 1), {.deflection = 1});
  EXPECT_EQ(facets.triangle.size(), n);
  for (const Corners& c : find_neighbours(facets.triangle)) EXPECT_EQ(std::count(c.begin(), c.end(), kNone), 0);
  EXPECT_TRUE(model.contacts(0, 1).empty());
}

}  // namespace
}  // namespace st
