#include <cmath>
#include <cstring>
#include <sstream>

#include "io/export/export.h"
#include "io/hdf5/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(Export, knows_formats_by_suffix_whatever_its_case) {
  TemporaryDirectory dir;
  for (const char* name :
       {"m.stl", "m.VTU", "m.Obj", "m.ply", "m.msh", "m.fro", "m.ASCII.stl", "m.Cgns", "m.eMesh", "m.meshb"}) {
    EXPECT_NO_THROW(require_export_format(dir / name, {}));
    export_mesh(dir / name, sample_mesh().mesh);
    EXPECT_GT(read_bytes(dir / name).size(), 80u) << name;
  }
  EXPECT_EQ(dir.files().size(), 10u);
}

TEST(Export, refuses_unknown_suffixes_before_writing) {
  TemporaryDirectory dir;
  for (const char* name : {"m.xyz", "m", "m.", "m.stl.gz"}) {
    EXPECT_ERROR(require_export_format(dir / name, {}), kUsage, "use one of .ascii.stl, .stl, .vtu");
    EXPECT_ERROR(require_export_format(dir / name, {}), kUsage, ".csv, .eMesh, with st-export also .vtm");
    EXPECT_ERROR(export_mesh(dir / name, sample_mesh().mesh), kUsage, name);
  }
  EXPECT_ERROR(require_export_format("folder.stl/m", {}), kUsage, "unknown suffix ''");
  EXPECT_ERROR(require_export_format("a/m.vtm", {}), kUsage,
               ".vtm is made of a finished mesh: st-export mesh.hdf -o m.vtm");
  EXPECT_TRUE(dir.files().empty());
}

TEST(Export, leaves_nothing_when_it_cannot_write) {
  EXPECT_ERROR(export_mesh("/none/m.stl", sample_mesh().mesh), kOutput, "/none/m.stl");
  TemporaryDirectory dir;
  EXPECT_ERROR(export_mesh(dir / "none/m.vtu", sample_mesh().mesh), kOutput, "create it first");
  EXPECT_TRUE(dir.files().empty());
}

TEST(Export, writes_equal_meshes_as_equal_bytes) {
  TemporaryDirectory dir;
  for (const char* suffix :
       {".stl", ".ascii.stl", ".vtu", ".obj", ".ply", ".msh", ".fro", ".cgns", ".meshb", ".binary.msh"}) {
    export_mesh(dir / "a" + suffix, sample_mesh().mesh);
    export_mesh(dir / "b" + suffix, sample_mesh().mesh);
    EXPECT_EQ(read_bytes(dir / "a" + suffix), read_bytes(dir / "b" + suffix)) << suffix;
  }
}

TEST(Export, writes_every_division_of_the_faces_as_physical_surfaces_of_msh) {
  TemporaryDirectory dir;
  export_mesh(dir / "m.msh", sample_mesh().mesh);
  const std::string text = read_bytes(dir / "m.msh");
  EXPECT_NE(
      text.find(
          "$PhysicalNames\n10\n2 1 \"body\"\n2 2 \"wing\"\n2 3 \"part:Träger/bolt#1\"\n2 4 \"part:Träger/bolt#2\"\n"
          "2 5 \"group_table:hot\"\n2 6 \"group_table:cold\"\n2 7 \"group_table:Öl\"\n"
          "1 8 \"te\"\n1 9 \"group_table:root\"\n0 10 \"tip\"\n$End"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("2 0 0 0 1 0.2 1 3 1 3 7 0\n"), std::string::npos)
      << "face 2 is of body, the first part and Öl: " << text;
}

TEST(Export, writes_the_cad_face_of_each_triangle_into_fro) {
  TemporaryDirectory dir;
  export_mesh(dir / "m.fro", sample_mesh().mesh);
  EXPECT_EQ(read_bytes(dir / "m.fro"),
            "4 4 1 0 0 4 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.1 0.2 1\n1 1 3 2 1\n2 1 2 4 2\n3 2 3 4 3\n4 3 1 4 4\n");
}

TEST(Export, writes_edges_and_vertices_in_groups_as_lines_and_points_of_msh_and_obj) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  EXPECT_TRUE(export_mesh(dir / "m.msh", m).empty());
  const std::string msh = read_bytes(dir / "m.msh");
  EXPECT_NE(msh.find("\n1 2 1 2\n5 1 3\n6 3 2\n1 4 1 1\n7 2 1\n0 2 15 1\n8 2\n$EndElements"), std::string::npos) << msh;
  EXPECT_NE(msh.find("\n2 0 0 0 1 1 0 1 8 0\n"), std::string::npos)
      << "edge 2 with the box of its segments is in \"te\": " << msh;
  EXPECT_NE(msh.find("\n2 1 0 0 1 10\n"), std::string::npos) << "vertex 2 is in \"tip\": " << msh;
  EXPECT_EQ(export_mesh(dir / "m.obj", m).size(), 2u) << "parts and a further table";
  const std::string obj = read_bytes(dir / "m.obj");
  EXPECT_NE(obj.find("g edge_group_1_te\nl 1 3\nl 3 2\nl 2 1\ng edge_group_2_table:root\ng vertex_group_1_tip\np 2\n"),
            std::string::npos)
      << obj;
}

