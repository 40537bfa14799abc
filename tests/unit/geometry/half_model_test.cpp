// import_model() with a symmetry plane and a far field.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

ImportResult import_domain(const std::string& shape, const std::string& symmetry, const std::string& farfield) {
  const TemporaryDirectory dir;
  test::write_brep(shape, dir / "model.brep");
  ImportOptions options;
  options.air.symmetry = symmetry;
  options.air.farfield = farfield;
  return import_model(dir / "model.brep", options);
}

std::string middle_of(const std::string& shape) {
  const Box3 box = test::import_shape(shape).tables.box();
  return "y=" + std::to_string(box.center().y);
}

double area_of_role(const ModelTables& t, const std::string& role) {
  double area = 0;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (t.labels.group_role[t.labels.face_group[f]] == role) area += t.face_area[f];
  return area;
}

struct DomainCase {
  std::string shape, farfield;
};

class FlowDomain : public testing::TestWithParam<DomainCase> {};

TEST_P(FlowDomain, full_one_is_the_outer_volume_without_the_body) {
  const auto& [shape, farfield] = GetParam();
  const ImportResult body = test::import_shape(shape), fluid = import_domain(shape, "", farfield);
  const double r = 3 * body.tables.box().diagonal();
  const double outer = farfield[0] == 'b' ? 8 * r * r * r : 4 * M_PI / 3 * r * r * r;
  EXPECT_TRUE(fluid.is_closed);
  EXPECT_EQ(fluid.tables.n_solids, 1);
  EXPECT_NEAR(fluid.volume, outer - body.volume, 1e-5 * outer);
  EXPECT_NEAR(area_of_role(fluid.tables, "wall"), body.area, 1e-6 * body.area);
  for (FaceId f = 0; f < body.tables.n_faces(); ++f) {
    EXPECT_NE(fluid.tables.face_is_reversed[f], body.tables.face_is_reversed[f])
        << "normals of the fluid point into the body";
    EXPECT_NEAR(fluid.tables.face_area[f], body.tables.face_area[f], 1e-9 * body.area)
        << "face " << f + 1 << " is another one";
  }
}

