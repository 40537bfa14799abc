#include "io/hdf5/artifact.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/patches_file.h"
#include "mesh/corner_uv.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "io/hdf5/hdf5_file.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

template <class T>
void expect_same(const std::vector<T>& a, const std::vector<T>& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  if (a.empty()) return;
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0) << what;
}
#define EXPECT_SAME(member) expect_same(a.member, b.member, #member)

/// One kind of artifact: how to write the sample, and how to read and write it again.
struct Kind {
  std::function<std::string(const std::string&)> write;
  std::function<std::string(const std::string& from, const std::string& to)> rewrite;
};
const std::map<std::string, Kind> kKinds = {
    {"geometry",
     {[](const auto& path) { return write_geometry(path, sample_geometry()); },
      [](const auto& from, const auto& to) { return write_geometry(to, read_geometry(from)); }}},
    {"patches",
     {[](const auto& path) { return write_patches(path, sample_patches()); },
      [](const auto& from, const auto& to) { return write_patches(to, read_patches(from)); }}},
    {"mesh",
     {[](const auto& path) { return write_mesh(path, sample_mesh()); },
      [](const auto& from, const auto& to) { return write_mesh(to, read_mesh(from)); }}}};

class Artifact : public testing::TestWithParam<std::string> {
 protected:
  const Kind& kind() const { return kKinds.at(GetParam()); }
  std::string file(const std::string& name = "a.hdf") const { return dir_ / name; }
  TemporaryDirectory dir_;
};
INSTANTIATE_TEST_SUITE_P(Kinds, Artifact, testing::Values("geometry", "patches", "mesh"),
                         [](const auto& info) { return info.param; });

TEST_P(Artifact, is_the_same_bytes_after_reading_and_writing) {
  const std::string hash = kind().write(file());
  EXPECT_EQ(kind().rewrite(file(), file("b.hdf")), hash);
  EXPECT_EQ(read_bytes(file()), read_bytes(file("b.hdf")));
  EXPECT_EQ(read_header(file()).content_hash, hash);
  EXPECT_EQ(read_header(file()).schema, GetParam());
}

TEST_P(Artifact, is_refused_when_truncated_anywhere) {
  kind().write(file());
  const std::string whole = read_bytes(file());
  for (std::size_t n = 0; n < whole.size(); n += n < 64 ? 1 : whole.size() / 97) {
    write_bytes(file("cut.hdf"), whole.substr(0, n));
    EXPECT_ERROR(kind().rewrite(file("cut.hdf"), file("b.hdf")), kInput, "cut.hdf");
  }
  EXPECT_EQ(dir_.files().size(), 2u);
}

TEST_P(Artifact, is_refused_or_unchanged_when_any_byte_is_flipped) {
  kind().write(file());
  const std::string whole = read_bytes(file());
  int n_refused = 0, n_unchanged = 0;
  for (std::size_t i = 0; i < whole.size(); i += 29) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
    write_bytes(file("flipped.hdf"), flipped);
    try {
      kind().rewrite(file("flipped.hdf"), file("b.hdf"));
      // Gaps between datasets, strings for VTK, words of HDF5 that change no content.
      ASSERT_EQ(read_bytes(file("b.hdf")), whole) << "byte " << i;
      ++n_unchanged;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kInput) << e.what();
      ++n_refused;
    }
  }
  EXPECT_GT(n_refused, n_unchanged / 10);
}

TEST_P(Artifact, names_the_dataset_of_which_a_byte_is_flipped) {
  kind().write(file());
  std::map<std::string, std::int64_t> offsets;
  {
    const Hdf5Reader reader(file());
    for (const DatasetInfo& d : reader.datasets())
      if (!d.is_foreign) offsets[d.name] = reader.file_offset(d.name);
  }
  const std::string whole = read_bytes(file());
  int n_checked = 0;
  for (const auto& [name, offset] : offsets) {
    if (offset < 0) continue;  // empty
    std::string flipped = whole;
    flipped[offset] = static_cast<char>(flipped[offset] ^ 1);
    write_bytes(file("flipped.hdf"), flipped);
    if (name.rfind("/VTKHDF/NumberOf", 0) == 0) continue;  // for VTK alone
    EXPECT_ERROR(kind().rewrite(file("flipped.hdf"), file("b.hdf")), kInput, name + ": does not fit its checksum");
    ++n_checked;
  }
  EXPECT_GE(n_checked, 10);
}

