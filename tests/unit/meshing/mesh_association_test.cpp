// A triangulation of another program on a CAD model: what lies where.
#include "meshing/associate/mesh_association.h"

#include <algorithm>

#include "base/error.h"
#include "meshing/associate/part_matching.h"
#include "meshing/hole/hole_mesh.h"
#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

/// Two triangles on each side of a box between `lo` and `hi`, behind what `mesh` has.
void add_box(SurfaceMesh& mesh, Vec3 lo, Vec3 hi) {
  const auto first = static_cast<NodeId>(mesh.node_xyz.size());
  for (int i = 0; i < 8; ++i) mesh.node_xyz.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  const int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& s : sides) {
    mesh.triangles.push_back({{first + s[0], first + s[1], first + s[2]}});
    mesh.triangles.push_back({{first + s[0], first + s[2], first + s[3]}});
  }
  mesh.node_size.assign(mesh.node_xyz.size(), 1);
}

class Association : public testing::Test {
 protected:
  void SetUp() override { add_box(mesh, model.tables().box().lo, model.tables().box().hi); }
  std::string message() const {
    try {
      associate_mesh(mesh, model, {1e-3});
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kMismatch);
      return e.what();
    }
    return "no error";
  }
  void expect_message(const std::string& part) const {
    const std::string said = message();
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
  Model model = make_model("box");
  SurfaceMesh mesh;
};

TEST_F(Association, of_a_box_has_its_corners_on_vertices_and_two_triangles_on_each_face) {
  const AssociatedMesh a = associate_mesh(mesh, model, {1e-3});
  EXPECT_EQ(a.report.n_nodes[0], 8);
  EXPECT_EQ(a.report.n_nodes[1] + a.report.n_nodes[2], 0);
  EXPECT_EQ(a.report.face_triangles, std::vector<std::int64_t>(6, 2));
  EXPECT_LT(a.report.max_distance, 1e-3);
  for (NodeId n = 0; n < 8; ++n) EXPECT_TRUE(a.mesh.node_xyz[n] == mesh.node_xyz[a.file_node[n]]);
  for (TriangleId t = 0; t < 12; ++t) {
    const auto surface = model.surface(a.mesh.triangle_face[t]);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(a.file_node[a.mesh.triangles[t].n[k]], mesh.triangles[a.file_triangle[t]].n[k]);
      EXPECT_LT(distance(surface->point(a.mesh.corner_uv[3 * t + k]), a.mesh.node_xyz[a.mesh.triangles[t].n[k]]), 1e-3);
    }
  }
  EXPECT_EQ(HoleMesh(a.mesh, model.tables()).segments.size(), 12u);  // it is canonical, and each edge one segment
}

TEST_F(Association, turns_triangles_that_disagree_with_the_rest_of_their_face) {
  std::swap(mesh.triangles[4].n[0], mesh.triangles[4].n[1]);
  const AssociatedMesh a = associate_mesh(mesh, model, {1e-3});
  EXPECT_EQ(a.report.n_turned, 1);
}

TEST_F(Association, tells_a_wrong_unit_from_another_model) {
  for (Vec3& x : mesh.node_xyz) x = 25.4 * x;
  expect_message("25.4 times as large");
  expect_message("mm for inches");
  for (Vec3& x : mesh.node_xyz) x = 0.1 * x;
  expect_message("no unit explains");
}

TEST_F(Association, says_where_triangles_are_missing) {
  mesh.triangles.pop_back();
  expect_message("3 of its edges lack a triangle");
}

TEST_F(Association, says_which_vertices_have_no_node) {
  mesh.node_xyz[7] = mesh.node_xyz[7] - Vec3{0.1, 0, 0};
  expect_message("1 of 8 CAD vertices have no node");
}

TEST_F(Association, says_which_edges_are_crossed) {
  const NodeId extra = 8;  // in the middle of an edge, but off it
  mesh.node_xyz.push_back(0.5 * (mesh.node_xyz[0] + mesh.node_xyz[1]) + Vec3{0, 0, 0.1});
  mesh.node_size.push_back(1);
  std::vector<Triangle> split;
  for (const Triangle& t : mesh.triangles) {
    int side = -1;
    for (int k = 0; k < 3; ++k)
      if (std::minmax(t.n[k], t.n[(k + 1) % 3]) == std::minmax<NodeId>(0, 1)) side = k;
    if (side < 0) {
      split.push_back(t);
      continue;
    }
    const NodeId a = t.n[side], b = t.n[(side + 1) % 3], c = t.n[(side + 2) % 3];
    split.push_back({{a, extra, c}});
    split.push_back({{extra, b, c}});
  }
  mesh.triangles = split;
  expect_message("no chain of mesh edges follows 1 of 12 CAD edges");
}

