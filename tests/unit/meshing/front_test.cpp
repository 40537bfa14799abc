// The advancing front alone: what it leaves to the enhancer.
#include "meshing/face/front.h"

#include <gtest/gtest.h>

#include "geometry/shape/analytic.h"
#include "unit/meshing/face_work.h"

namespace st::test {
namespace {

struct FrontCase {
  const char* shape;
  double length;
  std::int64_t euler;
  FaceId face = 0;
};

void PrintTo(const FrontCase& c, std::ostream* out) { *out << c.shape; }

class FrontOnFace : public testing::TestWithParam<FrontCase> {};

TEST_P(FrontOnFace, covers_the_face_and_keeps_the_boundary) {
  const FrontCase c = GetParam();
  const UniformField field(c.length);
  const FaceCase face(c.shape, field, c.face);
  Prepared p(*face.surface, face.boundary, field);
  const BoundaryWatch watch(p);
  advance_front(p.work);
  watch.expect_unchanged();
  const FaceMesh mesh = p.mesh();
  expect_valid(face.boundary, mesh);
  const MeshView view{face.boundary, mesh};
  EXPECT_EQ(view.euler(), c.euler);
  EXPECT_NEAR(view.area(), face.area(), 0.02 * face.area());
  EXPECT_FALSE(mesh.inner.empty());
  for (const auto& n : mesh.inner) EXPECT_LE(distance(n.x, face.surface->point(n.uv)), 1e-9);
}

TEST_P(FrontOnFace, ends_with_every_triangle_small_enough_or_given_up) {
  const FrontCase c = GetParam();
  const UniformField field(c.length);
  const FaceCase face(c.shape, field, c.face);
  Prepared p(*face.surface, face.boundary, field);
  advance_front(p.work);
  std::int64_t n_finished = 0, n_inside = 0;
  for (const PlaneTriangle& t : p.work.mesh.triangles) {
    if (!Prepared::is_inside(t)) continue;
    const bool has_pole =
        p.work.mesh.nodes[t.v[0]].is_pole || p.work.mesh.nodes[t.v[1]].is_pole || p.work.mesh.nodes[t.v[2]].is_pole;
    ++n_inside;
    n_finished += t.state == kFinished;
    EXPECT_TRUE(t.state == kFinished || t.state == kRetired || has_pole);
    EXPECT_LT(p.work.circumradius2<false>(t), 1.5 * 1.5 * c.length * c.length);
  }
  EXPECT_GT(n_finished, 17 * n_inside / 20);
}

TEST_P(FrontOnFace, spaces_its_nodes_as_a_graded_field_asks) {
  const FrontCase c = GetParam();
  const FaceCase uniform(c.shape, UniformField(c.length), c.face);
  const LinearField field(uniform.boundary.nodes[0].x, 0.4 * c.length, 0.2);
  const FaceCase face(c.shape, field, c.face);
  Prepared p(*face.surface, face.boundary, field);
  advance_front(p.work);
  const FaceMesh mesh = p.mesh();
  const MeshView view{face.boundary, mesh};
  EXPECT_GE(view.conformity(field), 0.91);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const std::int32_t a = mesh.corners[i], b = mesh.corners[i % 3 == 2 ? i - 2 : i + 1];
    if (std::max(a, b) < view.n_boundary()) continue;
    const double ratio = distance(view.x(a), view.x(b)) / field.size(0.5 * (view.x(a) + view.x(b)));
    EXPECT_GT(ratio, 0.3);
    EXPECT_LT(ratio, 2.2);
  }
}

INSTANTIATE_TEST_SUITE_P(, FrontOnFace,
                         testing::Values(FrontCase{"square", 0.5, 1}, FrontCase{"annulus", 0.7, 0},
                                         FrontCase{"plate_with_hole", 1.5, 0}, FrontCase{"sphere", 1.2, 2},
                                         FrontCase{"cone_side", 1, 1}, FrontCase{"torus", 1.5, 0},
                                         FrontCase{"periodic_tube", 1.2, 0}, FrontCase{"drilled_cylinder", 1, -1},
                                         FrontCase{"wave", 0.8, 1}),
                         [](const auto& info) { return std::string(info.param.shape); });

const std::vector<Vec2> kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

/// The square's sides, cut into n segments each.
std::vector<Vec2> cut_square(int n) {
  std::vector<Vec2> loop;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i)
      loop.push_back(kSquare[side] + (double(i) / n) * (kSquare[(side + 1) % 4] - kSquare[side]));
  return loop;
}

