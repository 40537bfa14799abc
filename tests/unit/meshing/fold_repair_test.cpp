#include "meshing/face/fold_repair.h"

#include <gtest/gtest.h>

#include "unit/meshing/faces.h"
#include "unit/meshing/grid_patch.h"

namespace st {
namespace {

using test::FaceCase;
using test::MeshView;

/// Somewhat more than half a pipe about the z axis; normals point out of it (side 1) or to its axis (-1).
class HalfPipe : public Surface {
 public:
  static constexpr double kRadius = 0.25, kEnd = 1.75;
  explicit HalfPipe(double side) : side_(side) { u_min_ = -kEnd, u_max_ = kEnd, v_min_ = 0, v_max_ = 2; }
  Vec3 point(Vec2 uv) const override { return evaluate(uv).x; }
  SurfacePoint evaluate(Vec2 uv) const override {
    ++n_evaluated;
    const double c = std::cos(uv.x), s = side_ * std::sin(uv.x);
    return {{kRadius * c, kRadius * s, uv.y}, {-kRadius * side_ * s, kRadius * side_ * c, 0}, {0, 0, 1}};
  }
  SurfacePoint2 evaluate2(Vec2 uv) const override {
    const SurfacePoint p = evaluate(uv);
    return {p.x, p.du, p.dv, {-p.x.x, -p.x.y, 0}, {}, {}};
  }
  mutable int n_evaluated = 0;

 private:
  double side_;
};

/// A surface with its boundary.
struct Sheet {
  std::unique_ptr<Surface> surface;
  FaceBoundary boundary;
  FaceMesh mesh(const SizeField& field) const { return mesh_face(*surface, boundary, field, {}); }
};

Sheet half_pipe(double side, double h) {
  Sheet sheet{std::make_unique<HalfPipe>(side), {}};
  std::vector<Vec2> loop;
  const auto n_u = static_cast<int>(2 * HalfPipe::kEnd * HalfPipe::kRadius / h), n_v = static_cast<int>(2 / h);
  const auto u = [&](int i) { return HalfPipe::kEnd * (2.0 * i / n_u - 1); };
  const auto v = [&](int i) { return 2.0 * i / n_v; };
  for (int i = 0; i < n_u; ++i) loop.push_back({u(i), 0});
  for (int i = 0; i < n_v; ++i) loop.push_back({HalfPipe::kEnd, v(i)});
  for (int i = n_u; i > 0; --i) loop.push_back({u(i), 2});
  for (int i = n_v; i > 0; --i) loop.push_back({-HalfPipe::kEnd, v(i)});
  sheet.boundary = test::polygons({loop}, h);
  for (FaceNode& n : sheet.boundary.nodes) n.x = sheet.surface->point(n.uv);
  return sheet;
}

/// Triangles against the surface at their corners.
int n_turned(const auto& face, const FaceMesh& mesh) {
  const MeshView view{face.boundary, mesh};
  int n = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    const std::int32_t* c = &mesh.corners[i];
    Vec3 normal;
    for (int k = 0; k < 3; ++k) normal = normal + surface_normal(*face.surface, view.uv(c[k]));
    n += dot(cross(view.x(c[1]) - view.x(c[0]), view.x(c[2]) - view.x(c[0])), normal) < 0;
  }
  return n;
}

/// Moves the inner node that is furthest from the boundary over its neighbours.
void fold(const FaceCase& face, FaceMesh& mesh, double h) {
  std::size_t best = 0;
  double most = 0;
  for (std::size_t i = 0; i < mesh.inner.size(); ++i) {
    double least = 1e300;
    for (const FaceNode& b : face.boundary.nodes) least = std::min(least, distance(b.x, mesh.inner[i].x));
    if (least > most) most = least, best = i;
  }
  FaceNode& n = mesh.inner[best];
  const SurfacePoint s = face.surface->evaluate(n.uv);
  n.uv.x += 2 * h / norm(s.du);
  n.x = face.surface->point(n.uv);
  mesh.n_folds = 100;
}

/// Moves the nodes half way along the pipe over their neighbours.
void fold(const Sheet& pipe, FaceMesh& mesh, double h) {
  for (FaceNode& n : mesh.inner) {
    if (std::abs(n.uv.y - 1) > 0.6 * h) continue;
    n.uv.y += 2.5 * h;
    n.x = pipe.surface->point(n.uv);
  }
  mesh.n_folds = 100;
}

/// A planted fold goes, and the mesh is as good as before.
void expect_repair(const auto& face, const SizeField& field, double h) {
  FaceMesh mesh = face.mesh(field);
  ASSERT_EQ(mesh.cause, FailureCause::kNone);
  const double area = MeshView{face.boundary, mesh}.area();
  fold(face, mesh, h);
  ASSERT_GT(n_turned(face, mesh), 0);
  repair_folds(*face.surface, face.boundary, field, {}, mesh);
  EXPECT_EQ(n_turned(face, mesh), 0);
  EXPECT_TRUE(mesh.refinement.empty());
  test::expect_valid(face.boundary, mesh);
  const MeshView view{face.boundary, mesh};
  EXPECT_NEAR(view.area(), area, 0.005 * area);
  EXPECT_GT(view.qualities().front(), 0.5);
  for (const FaceNode& n : mesh.inner) EXPECT_NEAR(distance(face.surface->point(n.uv), n.x), 0, 1e-9);
}

TEST(RepairFolds, meshes_folded_places_again_on_flat_and_round_faces) {
  const double h = 0.2;
  const UniformField field(h);
  for (const char* shape : {"box", "cylinder", "sphere"}) {
    SCOPED_TRACE(shape);
    expect_repair(FaceCase(shape, field), field, h);
  }
}

TEST(RepairFolds, meshes_folded_places_again_whose_normals_turn_half_around_whichever_way_they_point) {
  const double h = 0.07;
  for (const double side : {1.0, -1.0}) {
    SCOPED_TRACE(side);
    expect_repair(half_pipe(side, h), UniformField(h), h);
  }
}

TEST(RepairFolds, looks_for_a_point_once_however_often_it_is_asked) {
  const double h = 0.07;
  const Sheet pipe = half_pipe(1, h);
  const UniformField field(h);
  FaceMesh mesh = pipe.mesh(field);
  fold(pipe, mesh, h);
  const auto& surface = static_cast<const HalfPipe&>(*pipe.surface);
  surface.n_evaluated = 0;
  repair_folds(surface, pipe.boundary, field, {}, mesh);
  ASSERT_EQ(n_turned(pipe, mesh), 0);
  EXPECT_LT(surface.n_evaluated, 3850);  // 3,684; 4,027 where each point of the new mesh is looked for again
}

TEST(RepairFolds, leaves_a_mesh_without_folds_and_one_that_failed_as_they_are) {
  const UniformField field(0.2);
  const FaceCase face("box", field);
  FaceMesh mesh = face.mesh(field);
  const std::vector<std::int32_t> corners = mesh.corners;
  repair_folds(*face.surface, face.boundary, field, {}, mesh);
  EXPECT_EQ(mesh.corners, corners);
  fold(face, mesh, 0.2);
  mesh.cause = FailureCause::kNarrowPart;
  repair_folds(*face.surface, face.boundary, field, {}, mesh);
  EXPECT_EQ(mesh.corners, corners);
}

TEST(RepairFolds, counts_and_names_what_it_cannot_repair) {
  const UniformField field(0.2);
  const FaceCase face("box", field);
  FaceMesh mesh = face.mesh(field);
  const std::size_t n_corners = mesh.corners.size();
  std::swap(mesh.corners[0], mesh.corners[1]);  // its neighbours run the same way along its sides: no disc
  mesh.n_folds = 100;
  repair_folds(*face.surface, face.boundary, field, {}, mesh);
  EXPECT_EQ(mesh.corners.size(), n_corners);
  EXPECT_GT(mesh.n_folds, 0);
  EXPECT_LT(mesh.n_folds, 100);
  EXPECT_EQ(mesh.refinement.size(), static_cast<std::size_t>(mesh.n_folds));
}

/// n x n squares of two triangles each on a plane.
struct Grid {
  int n;
  std::unique_ptr<Surface> surface = std::make_unique<PlaneSurface>(test::kPlane);
  FaceBoundary boundary;
  FaceMesh mesh;

