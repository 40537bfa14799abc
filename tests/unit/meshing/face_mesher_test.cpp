#include "meshing/face/face_mesher.h"

#include <gtest/gtest.h>

#include "unit/meshing/faces.h"

namespace st {
namespace {

using test::FaceCase;
using test::kPlane;
using test::MeshView;
using test::polygons;

struct Case {
  const char* name;
  const char* shape;
  double length;
  std::int64_t euler;
  double area_error;  // relative, what the chord error explains
  double mean_quality;
  double conformity;
  FaceId face = 0;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class MeshedFace : public testing::TestWithParam<Case> {};

TEST_P(MeshedFace, gives_a_valid_mesh_of_the_whole_face) {
  const Case c = GetParam();
  const UniformField field(c.length);
  const FaceCase face(c.shape, field, c.face);
  const FaceMesh mesh = face.mesh(field);
  test::expect_valid(face.boundary, mesh);
  const MeshView view{face.boundary, mesh};
  EXPECT_NEAR(view.area(), face.area(), c.area_error * face.area());
  EXPECT_EQ(view.euler(), c.euler);
}

TEST_P(MeshedFace, makes_good_triangles_of_the_size_asked_for) {
  const Case c = GetParam();
  const UniformField field(c.length);
  const FaceCase face(c.shape, field, c.face);
  const FaceMesh mesh = face.mesh(field);
  ASSERT_EQ(mesh.cause, FailureCause::kNone);
  const MeshView view{face.boundary, mesh};
  EXPECT_GT(view.mean_quality(), c.mean_quality);
  EXPECT_GE(view.conformity(field), c.conformity);
}

TEST_P(MeshedFace, is_a_pure_function) {
  const Case c = GetParam();
  const FaceCase face(c.shape, UniformField(c.length), c.face);
  const FaceMesh a = face.mesh(UniformField(c.length));
  ASSERT_EQ(a.cause, FailureCause::kNone);
  ASSERT_FALSE(a.corners.empty());
  face.surface->evaluate({face.surface->u_max(), face.surface->v_max()});
  const FaceMesh b = face.mesh(test::RestlessField(c.length));
  EXPECT_EQ(a.corners, b.corners);
  ASSERT_EQ(a.inner.size(), b.inner.size());
  for (std::size_t i = 0; i < a.inner.size(); ++i)
    EXPECT_TRUE(a.inner[i].x == b.inner[i].x && a.inner[i].uv == b.inner[i].uv);
}

TEST_P(MeshedFace, keeps_boundary_nodes_and_puts_inner_ones_on_the_surface) {
  const Case c = GetParam();
  const UniformField field(c.length);
  const FaceCase face(c.shape, field, c.face);
  const FaceMesh mesh = face.mesh(field);
  ASSERT_EQ(mesh.cause, FailureCause::kNone);
  ASSERT_FALSE(mesh.inner.empty());
  for (const auto& n : mesh.inner) {
    EXPECT_LE(distance(face.surface->point(n.uv), n.x), 1e-9);
    EXPECT_GT(n.h, 0);
  }
  const std::int32_t n_nodes = static_cast<std::int32_t>(face.boundary.nodes.size() + mesh.inner.size());
  std::vector<char> used(n_nodes, 0);
  for (std::int32_t corner : mesh.corners) {
    ASSERT_TRUE(corner >= 0 && corner < n_nodes);
    used[corner] = 1;
  }
  for (std::size_t i = face.boundary.nodes.size(); i < used.size(); ++i)
    EXPECT_TRUE(used[i]) << "inner node without a triangle";
}

TEST_P(MeshedFace, follows_a_linear_field) {
  const Case c = GetParam();
  const FaceCase uniform(c.shape, UniformField(c.length), c.face);
  const Vec3 fine = uniform.boundary.nodes[0].x;
  const test::LinearField field(fine, 0.4 * c.length, 0.2);
  const FaceCase face(c.shape, field, c.face);
  const FaceMesh mesh = face.mesh(field);
  test::expect_valid(face.boundary, mesh);
  const MeshView view{face.boundary, mesh};
  EXPECT_GT(view.mean_quality(), c.mean_quality - 0.05);
  EXPECT_GE(view.conformity(field), c.conformity - 0.03);
}

INSTANTIATE_TEST_SUITE_P(, MeshedFace,
                         testing::Values(Case{"square", "square", 0.5, 1, 1e-12, 0.97, 0.97},
                                         Case{"disc", "disc", 1, 1, 0.01, 0.96, 0.95},
                                         Case{"annulus", "annulus", 0.7, 0, 0.01, 0.96, 0.95},
                                         Case{"sphere", "sphere", 1.2, 2, 0.01, 0.95, 0.95},
                                         Case{"cone_apex", "cone_side", 1, 1, 0.01, 0.95, 0.95},
                                         Case{"torus", "torus", 1.5, 0, 0.02, 0.95, 0.95},
                                         Case{"stretched", "stretched", 0.4, 1, 0.01, 0.95, 0.95},
                                         Case{"wave", "wave", 0.8, 1, 0.02, 0.95, 0.9},
                                         Case{"periodic_tube", "periodic_tube", 1.2, 0, 0.02, 0.95, 0.95},
                                         Case{"rational_torus", "rational_torus", 1.5, 0, 0.02, 0.95, 0.95},
                                         Case{"drilled", "drilled_cylinder", 1, -1, 0.02, 0.95, 0.95},
                                         Case{"plate", "plate_with_hole", 1.5, 0, 0.005, 0.95, 0.95}),
                         [](const auto& info) { return std::string(info.param.name); });

/// A field too coarse for the face: no quality to be had, but a valid mesh.
class MeshThinFace : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(MeshThinFace, is_valid) {
  const auto [shape, length] = GetParam();
  const UniformField field(length);
  const FaceCase face(shape, field);
  test::expect_valid(face.boundary, face.mesh(field));
}

INSTANTIATE_TEST_SUITE_P(, MeshThinFace,
                         testing::Values(std::pair{"strip", 1.0}, std::pair{"strip", 10.0}, std::pair{"thin_tube", 1.0},
                                         std::pair{"disc", 50.0}, std::pair{"annulus", 30.0}, std::pair{"torus", 40.0},
                                         std::pair{"cone_side", 30.0}));

TEST(MeshFace, says_where_a_sphere_needs_more_nodes_when_its_seam_has_hardly_any) {
  const UniformField field(40);
  const FaceCase face("sphere", field);
  const FaceMesh mesh = face.mesh(field);
  EXPECT_EQ(mesh.cause, FailureCause::kNarrowPart);
  ASSERT_FALSE(mesh.refinement.empty());
  for (const RefinementPoint& p : mesh.refinement) EXPECT_LT(p.length, 40);
}

TEST(MeshFace, takes_a_strip_thinner_than_the_size) {
  const UniformField field(1);
  const FaceCase face("strip", field);
  const FaceMesh mesh = face.mesh(field);
  test::expect_valid(face.boundary, mesh);
  EXPECT_NEAR((MeshView{face.boundary, mesh}.area()), 20, 1e-9);
  EXPECT_TRUE(mesh.inner.empty());
}

TEST(MeshFace, takes_a_tube_of_three_segments_a_turn) {
  const UniformField field(0.11);
  const FaceCase face("thin_tube", field);
  const FaceMesh mesh = face.mesh(field);
  test::expect_valid(face.boundary, mesh);
  EXPECT_EQ((MeshView{face.boundary, mesh}.euler()), 0);
}

TEST(MeshFace, meshes_polygons_exactly) {
  const FaceBoundary b = polygons({{{0, 0}, {10, 0}, {10, 10}, {6, 4}, {0, 10}}, {{4, 2}, {5, 3}, {6, 2}}}, 1.0);
  const FaceMesh mesh = mesh_face(kPlane, b, UniformField(1), {});
  test::expect_valid(b, mesh);
  EXPECT_NEAR((MeshView{b, mesh}.area()), 100 - 0.5 * 10 * 6 - 1, 1e-9);
}

TEST(MeshFace, says_where_loops_cross) {
  const FaceBoundary b = polygons({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{8, 4}, {8, 6}, {12, 6}, {12, 4}}}, 1.0);
  const FaceMesh mesh = mesh_face(kPlane, b, UniformField(1), {});
  EXPECT_EQ(mesh.cause, FailureCause::kCrossingLoops);
  EXPECT_TRUE(mesh.corners.empty());
  ASSERT_FALSE(mesh.refinement.empty());
  for (const RefinementPoint& p : mesh.refinement) EXPECT_LE(distance(p.x, {10, 5, 0}), 3);
}

TEST(MeshFace, finds_no_fault_in_good_loops) {
  const FaceBoundary b = polygons({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{4, 4}, {4, 6}, {6, 6}}}, 1.0);
  EXPECT_EQ(mesh_face(kPlane, b, UniformField(1), {}).cause, FailureCause::kNone);
}

TEST(MeshFace, refuses_a_loop_of_two_nodes) {
  EXPECT_EQ(mesh_face(kPlane, polygons({{{0, 0}, {10, 0}}}, 1.0), UniformField(1), {}).cause,
            FailureCause::kShortLoops);
  EXPECT_EQ(mesh_face(kPlane, {}, UniformField(1), {}).cause, FailureCause::kShortLoops);
}

TEST(MeshFace, tells_nodes_that_nearly_coincide_apart_by_their_ids) {
  FaceBoundary b = polygons({{{0, 0}, {5, 0}, {5.00001, 0}, {10, 0}, {10, 10}, {0, 10}}}, 1.0);
  b.nodes[2].id = b.nodes[1].id;  // one node with two places in (u,v), as at a bad junction
  const FaceMesh mesh = mesh_face(kPlane, b, UniformField(1), {});
  ASSERT_EQ(mesh.cause, FailureCause::kNone);
  EXPECT_EQ(std::count(mesh.corners.begin(), mesh.corners.end(), 2), 0);
}

TEST(MeshFace, reports_triangles_turned_against_the_surface) {
  FaceBoundary b = polygons({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}}, 100);
  for (auto& n : b.nodes) n.x = {-n.uv.x, n.uv.y, 0};  // all of it mirrored: no two neighbours are folded
  const FaceMesh mesh = mesh_face(kPlane, b, UniformField(100), {});
  EXPECT_EQ(mesh.n_folds, 2);
  EXPECT_EQ(mesh.refinement.size(), 2u);
}

