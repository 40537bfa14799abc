// st-check with a geometry: areas that chords explain, edges the CAD leaves open, faces without a mesh.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "io/hdf5/artifact.h"
#include "judge/chord_error.h"
#include "stages/check_stage.h"
#include "unit/judge/deviation.h"

namespace st {
namespace {

using test::measure_deviation;

namespace fs = std::filesystem;

/// A cylinder of radius 10 and height 30, written by OpenCASCADE.
constexpr const char* kCylinder = R"brep(
DBRep_DrawableShape

CASCADE Topology V3, (c) Open Cascade
Locations 0
Curve2ds 6
1 0 30 1 0 
2 0 0 1 0 -0 1 10
1 6.2831853071795862 -0 0 1 
1 0 -0 0 1 
1 0 0 1 0 
2 0 0 1 0 -0 1 10
Curves 3
2 0 0 30 0 0 1 1 0 -0 -0 1 0 10
1 10 -2.4492935982947065e-15 0 0 0 1 
2 0 0 0 0 0 1 1 0 -0 -0 1 0 10
Polygon3D 0
PolygonOnTriangulations 0
Surfaces 3
2 0 0 0 0 0 1 1 0 -0 -0 1 0 10
1 0 0 30 0 0 1 1 0 -0 -0 1 0 
1 0 0 0 0 0 1 1 0 -0 -0 1 0 
Triangulations 0

TShapes 13
Ve
1e-07
10 -2.44929359829471e-15 30
0 0

0101101
*
Ed
 1e-07 1 1 0
1  1 0 0 6.28318530717959
2  1 1 0 0 6.28318530717959
2  2 2 0 0 6.28318530717959
0

0101000
+13 0 -13 0 *
Ve
1e-07
10 -2.44929359829471e-15 0
0 0

0101101
*
Ed
 1e-07 1 1 0
1  2 0 0 30
3  3 4CN 1 0 0 30
0

0101000
-13 0 +11 0 *
Ed
 1e-07 1 1 0
1  3 0 0 6.28318530717959
2  5 1 0 0 6.28318530717959
2  6 3 0 0 6.28318530717959
0

0101000
+11 0 -11 0 *
Wi

0101100
-12 0 +10 0 +9 0 -10 0 *
Fa
0  1e-07 1 0

0111000
+8 0 *
Wi

0101100
+12 0 *
Fa
0  1e-07 2 0

0111000
+6 0 *
Wi

0101100
-9 0 *
Fa
0  1e-07 3 0

0111000
-4 0 *
Sh

0101100
+7 0 +5 0 -3 0 *
So

1100000
+2 0 *

+1 0 )brep";

constexpr double kRadius = 10, kHeight = 30;

class CheckCad : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "st_check_cad_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(path("cylinder.brep")) << kCylinder;
    ImportResult imported = import_model(path("cylinder.brep"), {});
    geometry_.header.schema = "geometry";
    geometry_.header.tool = "test";
    geometry_.header.options_json = "{}";
    geometry_.tables = imported.tables;
    geometry_.brep = imported.brep;
    geometry_.is_closed = true;
    geometry_hash_ = write_geometry(path("geometry.hdf"), geometry_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Face whose surface has this type and, for planes, this height.
  FaceId face(SurfaceType type, double z = -1) const {
    for (FaceId f = 0; f < geometry_.tables.n_faces(); ++f)
      if (geometry_.tables.face_type[f] == type &&
          (z < 0 || std::fabs(geometry_.tables.face_box[f].center().z - z) < 1e-3))
        return f;
    return kNone;
  }
  /// The circle at height z.
  EdgeId circle(const Model& model, double z) const {
    for (EdgeId e = 0; e < geometry_.tables.n_edges(); ++e)
      if (std::fabs(model.curve(e)->point(1).z - z) < 1e-9 && std::fabs(model.curve(e)->point(2).z - z) < 1e-9)
        return e;
    return kNone;
  }

  /// The coarsest mesh of n sides: quads halved along the side, fans without a middle node on both caps. Requested: its
  /// chords.
  MeshArtifact make_mesh(int n) const { return make_mesh(n, 2 * kRadius * std::sin(kPi / n)); }
  MeshArtifact make_mesh(int n, double size) const {
    const Model model(geometry_.tables, geometry_.brep);
    MeshArtifact a;
    SurfaceMesh& m = a.mesh;
    for (int ring = 0; ring < 2; ++ring) add_ring(model, ring * kHeight, n, m);
    const FaceId side = face(SurfaceType::kCylinder), bottom = face(SurfaceType::kPlane, 0),
                 top = face(SurfaceType::kPlane, kHeight);
    for (int i = 0; i < n; ++i) {
      const NodeId j = (i + 1) % n;
      const double u = 2 * kPi * i / n, w = 2 * kPi * (i + 1) / n;
      add_triangle(m, side, {{i, j, n + j}}, {Vec2{u, 0}, {w, 0}, {w, kHeight}});
      add_triangle(m, side, {{i, n + j, n + i}}, {Vec2{u, 0}, {w, kHeight}, {u, kHeight}});
    }
    for (NodeId i = 1; i + 1 < n; ++i) {
      add_flat(m, bottom, {{0, i + 1, i}});
      add_flat(m, top, {{n, n + i, n + i + 1}});
    }
    m.node_size.assign(m.node_xyz.size(), size);
    m.labels = geometry_.tables.labels;
    a.header.schema = "mesh";
    a.header.tool = "test";
    a.header.options_json = "{}";
    a.header.geometry_hash = geometry_hash_;
    return a;
  }
  void add_ring(const Model& model, double z, int n, SurfaceMesh& m) const {
    const EdgeId e = circle(model, z);
    for (int i = 0; i < n; ++i) {
      const double t = 2 * kPi * i / n;
      m.node_xyz.push_back(model.curve(e)->point(t));
      m.node_entity_dim.push_back(i ? 1 : 0);
      m.node_entity.push_back(i ? e : geometry_.tables.edge_vertices[2 * e]);
      m.node_t.push_back(i ? t : 0);
    }
  }
  static void add_triangle(SurfaceMesh& m, FaceId f, Triangle t, std::array<Vec2, 3> uv) {
    m.triangles.push_back(t);
    m.triangle_face.push_back(f);
    m.triangle_group.push_back(0);
    m.corner_uv.insert(m.corner_uv.end(), uv.begin(), uv.end());
  }
  static void add_flat(SurfaceMesh& m, FaceId f, Triangle t) {
    const auto uv = [&](int k) { return Vec2{m.node_xyz[t.n[k]].x, m.node_xyz[t.n[k]].y}; };
    add_triangle(m, f, t, {uv(0), uv(1), uv(2)});
  }
  StageSummary check(const MeshArtifact& mesh) const {
    write_mesh(path("mesh.hdf"), mesh);
    return run_check({path("mesh.hdf"), path("geometry.hdf"), "", 0.01, {}, {}});
  }
  using Names = std::vector<std::string>;
  static Names failed_checks(const StageSummary& s) { return nlohmann::json::parse(s.json).at("failed"); }

  fs::path folder_;
  GeometryArtifact geometry_;
  std::string geometry_hash_;
};

TEST_F(CheckCad, explains_the_missing_area_of_a_coarse_mesh_by_its_chords) {
  const Model model(geometry_.tables, geometry_.brep);
  for (const int n : {16, 40}) {
    const MeshArtifact a = make_mesh(n);
    const StageSummary s = check(a);
    EXPECT_EQ(s.code, ExitCode::kOk) << n << " sides: " << s.line;
    const ChordError chords = estimate_chord_error(model, a.mesh);
    const double missing_cap = kPi * kRadius * kRadius - 0.5 * n * kRadius * kRadius * std::sin(2 * kPi / n);
    const double missing_side = 2 * kHeight * kRadius * (kPi - n * std::sin(kPi / n));
    EXPECT_GE(chords.area[face(SurfaceType::kPlane, 0)], 0.99 * missing_cap);
    EXPECT_LE(chords.area[face(SurfaceType::kPlane, 0)], 1.3 * missing_cap);
    EXPECT_GE(chords.found_area[face(SurfaceType::kCylinder)], 0.9 * missing_side);
    EXPECT_NEAR(chords.distance[face(SurfaceType::kCylinder)], kRadius * (1 - std::cos(kPi / n)), 1e-6);
    EXPECT_GE(chords.volume[face(SurfaceType::kCylinder)], 0.9 * kHeight * missing_cap);
  }
}

TEST_F(CheckCad, lets_longer_chords_than_requested_explain_no_more_than_these) {
  const StageSummary s = check(make_mesh(16, 1));  // chords of 3.9
  EXPECT_EQ(failed_checks(s), (Names{"areas", "cad-volume"})) << s.line;
}

TEST_F(CheckCad, fails_a_face_off_by_more_than_3_percent_unless_it_is_below_the_sizes) {
  const auto below = [](const StageSummary& s) {
    return nlohmann::json::parse(s.json).at("checks").at("below-sizes").at("count").get<int>();
  };
  const StageSummary wide = check(make_mesh(6));  // chords of 10; the side is 22 wide, 4.5 % off, the caps are 17 wide
  EXPECT_EQ(failed_checks(wide), (Names{"areas", "cad-area"})) << wide.line;
  EXPECT_EQ(below(wide), 2);
  const StageSummary asked = check(make_mesh(6, 11.5));
  EXPECT_EQ(failed_checks(asked), Names{"cad-area"}) << asked.line;
  EXPECT_EQ(below(asked), 3);
  const StageSummary narrow = check(make_mesh(3));
  EXPECT_EQ(failed_checks(narrow), Names{"cad-area"}) << narrow.line;
  EXPECT_EQ(below(narrow), 3);
  EXPECT_NEAR(nlohmann::json::parse(narrow.json).at("area_difference"), -0.276, 1e-3);
  EXPECT_NEAR(nlohmann::json::parse(narrow.json).at("volume_difference"), -0.587, 1e-3);
}

TEST_F(CheckCad, lets_faces_below_the_sizes_be_off_by_a_negligible_part_of_the_whole) {
  const auto wrong = [&] {
    geometry_hash_ = write_geometry(path("geometry.hdf"), geometry_);
    return nlohmann::json::parse(check(make_mesh(3)).json).at("checks").at("areas").at("count").get<int>();
  };
  std::vector<double>& area = geometry_.tables.face_area;
  for (const double z : {0.0, kHeight}) area[face(SurfaceType::kPlane, z)] *= 3;
  EXPECT_EQ(wrong(), 2) << "both caps";
  area[face(SurfaceType::kCylinder)] *= 1e7;
  EXPECT_EQ(wrong(), 1) << "the side only";
}

TEST_F(CheckCad, fails_nodes_off_their_face_whatever_the_tolerances_of_the_cad) {
  for (double& t : geometry_.tables.edge_tolerance) t = 5;
  geometry_hash_ = write_geometry(path("geometry.hdf"), geometry_);
  MeshArtifact a = make_mesh(40);
  a.mesh.node_xyz[45].z += 0.07;  // of 41, and of a requested length of 1.57
  EXPECT_EQ(check(a).code, ExitCode::kOk);
  a.mesh.node_xyz[45].z += 0.02;
  const StageSummary s = check(a);
  EXPECT_EQ(failed_checks(s), Names{"off-surface"}) << s.line;
}

TEST_F(CheckCad, fails_nodes_that_lie_elsewhere_on_their_face_whatever_the_tolerances_of_the_cad) {
  for (double& t : geometry_.tables.edge_tolerance) t = 5;
  geometry_hash_ = write_geometry(path("geometry.hdf"), geometry_);
  MeshArtifact a = make_mesh(40);
  const FaceId side = face(SurfaceType::kCylinder);
  const auto t = static_cast<std::size_t>(std::ranges::find(a.mesh.triangle_face, side) - a.mesh.triangle_face.begin());
  double& v = a.mesh.corner_uv[3 * t].y;
  v += v < 1 ? 0.5 : -0.5;  // a quarter of the requested length is 0.39, twice 0.05 of it 0.16
  EXPECT_EQ(check(a).code, ExitCode::kOk);
  v += v < 1 ? 0.1 : -0.1;
  const StageSummary s = check(a);
  EXPECT_EQ(failed_checks(s), Names{"off-surface"}) << s.line;
}

TEST_F(CheckCad, finds_a_face_whose_area_and_a_mesh_whose_volume_is_wrong) {
  MeshArtifact a = make_mesh(40);
  for (std::size_t n = 40; n < 80; ++n) a.mesh.node_xyz[n].z -= 0.6;  // 2 % of the height
  const StageSummary s = check(a);
  EXPECT_EQ(s.code, ExitCode::kIncomplete);
  EXPECT_EQ(failed_checks(s), (Names{"areas", "cad-volume", "off-surface"}));
  EXPECT_NE(s.line.find("note: 2 faces with nodes off the surface"), std::string::npos) << s.line;
}

TEST_F(CheckCad, measures_how_far_midpoints_and_normals_are_off_the_surface) {
  const Model model(geometry_.tables, geometry_.brep);
  const FaceId side = face(SurfaceType::kCylinder), top = face(SurfaceType::kPlane, kHeight);
  for (const int n : {8, 40}) {
    const SurfaceDeviation d = measure_deviation(model, make_mesh(n).mesh);
    const double turn = 2 * kPi / n;  // a midpoint lies at a third of the chord
    const double radius = kRadius * std::sqrt(1 - 8.0 / 9 * std::pow(std::sin(turn / 2), 2));
    EXPECT_NEAR(d.faces[side].max_distance, kRadius - radius, 1e-6);
    EXPECT_NEAR(d.faces[side].mean_distance(), kRadius - radius, 1e-6);
    EXPECT_NEAR(d.faces[side].max_angle_deg, degrees(std::atan(std::tan(turn / 2) / 3)), 1e-4);
    EXPECT_NEAR(d.faces[top].max_distance, 0, 1e-9);
    EXPECT_NEAR(d.faces[top].max_angle_deg, 0, 1e-6);
    EXPECT_EQ(d.worst_distance, side);
    EXPECT_EQ(d.model.n_triangles, 2 * n + 2 * (n - 2));
  }
}

TEST_F(CheckCad, does_not_mind_a_mesh_turned_as_a_whole) {
  const Model model(geometry_.tables, geometry_.brep);
  MeshArtifact a = make_mesh(12);
  for (std::size_t t = 0; t < a.mesh.triangles.size(); ++t) {
    std::swap(a.mesh.triangles[t].n[1], a.mesh.triangles[t].n[2]);
    std::swap(a.mesh.corner_uv[3 * t + 1], a.mesh.corner_uv[3 * t + 2]);
  }
  EXPECT_LT(measure_deviation(model, a.mesh).model.max_angle_deg, 15);
}

TEST_F(CheckCad, holds_deviations_to_their_thresholds) {
  const auto failed = [&](const std::string& distance, std::optional<double> angle_deg) {
    write_mesh(path("mesh.hdf"), make_mesh(40));
    CheckStageOptions o{path("mesh.hdf"), path("geometry.hdf"), "", 0.01, {}, {}};
    o.thresholds.max_deviation = distance;
    o.thresholds.max_normal_deviation_deg = angle_deg;
    const StageSummary s = run_check(o);
    EXPECT_EQ(s.code == ExitCode::kOk, failed_checks(s).empty());
    return failed_checks(s);
  };
  EXPECT_EQ(failed("0.028", 1.6), Names{});  // measured: 0.0274, 1.503 degrees
  EXPECT_EQ(failed("0.027", 1.6), Names{"max-deviation"});
  EXPECT_EQ(failed("0.028", 1.5), Names{"max-normal-deviation"});
  EXPECT_EQ(failed("0.1%", {}), Names{}) << "of the diagonal of 41";
  EXPECT_EQ(failed("0.05%", {}), Names{"max-deviation"});
}

TEST_F(CheckCad, finds_a_face_without_triangles) {
  const FaceId top = face(SurfaceType::kPlane, kHeight);
  const MeshArtifact whole = make_mesh(16);
  MeshArtifact a = whole;
  a.mesh.triangles.clear(), a.mesh.triangle_face.clear(), a.mesh.triangle_group.clear(), a.mesh.corner_uv.clear();
  for (std::size_t t = 0; t < whole.mesh.triangles.size(); ++t) {
    const Vec2* uv = &whole.mesh.corner_uv[3 * t];
    if (whole.mesh.triangle_face[t] != top)
      add_triangle(a.mesh, whole.mesh.triangle_face[t], whole.mesh.triangles[t], {uv[0], uv[1], uv[2]});
  }
  const StageSummary s = check(a);
  EXPECT_EQ(s.code, ExitCode::kIncomplete);
  EXPECT_EQ(failed_checks(s), (Names{"closed", "faces"}));
  EXPECT_EQ(nlohmann::json::parse(s.json).at("boundary_edges"), 16);
}

TEST_F(CheckCad, refuses_a_mesh_of_another_geometry) {
  MeshArtifact a = make_mesh(12);
  a.header.geometry_hash = "0123456789abcdef0123456789abcdef";
  try {
    check(a);
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kMismatch);
  }
}

}  // namespace
}  // namespace st
