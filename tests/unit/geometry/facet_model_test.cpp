#include "geometry/facet/facet_model.h"

#include <gtest/gtest.h>

#include "geometry/facet/facet_cuts.h"
#include "geometry/facet/facet_faces.h"
#include "geometry/model/model_state.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

FacetModel model_of(const FacetInput& input) {
  FacetMesh mesh = find_smooth_faces(input, radians(40));
  cut_into_charts(mesh);
  return make_facet_model(mesh, input.part_name, radians(40));
}

TEST(FacetModel, of_a_cube_is_the_cube) {
  const FacetModel m = model_of(test::cube_facets());
  EXPECT_EQ(m.tables.n_faces(), 6);
  EXPECT_EQ(m.tables.n_edges(), 12);
  EXPECT_EQ(m.tables.n_vertices(), 8);
  EXPECT_EQ(m.tables.n_solids, 1);
  EXPECT_NEAR(m.tables.volume.value(), 1, 1e-14);
  for (FaceId f = 0; f < 6; ++f) {
    EXPECT_EQ(m.tables.face_type[f], SurfaceType::kPlane);
    EXPECT_NEAR(m.tables.face_area[f], 1, 1e-14);
    EXPECT_NEAR(m.tables.face_width[f], 1, 1e-7);
  }
}

TEST(FacetModel, is_closed_where_the_facets_are) {
  for (const FacetInput& in :
       {test::cube_facets(), test::sphere_facets(16), test::torus_facets(40, 20), test::drum_facets(40, 5)}) {
    const FacetModel m = model_of(in);
    EXPECT_TRUE(is_closed(m.tables, report_edge_uses(m.tables)));
  }
  FacetInput open = test::cube_facets();
  open.corners.pop_back(), open.part.pop_back();
  const FacetModel m = model_of(open);
  EXPECT_EQ(report_edge_uses(m.tables).n_free, 3);
  EXPECT_EQ(m.tables.n_solids, 0);
  EXPECT_FALSE(m.tables.volume);
}

// Edges, trimming curves and surfaces agree all along.
TEST(FacetModel, has_edges_on_its_faces) {
  for (const FacetInput& in : {test::sphere_facets(16), test::torus_facets(40, 20), test::drum_facets(40, 5)}) {
    FacetModel made = model_of(in);
    const Model model(std::move(made.tables), std::move(made.shape));
    const ModelTables& t = model.tables();
    for (FaceId f = 0; f < t.n_faces(); ++f) {
      const auto surface = model.surface(f);
      for (const CoedgeId c : t.coedges(f)) {
        const auto curve = model.curve(t.coedge_edge[c]);
        const auto trace = model.pcurve(f, c);
        for (int k = 0; k <= 20; ++k) {
          const double at = curve->t_max() * k / 20;
          EXPECT_LE(distance(surface->point(trace->point(at)), curve->point(at)), 1e-12);
        }
      }
    }
  }
}

TEST(FacetModel, has_loops_that_hang_together) {
  const ModelTables t = model_of(test::drum_facets(40, 5)).tables;
  for (LoopId l = 0; l < t.n_loops(); ++l) {
    const auto end_of = [&](CoedgeId c, bool at_head) {
      return t.edge_vertices[2 * t.coedge_edge[c] + ((t.coedge_is_reversed[c] != 0) != at_head ? 1 : 0)];
    };
    const IdRange own = t.loop_coedges(l);
    for (const CoedgeId c : own) {
      const CoedgeId next = c + 1 < own.first() + own.size() ? c + 1 : own.first();
      EXPECT_EQ(end_of(c, true), end_of(next, false));
    }
  }
}

TEST(FacetModel, has_planes_through_all_nodes_of_their_faces) {
  const FacetInput strip = test::grid_facets(4, 2000, [](int i, int j) {  // of single precision, as an STL file has it
    const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    return Vec3{rounded(6.65 + 5e-5 * j), rounded(0.11 + 8e-4 * j), rounded(0.28 + 4e-4 * i)};
  });
  FacetModel made = model_of(strip);
  ASSERT_EQ(made.tables.n_faces(), 1);
  ASSERT_EQ(made.tables.face_type[0], SurfaceType::kPlane);
  const Chart chart = made.shape.chart(0);
  const Model model(std::move(made.tables), std::move(made.shape));
  const auto surface = model.surface(0);
  for (std::size_t n = 0; n < chart.x.size(); ++n)
    ASSERT_LE(distance(surface->point(chart.uv[n]), chart.x[n]), 2e-6) << n;
}

// The normals of a closed skin add up to nothing, so that all nodes are in every plane across them.
TEST(FacetModel, takes_the_skin_of_a_wing_for_no_plane) {
  const FacetModel m = model_of(test::grid_facets(64, 3, [](int i, int j) {
    const int k = i % 64 <= 32 ? 32 - i % 64 : i % 64 - 32;  // from the trailing edge to the nose and back
    const int height = k * (32 - k);
    return Vec3{k * k / 1024.0, 1.0 * j, (i % 64 < 32 ? -height : height) / 256.0};  // sums of these are exact
  }));
  ASSERT_EQ(m.tables.n_faces(), 1);
  EXPECT_EQ(m.tables.face_type[0], SurfaceType::kOther);
}

TEST(FacetModel, has_groups_by_the_names_of_parts) {
  FacetInput in = test::cube_facets();
  in.part_name = {"body", "inlet", ""};
  in.part[0] = in.part[1] = 1;
  in.part[2] = in.part[3] = 2;
  const FaceLabels labels = model_of(in).tables.labels;
  EXPECT_EQ(labels.group_name, (std::vector<std::string>{"inlet", "default", "body"}));
  EXPECT_EQ(labels.face_name[0], "inlet");
}

}  // namespace
}  // namespace st
