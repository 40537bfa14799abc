// What import_model() finds wrong with a model, and what it repairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;
using test::largest_gap;

TEST(ImportRepair, turns_a_solid_that_is_inside_out) {
  const ImportResult r = import_broken("inside_out");
  EXPECT_NEAR(r.volume, 48000, 1e-6);
  EXPECT_EQ(findings_of(r, "solid inside out").size(), 1u);
  const Model model(r.tables, r.brep);
  for (FaceId f = 0; f < 6; ++f) {
    const auto s = model.surface(f);
    const Vec2 uv{0.5 * (s->u_min() + s->u_max()), 0.5 * (s->v_min() + s->v_max())};
    const double sign = r.tables.face_is_reversed[f] ? -1 : 1;
    EXPECT_GT(sign * dot(surface_normal(*s, uv), s->point(uv) - Vec3{30, 20, 10}), 0) << f;
  }
}

TEST(ImportRepair, makes_a_closed_shell_an_outward_solid) {
  const ImportResult r = import_broken("loose_shell");
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_NEAR(r.volume, 48000, 1e-6);
  EXPECT_EQ(findings_of(r, "closed shell made a solid").size(), 1u);
}

TEST(ImportRepair, makes_a_lone_closed_face_a_solid) {
  const ImportResult r = import_broken("lone_sphere");
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_NEAR(r.volume, 4000 * std::acos(-1.0) / 3, 1e-6);
}

TEST(ImportRepair, makes_shells_inside_shells_voids_and_solids_in_turn) {
  const ImportResult r = import_broken("nested_shells");
  EXPECT_EQ(r.tables.n_solids, 2);
  EXPECT_EQ(r.tables.n_shells, 3);
  EXPECT_NEAR(r.volume, 216000 - 64000 + 8000, 1e-6);
}

TEST(ImportRepair, projects_a_trimming_curve_that_leaves_its_edge) {
  const ImportResult r = import_broken("off_pcurve");
  const auto found = findings_of(r, "trimming curve off its edge, projected again");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(found[0].size, 0.1);
  EXPECT_LE(largest_gap(Model(r.tables, r.brep), 0), 1e-5);
  for (double tolerance : r.tables.edge_tolerance) EXPECT_LE(tolerance, 1e-5);
}

TEST(ImportRepair, makes_slits_of_edges_inside_a_face_on_which_others_end) {
  const ImportResult r = test::import_shape("baffled_box");
  ASSERT_EQ(findings_of(r, "edges inside, on which other faces end").size(), 1u);
  const ModelTables& t = r.tables;
  ASSERT_EQ(t.n_faces(), 7);
  EXPECT_NEAR(r.area, 616, 1e-6);
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  int n_rims = 0;
  for (EdgeId e = 0; e < t.n_edges(); ++e) n_rims += offsets[e + 1] - offsets[e] == 3;
  EXPECT_EQ(n_rims, 1);
  EXPECT_EQ(r.edge_uses.n_free, 3);
}

TEST(ImportRepair, keeps_the_period_and_the_pole_of_a_trimming_curve_projected_again) {
  const ImportResult r = import_broken("off_meridian");
  ASSERT_EQ(findings_of(r, "trimming curve off its edge, projected again").size(), 2u);
  EXPECT_EQ(r.tables.n_coedges(), 4);  // the pole among them
  EXPECT_NEAR(r.area, 50 * kPi, 1e-4);
  EXPECT_NEAR(r.tables.face_uv_bounds[1] - r.tables.face_uv_bounds[0], 0.5 * kPi, 1e-6);
  EXPECT_LE(largest_gap(Model(r.tables, r.brep), 0), 1e-5);
}

TEST(ImportRepair, bounds_a_face_without_loops) {
  const ImportResult r = import_broken("bare_sphere");
  EXPECT_EQ(r.tables.n_loops(), 1);
  EXPECT_NEAR(r.area, 400 * kPi, 1e-3);
  EXPECT_GE(r.n_repairs(), 1);
}

TEST(ImportRepair, bounds_a_ring_whose_loop_encloses_nothing) {
  const ImportResult r = import_broken("ring");
  EXPECT_EQ(findings_of(r, "ring without bounds").size(), 1u);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, 80 * kPi * kPi, 1e-3);
  EXPECT_NEAR(r.volume, 80 * kPi * kPi, 1e-3);
  EXPECT_TRUE(findings_of(test::import_shape("torus"), "ring").empty());
}

