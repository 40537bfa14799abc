// Formats of flow solvers, as text.
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "io/export/export.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// Two triangles in the plane z = 0, one in y = 0; three groups, two of names that are one word.
SurfaceMesh three_triangles() {
  SurfaceMesh m;
  m.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  m.node_entity_dim.assign(5, 0);
  m.node_entity = {0, 1, 2, 3, 4};
  m.node_t.assign(5, 0);
  m.node_size.assign(5, 1);
  m.triangles = {{{0, 1, 2}}, {{1, 3, 2}}, {{0, 1, 4}}};
  m.triangle_face = {0, 1, 2};
  m.triangle_group = {0, 1, 2};
  m.labels.group_name = {"a b", "a_b", "mirror"};
  m.labels.group_role = {"wall", "farfield", "symmetry"};
  return m;
}

TEST(ExportSolvers, mapbc_has_a_condition_by_role_and_names_that_are_different_words) {
  TemporaryDirectory dir;
  export_mesh(dir / "m.b8.ugrid", three_triangles());
  EXPECT_EQ(read_bytes(dir / "m.mapbc"), "3\n1 4000 a_b\n2 5000 a_b_2\n3 6662 mirror\n");
}

TEST(ExportSolvers, geo_fills_the_msh_beside_it) {
  TemporaryDirectory dir;
  export_mesh(dir / "m.geo", three_triangles());
  export_mesh(dir / "alone.msh", three_triangles());
  EXPECT_EQ(read_bytes(dir / "m.msh"), read_bytes(dir / "alone.msh"));
  EXPECT_NE(read_bytes(dir / "m.geo").find("Merge \"m.msh\";\n"), std::string::npos);
}

TEST(ExportSolvers, binary_ugrid_has_both_byte_orders) {
  TemporaryDirectory dir;
  export_mesh(dir / "m.b8.ugrid", three_triangles());
  export_mesh(dir / "m.lb8.ugrid", three_triangles());
  const std::string big = read_bytes(dir / "m.b8.ugrid"), little = read_bytes(dir / "m.lb8.ugrid");
  ASSERT_EQ(big.size(), little.size());
  EXPECT_EQ(big.size(), 7u * 4 + 5 * 24 + 9 * 4 + 3 * 4);
  EXPECT_EQ(big.substr(0, 8), std::string("\0\0\0\5\0\0\0\3", 8));
  EXPECT_EQ(little.substr(0, 8), std::string("\5\0\0\0\3\0\0\0", 8));
}

/// Faces 0 and 1 are a periodic pair.
SurfaceMesh with_pair(const Similarity& motion) {
  SurfaceMesh m = three_triangles();
  m.merged.pairs = {{0, 1, motion}};
  return m;
}

TEST(ExportSolvers, su2_has_lines_for_periodic_markers) {
  TemporaryDirectory dir;
  const auto first_line = [&](const SurfaceMesh& m) {
    export_mesh(dir / "m.su2", m);
    return read_bytes(dir / "m.su2").substr(0, read_bytes(dir / "m.su2").find('\n'));
  };
  SurfaceMesh m = with_pair(rotation_about({1, 0, 0}, kPi / 2).about({7, 2, 1}));
  const std::string start = "% MARKER_PERIODIC= ( a_b, a_b_2, ", turned = first_line(m);
  ASSERT_TRUE(turned.starts_with(start)) << turned;
  std::istringstream numbers(turned.substr(start.size()));
  for (const double expected : {0, 2, 1, 90, 0, 0, 0, 0, 0}) {  // centre on the axis, degrees, along the axis
    double value = 1e9;
    char comma = 0;
    numbers >> value >> comma;
    EXPECT_NEAR(value, expected, 1e-12) << turned;
  }
  std::swap(m.merged.pairs[0].a, m.merged.pairs[0].b);
  EXPECT_TRUE(first_line(m).starts_with("% MARKER_PERIODIC= ( a_b_2, a_b, ")) << "the other way";
  m.merged.pairs = {{0, 1, {.translation = {0, 0, 1}}}};
  EXPECT_EQ(first_line(m), "% MARKER_PERIODIC= ( a_b, a_b_2, 0, 0, 0, 0, 0, 0, 0, 0, 1 )");
  m.triangle_group[2] = 0;
  EXPECT_EQ(first_line(m), "% a_b and a_b_2 are no periodic markers: other faces are in them");
  EXPECT_EQ(first_line(with_pair(rotation_about({0, 0.6, 0.8}, 1))),
            "% a_b and a_b_2 are no periodic markers: their axis is not along x, y or z");
  EXPECT_EQ(first_line(three_triangles()), "NDIME= 3");
}

TEST(ExportSolvers, su2_has_one_line_for_two_groups_of_several_faces) {
  TemporaryDirectory dir;
  SurfaceMesh m = three_triangles();
  m.triangles.push_back({{1, 3, 4}});
  m.triangle_face = {0, 1, 2, 3};
  m.triangle_group = {0, 1, 0, 1};
  const Similarity up{.translation = {0, 0, 1}};
  m.merged.pairs = {{0, 1, up}, {3, 2, up.inverse()}};  // the second is found the other way round
  export_mesh(dir / "m.su2", m);
  EXPECT_TRUE(read_bytes(dir / "m.su2")
                  .starts_with("% MARKER_PERIODIC= ( a_b, a_b_2, 0, 0, 0, 0, 0, 0, 0, 0, 1 )\nNDIME= 3\n"));
  m.merged.pairs[1].motion = up;
  export_mesh(dir / "m.su2", m);
  EXPECT_TRUE(read_bytes(dir / "m.su2").starts_with("% a_b and a_b_2 are no periodic markers: their faces move"));
}