TEST_P(FlowDomain, half_one_has_half_the_walls_and_a_plane_with_the_section_cut_out) {
  const auto& [shape, farfield] = GetParam();
  const ImportResult body = test::import_shape(shape), half_body = import_domain(shape, middle_of(shape), ""),
                     fluid = import_domain(shape, middle_of(shape), farfield);
  const double r = 3 * body.tables.box().diagonal();
  const double plane = farfield[0] == 'b' ? 4 * r * r : M_PI * r * r;
  EXPECT_TRUE(half_body.is_closed && fluid.is_closed);
  EXPECT_NEAR(half_body.volume, body.volume / 2, 2e-5 * body.volume);
  EXPECT_EQ(fluid.tables.n_solids, 1);
  EXPECT_NEAR(area_of_role(fluid.tables, "wall"), area_of_role(half_body.tables, "wall"), 1e-6 * body.area);
  EXPECT_NEAR(area_of_role(fluid.tables, "wall"), body.area / 2, 1e-5 * body.area);
  EXPECT_NEAR(area_of_role(fluid.tables, "symmetry"), plane - area_of_role(half_body.tables, "symmetry"), 1e-5 * plane);
  EXPECT_GT(area_of_role(half_body.tables, "symmetry"), 0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FlowDomain,
                         testing::Values(DomainCase{"sphere", "box:3"}, DomainCase{"box", "sphere:3"},
                                         DomainCase{"torus", "sphere:3"}, DomainCase{"two_boxes", "box:3"},
                                         DomainCase{"cylinder", "box:3"}),
                         [](const auto& i) { return i.param.shape; });

TEST(HalfModel, that_was_cut_before_is_taken_as_it_is) {
  const ImportResult box = test::import_shape("box");
  const ImportResult taken = import_domain("box", "y=" + std::to_string(box.tables.box().lo.y), "");
  EXPECT_EQ(taken.tables.n_faces(), 6);
  EXPECT_NEAR(taken.volume, box.volume, 1e-9 * box.volume);
  EXPECT_GT(area_of_role(taken.tables, "symmetry"), 0);
}

TEST(HalfModel, keeps_the_side_that_was_asked_for) {
  const double middle = test::import_shape("sphere").tables.box().center().y;
  EXPECT_LE(import_domain("sphere", middle_of("sphere") + "-", "").tables.box().hi.y, middle + 1e-4);
  EXPECT_GE(import_domain("sphere", middle_of("sphere") + "+", "").tables.box().lo.y, middle - 1e-4);
}

void expect_error(ExitCode code, const std::string& says, const std::string& shape, const std::string& symmetry,
                  const std::string& farfield) {
  try {
    import_domain(shape, symmetry, farfield);
    ADD_FAILURE() << shape << " was taken with " << symmetry << " " << farfield;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
  }
}

/// Whole, or only as much of it as the outer one leaves: there is no flow inside a body.
TEST(HalfModel, bodies_inside_others_are_no_walls_of_the_fluid) {
  const ImportResult fluid = import_domain("nested_boxes", "", "box:3"),
                     alone = import_domain("box_of_60", "", "box:3");
  EXPECT_EQ(fluid.tables.n_faces(), 12);
  EXPECT_NEAR(fluid.volume, alone.volume, 1e-9 * alone.volume);
  EXPECT_EQ(std::count_if(fluid.findings.begin(), fluid.findings.end(),
                          [](const ImportFinding& f) { return f.kind == FindingKind::kInnerBodyLeftOut; }),
            2);
}

TEST(HalfModel, open_elsewhere_or_away_from_the_plane_is_an_error_with_places) {
  expect_error(ExitCode::kGeometry, "free edges at (", "wave", "", "box:10");
  expect_error(ExitCode::kGeometry, "free edges at (", "wave", "z=-1000", "box:10");
  expect_error(ExitCode::kGeometry, "does not touch", "box", "y=-1000", "");
  expect_error(ExitCode::kGeometry, "other side", "box", "y=-1000-", "");
}

/// The plane x=14 touches the hole of the torus: its section is a figure of eight.
TEST(HalfModel, is_whole_where_the_section_touches_itself) {
  for (const char* side : {"", "-"}) {
    const ImportResult beside = import_domain("torus", std::string("x=13.999") + side, ""),
                       touching = import_domain("torus", std::string("x=14") + side, "");
    EXPECT_TRUE(touching.is_closed);
    EXPECT_NEAR(touching.volume, beside.volume, 1e-3 * beside.volume);
    EXPECT_NEAR(touching.area, beside.area, 1e-3 * beside.area);
  }
}

TEST(HalfModel, wrong_values_are_usage_errors) {
  for (const char* bad : {"y", "y=", "w=0", "y=0x", "y=+-", "y=nan", "=0"})
    expect_error(ExitCode::kUsage, "--symmetry", "box", bad, "");
  for (const char* bad : {"box", "box:", "box:0.5", "ball:20", "sphere:1e9", "box:20x", ":3"})
    expect_error(ExitCode::kUsage, "--farfield", "box", "", bad);
}

ImportResult import_half(const std::string& shape, const std::string& symmetry, const std::string& farfield = "",
                         bool unite = false) {
  ImportOptions options;
  options.air.symmetry = symmetry;
  options.air.farfield = farfield;
  options.unite = unite;
  return test::import_broken(shape, options);
}

/// The plane would have a hole where there is material, or faces on each other.
TEST(HalfModel, of_a_solid_inside_a_solid_is_refused_unless_they_are_united) {
  EXPECT_ERROR(import_half("box_in_box", "y=0"), kGeometry, "lies inside");
  const ImportResult united = import_half("box_in_box", "y=0", "", true);
  EXPECT_NEAR(united.volume, 0.5 * 60 * 60 * 60, 1e-6 * 60 * 60 * 60);
  EXPECT_NEAR(area_of_role(united.tables, "symmetry"), 60 * 60, 1e-6);
}

TEST(HalfModel, keeps_the_cavity_of_a_solid_open) {
  const ImportResult half = import_half("housing", "y=0");
  EXPECT_NEAR(area_of_role(half.tables, "symmetry"), 40 * 40 - 30 * 30, 1e-6);
  EXPECT_NEAR(half.volume, 0.5 * (40 * 40 * 40 - 30 * 30 * 30), 1e-4);
}

TEST(HalfModel, of_solids_that_touch_closes_each_of_them) {
  const ImportResult half = import_half("touching_boxes", "z=5");
  EXPECT_TRUE(half.is_closed);
  EXPECT_EQ(half.tables.n_solids, 2);
}

}  // namespace
}  // namespace st