  explicit Grid(int squares) : n(squares) {
    std::vector<Vec2> loop;
    for (int i = 0; i < n; ++i) loop.push_back(place(i, 0));
    for (int i = 0; i < n; ++i) loop.push_back(place(n, i));
    for (int i = n; i > 0; --i) loop.push_back(place(i, n));
    for (int i = n; i > 0; --i) loop.push_back(place(0, i));
    boundary = test::polygons({loop}, length());
    for (int j = 1; j < n; ++j)
      for (int i = 1; i < n; ++i) mesh.inner.push_back({place(i, j), {place(i, j).x, place(i, j).y, 0}, length()});
    for (const Triangle& t : test::grid_triangles(n))
      for (const NodeId k : t.n) mesh.corners.push_back(number(k % (n + 1), k / (n + 1)));
  }
  double length() const { return 10.0 / n; }
  FaceNode& inner(int i, int j) { return mesh.inner[static_cast<std::size_t>((j - 1) * (n - 1) + i - 1)]; }
  void move(int i, int j, Vec2 to) { inner(i, j).uv = to, inner(i, j).x = {to.x, to.y, 0}; }
  Vec2 place(int i, int j) const { return {10.0 * i / n, 10.0 * j / n}; }
  void repair() {
    mesh.n_folds = 1'000'000;
    repair_folds(*surface, boundary, UniformField(length()), {}, mesh);
  }

 private:
  std::int32_t number(int i, int j) const {
    if (j == 0) return i;
    if (i == n) return n + j;
    if (j == n) return 3 * n - i;
    if (i == 0) return 4 * n - j;
    return 4 * n + (j - 1) * (n - 1) + i - 1;
  }
};

TEST(RepairFolds, tries_no_more_than_some_hundred_places) {
  constexpr int kPlaces = 15, kApart = 12;
  Grid grid(kPlaces * kApart);
  for (int j = 0; j < kPlaces; ++j)
    for (int i = 0; i < kPlaces; ++i)
      grid.move(kApart * i + 5, kApart * j + 5, grid.place(kApart * i + 7, kApart * j + 5));
  const int n_before = n_turned(grid, grid.mesh);
  ASSERT_EQ(n_before % (kPlaces * kPlaces), 0);
  grid.repair();
  EXPECT_EQ(n_turned(grid, grid.mesh), n_before / (kPlaces * kPlaces) * (kPlaces * kPlaces - 200));
}

TEST(RepairFolds, leaves_a_place_of_thousands_of_nodes_as_it_is) {
  for (const int n : {30, 50}) {
    Grid grid(n);
    for (int j = 1; j < n; ++j)
      for (int i = 1; i < n; ++i) grid.move(i, j, grid.place(n - i, j));  // all are turned over
    const int n_before = n_turned(grid, grid.mesh);
    ASSERT_GT(n_before, n * n);
    grid.repair();
    EXPECT_EQ(n_turned(grid, grid.mesh), n == 30 ? 0 : n_before);
  }
}

}  // namespace
}  // namespace st
