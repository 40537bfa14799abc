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

TEST(FacetImport, gives_a_closed_model_with_its_unit) {
  const ImportResult r = import_facets(test::torus_facets(48, 24), in_metres(), "torus.stl");
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.unit, "m");
  EXPECT_NEAR(r.volume, 6 * kPi * kPi, 0.02 * r.volume);
  EXPECT_NEAR(r.area, 12 * kPi * kPi, 0.01 * r.area);
  EXPECT_FALSE(r.facets.empty());
  EXPECT_TRUE(r.brep.empty());
}

TEST(FacetImport, asks_for_a_unit_and_refuses_what_needs_cad) {
  EXPECT_ERROR(import_facets(test::cube_facets(), {}, "cube.stl"), kUsage, "--unit");
  ImportOptions options = in_metres();
  options.symmetry = "y=0";
  EXPECT_ERROR(import_facets(test::cube_facets(), options, "cube.stl"), kUsage, "--symmetry");
}

TEST(FacetImport, splits_at_the_angle_asked_for) {
  ImportOptions options = in_metres();
  EXPECT_EQ(import_facets(test::drum_facets(8, 1), options, "drum.stl").tables.n_faces(), 10);
  options.feature_deg = 50;
  EXPECT_LT(import_facets(test::drum_facets(8, 1), options, "drum.stl").tables.n_faces(), 10);
}

TEST(FacetImport, lists_what_is_open) {
  FacetInput open = test::cube_facets();
  open.corners.pop_back(), open.part.pop_back();
  ImportOptions options = in_metres();
  EXPECT_EQ(import_facets(open, options, "open.stl").n_free_edges, 3);
  options.require_closed = true;
  EXPECT_ERROR(import_facets(open, options, "open.stl"), kGeometry, "open.stl: the model is open: 3 free edges");
}

}  // namespace
}  // namespace st