TEST(ImportReport, lists_a_loop_that_crosses_itself_with_its_place) {
  const auto found = findings_of(import_broken("bow_tie"), "loop crosses");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LE(distance(found[0].xyz, {5, 5, 0}), 1e-9);
  EXPECT_FALSE(found[0].is_repair);
  EXPECT_TRUE(findings_of(test::import_shape("plate_with_hole"), "loop crosses").empty());
}

TEST(ImportReport, lists_vertices_whose_edges_end_elsewhere) {
  const auto found = findings_of(import_broken("parted_corner"), "edges end away from their vertex");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LE(distance(found[0].xyz, {9.75, 9.75, 0}), 1e-9);
  EXPECT_NEAR(found[0].size, std::hypot(0.25, 0.25), 1e-9);
  EXPECT_TRUE(findings_of(test::import_shape("drilled_block"), "edges end").empty());
}

TEST(ImportReport, leaves_the_volume_out_where_solids_have_a_face_in_common) {
  const ImportResult r = import_broken("stacked_boxes");
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_faces(), 11);
  EXPECT_NEAR(r.volume, 60 * 40 * 30, 1e-6);
  EXPECT_FALSE(r.tables.volume.has_value());
  EXPECT_TRUE(import_broken("box_in_box").tables.volume.has_value());
}

TEST(ImportReport, lists_sliver_faces_with_their_width) {
  const ImportResult r = import_broken("sliver");
  const auto found = findings_of(r, "sliver face");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].size, 0.001, 1e-9);
  EXPECT_NEAR(r.tables.face_width[0], 0.001, 1e-9);
  EXPECT_NEAR(test::import_shape("strip").tables.face_width[0], 0.2, 1e-9);
  EXPECT_NEAR(test::import_shape("square").tables.face_width[0], 10, 1e-6);
}

TEST(ImportReport, lists_a_face_without_area_as_a_sliver_with_its_loop_intact) {
  const ImportResult r = import_broken("flat");
  ASSERT_EQ(r.tables.n_faces(), 1);
  EXPECT_NEAR(r.tables.face_area[0], 0, 1e-9);
  EXPECT_EQ(r.tables.n_coedges(), 3);
  const auto found = findings_of(r, "sliver face");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].size, 0, 1e-9);
}

/// Ends of a coedge in (u,v), in the direction of the loop.
std::pair<Vec2, Vec2> ends(const Model& model, FaceId f, CoedgeId c) {
  const ModelTables& t = model.tables();
  const EdgeId e = t.coedge_edge[c];
  const auto pcurve = model.pcurve(f, c);
  Vec2 a = pcurve->point(t.edge_range[2 * e]), b = pcurve->point(t.edge_range[2 * e + 1]);
  if (t.coedge_is_reversed[c]) std::swap(a, b);
  return {a, b};
}

TEST(ImportReport, recovers_loops_of_broken_faces_head_to_tail) {
  for (const char* shape : {"bow_tie", "sliver", "flat", "short_edge", "bare_sphere", "off_pcurve", "off_meridian"}) {
    const ImportResult r = import_broken(shape);
    const Model model(r.tables, r.brep);
    const ModelTables& t = model.tables();
    for (std::int32_t l = 0; l < t.n_loops(); ++l) {
      const std::int32_t first = t.loop_coedge_offsets[l], n = t.loop_coedge_offsets[l + 1] - first;
      for (std::int32_t k = 0; k < n; ++k)
        EXPECT_LE(norm(ends(model, 0, first + k).second - ends(model, 0, first + (k + 1) % n).first), 1e-5)
            << shape << " coedge " << k;
    }
  }
}

TEST(ImportReport, lists_short_edges_below_the_length_asked_for) {
  ImportOptions options;
  const auto found = findings_of(import_broken("short_edge", options), "short edge");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].size, 1e-4, 1e-9);
  options.small = "0.00005";
  EXPECT_TRUE(findings_of(import_broken("short_edge", options), "short edge").empty());
}

TEST(ImportReport, names_invalid_faces_when_asked) {
  ImportOptions options;
  EXPECT_TRUE(findings_of(import_broken("bow_tie", options), "invalid face").empty());
  options.check_only = true;
  EXPECT_EQ(findings_of(import_broken("bow_tie", options), "invalid face").size(), 1u);
}

