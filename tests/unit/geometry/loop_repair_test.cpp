// Loops of curved faces that a reader has lost in (u,v).
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;
using test::largest_gap;

/// Volume of the pin of broken_shapes.cpp: its rounded end by Simpson's rule along the cubic, its shaft.
double pin_volume() {
  constexpr int n = 2000;
  double end = 0;
  for (int k = 0; k < n; ++k) {
    const auto radius = [](double t) { return 0.8 + 1.98 * t - 0.36 * t * t - 0.42 * t * t * t; };
    const auto height = [](double t) { return 1.62 * t * t - 0.42 * t * t * t; };
    const double a = double(k) / n, b = double(k + 1) / n, r = radius(0.5 * (a + b));
    end += kPi * r * r * (height(b) - height(a));
  }
  return end + kPi * 4 * 8.8;
}

TEST(LoopRepair, rebuilds_loops_that_are_at_another_place_of_the_surface) {
  const ImportResult r = import_broken("lost_fillet");
  const auto found = findings_of(r, "loops rebuilt from their edges");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.volume, pin_volume(), 1e-4);
  const Model model(r.tables, r.brep);
  for (FaceId f = 0; f < r.tables.n_faces(); ++f) EXPECT_LE(largest_gap(model, f), 1e-6) << f;
  for (double tolerance : r.tables.vertex_tolerance) EXPECT_LE(tolerance, 1e-5);
}

TEST(LoopRepair, names_the_face_and_its_place) {
  const ImportResult r = import_broken("lost_fillet");
  const auto found = findings_of(r, "loops rebuilt from their edges");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_repair);
  EXPECT_GT(found[0].size, 1);
  EXPECT_LT(found[0].size, 10);
}

TEST(LoopRepair, leaves_loops_that_are_where_they_should_be) {
  for (const char* shape :
       {"sphere", "cone", "cone_side", "torus", "drilled_cylinder", "mirrored_cylinder", "sphere_octant", "wave",
        "periodic_tube", "closed_tube", "tube_window", "rational_torus", "revolution", "extrusion", "kinked"})
    EXPECT_TRUE(findings_of(test::import_shape(shape), "loops rebuilt from").empty()) << shape;
}

TEST(LoopRepair, leaves_a_trimming_curve_that_is_only_inaccurate_to_others) {
  EXPECT_TRUE(findings_of(import_broken("off_pcurve"), "loops rebuilt from").empty());
  EXPECT_TRUE(findings_of(import_broken("off_meridian"), "loops rebuilt from").empty());
}

TEST(LoopRepair, leaves_a_face_whose_edges_are_not_on_its_surface) {
  const ImportResult r = import_broken("edges_elsewhere");
  EXPECT_TRUE(findings_of(r, "loops rebuilt from").empty());
  EXPECT_EQ(r.tables.n_faces(), 1);
}

TEST(LoopRepair, gives_the_loops_the_direction_and_the_extent_of_the_face) {
  const ImportResult r = import_broken("lost_fillet");
  const Model model(r.tables, r.brep);
  double area = 0;
  for (FaceId f = 0; f < r.tables.n_faces(); ++f) {
    EXPECT_GT(r.tables.face_area[f], 0);
    area += r.tables.face_area[f];
    EXPECT_LE(r.tables.face_uv_bounds[4 * f + 1] - r.tables.face_uv_bounds[4 * f], 2 * kPi + 1e-6)
        << "one turn, not two";
  }
  EXPECT_NEAR(area, r.area, 1e-9 * area);
}

/// Vertices of a STEP file with three digits after the point: they lie aside of their edges.
void round_vertices(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  const std::string from = text.str();
  std::set<std::string> points;
  const std::regex vertex("VERTEX_POINT\\('',(#[0-9]+)\\)");
  for (std::sregex_iterator m(from.begin(), from.end(), vertex), end; m != end; ++m) points.insert((*m)[1]);
  const std::regex point("(#[0-9]+) = CARTESIAN_POINT\\('',\\(([^,]*),([^,]*),([^)]*)\\)\\)");
  std::string kept, rest = from;
  for (std::smatch m; std::regex_search(rest, m, point); rest = m.suffix()) {
    kept += m.prefix();
    kept += points.contains(m[1]) ? fmt::format("{} = CARTESIAN_POINT('',({:.3f},{:.3f},{:.3f}))", m[1].str(),
                                                std::stod(m[2]), std::stod(m[3]), std::stod(m[4]))
                                  : m[0].str();
  }
  std::ofstream(path) << kept << rest;
}

TEST(LoopRepair, leaves_a_loop_around_a_pole) {
  const TemporaryDirectory dir;
  test::write_step("spline_ball_with_pit", dir / "a.step", "MM");
  round_vertices(dir / "a.step");
  const ImportResult sound = test::import_shape("spline_ball_with_pit"), r = import_model(dir / "a.step", {});
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, sound.area, 1e-3 * sound.area);
  EXPECT_NEAR(r.volume, sound.volume, 1e-3 * sound.volume);
}

}  // namespace
}  // namespace st