TEST(MeshFace, reports_neighbours_folded_onto_each_other) {
  // A dart, whose only diagonal is a ridge; both sides drop by 72.5 degrees, so that none is turned against the plane.
  FaceBoundary b = polygons({{{3, 3}, {8, 5}, {3, 7}, {5, 5}}}, 100);
  const double y = 2 * std::cos(radians(72.5)), z = -2 * std::sin(radians(72.5));
  b.nodes[0].x = {3, 5 - y, z};
  b.nodes[2].x = {3, 5 + y, z};
  const FaceMesh mesh = mesh_face(kPlane, b, UniformField(100), {});
  ASSERT_EQ(mesh.corners.size(), 6u);
  EXPECT_EQ(mesh.n_folds, 1);
  EXPECT_FALSE(mesh.refinement.empty());
}

/// Lengths that grow with the distance to the line y = 0, as behind an edge of the CAD.
class GrowsFromLine : public test::LinearField {
 public:
  using LinearField::LinearField;
  double size(Vec3 x, int& hint) const override { return LinearField::size({0, x.y, 0}, hint); }
};

TEST(MeshFace, has_its_lengths_where_they_grow_fast) {
  for (const auto& [slope, least] : {std::pair{0.2, 0.98}, {0.4, 0.93}}) {
    const GrowsFromLine field({0, 0, 0}, 0.005, slope);
    const FaceCase square("square", field);
    const FaceMesh mesh = square.mesh(field);
    const MeshView view{square.boundary, mesh};
    EXPECT_GE(view.conformity(field), least) << slope;
  }
}