TEST(ImportReport, boxes_touch_the_faces_and_not_their_poles) {
  const Box3 sphere = test::import_shape("sphere").tables.box();
  EXPECT_LE(distance(sphere.hi, {10, 10, 10}), 1e-5);
  for (const char* shape : {"wave", "closed_tube", "torus", "sphere_octant"}) {
    const ImportResult r = test::import_shape(shape);
    const Model model(r.tables, r.brep);
    Box3 samples;
    const auto s = model.surface(0);
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j)
        samples.add(s->point(
            {s->u_min() + 0.005 * i * (s->u_max() - s->u_min()), s->v_min() + 0.005 * j * (s->v_max() - s->v_min())}));
    const Box3 box = r.tables.face_box[0];
    const double slack = 0.02 * samples.diagonal(), rounding = 1e-6 * samples.diagonal();
    for (const auto& [outer, inner] : {std::pair{box, samples}}) {
      EXPECT_TRUE(outer.lo.x <= inner.lo.x + rounding && outer.lo.y <= inner.lo.y + rounding &&
                  outer.lo.z <= inner.lo.z + rounding)
          << shape;
      EXPECT_TRUE(outer.hi.x >= inner.hi.x - rounding && outer.hi.y >= inner.hi.y - rounding &&
                  outer.hi.z >= inner.hi.z - rounding)
          << shape;
    }
    EXPECT_LE(distance(box.lo, samples.lo), slack) << shape;
    EXPECT_LE(distance(box.hi, samples.hi), slack) << shape;
  }
}

GroupRule tolerance_group(const char* faces, double tolerance) {
  GroupRule rule;
  rule.where = "g.toml:1";
  rule.name = "far";
  rule.selection.faces = {faces};
  rule.tolerance = LengthSpec{LengthSpec::Kind::kModelUnit, tolerance, ""};
  return rule;
}

TEST(ImportRepair, joins_faces_of_a_group_as_far_apart_as_its_tolerance) {
  ImportOptions options;
  options.groups = {tolerance_group("1-6", 0.01)};
  EXPECT_EQ(import_broken("gappy_box", options).edge_uses.n_free, 24) << "the gaps are wider";
  options.groups = {tolerance_group("1-6", 0.15)};
  const ImportResult r = import_broken("gappy_box", options);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_NEAR(r.volume, 48000, 0.005 * 48000);
  const std::vector<ImportFinding> sewn = findings_of(r, "sewn by the tolerance of their group");
  ASSERT_EQ(sewn.size(), 1u);
  EXPECT_EQ(sewn[0].size, 0.15);
  EXPECT_EQ(r.tables.labels.group_attributes, std::vector<std::string>{"{\"tolerance\":0.15}"});
}

TEST(ImportRepair, joins_by_a_tolerance_only_edges_of_two_faces_that_have_it) {
  ImportOptions options;
  options.groups = {tolerance_group("1-4", 0.15)};
  const ImportResult some = import_broken("gappy_box", options);
  EXPECT_EQ(some.edge_uses.n_free, 16) << "four faces of the box have four edges in common";
  GroupRule rest = tolerance_group("5-6", 0.01);
  rest.name = "rest";
  options.groups.push_back(rest);
  EXPECT_EQ(import_broken("gappy_box", options).edge_uses.n_free, 16)
      << "between two groups the smaller tolerance holds";
  options.sew = "0.15";
  EXPECT_TRUE(import_broken("gappy_box", options).is_closed) << "a group's tolerance does not keep --sew from joining";
}

TEST(ImportRepair, projects_trimming_curves_that_cross_within_the_tolerance_of_their_edges) {
  for (const auto& [shape, area] : {std::pair{"blend_curves", 1.6 * std::sqrt(2)}, {"blend_tip", 0.8 * std::sqrt(2)}}) {
    ImportResult r = test::import_narrow(shape);
    EXPECT_EQ(findings_of(r, "trimming curve off its edge, projected again").size(), 2u) << shape;
    EXPECT_TRUE(findings_of(r, "loop crosses itself").empty()) << shape;
    EXPECT_NEAR(r.tables.face_area[0], area, 1e-4 * area) << shape;
    const Model model(std::move(r.tables), std::move(r.brep));
    EXPECT_LT(test::largest_gap(model, 0), 1e-6) << shape;
  }
}

TEST(ImportRepair, keeps_trimming_curves_whose_edges_cross_in_space) {
  const ImportResult r = test::import_narrow("blend_edges");
  EXPECT_TRUE(findings_of(r, "trimming curve off its edge").empty());
  EXPECT_EQ(findings_of(r, "loop crosses itself").size(), 1u);
}

}  // namespace
}  // namespace st
