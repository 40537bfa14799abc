// Models to FLITE and back.
#include "geometry/flite/flite_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "geometry/flite/flite_sampling.h"
#include "geometry/flite/flite_spline.h"
#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/flite_models.h"

namespace st {
namespace {

constexpr double kTolerance = 1e-5;  // of the diagonal

struct RoundTrip {
  ImportResult before, after;
  FliteExport written;
};

RoundTrip round_trip(ImportResult before) {
  RoundTrip trip;
  const Model model(before.tables, before.brep);
  trip.written = make_flite(model, kTolerance * before.tables.reference_diagonal());
  const TemporaryDirectory dir;
  trip.after = import_model(test::write_text(dir, flite_text(trip.written.file)), {});
  trip.before = std::move(before);
  return trip;
}

double free_length(const ModelTables& t) {
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  double length = 0;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (offsets[e + 1] - offsets[e] == 1) length += t.edge_length[e];
  return length;
}

class FliteRoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(FliteRoundTrip, keeps_shells_areas_and_volume_within_the_tolerance) {
  const RoundTrip trip = round_trip(test::import_shape(GetParam()));
  const ImportResult &a = trip.before, &b = trip.after;
  EXPECT_LE(trip.written.deviation, trip.written.tolerance);
  EXPECT_EQ(b.tables.n_faces(), static_cast<int>(trip.written.file.regions.size()));
  const double diagonal = a.tables.reference_diagonal();
  EXPECT_NEAR(b.area, a.area, 10 * kTolerance * diagonal * diagonal);
  EXPECT_NEAR(free_length(b.tables), free_length(a.tables), 1e-3 * free_length(a.tables));
  EXPECT_LE(*std::max_element(b.tables.edge_tolerance.begin(), b.tables.edge_tolerance.end()),
            5 * kTolerance * diagonal);
  EXPECT_EQ(b.edge_uses.n_nonmanifold, a.edge_uses.n_nonmanifold);
  if (a.is_closed) {
    EXPECT_TRUE(b.is_closed);
    EXPECT_EQ(b.tables.n_shells, a.tables.n_shells);
    EXPECT_EQ(b.tables.n_solids, a.tables.n_solids);
    EXPECT_NEAR(b.volume, a.volume, 10 * kTolerance * std::pow(diagonal, 3));
  }
  if (trip.written.n_divided == 0) {
    EXPECT_EQ(b.tables.n_faces(), a.tables.n_faces());
  }
}

INSTANTIATE_TEST_SUITE_P(shapes, FliteRoundTrip,
                         testing::Values("box", "sphere", "cylinder", "cone", "torus", "drilled_cylinder", "two_boxes",
                                         "drilled_block", "blunt_wing", "annulus", "l_face", "sphere_octant", "wave",
                                         "stretched", "kinked", "periodic_tube", "closed_tube", "rational_torus",
                                         "tube_window", "revolution", "t_junction"),
                         [](const auto& info) { return std::string(info.param); });

TEST(FliteWriter, divides_closed_faces_and_says_how_many) {
  const auto divided = [](const char* shape) { return make_flite(test::make_model(shape), 1e-3); };
  EXPECT_EQ(divided("box").n_divided, 0);
  EXPECT_EQ(divided("cylinder").n_divided, 1);
  EXPECT_EQ(divided("cylinder").file.regions.size(), 4u);
  EXPECT_EQ(divided("sphere").file.regions.size(), 2u);
  EXPECT_EQ(divided("torus").file.regions.size(), 4u);
}

TEST(FliteWriter, takes_two_points_for_lines_and_four_for_planes) {
  const FliteExport box = make_flite(test::make_model("box"), 1e-3);
  for (const FliteCurve& c : box.file.curves) EXPECT_EQ(c.points.size(), 2u);
  for (const FliteSurface& s : box.file.surfaces) EXPECT_EQ(s.points.size(), 4u);
  EXPECT_LE(box.deviation, 1e-12);
}

TEST(FliteWriter, is_as_exact_as_asked_and_needs_more_points_for_it) {
  const Model model = test::make_model("wave");
  const FliteExport rough = make_flite(model, 1e-2), fine = make_flite(model, 1e-4);
  EXPECT_LE(rough.deviation, 1e-2);
  EXPECT_LE(fine.deviation, 1e-4);
  EXPECT_GT(fine.file.surfaces[0].points.size(), rough.file.surfaces[0].points.size());
}

TEST(FliteSampling, stays_within_the_tolerance_between_the_points) {
  const Model model = test::make_model("wave");
  const auto surface = model.surface(0);
  const SampledSurface grid = sample_surface(*surface, 1e-4);
  EXPECT_LE(grid.deviation, 1e-4);
  const auto ferguson = ferguson_surface(grid.n_u, grid.n_v, grid.points);
  for (int k = 0; k < 200; ++k) {  // places of no pattern
    const Vec2 uv{(grid.n_u - 1) * (0.5 + 0.49 * std::sin(1.7 * k)), (grid.n_v - 1) * (0.5 + 0.49 * std::cos(2.3 * k))};
    const Vec3 p = ferguson->point(uv);
    const double u = surface->u_min() + (surface->u_max() - surface->u_min()) * uv.x / (grid.n_u - 1);
    const double v = surface->v_min() + (surface->v_max() - surface->v_min()) * uv.y / (grid.n_v - 1);
    const auto foot = project_near(*surface, p, {u, v});
    ASSERT_TRUE(foot);
    EXPECT_LE(distance(surface->point(*foot), p), 1.5e-4);
  }
}

TEST(FliteRoundTripOfTheCorpus, keeps_the_wing_closed_and_the_fli_files_as_they_are) {
  const char* corpus = std::getenv("ST_CORPUS");
  const std::string folder = corpus ? corpus : "";
  if (!std::filesystem::exists(folder + "/flite_zju_cylinders.fli")) GTEST_SKIP() << "LOUD: no corpus; set ST_CORPUS";
  for (const auto& [name, tolerance] :
       {std::pair("flite_zju_cylinders.fli", 1e-6), std::pair("flite_zju_trefoil.fli", 1e-9),
        std::pair("aero_d150_wing_body_half.brep", 1e-4)}) {
    const RoundTrip trip = round_trip(import_model(folder + "/" + name, {}));
    EXPECT_TRUE(trip.after.is_closed) << name;
    EXPECT_EQ(trip.after.tables.n_faces(), trip.before.tables.n_faces()) << name;
    EXPECT_NEAR(trip.after.area, trip.before.area, tolerance * trip.before.area) << name;
    EXPECT_NEAR(trip.after.volume, trip.before.volume, tolerance * trip.before.volume) << name;
  }
}

}  // namespace
}  // namespace st