TEST_P(Artifact, of_another_kind_is_refused_with_both_names) {
  for (const auto& [name, other] : kKinds) {
    if (name == GetParam()) continue;
    other.write(file("other.hdf"));
    EXPECT_ERROR(kind().rewrite(file("other.hdf"), file("b.hdf")), kInput,
                 "other.hdf: is a " + name + " artifact, but a " + GetParam() + " artifact is needed");
  }
}

TEST_P(Artifact, that_is_no_artifact_is_refused_with_its_own_message) {
  const auto expect_refused = [&](const std::string& path, const std::string& text) {
    EXPECT_ERROR(kind().rewrite(path, file("b.hdf")), kInput, path + ": " + text);
  };
  expect_refused(file("missing.hdf"), "no such file");
  expect_refused(dir_.path(), "is a directory");
  write_bytes(file("empty.hdf"), "");
  expect_refused(file("empty.hdf"), "is empty");
  write_bytes(file("text.hdf"), "solid nothing\n");
  expect_refused(file("text.hdf"), "is not an artifact (no HDF5 file)");
  write_bytes(file("short.hdf"), "\211H");
  expect_refused(file("short.hdf"), "is not an artifact (no HDF5 file)");
  ASSERT_EQ(mkfifo(file("fifo.hdf").c_str(), 0600), 0);
  expect_refused(file("fifo.hdf"), "is not a regular file");
}

TEST_P(Artifact, of_a_newer_version_is_refused) {
  ArtifactHeader header = sample_header();
  header.schema = GetParam();
  header.schema_version = 99;
  Hdf5Writer(file(), header).commit();
  EXPECT_ERROR(kind().rewrite(file(), file("b.hdf")), kInput, "schema version 99 is newer than this tool knows (");
}

TEST_P(Artifact, replaces_an_older_file_at_once_and_leaves_it_when_writing_fails) {
  write_bytes(file(), "old");
  {
    ArtifactHeader header = sample_header();
    header.schema = GetParam();
    Hdf5Writer writer(file(), header);
    EXPECT_EQ(read_bytes(file()), "old");
  }
  EXPECT_EQ(read_bytes(file()), "old");
  kind().write(file());
  EXPECT_EQ(read_header(file()).schema, GetParam());
  EXPECT_EQ(dir_.files().size(), 1u);
}