TEST(PartMatching, tells_touching_boxes_apart) {
  const Model model = make_model("two_boxes");
  const Box3 box = model.tables().box();
  SurfaceMesh mesh;
  add_box(mesh, box.lo, box.hi);
  EXPECT_EQ(match_parts(mesh, model.tables()).n_parts, 1);
  add_box(mesh, box.lo, 0.5 * (box.lo + box.hi));
  EXPECT_EQ(match_parts(mesh, model.tables()).n_parts, 2);
}

/// Points and triangles alone.
SurfaceMesh bare(const SurfaceMesh& mesh) {
  SurfaceMesh m;
  m.node_xyz = mesh.node_xyz;
  m.triangles = mesh.triangles;
  m.node_size = mesh.node_size;
  return m;
}

void expect_entities(const AssociatedMesh& a, const SurfaceMesh& made) {
  ASSERT_EQ(a.mesh.n_nodes(), made.n_nodes());
  for (NodeId n = 0; n < a.mesh.n_nodes(); ++n) {
    EXPECT_EQ(a.mesh.node_entity_dim[n], made.node_entity_dim[a.file_node[n]]);
    EXPECT_EQ(a.mesh.node_entity[n], made.node_entity[a.file_node[n]]);
    EXPECT_NEAR(a.mesh.node_t[n], made.node_t[a.file_node[n]], 1e-6);
  }
}

/// Triangles on their faces, and on the right side of seams and poles.
void expect_parameters(const AssociatedMesh& a, const ShapeMesh& solid) {
  ASSERT_EQ(a.mesh.n_triangles(), solid.mesh.n_triangles());
  for (TriangleId t = 0; t < a.mesh.n_triangles(); ++t) {
    const TriangleId old = a.file_triangle[t];
    EXPECT_EQ(a.mesh.triangle_face[t], solid.mesh.triangle_face[old]);
    const auto surface = solid.model.surface(a.mesh.triangle_face[t]);
    double area = 0, area_before = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec2 p = a.mesh.corner_uv[3 * t + k], q = a.mesh.corner_uv[3 * t + (k + 1) % 3];
      EXPECT_LE(distance(surface->point(p), a.mesh.node_xyz[a.mesh.triangles[t].n[k]]), 1e-5);
      area += cross(p, q);
      area_before += cross(solid.mesh.corner_uv[3 * old + k], solid.mesh.corner_uv[3 * old + (k + 1) % 3]);
    }
    EXPECT_GT(area * area_before, 0) << t;
  }
}

class AssociatedSolid : public testing::TestWithParam<const char*> {};

TEST_P(AssociatedSolid, has_the_entities_and_parameters_it_was_made_with) {
  const ShapeMesh solid(GetParam(), 0.05);
  const AssociatedMesh a = associate_mesh(bare(solid.mesh), solid.model, {});
  EXPECT_EQ(a.report.n_turned, 0);
  expect_entities(a, solid.mesh);
  expect_parameters(a, solid);
}

TEST_P(AssociatedSolid, is_the_same_when_some_of_its_triangles_were_turned) {
  const ShapeMesh solid(GetParam(), 0.05);
  SurfaceMesh foreign = bare(solid.mesh);
  for (std::size_t t = 0; t < foreign.triangles.size(); t += 5)
    std::swap(foreign.triangles[t].n[1], foreign.triangles[t].n[2]);
  const AssociatedMesh a = associate_mesh(foreign, solid.model, {});
  EXPECT_EQ(a.report.n_turned, (solid.mesh.n_triangles() + 4) / 5);
  expect_entities(a, solid.mesh);
  expect_parameters(a, solid);
}

TEST(AssociatedMesh, that_lies_elsewhere_or_has_a_node_on_no_face_is_refused) {
  const ShapeMesh solid("cylinder", 0.05);
  const double size = solid.model.tables().reference_diagonal();
  const auto message = [&](const SurfaceMesh& m) -> std::string {
    try {
      associate_mesh(m, solid.model, {});
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  SurfaceMesh moved = bare(solid.mesh);
  for (Vec3& x : moved.node_xyz) x.x += 0.2 * size;
  EXPECT_NE(message(moved).find("is at another place"), std::string::npos) << message(moved);
  SurfaceMesh dented = bare(solid.mesh);
  ASSERT_EQ(solid.mesh.node_entity_dim.back(), 2);
  dented.node_xyz.back() = dented.node_xyz.back() + Vec3{0.01 * size, 0.01 * size, 0.01 * size};
  EXPECT_NE(message(dented).find("lie on no face"), std::string::npos) << message(dented);
}

INSTANTIATE_TEST_SUITE_P(, AssociatedSolid, testing::ValuesIn(kSolids),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace st::test