TEST(MeshFace, leaves_no_edge_far_longer_than_its_size_and_hardly_a_node_with_four_neighbours) {
  std::ptrdiff_t n_of_four = 0, n_inner = 0;
  for (const char* shape :
       {"square", "disc", "sphere", "torus", "wave", "stretched", "periodic_tube", "drilled_cylinder"}) {
    const double size = test::make_model(shape).tables().reference_diagonal();
    for (const double share : {0.02, 0.04}) {
      const UniformField uniform(share * size);
      const test::LinearField steep(FaceCase(shape, uniform).boundary.nodes[0].x, 0.1 * share * size, 0.4);
      for (const SizeField* field : {static_cast<const SizeField*>(&uniform), static_cast<const SizeField*>(&steep)}) {
        const FaceCase face(shape, *field);
        const FaceMesh mesh = face.mesh(*field);
        const MeshView view{face.boundary, mesh};
        double most = 0;
        std::vector<int> degree(face.boundary.nodes.size() + mesh.inner.size(), 0);
        for (const std::int32_t corner : mesh.corners) ++degree[corner];
        for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
          const std::int32_t a = mesh.corners[i], b = mesh.corners[i % 3 == 2 ? i - 2 : i + 1];
          if (std::min(a, b) < view.n_boundary()) continue;
          const double ratio =
              distance(view.x(a), view.x(b)) / (0.5 * (field->size(view.x(a)) + field->size(view.x(b))));
          most = std::max(most, ratio);
        }
        n_of_four += std::count_if(degree.begin() + view.n_boundary(), degree.end(), [](int d) { return d <= 4; });
        n_inner += static_cast<std::ptrdiff_t>(mesh.inner.size());
        EXPECT_LT(most, 1.6) << shape << " " << share;
      }
    }
  }
  EXPECT_LT(n_of_four, n_inner / 2000);
}

