#include "stages/report_cad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/shapes.h"

namespace st {
namespace {

/// Length of the lines of each kind.
std::map<LineKind, double> lengths(const CadLines& lines) {
  std::map<LineKind, double> length;
  std::size_t i = 0;
  for (const LineRun& run : lines.runs)
    for (const std::size_t end = i + 2 * static_cast<std::size_t>(run.n_lines); i < end; i += 2)
      length[run.kind] += distance(lines.ends[i], lines.ends[i + 1]);
  EXPECT_EQ(i, lines.ends.size());
  std::int64_t n_lines = 0;
  for (const EdgeLines& own : lines.edges) n_lines += own.n_lines;
  EXPECT_EQ(2 * n_lines, static_cast<std::int64_t>(lines.ends.size()));
  return length;
}

double length_of(const Model& model) {
  double sum = 0;
  for (const double length : model.tables().edge_length) sum += length;
  return sum;
}

TEST(ReportCad, draws_each_edge_once_and_no_pole) {
  for (const char* shape : {"box", "sphere"}) {
    const Model model = test::make_model(shape);
    const std::map<LineKind, double> found = lengths(cad_lines(model, {}));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found.at(LineKind::kEdge), length_of(model), 0.002 * length_of(model)) << shape;
  }
}

TEST(ReportCad, marks_all_loops_of_faces_without_a_mesh) {
  const Model model = test::make_model("box");
  const FaceId face = 3;
  double around = 0;
  for (const EdgeId e : model.tables().edges_of(face)) around += model.tables().edge_length[e];
  const std::map<LineKind, double> found = lengths(cad_lines(model, std::span(&face, 1)));
  EXPECT_NEAR(found.at(LineKind::kUnmeshed), around, 1e-9 * around);
  EXPECT_NEAR(found.at(LineKind::kEdge), length_of(model) - around, 1e-9 * around);
}

TEST(ReportCad, marks_where_the_cad_is_open) {
  const Model model = test::make_model("square");
  const std::map<LineKind, double> found = lengths(cad_lines(model, {}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found.at(LineKind::kFree), length_of(model), 1e-9 * length_of(model));
}

TEST(ReportCad, shows_every_face_as_facets_near_its_surface) {
  const Model model = test::make_model("cylinder");
  const SurfaceMesh mesh = facet_mesh(model);
  std::vector<double> area(model.tables().n_faces(), 0);
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    const auto& n = mesh.triangles[t].n;
    const Vec3 a = mesh.node_xyz[n[0]], b = mesh.node_xyz[n[1]], c = mesh.node_xyz[n[2]];
    area[mesh.triangle_face[t]] += 0.5 * norm(cross(b - a, c - a));
    EXPECT_EQ(mesh.triangle_group[t], model.tables().labels.face_group[mesh.triangle_face[t]]);
  }
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    EXPECT_NEAR(area[f], model.tables().face_area[f], 0.03 * model.tables().face_area[f]) << f;
}

}  // namespace
}  // namespace st