/// Runs `action` in a child process; returns its wait status.
int in_child(const std::function<void()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    action();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST_P(Artifact, leaves_nothing_when_the_disk_is_full) {
  const int status = in_child([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{2000, 2000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      kind().write(file());
    } catch (const Error& e) {
      const bool is_right = e.code() == ExitCode::kOutput && std::string(e.what()).find(file()) == 0 &&
                            std::string(e.what()).find("File too large") != std::string::npos;
      _exit(is_right ? 42 : 1);
    }
  });
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_TRUE(dir_.files().empty());
}

TEST_P(Artifact, leaves_nothing_when_the_writer_is_ended_by_a_signal) {
  const int status = in_child([&] {
    signal(SIGTERM, [](int) {
      remove_temporaries();
      _exit(143);
    });
    ArtifactHeader header = sample_header();
    header.schema = GetParam();
    Hdf5Writer writer(file(), header);
    writer.write("/st/x", std::vector<double>(100000));
    raise(SIGTERM);
  });
  EXPECT_EQ(WEXITSTATUS(status), 143);
  EXPECT_TRUE(dir_.files().empty());
}

TEST_P(Artifact, has_no_name_when_the_writer_is_killed) {
  const int status = in_child([&] {
    ArtifactHeader header = sample_header();
    header.schema = GetParam();
    Hdf5Writer writer(file(), header);
    writer.write("/st/x", std::vector<double>(100000));
    raise(SIGKILL);
  });
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST(GeometryArtifact, gives_back_every_table) {
  TemporaryDirectory dir;
  write_geometry(dir / "g.hdf", sample_geometry());
  const GeometryArtifact ga = sample_geometry(), gb = read_geometry(dir / "g.hdf");
  const ModelTables &a = ga.tables, &b = gb.tables;
  EXPECT_SAME(vertex_xyz);
  EXPECT_SAME(vertex_tolerance);
  EXPECT_SAME(edge_vertices);
  EXPECT_SAME(edge_range);
  EXPECT_SAME(edge_length);
  EXPECT_SAME(edge_tolerance);
  EXPECT_SAME(edge_is_degenerate);
  EXPECT_EQ(a.edge_name, b.edge_name);
  EXPECT_SAME(face_loop_offsets);
  EXPECT_SAME(loop_coedge_offsets);
  EXPECT_SAME(coedge_edge);
  EXPECT_SAME(coedge_is_reversed);
  EXPECT_SAME(face_is_reversed);
  EXPECT_SAME(face_type);
  EXPECT_SAME(face_uv_bounds);
  EXPECT_SAME(face_tolerance);
  EXPECT_SAME(face_area);
  EXPECT_SAME(face_box);
  EXPECT_EQ(a.labels.face_name, b.labels.face_name);
  EXPECT_SAME(face_color);
  EXPECT_EQ(a.face_layer, b.face_layer);
  EXPECT_SAME(labels.face_group);
  EXPECT_SAME(face_shell);
  EXPECT_SAME(face_solid);
  EXPECT_EQ(a.labels.group_name, b.labels.group_name);
  EXPECT_EQ(a.labels.group_role, b.labels.group_role);
  EXPECT_EQ(a.n_shells, b.n_shells);
  EXPECT_EQ(a.face_width, b.face_width);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.n_solids, b.n_solids);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.unit_in_m, b.unit_in_m);
  EXPECT_EQ(ga.brep, gb.brep);
  EXPECT_EQ(ga.is_closed, gb.is_closed);
  ASSERT_EQ(gb.findings.size(), 2u);
  EXPECT_EQ(gb.findings[0].kind, FindingKind::kShortEdge);
  EXPECT_EQ(gb.findings[0].entity, "edge 3 \"TE\"");
  EXPECT_TRUE(gb.findings[0].xyz == (Vec3{1, 2, 3}));
  EXPECT_TRUE(gb.findings[1].is_repair);
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(ga.findings[i].kind, gb.findings[i].kind);
    EXPECT_EQ(ga.findings[i].detail, gb.findings[i].detail);
    EXPECT_EQ(ga.findings[i].what(), gb.findings[i].what());
  }
}

TEST(GeometryArtifact, keeps_a_model_without_unit_without_one) {
  TemporaryDirectory dir;
  GeometryArtifact g = sample_geometry();
  g.tables.unit.clear();
  g.tables.unit_in_m.reset();
  write_geometry(dir / "g.hdf", g);
  EXPECT_EQ(read_geometry(dir / "g.hdf").tables.unit, "");
  EXPECT_EQ(read_geometry(dir / "g.hdf").tables.unit_in_m, std::nullopt);
}

TEST(GeometryArtifact, has_as_many_shells_as_its_faces_have_sides) {
  TemporaryDirectory dir;
  GeometryArtifact g = sample_geometry();
  g.tables.n_shells = 2 * g.tables.n_faces();  // walls between solids are faces of both
  write_geometry(dir / "g.hdf", g);
  EXPECT_EQ(read_geometry(dir / "g.hdf").tables.n_shells, g.tables.n_shells);
  ++g.tables.n_shells;
  write_geometry(dir / "g.hdf", g);
  EXPECT_ERROR(read_geometry(dir / "g.hdf"), kInput, "n_shells");
}

TEST(PatchesArtifact, gives_back_every_array) {
  TemporaryDirectory dir;
  write_patches(dir / "p.hdf", sample_patches());
  const PatchesArtifact a = sample_patches(), b = read_patches(dir / "p.hdf");
  EXPECT_SAME(edges.edge_offsets);
  EXPECT_SAME(edges.node_t);
  EXPECT_SAME(edges.node_xyz);
  EXPECT_SAME(edges.node_size);
  EXPECT_SAME(vertex_xyz);
  EXPECT_SAME(edge_vertices);
  EXPECT_SAME(labels.face_group);
  EXPECT_SAME(face_shell);
  EXPECT_SAME(face_area);
  EXPECT_EQ(a.merged, b.merged);
  EXPECT_EQ(a.labels.face_name, b.labels.face_name);
  EXPECT_EQ(a.labels.group_name, b.labels.group_name);
  EXPECT_EQ(a.is_complete, b.is_complete);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_EQ(a.patches[i].face, b.patches[i].face);
    EXPECT_EQ(a.patches[i].n_boundary, b.patches[i].n_boundary);
    EXPECT_SAME(patches[i].boundary_dim);
    EXPECT_SAME(patches[i].boundary_entity);
    EXPECT_SAME(patches[i].boundary_index);
    EXPECT_SAME(patches[i].inner_xyz);
    EXPECT_SAME(patches[i].inner_uv);
    EXPECT_SAME(patches[i].inner_size);
    EXPECT_SAME(patches[i].triangles);
    EXPECT_SAME(patches[i].uv_corner);
    EXPECT_SAME(patches[i].own_uv);
  }
  ASSERT_EQ(b.failures.size(), 1u);
  EXPECT_EQ(b.failures[0].face, 1);
  EXPECT_EQ(b.failures[0].cause, a.failures[0].cause);
  EXPECT_EQ(b.failures[0].remedy, a.failures[0].remedy);
  EXPECT_TRUE(b.failures[0].is_closed);
  EXPECT_FALSE(b.failures[0].is_near);
  EXPECT_EQ(b.failures[0].deviation, a.failures[0].deviation);
}