/// Sizes from far too coarse to fine, uniform and falling towards a boundary node; up to `valid_below` of the diagonal
/// all are meshed.
struct EverySize {
  const char* shape;
  double valid_below;
};

void PrintTo(const EverySize& e, std::ostream* out) { *out << e.shape; }

class FaceAtEverySize : public testing::TestWithParam<EverySize> {};

TEST_P(FaceAtEverySize, is_valid_or_far_too_coarse_and_says_where_to_refine) {
  const auto [shape, valid_below] = GetParam();
  const Model model = test::make_model(shape);
  const double size = model.tables().reference_diagonal();
  for (double share = 0.6; share > 0.04; share *= 0.75) {
    const UniformField uniform(share * size);
    const test::LinearField falling(FaceCase(shape, uniform).boundary.nodes[0].x, 0.2 * share * size, 0.3);
    for (const SizeField* field : {static_cast<const SizeField*>(&uniform), static_cast<const SizeField*>(&falling)}) {
      SCOPED_TRACE(testing::Message() << share << (field == &uniform ? " uniform" : " falling"));
      const FaceCase face(shape, *field);
      const FaceMesh mesh = face.mesh(*field);
      if (share < valid_below || (mesh.cause == FailureCause::kNone && mesh.n_folds == 0))
        test::expect_valid(face.boundary, mesh);
      else
        EXPECT_FALSE(mesh.refinement.empty()) << text_of(mesh.cause);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, FaceAtEverySize,
                         testing::Values(EverySize{"disc", 1}, EverySize{"annulus", 1}, EverySize{"sphere", 1},
                                         EverySize{"cone_side", 1}, EverySize{"torus", 1}, EverySize{"stretched", 1},
                                         EverySize{"wave", 1}, EverySize{"periodic_tube", 1},
                                         EverySize{"rational_torus", 1}, EverySize{"drilled_cylinder", 1},
                                         EverySize{"plate_with_hole", 1}, EverySize{"thin_crescent", 0.07},
                                         EverySize{"sharp_triangle", 1}, EverySize{"tube_window", 1},
                                         EverySize{"kinked", 1}, EverySize{"sphere_octant", 1},
                                         EverySize{"closed_tube", 1}),
                         [](const auto& info) { return std::string(info.param.shape); });

/// Asks for next to nothing where expected_nodes() does not look: on a line x = const. At one of its probes no number.
class Trap : public UniformField {
 public:
  Trap(double length, double least) : UniformField(length), least_(least) {}
  using SizeField::size;
  double size(Vec3 x, int&) const override {
    if (distance(x, {0.5, 0.5, 0}) < 1e-9) return std::numeric_limits<double>::quiet_NaN();
    return std::abs(x.x - 35.0 / 11) < 0.015 ? least_ : 1;
  }

 private:
  double least_;
};

TEST(MeshFace, stops_a_runaway_at_what_area_and_boundary_explain) {
  constexpr int n = 99;  // segments along each side
  std::vector<Vec2> loop;
  for (int i = 0; i < n; ++i) loop.push_back({10.0 * i / n, 0});
  for (int i = 0; i < n; ++i) loop.push_back({10, 10.0 * i / n});
  for (int i = n; i > 0; --i) loop.push_back({10.0 * i / n, 10});
  for (int i = n; i > 0; --i) loop.push_back({0, 10.0 * i / n});
  const FaceMesh mesh = mesh_face(kPlane, polygons({loop}, 10.0 / n), Trap(1, 8e-4), {});
  EXPECT_EQ(mesh.cause, FailureCause::kTooManyNodes);
  EXPECT_LT(mesh.inner.size(), 60'000u) << "of some hundred thousand";
}

TEST(MeshFace, enhancer_improves_the_triangles) {
  for (const char* shape : {"square", "sphere", "wave", "torus", "stretched"}) {
    const UniformField field(shape[0] == 's' && shape[1] == 'q' ? 0.4 : 1.0);
    const FaceCase face(shape, field);
    FaceMeshOptions raw;
    raw.enhance_rounds = 0;
    const FaceMesh before = face.mesh(field, raw), after = face.mesh(field);
    test::expect_valid(face.boundary, before);
    const MeshView a{face.boundary, before}, b{face.boundary, after};
    EXPECT_GT(b.mean_quality(), a.mean_quality()) << shape;
    EXPECT_GE(b.qualities()[b.n_triangles() / 100], a.qualities()[a.n_triangles() / 100]) << shape;
  }
}

TEST(MeshFace, grows_from_short_boundary_segments) {
  // a side cut a hundred times finer than the field asks for
  std::vector<Vec2> loop;
  for (int i = 0; i < 200; ++i) loop.push_back({0.05 * i, 0});
  for (Vec2 p : {Vec2{10, 0}, Vec2{10, 5}, Vec2{10, 10}, Vec2{5, 10}, Vec2{0, 10}, Vec2{0, 5}}) loop.push_back(p);
  FaceBoundary b = polygons({loop}, 5.0);
  for (int i = 0; i < 200; ++i) b.nodes[i].h = 0.0625;
  const FaceMesh mesh = mesh_face(kPlane, b, UniformField(5), {});
  test::expect_valid(b, mesh);
  const MeshView view{b, mesh};
  EXPECT_GT(view.mean_quality(), 0.85);
  EXPECT_LT(view.n_triangles(), 3000u);
}

double largest_angle(const FaceCase& face, const FaceMesh& mesh) {
  const auto at = [&](std::int32_t c) {
    const auto n = static_cast<std::int32_t>(face.boundary.nodes.size());
    return c < n ? face.boundary.nodes[c].x : mesh.inner[c - n].x;
  };
  double largest = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    const Vec3 a = at(mesh.corners[i]), b = at(mesh.corners[i + 1]), c = at(mesh.corners[i + 2]);
    largest =
        std::max({largest, angle_between(b - a, c - a), angle_between(c - b, a - b), angle_between(a - c, b - c)});
  }
  return degrees(largest);
}

TEST(StretchedFace, has_as_many_right_angled_triangles_as_its_two_lengths_ask_for) {
  for (const double aspect : {2.0, 8.0, 16.0}) {
    const test::StretchedField field({0.1, 0.1 * aspect, {1, 0, 0}});
    const FaceCase face("square", field);
    const FaceMesh mesh = face.mesh(field);
    test::expect_valid(face.boundary, mesh);
    EXPECT_EQ(mesh.n_folds, 0);
    const double n_rows = 2 * face.area() / (0.1 * 0.1 * aspect);
    EXPECT_NEAR(static_cast<double>(mesh.corners.size()) / 3, n_rows, 0.15 * n_rows) << aspect;
    EXPECT_LT(largest_angle(face, mesh), 135) << aspect;
  }
}

TEST(StretchedFace, is_one_of_equal_lengths_across_its_direction) {
  const test::StretchedField out_of_plane({0.4, 4, {0, 0, 1}});
  const FaceCase face("square", out_of_plane);
  const FaceMesh stretched = face.mesh(out_of_plane), plain = face.mesh(UniformField(0.4));
  const auto n = static_cast<double>(plain.corners.size());  // the enhancer goes through them in another order
  EXPECT_NEAR(static_cast<double>(stretched.corners.size()), n, 0.02 * n);
  EXPECT_NEAR((MeshView{face.boundary, stretched}.mean_quality()), (MeshView{face.boundary, plain}.mean_quality()),
              0.01);
}

TEST(StretchedFace, lies_on_curved_surfaces_without_folds) {
  const test::StretchedField field({0.5, 8, {0, 0, 1}});
  for (const FaceId f : {0, 1, 2}) {
    const FaceCase face("cylinder", field, f);
    const FaceMesh mesh = face.mesh(field);
    test::expect_valid(face.boundary, mesh);
    EXPECT_EQ(mesh.n_folds, 0);
    const MeshView view{face.boundary, mesh};
    EXPECT_NEAR(view.area(), face.area(), 2e-3 * face.area());
  }
}

}  // namespace
}  // namespace st