TEST(Export, says_what_a_format_has_no_room_for) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  using Losses = std::vector<std::string>;
  const Losses all = {"groups (2)", "parts (2)", "further tables of groups (1)", "groups of edges and vertices (3)"};
  for (const char* name : {"m.stl", "m.fro", "m.off"}) EXPECT_EQ(export_mesh(dir / name, m), all) << name;
  for (const char* name : {"m.vtu", "m.ply", "m.msh"}) EXPECT_EQ(export_mesh(dir / name, m), Losses()) << name;
  EXPECT_EQ(export_mesh(dir / "m.meshb", m)[0], "names of groups (2)");
  EXPECT_EQ(export_mesh(dir / "m.ascii.stl", m), Losses(all.begin() + 1, all.end()));
  SurfaceMesh plain = m;
  plain.labels = {};
  plain.labels.group_name = {"default"};
  plain.triangle_group = {0, 0, 0, 0};
  EXPECT_EQ(export_mesh(dir / "m.off", plain), Losses()) << "the one group that nobody named is no loss";
}

TEST(Export, chooses_the_form_that_is_wanted_where_a_format_has_both) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  const auto bytes_of = [&](const std::string& name, Encoding encoding, const std::string& format = "") {
    ExportOptions options;
    options.encoding = encoding;
    options.format = format;
    export_mesh(dir / name, {m, all_triangles(m), {}}, options);
    return read_bytes(dir / name);
  };
  for (const auto& [text, binary] : {std::pair("m.ascii.stl", "m.stl"),
                                     {"m.ply", "m.binary.ply"},
                                     {"m.mesh", "m.meshb"},
                                     {"m.msh", "m.binary.msh"},
                                     {"m.ugrid", "m.lb8.ugrid"}}) {
    EXPECT_EQ(bytes_of(text, Encoding::kBinary), bytes_of(binary, Encoding::kOfFormat)) << text;
    EXPECT_EQ(bytes_of(binary, Encoding::kText), bytes_of(text, Encoding::kOfFormat)) << binary;
  }
  EXPECT_EQ(bytes_of("m.any", Encoding::kBinary, "msh2"), bytes_of("m.binary.msh2", Encoding::kOfFormat));
  EXPECT_ERROR(bytes_of("m.off", Encoding::kBinary), kUsage, "has no binary form");
  EXPECT_ERROR(bytes_of("m.cgns", Encoding::kText), kUsage, "has no text form");
  EXPECT_ERROR(bytes_of("m.off", Encoding::kOfFormat, "xyz"), kUsage, "--format: unknown format 'xyz'");
}

TEST(Export, names_files_of_groups_before_the_whole_suffix) {
  EXPECT_EQ(path_of_group("a.b/wing.stl", "TAIL"), "a.b/wing_TAIL.stl");
  EXPECT_EQ(path_of_group("wing.ascii.stl", "T"), "wing_T.ascii.stl");
  EXPECT_EQ(path_of_group("a.b/wing", "T"), "a.b/wing_T");
  const std::string long_name(300, 'x'), other = long_name + "y", umlauts = [] {
    std::string text;
    for (int i = 0; i < 150; ++i) text += "\u00e4";
    return text;
  }();
  EXPECT_LE(path_of_group("a/wing.stl", long_name).size(), 202u);
  EXPECT_NE(path_of_group("wing.stl", long_name), path_of_group("wing.stl", other));
  EXPECT_TRUE(path_of_group("wing.stl", long_name).ends_with(".stl"));
  for (const char* path : {"w.stl", "wi.stl"})
    EXPECT_NE(path_of_group(path, umlauts).find("\u00e4~"), std::string::npos) << "no half of a letter";
}

TEST(Export, refuses_curved_elements_and_parameters_where_there_is_no_room) {
  ExportOptions curved, parametric;
  curved.has_mid_nodes = true;
  parametric.has_parameters = true;
  EXPECT_ERROR(require_export_format("m.stl", curved), kUsage, "for --quadratic use one of .vtu");
  EXPECT_ERROR(require_export_format("m.stl", parametric), kUsage, "for --parametric use one of .binary.msh, .msh");
  for (const char* name : {"m.cgns", "m.msh", "m.msh2", "m.vtu", "m.nas"})
    EXPECT_NO_THROW(require_export_format(name, curved));
}

TEST(Export, writes_parameters_of_nodes_on_edges_and_faces_into_msh) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  ExportOptions options;
  options.has_parameters = true;
  export_mesh(dir / "m.msh", {m, all_triangles(m), {}}, options);
  const std::string text = read_bytes(dir / "m.msh");
  EXPECT_NE(text.find("\n1 5 1 1\n3\n0 1 0 0.7\n"), std::string::npos) << "edge 5: t = 0.7: " << text;
  EXPECT_NE(text.find("\n2 4 1 1\n4\n0.1 0.2 1 0.5 -0.5\n"), std::string::npos) << "face 4, first corner: " << text;
  EXPECT_NE(text.find("\n0 1 0 1\n1\n0 0 0\n"), std::string::npos) << "vertices have none: " << text;
}

}  // namespace
}  // namespace st
