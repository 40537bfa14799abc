// FLITE files through import_model().
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "support/shapes.h"
#include "unit/geometry/flite_models.h"

namespace st {
namespace {

ImportResult import_file(const FliteFile& file) {
  const TemporaryDirectory dir;
  return import_model(test::write_text(dir, flite_text(file)), {});
}

void expect_refused(const FliteFile& file, const std::string& why) {
  try {
    import_file(file);
    ADD_FAILURE() << "not refused: " << why;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kInput);
    EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
  }
}

double max_edge_tolerance(const ModelTables& t) {
  return *std::max_element(t.edge_tolerance.begin(), t.edge_tolerance.end());
}

/// The box with every number rounded to seven digits away from where it was.
FliteFile rounded_box() {
  FliteFile file = test::box_file();
  int k = 0;
  for (FliteCurve& c : file.curves)
    for (Vec3& p : c.points) p = {p.x + 1e-7 * (++k % 3), p.y - 1e-7 * (k % 5), p.z + 1e-7 * (k % 2)};
  return file;
}

TEST(FliteReader, makes_a_closed_box_of_shared_edges_whatever_the_order_of_its_segments) {
  for (const auto& [n, m] : {std::pair(2, 2), std::pair(3, 4), std::pair(2, 5)}) {
    const ImportResult r = import_file(test::box_file(n, m));
    EXPECT_EQ(r.format, "FLITE");
    EXPECT_TRUE(r.is_closed);
    EXPECT_EQ(r.tables.n_faces(), 6);
    EXPECT_EQ(r.tables.n_edges(), 12);
    EXPECT_EQ(r.tables.n_vertices(), 8);
    EXPECT_EQ(r.tables.n_solids, 1);
    EXPECT_NEAR(r.area, 6, 1e-9);
    EXPECT_NEAR(r.volume, 1, 1e-9);
    EXPECT_LE(max_edge_tolerance(r.tables), 1e-6);
    EXPECT_EQ(r.tables.labels.face_name[4], "region 5");
    EXPECT_TRUE(r.tables.unit.empty());
  }
}

TEST(FliteReader, joins_ends_that_seven_digits_keep_apart) {
  const ImportResult r = import_file(rounded_box());
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_vertices(), 8);
  EXPECT_NEAR(r.volume, 1, 1e-5);
}

TEST(FliteReader, finds_out_which_count_of_a_grid_runs_fastest) {
  FliteFile file = test::box_file(3, 5);
  for (FliteSurface& s : file.surfaces) std::swap(s.n_first, s.n_second);
  const ImportResult r = import_file(file);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, 6, 1e-9);
  EXPECT_LE(max_edge_tolerance(r.tables), 1e-6);
}

/// The box with a disc cut out of the face z = 0 by two half circles, left open.
FliteFile box_with_hole() {
  FliteFile file = test::box_file();
  for (int half = 0; half < 2; ++half) {
    const int id = 13 + half;
    FliteCurve c{id, 0, {}};
    for (int k = 0; k <= 16; ++k)
      c.points.push_back(
          {0.5 + 0.3 * std::cos(kPi * (half + k / 16.0)), 0.5 + 0.3 * std::sin(kPi * (half + k / 16.0)), 0});
    file.curves.push_back(c);
    file.segments.push_back({id, 0, id - 1});
    file.regions[4].segments.insert(file.regions[4].segments.begin() + 1, id - 1);
  }
  return file;
}

TEST(FliteReader, takes_several_loops_of_a_region) {
  const ImportResult r = import_file(box_with_hole());
  EXPECT_EQ(r.tables.face_loop_offsets[5] - r.tables.face_loop_offsets[4], 2);
  EXPECT_EQ(r.edge_uses.n_free, 2);
  EXPECT_NEAR(r.tables.face_area[4], 1 - 0.09 * kPi, 1e-4);
}

