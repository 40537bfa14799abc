#include "geometry/import/facet_import.h"

#include <gtest/gtest.h>

#include "unit/geometry/facet_inputs.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

ImportOptions in_metres() {
  ImportOptions options;
  options.unit = "m";
  return options;
}

ImportResult imported(FacetInput input, const ImportOptions& options, const std::string& path) {
  return import_facets(input, options, path);
}

TEST(FacetImport, gives_a_closed_model_with_its_unit) {
  const ImportResult r = imported(test::torus_facets(48, 24), in_metres(), "torus.stl");
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.unit, "m");
  EXPECT_NEAR(r.volume, 6 * kPi * kPi, 0.02 * r.volume);
  EXPECT_NEAR(r.area, 12 * kPi * kPi, 0.01 * r.area);
  EXPECT_FALSE(r.facets.empty());
  EXPECT_TRUE(r.brep.empty());
}

TEST(FacetImport, asks_for_a_unit_and_refuses_what_needs_cad) {
  EXPECT_ERROR(imported(test::cube_facets(), {}, "cube.stl"), kUsage, "--unit");
  ImportOptions options = in_metres();
  options.unite = true;
  EXPECT_ERROR(imported(test::cube_facets(), options, "cube.stl"), kUsage, "--unite");
}

TEST(FacetImport, refuses_a_node_in_the_far_distance) {
  FacetInput stray = test::torus_facets(48, 24);
  stray.x[7].z = 1e30;
  EXPECT_ERROR(imported(stray, in_metres(), "torus.stl"), kGeometry, "torus.stl: node 8 has a point");
}

TEST(FacetImport, puts_half_a_body_into_its_air) {
  ImportOptions options = in_metres();
  options.air.symmetry = "z=0", options.air.farfield = "sphere:3";
  const ImportResult r = imported(test::torus_facets(48, 24), options, "torus.stl");
  EXPECT_TRUE(r.is_closed);
  const FaceLabels& labels = r.tables.labels;
  EXPECT_EQ(labels.group_name, (std::vector<std::string>{"default", "symmetry", "farfield"}));
  EXPECT_EQ(labels.group_role, (std::vector<std::string>{"wall", "symmetry", "farfield"}));
  EXPECT_NEAR(r.tables.reference_diagonal(), std::sqrt(8 * 8 + 8 * 8 + 1), 1e-9);
  EXPECT_LT(r.tables.vertex_tolerance[0], 1e-6);  // that of the body's coordinates
  FacetInput named = test::cube_facets();
  named.part_name = {"farfield"};
  EXPECT_ERROR(imported(named, options, "cube.stl"), kUsage, "is a far field already");
  options.air.farfield = "cube:3";
  EXPECT_ERROR(imported(test::cube_facets(), options, "cube.stl"), kUsage, "--farfield");
}

TEST(FacetImport, splits_at_the_angle_asked_for) {
  ImportOptions options = in_metres();
  EXPECT_EQ(imported(test::drum_facets(8, 1), options, "drum.stl").tables.n_faces(), 10);
  options.feature_deg = 50;
  EXPECT_LT(imported(test::drum_facets(8, 1), options, "drum.stl").tables.n_faces(), 10);
}

TEST(FacetImport, takes_noise_away_where_it_is_asked_to) {
  FacetInput torus = test::torus_facets(96, 48);
  for (std::size_t i = 0; i < torus.x.size(); ++i) torus.x[i].z += i % 3 == 0 ? 0.04 : -0.02;
  ImportOptions options = in_metres();
  const double rough = imported(torus, options, "scan.stl").area;
  options.smooth = "1%";
  EXPECT_NEAR(imported(torus, options, "scan.stl").area, 12 * kPi * kPi, 0.2 * std::abs(rough - 12 * kPi * kPi));
  options.smooth = "10%chord";
  EXPECT_ERROR(imported(torus, options, "scan.stl"), kUsage, "--smooth");
}

TEST(FacetImport, lists_what_is_open) {
  FacetInput open = test::cube_facets();
  open.corners.pop_back(), open.part.pop_back();
  ImportOptions options = in_metres();
  EXPECT_EQ(imported(open, options, "open.stl").edge_uses.n_free, 3);
  options.require_closed = true;
  EXPECT_ERROR(imported(open, options, "open.stl"), kGeometry, "open.stl: the model is open: 3 free edges");
}

}  // namespace
}  // namespace st
