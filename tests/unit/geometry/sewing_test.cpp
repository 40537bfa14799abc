// Faces that share no edges are joined; nothing else is.
#include <gtest/gtest.h>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;
using test::largest_gap;

TEST(Sewing, joins_edges_as_far_apart_as_asked_and_no_further) {
  EXPECT_EQ(import_broken("gappy_box").edge_uses.n_free, 24);
  ImportOptions options;
  options.sew = "0.01";
  EXPECT_EQ(import_broken("gappy_box", options).edge_uses.n_free, 24);
  options.sew = "0.15";
  const ImportResult r = import_broken("gappy_box", options);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_NEAR(r.volume, 48000, 0.005 * 48000);
  EXPECT_EQ(findings_of(r, "sewn").size(), 1u);
  options.unit = "in";
  options.sew = "0.5%";
  EXPECT_TRUE(import_broken("gappy_box", options).is_closed);
}

TEST(Sewing, leaves_no_tolerance_as_long_as_the_edge_where_partners_run_at_different_speeds) {
  const ImportResult r = import_broken("speeds");
  EXPECT_EQ(r.edge_uses.n_free, 6);
  EXPECT_EQ(findings_of(r, "sewn").size(), 1u);
  for (double tolerance : r.tables.edge_tolerance) EXPECT_LE(tolerance, 1e-3);
  const Model model(r.tables, r.brep);
  for (FaceId f = 0; f < 2; ++f) EXPECT_LE(largest_gap(model, f), 1e-3) << f;
}

TEST(Sewing, says_how_many_edges_were_free_before_and_after) {
  const ImportResult r = test::import_shape("loose_box");
  const auto found = findings_of(r, "sewn: 24 free edges before, 0 after");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_repair);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_edges(), 12);
  EXPECT_EQ(r.tables.n_vertices(), 8);
}

TEST(Sewing, joins_both_halves_of_a_rim) {
  const TemporaryDirectory dir;
  test::write_iges("ball_with_bore", dir / "a.igs");
  const ImportResult r = import_model(dir / "a.igs", {});
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.edge_uses.n_free, 0);
}

TEST(Sewing, takes_the_smallest_tolerance_that_closes_the_model) {
  const ImportResult exact = test::import_shape("loose_box");
  EXPECT_LE(findings_of(exact, "sewn").at(0).size, 1.01e-6 * exact.tables.box().diagonal());
  ImportOptions options;
  options.sew = "5";
  EXPECT_LT(import_broken("gappy_box", options).tables.box().diagonal(), 76);
  const ImportResult gappy = import_broken("gappy_box");
  EXPECT_TRUE(findings_of(gappy, "sewn").empty()) << "gaps of 0.02 and more are not closed unless asked for";
}

TEST(Sewing, joins_more_the_more_it_may) {
  int last = 24;
  for (const char* largest : {"0.005", "0.03", "0.05", "0.15"}) {
    ImportOptions options;
    options.sew = largest;
    const ImportResult r = import_broken("gappy_box", options);
    EXPECT_LE(r.edge_uses.n_free, last) << largest;
    EXPECT_EQ(r.tables.n_faces(), 6) << largest;
    if (r.edge_uses.n_free < 24) {
      EXPECT_EQ(findings_of(r, "sewn: 24 free edges before, " + std::to_string(r.edge_uses.n_free) + " after").size(),
                1u)
          << largest;
    }
    last = r.edge_uses.n_free;
  }
  EXPECT_EQ(last, 0);
}

TEST(Sewing, moves_no_vertex_farther_than_the_gap) {
  const ImportResult exact = test::import_shape("loose_box");
  const Box3 box = exact.tables.box();
  const auto off_corner = [&](Vec3 x) {
    const auto off = [](double lo, double hi, double at) { return std::min(std::abs(at - lo), std::abs(at - hi)); };
    return norm(Vec3{off(box.lo.x, box.hi.x, x.x), off(box.lo.y, box.hi.y, x.y), off(box.lo.z, box.hi.z, x.z)});
  };
  for (const Vec3 x : exact.tables.vertex_xyz) EXPECT_LE(off_corner(x), 1e-6);
  EXPECT_NEAR(exact.area, 8800, 1e-6);
  EXPECT_NEAR(exact.volume, 48000, 1e-6);
}

TEST(Sewing, keeps_faces_with_their_names_in_their_order) {
  const TemporaryDirectory dir;
  test::write_named_loose_box(dir / "box.step");
  const ImportResult r = import_model(dir / "box.step", {});
  ASSERT_TRUE(r.is_closed);
  ASSERT_EQ(r.tables.n_faces(), 6);
  const Box3 box = r.tables.box();
  const Vec3 middle = box.center();
  std::vector<std::string> names;
  for (FaceId f = 0; f < 6; ++f) {
    const Vec3 at = r.tables.face_box[f].center();
    const std::string name = r.tables.labels.group_name[r.tables.labels.face_group[f]];
    names.push_back(name);
    const double expected = name[0] == 'x' ? at.x - middle.x : name[0] == 'y' ? at.y - middle.y : at.z - middle.z;
    EXPECT_GT(name.substr(1) == "_max" ? expected : -expected, 1) << name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"}));
}

TEST(Sewing, does_not_touch_what_is_closed_or_open_by_right) {
  for (const char* shape : {"box", "cylinder", "sphere", "torus", "drilled_block", "two_boxes"}) {
    const ImportResult r = test::import_shape(shape);
    EXPECT_EQ(r.edge_uses.n_free, 0) << shape;
    EXPECT_TRUE(findings_of(r, "sewn").empty()) << shape;
  }
  const ImportResult sheet = test::import_shape("square");
  EXPECT_EQ(sheet.edge_uses.n_free, 4);
  EXPECT_TRUE(findings_of(sheet, "sewn").empty());
}

}  // namespace
}  // namespace st