/// An eighth of the unit sphere, one side of its grid the pole; `with_point`: the pole is a segment of its own.
FliteFile octant(bool with_point) {
  FliteFile file;
  const auto at = [](double longitude, double latitude) {
    return Vec3{std::cos(longitude) * std::cos(latitude), std::sin(longitude) * std::cos(latitude), std::sin(latitude)};
  };
  constexpr int kN = 17;
  const auto a = [](int i) { return 0.5 * kPi * i / (kN - 1); };
  FliteSurface surface{1, 0, kN, kN, {}};
  for (int j = 0; j < kN; ++j)
    for (int i = 0; i < kN; ++i) surface.points.push_back(j == kN - 1 ? Vec3{0, 0, 1} : at(a(i), a(j)));
  file.surfaces = {surface};
  for (int side = 0; side < (with_point ? 4 : 3); ++side) {
    FliteCurve c{side + 1, 0, {}};
    for (int k = 0; k < kN; ++k)
      c.points.push_back(side == 0   ? at(a(k), 0)
                         : side == 3 ? Vec3{0, 0, 1}
                                     : surface.points[k * kN + (side == 1 ? kN - 1 : 0)]);
    file.curves.push_back(c);
    file.segments.push_back({side + 1, 0, side});
  }
  file.regions = {{1, 0, 0, {0, 1, 2}}};
  if (with_point) file.regions[0].segments = {2, 3, 0, 1};
  return file;
}

TEST(FliteReader, gives_a_collapsed_side_its_pole) {
  for (const bool with_point : {false, true}) {
    const ImportResult r = import_file(octant(with_point));
    EXPECT_EQ(std::count(r.tables.edge_is_degenerate.begin(), r.tables.edge_is_degenerate.end(), 1), 1) << with_point;
    EXPECT_EQ(r.edge_uses.n_free, 3);
    EXPECT_NEAR(r.area, 0.5 * kPi, 2e-4);
  }
}

TEST(FliteReader, refuses_segments_that_close_no_loop) {
  FliteFile file = test::box_file();
  file.regions[1].segments.pop_back();
  expect_refused(file, "region 2: its segments close no loop: segment ");
}

TEST(FliteReader, refuses_segments_off_the_surface_of_their_region) {
  FliteFile file = test::box_file();
  for (Vec3& p : file.surfaces[3].points) p.y += 0.5;
  expect_refused(file, "off surface 4 at (");
}

TEST(FliteReader, closes_small_gaps_between_ends_and_says_so_in_the_tolerance) {
  FliteFile file = test::box_file();
  file.curves[0].points[0] += {0, 0.001, 0};
  const ImportResult r = import_file(file);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_vertices(), 8);
  EXPECT_GE(*std::max_element(r.tables.vertex_tolerance.begin(), r.tables.vertex_tolerance.end()), 0.0005);
}

TEST(FliteReader, leaves_a_step_file_called_dat_to_the_step_reader) {
  const TemporaryDirectory dir;
  test::write_step("box", dir / "model.dat", "MM");
  EXPECT_EQ(import_model(dir / "model.dat", {}).format, "STEP");
}

TEST(FliteReader, reads_the_files_of_the_corpus) {
  const char* corpus = std::getenv("ST_CORPUS");
  const std::string folder = corpus ? corpus : "";
  if (!std::filesystem::exists(folder + "/flite_zju_cylinders.fli")) GTEST_SKIP() << "LOUD: no corpus; set ST_CORPUS";
  const ImportResult cylinders = import_model(folder + "/flite_zju_cylinders.fli", {}),
                     trefoil = import_model(folder + "/flite_zju_trefoil.fli", {});
  EXPECT_TRUE(cylinders.is_closed && trefoil.is_closed);
  EXPECT_EQ(cylinders.tables.n_faces(), 8);
  EXPECT_EQ(cylinders.tables.n_edges(), 18);
  EXPECT_NEAR(cylinders.volume, 100 - 0.5 * kPi, 1e-3);  // a box of 10 x 2 x 5 without a cylinder of radius 0.5
  EXPECT_EQ(trefoil.tables.n_faces(), 30);
  EXPECT_EQ(trefoil.tables.n_edges(), 60);
  EXPECT_LE(max_edge_tolerance(trefoil.tables), 1e-5);
}

}  // namespace
}  // namespace st