TEST(PatchesArtifact, refuses_indices_that_point_nowhere) {
  TemporaryDirectory dir;
  const auto expect_refused = [&](const std::function<void(PatchesArtifact&)>& spoil, const std::string& dataset) {
    PatchesArtifact p = sample_patches();
    spoil(p);
    write_patches(dir / "p.hdf", p);
    EXPECT_ERROR(read_patches(dir / "p.hdf"), kInput, dataset);
  };
  expect_refused([](auto& p) { p.patches[0].triangles[0].n[1] = 6; }, "/st/triangle/nodes");
  expect_refused([](auto& p) { p.patches[0].triangles[0].n[1] = -1; }, "/st/triangle/nodes");
  expect_refused([](auto& p) { p.patches[0].uv_corner[0] = 1; }, "/st/corner/number");
  expect_refused([](auto& p) { p.patches[0].boundary_entity[0] = 3; }, "/st/boundary/entity");
  expect_refused([](auto& p) { p.patches[0].boundary_entity[1] = 3; }, "/st/boundary/entity");
  expect_refused([](auto& p) { p.patches[0].boundary_index[1] = 3; }, "/st/boundary/index");
  expect_refused([](auto& p) { p.patches[1].face = 2; }, "/st/patch/face");
  expect_refused([](auto& p) { p.edge_vertices[5] = 3; }, "/st/edge/vertices");
  expect_refused([](auto& p) { p.edges.edge_offsets[1] = 7; }, "/st/edge/node_offsets");
  expect_refused([](auto& p) { p.labels.face_group[1] = 1; }, "/st/face/group");
  expect_refused([](auto& p) { p.face_area.pop_back(); }, "/st/face/area");
}

/// What a streaming reader gives of the first patch.
TEST(PatchesArtifact, refuses_corners_that_point_nowhere_patch_by_patch_too) {
  TemporaryDirectory dir;
  const auto corners = [&](const PatchesArtifact& p) {
    write_patches(dir / "p.hdf", p);
    return corner_uvs(PatchesFile(dir / "p.hdf").corners(0));
  };
  PatchesArtifact p = sample_patches();
  EXPECT_EQ(corners(p), corner_uvs(p.patches[0]));
  const PatchesArtifact whole = p;
  p.patches[0].uv_corner[1] = 0;
  EXPECT_ERROR(corners(p), kInput, "/st/corner/number");
  p = whole;
  p.patches[0].triangles[0].n[2] = 6;
  EXPECT_ERROR(corners(p), kInput, "/st/triangle/nodes");
  p = whole;
  p.patches[0].own_uv[2].y = std::nan("");
  EXPECT_ERROR(corners(p), kInput, "/st/corner/uv");
  p = whole;
  p.patches[0].inner_uv[0].y = std::nan("");
  EXPECT_ERROR(corners(p), kInput, "/st/inner/uv");
}

TEST(PatchesArtifact, of_an_older_tool_is_to_be_made_again) {
  TemporaryDirectory dir;
  ArtifactHeader header = sample_header();
  header.schema = "patches";
  header.schema_version = 1;
  Hdf5Writer(dir / "p.hdf", header).commit();
  EXPECT_ERROR(read_patches(dir / "p.hdf"), kInput, "schema version 1 of an older st-mesh; run st-mesh again");
  EXPECT_ERROR(PatchesFile(dir / "p.hdf"), kInput, "schema version 1 of an older st-mesh; run st-mesh again");
}

