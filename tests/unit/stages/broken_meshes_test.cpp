// st-check is proven by meshes that are broken on purpose, one defect each: it finds each of them, and says no other
// thing of it than is listed here.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "base/log.h"
#include "geometry/import/import.h"
#include "io/hdf5/artifact.h"
#include "stages/check_stage.h"
#include "support/meshed.h"

namespace st {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// A model meshed with length 4; the box is 60 x 40 x 20.
SurfaceMesh good_mesh(Model model) { return test::Meshed(std::move(model), 4).mesh; }

void add_triangle(SurfaceMesh& m, Triangle t, TriangleId like) {
  m.triangles.push_back(t);
  m.triangle_face.push_back(m.triangle_face[like]);
  m.triangle_group.push_back(m.triangle_group[like]);
  for (int k = 0; k < 3; ++k) m.corner_uv.push_back(m.corner_uv[3 * like + k]);
}

void remove_triangle(SurfaceMesh& m, TriangleId t) {
  m.triangles.erase(m.triangles.begin() + t);
  m.triangle_face.erase(m.triangle_face.begin() + t);
  m.triangle_group.erase(m.triangle_group.begin() + t);
  m.corner_uv.erase(m.corner_uv.begin() + 3 * t, m.corner_uv.begin() + 3 * t + 3);
}

NodeId copy_node(SurfaceMesh& m, NodeId n) {
  m.node_xyz.push_back(Vec3(m.node_xyz[n]));
  m.node_entity_dim.push_back(std::uint8_t(m.node_entity_dim[n]));
  m.node_entity.push_back(std::int32_t(m.node_entity[n]));
  m.node_t.push_back(double(m.node_t[n]));
  m.node_size.push_back(double(m.node_size[n]));
  return static_cast<NodeId>(m.n_nodes()) - 1;
}

/// A triangle of face 0 whose nodes all lie inside the face.
TriangleId inner_triangle(const SurfaceMesh& m, FaceId face = 0) {
  for (TriangleId t = 0; t < m.n_triangles(); ++t) {
    const auto& n = m.triangles[t].n;
    if (m.triangle_face[t] == face && std::all_of(n, n + 3, [&](NodeId i) { return m.node_entity_dim[i] == 2; }))
      return t;
  }
  return kNone;
}

Vec3 normal_of(const SurfaceMesh& m, TriangleId t) {
  const auto& n = m.triangles[t].n;
  return normalized(cross(m.node_xyz[n[1]] - m.node_xyz[n[0]], m.node_xyz[n[2]] - m.node_xyz[n[0]]));
}

/// Moves corner 0 of an inner triangle within its plane, (u,v) with it.
void move_in_plane(SurfaceMesh& m, TriangleId t, Vec3 to) {
  const NodeId moved = m.triangles[t].n[0];
  const auto& n = m.triangles[t].n;
  const Vec3 a = m.node_xyz[n[1]] - m.node_xyz[n[0]], b = m.node_xyz[n[2]] - m.node_xyz[n[0]],
             d = to - m.node_xyz[n[0]];
  const Vec3 normal = cross(a, b);
  const double s = dot(cross(d, b), normal) / norm2(normal), r = dot(cross(a, d), normal) / norm2(normal);
  const Vec2 uv = m.corner_uv[3 * t] + s * (m.corner_uv[3 * t + 1] - m.corner_uv[3 * t]) +
                  r * (m.corner_uv[3 * t + 2] - m.corner_uv[3 * t]);
  for (TriangleId i = 0; i < m.n_triangles(); ++i)
    for (int k = 0; k < 3; ++k)
      if (m.triangles[i].n[k] == moved) m.corner_uv[3 * i + k] = uv;
  m.node_xyz[moved] = to;
}

void flip(SurfaceMesh& m, TriangleId t) {
  std::swap(m.triangles[t].n[1], m.triangles[t].n[2]);
  std::swap(m.corner_uv[3 * t + 1], m.corner_uv[3 * t + 2]);
}

struct Defect {
  const char* name;
  std::function<void(SurfaceMesh&)> make;
  Names failed;  // the checks that fail, and no other
};

void PrintTo(const Defect& d, std::ostream* out) { *out << d.name; }

void cut_t_junction(SurfaceMesh& m) {
  const TriangleId t = inner_triangle(m);
  const Triangle old = m.triangles[t];
  const NodeId middle = copy_node(m, old.n[0]);
  constexpr double kInside = 1e-6;  // of the triangle: beside the neighbour, whatever the rounding
  const Vec3 on_side = 0.5 * (m.node_xyz[old.n[0]] + m.node_xyz[old.n[1]]);
  m.node_xyz[middle] = on_side + kInside * (m.node_xyz[old.n[2]] - on_side);
  const Vec2 uv = 0.5 * (m.corner_uv[3 * t] + m.corner_uv[3 * t + 1]);
  add_triangle(m, {{middle, old.n[1], old.n[2]}}, t);
  m.corner_uv[m.corner_uv.size() - 3] = uv;
  m.triangles[t].n[1] = middle;
  m.corner_uv[3 * t + 1] = uv;
}

void lift_a_fin(SurfaceMesh& m) {
  const TriangleId t = inner_triangle(m);
  const Triangle old = m.triangles[t];
  const NodeId tip = copy_node(m, old.n[2]);
  m.node_xyz[tip] += 0.8 * normal_of(m, t);  // within a quarter of the length: not off the surface
  add_triangle(m, {{old.n[0], old.n[1], tip}}, t);
}

void split_a_node(SurfaceMesh& m) {  // two nodes where one was: a slit
  const TriangleId t = inner_triangle(m);
  const NodeId old = m.triangles[t].n[0];
  m.triangles[t].n[0] = copy_node(m, old);
}

void name_a_node_twice(SurfaceMesh& m) {
  const TriangleId t = inner_triangle(m);
  m.triangles[t].n[1] = m.triangles[t].n[0];
  m.corner_uv[3 * t + 1] = Vec2(m.corner_uv[3 * t]);
}

void fold(SurfaceMesh& m) {  // a node drawn over its neighbours' far edge, in the face's plane
  const TriangleId t = inner_triangle(m);
  const auto& n = m.triangles[t].n;
  move_in_plane(m, t, m.node_xyz[n[0]] + 2.2 * (0.5 * (m.node_xyz[n[1]] + m.node_xyz[n[2]]) - m.node_xyz[n[0]]));
}

void flatten(SurfaceMesh& m) {  // a corner onto the middle of the opposite side: no area, and its neighbour folds over
  const TriangleId t = inner_triangle(m);
  const auto& n = m.triangles[t].n;
  for (const NodeId i : n) {  // few digits: the middle is exact
    const auto rounded = [](double x) { return std::round(1024 * x) / 1024; };
    m.node_xyz[i] = {rounded(m.node_xyz[i].x), rounded(m.node_xyz[i].y), rounded(m.node_xyz[i].z)};
  }
  move_in_plane(m, t, 0.5 * (m.node_xyz[n[1]] + m.node_xyz[n[2]]));
}

void push_through(SurfaceMesh& m) {  // a node of the top through the bottom
  const TriangleId top = inner_triangle(m, 5), bottom = inner_triangle(m, 4);
  Vec3& x = m.node_xyz[m.triangles[top].n[0]];
  x += 1.2 * dot(m.node_xyz[m.triangles[bottom].n[0]] - x, normal_of(m, top)) * normal_of(m, top);
}

void turn_the_shell(SurfaceMesh& m) {
  for (TriangleId t = 0; t < m.n_triangles(); ++t) flip(m, t);
}

void swap_face_ids(SurfaceMesh& m) {  // of two opposite faces of the same area
  for (FaceId& f : m.triangle_face) f = f == 0 ? 1 : f == 1 ? 0 : f;
}

void drop_a_face(SurfaceMesh& m) {
  for (TriangleId t = static_cast<TriangleId>(m.n_triangles()) - 1; t >= 0; --t)
    if (m.triangle_face[t] == 3) remove_triangle(m, t);
}

const std::vector<Defect>& defects() {
  static const std::vector<Defect> list = {
      {"hole", [](SurfaceMesh& m) { remove_triangle(m, inner_triangle(m)); }, {"closed"}},
      {"missing_face", drop_a_face, {"closed", "faces"}},
      {"t_junction", cut_t_junction, {"closed"}},
      {"duplicate_node", split_a_node, {"closed", "duplicate-nodes", "crossings", "overlaps"}},
      {"duplicate_triangle",
       [](SurfaceMesh& m) { add_triangle(m, m.triangles[inner_triangle(m)], inner_triangle(m)); },
       {"manifold", "duplicate-triangles"}},
      {"fin", lift_a_fin, {"closed", "manifold", "off-surface"}},
      {"flipped_triangle", [](SurfaceMesh& m) { flip(m, inner_triangle(m)); }, {"oriented"}},
      {"repeated_node", name_a_node_twice, {"closed", "repeated-nodes"}},
      {"degenerate_triangle", flatten, {"zero-area", "crossings", "overlaps"}},
      {"fold", fold, {"folds", "areas", "crossings", "overlaps"}},
      {"crossing", push_through, {"crossings", "off-surface", "areas", "cad-area", "cad-volume"}},
      {"node_off_surface",
       [](SurfaceMesh& m) { m.node_xyz[m.triangles[inner_triangle(m)].n[0]] += 2.0 * normal_of(m, inner_triangle(m)); },
       {"off-surface"}},
      {"wrong_face_id_of_one_triangle",
       [](SurfaceMesh& m) { m.triangle_face[inner_triangle(m, 0)] = 4; },
       {"off-surface"}},
      {"wrong_face_ids_of_two_faces", swap_face_ids, {"off-surface"}},
      {"inward_shell", turn_the_shell, {"volume", "cad-volume"}},
      {"no_triangles",
       [](SurfaceMesh& m) {
         m.triangles.clear(), m.triangle_face.clear(), m.triangle_group.clear(), m.corner_uv.clear();
       },
       {"complete", "faces", "volume", "cad-volume"}},
  };
  return list;
}

class BrokenMesh : public testing::TestWithParam<Defect> {
 protected:
  void SetUp() override {
    set_verbosity(Verbosity::kQuiet);
    std::string name = (fs::temp_directory_path() / "st_broken_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Names of the checks that fail.
  Names check(const std::function<void(SurfaceMesh&)>& make, const std::string& shape = "box") {
    ImportResult import = test::import_shape(shape);
    GeometryArtifact g;
    g.header.schema = "geometry";
    g.header.tool = "test";
    g.header.options_json = "{}";
    g.tables = import.tables;
    g.brep = import.brep;
    g.is_closed = true;
    MeshArtifact m;
    m.header.schema = "mesh";
    m.header.tool = "test";
    m.header.options_json = "{}";
    m.header.geometry_hash = write_geometry((folder_ / "geometry.hdf").string(), g);
    m.mesh = good_mesh(Model(std::move(import.tables), std::move(import.brep)));
    make(m.mesh);
    write_mesh((folder_ / "mesh.hdf").string(), m);
    CheckStageOptions o;
    o.mesh = (folder_ / "mesh.hdf").string();
    o.geometry = (folder_ / "geometry.hdf").string();
    const StageSummary s = run_check(o);
    const auto json = nlohmann::json::parse(s.json);
    EXPECT_EQ(s.code == ExitCode::kOk, json["failed"].empty());
    return json["failed"].get<Names>();
  }
  fs::path folder_;
};

TEST_F(BrokenMesh, passes_when_it_is_not) {
  EXPECT_EQ(check([](SurfaceMesh&) {}), Names{});
}

TEST_F(BrokenMesh, passes_where_the_rims_of_a_thin_plate_are_merged) {
  std::size_t n_merged = 0;
  EXPECT_EQ(check([&](SurfaceMesh& m) { n_merged = m.merged.strip_face.size(); }, "thin_plate"), Names{});
  EXPECT_GT(n_merged, 0u);
}

TEST_P(BrokenMesh, is_found) {
  const Names failed = check(GetParam().make);
  for (const std::string& name : GetParam().failed) EXPECT_TRUE(failed.count(name)) << name << " does not fail";
  EXPECT_EQ(failed, GetParam().failed);
}

INSTANTIATE_TEST_SUITE_P(, BrokenMesh, testing::ValuesIn(defects()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace st