TEST(ExportSolvers, su2_names_its_markers) {
  TemporaryDirectory dir;
  export_mesh(dir / "m.su2", three_triangles());
  const std::string text = read_bytes(dir / "m.su2");
  EXPECT_NE(text.find("NELEM= 3\n5 0 1 2 0\n"), std::string::npos);
  EXPECT_NE(text.find("NMARK= 3\nMARKER_TAG= a_b\nMARKER_ELEMS= 1\n5 0 1 2\n"), std::string::npos);
  EXPECT_NE(text.find("MARKER_TAG= a_b_2\n"), std::string::npos);
}

TEST(ExportSolvers, quadrilaterals_follow_the_triangles) {
  const SurfaceMesh m = three_triangles();
  const QuadPairs pairs{{2}, {{{0, 1, 3, 2}, 0}}};
  TemporaryDirectory dir;
  const auto text_of = [&](const std::string& name) {
    export_mesh(dir / name, {m, pairs, {}}, {});
    return read_bytes(dir / name);
  };
  EXPECT_TRUE(text_of("m.ugrid").starts_with("5 1 1 0 0 0 0\n"));
  EXPECT_TRUE(text_of("m.ugrid").ends_with("\n1 2 5\n1 2 4 3\n3\n1\n"));
  EXPECT_EQ(text_of("m.lb8.ugrid").size(), 7u * 4 + 5 * 24 + 7 * 4 + 2 * 4);
  EXPECT_NE(text_of("m.su2").find("NELEM= 2\n5 0 1 4 0\n9 0 1 3 2 1\n"), std::string::npos);
  EXPECT_NE(text_of("m.su2").find("MARKER_TAG= a_b\nMARKER_ELEMS= 1\n9 0 1 3 2\n"), std::string::npos);
  EXPECT_NE(text_of("m.mesh").find("Triangles\n1\n1 2 5 3\nQuadrilaterals\n1\n1 2 4 3 1\nEnd"), std::string::npos);
  EXPECT_NE(text_of("m.msh").find("2 1 3 1\n1 1 2 4 3\n2 3 2 1\n2 1 2 5\n"), std::string::npos);
  for (const char* name : {"m.stl", "m.off", "m.poly"})
    EXPECT_ERROR(export_mesh(dir / name, {m, pairs, {}}, {}), kUsage, "triangles only");
}

/// Stretched along a direction where x > 0.5.
class HalfStretched : public UniformField {
 public:
  using UniformField::UniformField;
  LocalSize local(Vec3 x, int&) const override {
    return x.x > 0.5 ? LocalSize{min_size(), 2 * min_size(), {0.6, 0.8, 0}} : LocalSize{min_size(), min_size(), {}};
  }
  bool is_stretched() const override { return true; }
};

TEST(ExportSolvers, sol_holds_lengths_or_metrics) {
  TemporaryDirectory dir;
  export_sol(dir / "m.sol", three_triangles(), UniformField(0.25));
  EXPECT_EQ(read_bytes(dir / "m.sol"),
            "MeshVersionFormatted 2\nDimension\n3\nSolAtVertices\n5\n1 1\n0.25\n0.25\n0.25\n0.25\n0.25\nEnd\n");
  export_sol(dir / "m.sol", three_triangles(), HalfStretched(0.5));
  std::istringstream text(read_bytes(dir / "m.sol"));
  std::string line;
  for (int i = 0; i < 6; ++i) std::getline(text, line);
  EXPECT_EQ(line, "1 3");
  double m[5][6];
  for (auto& row : m)
    for (double& value : row) text >> value;
  ASSERT_TRUE(text.good());
  const double expected[] = {4 - 3 * 0.36, -3 * 0.48, 4 - 3 * 0.64, 0, 0, 4};  // of node 1, at x = 1
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(m[1][k], expected[k], 1e-12);
  EXPECT_EQ(m[0][0], 4);
  EXPECT_EQ(m[0][1], 0);
}

/// A metric of lengths 0.1 along x, 0.2 along y and 0.4 along z.
class ThreeLengths : public UniformField {
 public:
  ThreeLengths() : UniformField(0.1) {}
  LocalSize local_on(Vec3, Vec3 normal, int&) const override {
    if (normal.x > 0.5) return {0.2, 0.4, {0, 0, 1}};
    return normal.y > 0.5 ? LocalSize{0.1, 0.4, {0, 0, 1}} : LocalSize{0.1, 0.2, {0, 1, 0}};
  }
  bool is_stretched() const override { return true; }
  bool has_metrics() const override { return true; }
};

TEST(ExportSolvers, sol_holds_all_lengths_of_a_metric) {
  TemporaryDirectory dir;
  export_sol(dir / "m.sol", three_triangles(), ThreeLengths());
  std::istringstream text(read_bytes(dir / "m.sol"));
  std::string line;
  for (int i = 0; i < 6; ++i) std::getline(text, line);
  for (const double expected : {100.0, 0.0, 25.0, 0.0, 0.0, 6.25}) {
    double value = -1;
    text >> value;
    EXPECT_NEAR(value, expected, 1e-9);
  }
}

TEST(ExportSolvers, nastran_reals_have_a_point_and_fit_their_fields) {
  SurfaceMesh m = three_triangles();
  m.node_xyz[1] = {-1.23456789012345678e-123, 1e22, 3};
  TemporaryDirectory dir;
  export_mesh(dir / "m.bdf", m);
  std::istringstream lines(read_bytes(dir / "m.bdf"));
  int n_nodes = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 72u);
    if (line.starts_with("GRID*")) {
      ++n_nodes;
      for (const std::size_t at : {40u, 56u}) EXPECT_NE(line.substr(at, 16).find('.'), std::string::npos) << line;
    }
  }
  EXPECT_EQ(n_nodes, 5);
}

}  // namespace
}  // namespace st