TEST(MeshArtifact, gives_back_every_array) {
  TemporaryDirectory dir;
  write_mesh(dir / "m.hdf", sample_mesh());
  const MeshArtifact ma = sample_mesh(), mb = read_mesh(dir / "m.hdf");
  const SurfaceMesh &a = ma.mesh, &b = mb.mesh;
  EXPECT_SAME(node_xyz);
  EXPECT_SAME(node_entity_dim);
  EXPECT_SAME(node_entity);
  EXPECT_SAME(node_t);
  EXPECT_SAME(node_size);
  EXPECT_SAME(triangles);
  EXPECT_SAME(triangle_face);
  EXPECT_SAME(triangle_group);
  EXPECT_SAME(corner_uv);
  EXPECT_EQ(a.merged, b.merged);
  EXPECT_EQ(a.labels.face_name, b.labels.face_name);
  EXPECT_EQ(a.labels.group_name, b.labels.group_name);
  EXPECT_TRUE(mb.is_complete);
}

TEST(MeshArtifact, refuses_indices_that_point_nowhere) {
  TemporaryDirectory dir;
  const auto expect_refused = [&](const std::function<void(SurfaceMesh&)>& spoil, const std::string& dataset) {
    MeshArtifact m = sample_mesh();
    spoil(m.mesh);
    write_mesh(dir / "m.hdf", m);
    EXPECT_ERROR(read_mesh(dir / "m.hdf"), kInput, dataset);
  };
  expect_refused([](auto& m) { m.triangles[3].n[2] = 4; }, "/VTKHDF/Connectivity");
  expect_refused([](auto& m) { m.triangle_face[0] = 4; }, "/VTKHDF/CellData/face");
  expect_refused([](auto& m) { m.triangle_group[0] = -1; }, "/VTKHDF/CellData/group");
  expect_refused([](auto& m) { m.node_size.pop_back(); }, "/VTKHDF/PointData/size");
}

TEST(MeshArtifact, of_no_triangle_can_be_written_and_read) {
  TemporaryDirectory dir;
  MeshArtifact empty;
  empty.is_complete = false;
  write_mesh(dir / "m.hdf", empty);
  EXPECT_EQ(read_mesh(dir / "m.hdf").mesh.n_triangles(), 0);
  EXPECT_FALSE(read_mesh(dir / "m.hdf").is_complete);
}

TEST(MeshArtifact, has_a_hash_that_follows_every_array) {
  TemporaryDirectory dir;
  const std::vector<std::function<void(MeshArtifact&)>> changes = {
      [](auto&) {},
      [](auto& m) { m.mesh.node_xyz[1].y = 1e-16; },
      [](auto& m) { std::swap(m.mesh.triangles[0], m.mesh.triangles[1]); },
      [](auto& m) { m.mesh.node_t[0] = -0.0; },
      [](auto& m) { m.mesh.labels.face_name[1].push_back('x'); },
      [](auto& m) { m.mesh.corner_uv[11].y = 0; },
      [](auto& m) { m.is_complete = false; },
      [](auto& m) { m.header.unit.pop_back(); }};
  std::set<std::string> hashes;
  for (const auto& change : changes) {
    MeshArtifact m = sample_mesh();
    change(m);
    hashes.insert(write_mesh(dir / "m.hdf", m));
  }
  EXPECT_EQ(hashes.size(), changes.size());
}

TEST(RequireSameGeometry, accepts_what_goes_back_to_one_geometry_and_names_both_files_otherwise) {
  ArtifactHeader geometry, mesh;
  geometry.schema = "geometry";
  geometry.content_hash = "1";
  mesh.schema = "mesh";
  mesh.content_hash = "2";
  mesh.geometry_hash = "1";
  EXPECT_NO_THROW(require_same_geometry("g.hdf", geometry, "m.hdf", mesh));
  EXPECT_NO_THROW(require_same_geometry("m.hdf", mesh, "n.hdf", mesh));
  mesh.geometry_hash = "3";
  EXPECT_ERROR(require_same_geometry("g.hdf", geometry, "m.hdf", mesh), kMismatch, "g.hdf (geometry) and m.hdf (mesh)");
}