TEST(Front, makes_as_many_triangles_as_the_area_holds) {
  const UniformField field(0.5);
  const FaceBoundary b = polygons({cut_square(20)}, 0.5);
  Prepared p(kPlane, b, field);
  advance_front(p.work);
  const double expected = 100 / (0.25 * std::sqrt(3.0) * 0.25);  // of equilateral ones
  EXPECT_NEAR(static_cast<double>(p.mesh().corners.size()) / 3, expected, 0.1 * expected);
  EXPECT_NEAR((MeshView{b, p.mesh()}.area()), 100, 1e-9);
}

// A new node keeps 0.76 of the length from others; one that splits a very long edge 0.55 of that.
TEST(Front, keeps_its_nodes_apart) {
  for (const double length : {0.31, 0.5, 0.73}) {
    const UniformField field(length);
    const FaceBoundary b = polygons({cut_square(static_cast<int>(10 / length))}, length);
    Prepared p(kPlane, b, field);
    advance_front(p.work);
    const auto& nodes = p.work.mesh.nodes;
    double least = 1e300;
    for (std::int32_t i = p.first_inner(); i < static_cast<std::int32_t>(nodes.size()); ++i)
      for (std::int32_t j = 0; j < i; ++j)
        if (j < p.work.mesh.n_boundary || j >= p.first_inner())
          least = std::min(least, distance(nodes[i].x, nodes[j].x));
    EXPECT_GT(least, 0.76 * 0.55 * length);
  }
}

TEST(Front, has_a_row_of_triangles_on_each_side_of_a_slit) {
  FaceBoundary b = polygons({cut_square(10)}, 1);
  const auto first = static_cast<std::int32_t>(b.nodes.size());
  for (int i = 0; i <= 4; ++i) b.nodes.push_back({{3.0 + i, 5}, {3.0 + i, 5, 0}, 1, first + i, false});
  for (int i = 0; i < 4; ++i) {  // there and back
    b.segments.push_back({first + i, first + i + 1});
    b.segments.push_back({first + i + 1, first + i});
  }
  const UniformField field(1);
  Prepared p(kPlane, b, field);
  const BoundaryWatch watch(p);
  advance_front(p.work);
  watch.expect_unchanged();
  const FaceMesh mesh = p.mesh();
  expect_valid(b, mesh);
  EXPECT_NEAR((MeshView{b, mesh}.area()), 100, 1e-9);
  for (std::int32_t i = first; i < first + 5; ++i) EXPECT_GE(p.valence(i), 4) << "triangles on both sides";
}

TEST(Front, stops_at_the_largest_number_of_nodes) {
  const UniformField field(0.1);
  const FaceBoundary b = polygons({cut_square(10)}, 1);
  Prepared p(kPlane, b, field);
  p.work.max_nodes = 200;
  advance_front(p.work);
  EXPECT_EQ(p.work.mesh.nodes.size(), 200u);
}

TEST(Front, puts_no_node_in_a_face_that_is_fine_enough) {
  const UniformField field(12);
  const FaceBoundary b = polygons({kSquare}, 12);
  Prepared p(kPlane, b, field);
  advance_front(p.work);
  EXPECT_EQ(p.n_inner(), 0);
  EXPECT_EQ(p.mesh().corners.size(), 6u);
}

TEST(Front, makes_sides_shorter_where_the_normal_turns) {
  const UniformField field(8);
  const FaceCase face("sphere", field);
  int n_inner[2] = {};
  for (int k = 0; k < 2; ++k) {
    Prepared p(*face.surface, face.boundary, field);
    p.work.max_turning = k ? 0.3 : 1.0;
    advance_front(p.work);
    n_inner[k] = p.n_inner();
  }
  EXPECT_GT(n_inner[1], 2 * n_inner[0]);
}

TEST(Front, does_not_shorten_sides_of_a_plane) {
  const FaceBoundary b = polygons({cut_square(10)}, 1);
  const UniformField field(1);
  int n_inner[2] = {};
  for (int k = 0; k < 2; ++k) {
    Prepared p(kPlane, b, field);
    p.work.max_turning = k ? 0.01 : 1.0;
    advance_front(p.work);
    n_inner[k] = p.n_inner();
  }
  EXPECT_EQ(n_inner[0], n_inner[1]);
}

TEST(Front, makes_rings_of_three_where_a_face_closes_on_itself_with_little_room) {
  const UniformField field(4);
  const FaceCase cone("cone_side", field);
  Prepared p(*cone.surface, cone.boundary, field);
  advance_front(p.work);
  std::map<double, int> ring;  // height -> kept nodes
  for (std::int32_t i = p.first_inner(); i < static_cast<std::int32_t>(p.work.mesh.nodes.size()); ++i)
    if (p.work.mesh.nodes[i].is_kept) ++ring[std::round(1e6 * p.work.mesh.nodes[i].x.z)];
  ASSERT_FALSE(ring.empty());
  for (const auto& [z, n] : ring) EXPECT_EQ(n, 2) << "with the seam's node three, at z = " << 1e-6 * z;
  expect_valid(cone.boundary, p.mesh());

  const UniformField fine(0.5);
  const FaceCase square("square", fine);
  Prepared flat(*square.surface, square.boundary, fine);
  advance_front(flat.work);
  for (const MeshNode& n : flat.work.mesh.nodes) EXPECT_FALSE(n.is_kept);
}

TEST(Front, grows_from_a_short_side_layer_by_layer) {
  // a side of 0.1 in a field of 5: the next nodes are no more than 1.4 times as far as their base is long
  std::vector<Vec2> loop;
  for (int i = 0; i < 100; ++i) loop.push_back({0.1 * i, 0});
  for (const Vec2 corner : {Vec2{10, 0}, Vec2{10, 10}, Vec2{0, 10}}) loop.push_back(corner);
  FaceBoundary b = polygons({loop}, 5);
  for (int i = 0; i <= 100; ++i) b.nodes[i].h = 0.125;
  const UniformField field(5);
  Prepared p(kPlane, b, field);
  advance_front(p.work);
  const FaceMesh mesh = p.mesh();
  int n_first_layer = 0;
  for (const auto& n : mesh.inner) n_first_layer += n.x.y < 0.2;
  EXPECT_GT(n_first_layer, 50) << "of 100 sides";
  const MeshView view{b, mesh};
  EXPECT_GT(view.mean_quality(), 0.8);
}

TEST(FaceWork, measures_the_circumradius_in_space) {
  const UniformField field(1);
  const FaceBoundary b = polygons({{{0, 0}, {3, 0}, {3, 4}, {0, 4}}}, 1);
  const Prepared p(kPlane, b, field);
  const PlaneTriangle right{{0, 1, 2}, {kNone, kNone, kNone}};
  EXPECT_NEAR(p.work.circumradius2<false>(right), 2.5 * 2.5, 1e-12);
  EXPECT_NEAR(std::sqrt(p.work.edge_length2<false>(0, 2)), 5, 1e-12);
}

TEST(FaceWork, takes_a_triangle_without_area_to_be_as_large_as_its_longest_side) {
  const UniformField field(1);
  const FaceBoundary b = polygons({{{0, 0}, {4, 0}, {4, 4}, {2, 0.5}}}, 1);
  Prepared p(kPlane, b, field);
  p.work.mesh.nodes[3].x = {2, 0, 0};
  EXPECT_NEAR(p.work.circumradius2<false>({{0, 1, 3}, {kNone, kNone, kNone}}), 16, 1e-12);
}

TEST(FaceWork, measures_between_seam_twins_along_the_surface) {
  const UniformField field(1.2);
  const FaceCase tube("periodic_tube", field);
  const Prepared p(*tube.surface, tube.boundary, field);
  const Triangulation& m = p.work.mesh;
  int n_twins = 0;
  for (std::int32_t a = 0; a < m.n_boundary; ++a)
    for (std::int32_t c = a + 1; c < m.n_boundary; ++c)
      if (m.nodes[a].id == m.nodes[c].id) {
        ++n_twins;
        EXPECT_GT(std::sqrt(p.work.edge_length2<false>(a, c)), field.min_size())
            << "around the tube, not through the air";
      }
  EXPECT_GT(n_twins, 2);
}

TEST(FaceWork, an_edge_where_the_parametrisation_is_fast_at_its_end_only_is_short) {
  const UniformField field(1);
  const FaceBoundary b = polygons({{{0, 0}, {3, 0}, {3, 4}, {0, 4}}}, 1);
  Prepared p(kPlane, b, field);
  p.work.mesh.nodes[0].du = 10 * p.work.mesh.nodes[0].du;
  EXPECT_NEAR(std::sqrt(p.work.edge_length2<false>(0, 1)), 3, 1e-12);
  EXPECT_NEAR(std::sqrt(p.work.edge_length2<true>(0, 1)), 3, 1e-12);
}

TEST(Metric, of_two_derivatives_is_their_first_fundamental_form) {
  const auto metric = [](Vec3 du, Vec3 dv) {
    MeshNode n;
    n.du = du;
    n.dv = dv;
    return metric_of(n);
  };
  const Metric m = metric({2, 0, 0}, {1, 3, 0});
  EXPECT_NEAR(m.length2({1, 1}), 9 + 9, 1e-6);
  EXPECT_NEAR(m.length2({1, 0}), 4, 1e-6);
  const Metric pole = metric({0, 0, 0}, {0, 5, 0});
  EXPECT_GT(pole.length2({1, 0}), 0) << "a direction without length is no excuse for a singular metric";
}

}  // namespace
}  // namespace st::test