TEST(RequireWritable, refuses_what_could_not_be_written_later) {
  TemporaryDirectory dir;
  EXPECT_NO_THROW(require_writable(dir / "new.hdf"));
  EXPECT_ERROR(require_writable(dir.path()), kOutput, "is a directory");
  EXPECT_ERROR(require_writable(dir / "none/a.hdf"), kOutput, "create it first");
  EXPECT_ERROR(require_writable(""), kOutput, "empty output name");
  write_bytes(dir / "file", "x");
  EXPECT_ERROR(require_writable(dir / "file/a.hdf"), kOutput, "file");
  EXPECT_ERROR(require_writable("/proc/a.hdf"), kOutput, "cannot be written");
  EXPECT_EQ(dir.files().size(), 1u);
}

TEST(Artifacts, of_meshes_with_ids_or_numbers_that_do_not_exist_are_refused) {
  const TemporaryDirectory dir;
  const std::vector<std::pair<const char*, std::function<void(SurfaceMesh&)>>> breaks = {
      {"entity_id", [](auto& m) { m.node_entity[0] = -2; }},
      {"entity_id", [](auto& m) { m.node_entity_dim[0] = 2, m.node_entity[0] = 1000; }},
      {"CellData/face", [](auto& m) { m.triangle_face[0] = 1000; }},
      {"Points", [](auto& m) { m.node_xyz[0].x = std::nan(""); }},
      {"PointData/size", [](auto& m) { m.node_size[0] = std::nan(""); }}};
  for (const auto& [name, break_it] : breaks) {
    MeshArtifact mesh = sample_mesh();
    break_it(mesh.mesh);
    write_mesh(dir / "a.hdf", mesh);
    EXPECT_ERROR(read_mesh(dir / "a.hdf"), kInput, name);
  }
}

TEST(Artifacts, of_patches_with_ids_or_numbers_that_do_not_exist_are_refused) {
  const TemporaryDirectory dir;
  constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max();
  const auto set_entities = [](PatchesArtifact& p, std::uint8_t dim, std::int32_t id) {
    for (FacePatch& patch : p.patches) {
      patch.boundary_dim.assign(patch.boundary_dim.size(), dim);
      patch.boundary_entity.assign(patch.boundary_entity.size(), id);
    }
  };
  const std::vector<std::pair<const char*, std::function<void(PatchesArtifact&)>>> breaks = {
      {"boundary/entity", [&](auto& p) { set_entities(p, 1, kLargest); }},
      {"boundary/entity", [&](auto& p) { set_entities(p, 0, kLargest); }},
      {"edge_node/size", [](auto& p) { p.edges.node_size[0] = std::nan(""); }},
      {"vertex/xyz", [](auto& p) { p.vertex_xyz[0].y = std::nan(""); }}};
  for (const auto& [name, break_it] : breaks) {
    PatchesArtifact patches = sample_patches();
    break_it(patches);
    write_patches(dir / "a.hdf", patches);
    EXPECT_ERROR(read_patches(dir / "a.hdf"), kInput, name);
  }
}

TEST(Artifacts, of_geometries_with_numbers_that_are_none_are_refused) {
  const TemporaryDirectory dir;
  const std::vector<std::pair<const char*, std::function<void(ModelTables&)>>> breaks = {
      {"vertex/xyz", [](auto& t) { t.vertex_xyz[0].z = std::nan(""); }},
      {"uv_bounds", [](auto& t) { t.face_uv_bounds[0] = std::numeric_limits<double>::infinity(); }},
      {"uv_bounds", [](auto& t) { std::swap(t.face_uv_bounds[2], t.face_uv_bounds[3]); }},
      {"edge/range", [](auto& t) { t.edge_range[1] = t.edge_range[0] - 1; }},
      {"edge/length", [](auto& t) { t.edge_length[0] = -1; }},
      {"edge/range", [](auto& t) { t.edge_range[0] = std::nan(""); }},
      {"/st/edge_group/ids: row 1 names entity 9 of 4",
       [](auto& t) {
         t.labels.edge_groups[0].ids = {1, 9};
       }},
      {"n_shells", [](auto& t) { t.n_shells = 1 << 30; }},
      {"n_solids", [](auto& t) { t.n_solids = 1 << 30; }}};
  for (const auto& [name, break_it] : breaks) {
    GeometryArtifact geometry = sample_geometry();
    break_it(geometry.tables);
    write_geometry(dir / "a.hdf", geometry);
    EXPECT_ERROR(read_geometry(dir / "a.hdf"), kInput, name);
  }
}

}  // namespace
}  // namespace st
