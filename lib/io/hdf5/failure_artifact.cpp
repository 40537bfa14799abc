#include "io/hdf5/failure_artifact.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>

#include "base/error.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/vtu_arrays.h"

namespace st {
namespace {

constexpr std::uint8_t kVtkVertex = 1, kVtkLine = 3, kVtkTriangle = 5;

/// What is shown: cells of three kinds over the nodes of all failed faces.
struct Grid {
  std::vector<Vec3> points;
  std::vector<double> u, v, size;
  std::vector<std::int64_t> connectivity, offsets = {0};
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> face, loop, edge;  // from 1; 0: none

  void add_point(Vec3 x, Vec2 uv, double h) {
    points.push_back(x);
    u.push_back(uv.x);
    v.push_back(uv.y);
    size.push_back(h);
  }
  void add_cell(std::uint8_t type, std::initializer_list<std::int64_t> nodes, FaceId in_face, std::int32_t of_loop,
                EdgeId on_edge) {
    connectivity.insert(connectivity.end(), nodes);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(type);
    face.push_back(in_face + 1);
    loop.push_back(of_loop + 1);
    edge.push_back(on_edge + 1);
  }
  void add(const FaceAttempt& f) {
    const std::int64_t first = static_cast<std::int64_t>(points.size());
    const FacePatch& p = f.patch;
    for (std::size_t i = 0; i < p.inner_xyz.size(); ++i) add_point(p.inner_xyz[i], p.inner_uv[i], p.inner_size[i]);
    for (std::size_t s = 0; s < f.segment_loop.size(); ++s)
      add_cell(kVtkLine, {first + f.segment_nodes[2 * s], first + f.segment_nodes[2 * s + 1]}, p.face,
               f.segment_loop[s], f.segment_edge[s]);
    for (const Triangle& t : p.triangles)
      add_cell(kVtkTriangle, {first + t.n[0], first + t.n[1], first + t.n[2]}, p.face, kNone, kNone);
    for (const Vec3 x : f.places) {
      add_point(x, {0, 0}, 0);
      add_cell(kVtkVertex, {static_cast<std::int64_t>(points.size()) - 1}, p.face, kNone, kNone);
    }
  }
};

void write_grid(Hdf5Writer& w, const Grid& g) {
  w.set_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  w.set_attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
  w.write("/VTKHDF/NumberOfPoints", std::vector<std::int64_t>{static_cast<std::int64_t>(g.points.size())});
  w.write("/VTKHDF/NumberOfCells", std::vector<std::int64_t>{static_cast<std::int64_t>(g.types.size())});
  w.write("/VTKHDF/NumberOfConnectivityIds",
          std::vector<std::int64_t>{static_cast<std::int64_t>(g.connectivity.size())});
  w.write("/VTKHDF/Points", g.points);
  w.write("/VTKHDF/Connectivity", g.connectivity);
  w.write("/VTKHDF/Offsets", g.offsets);
  w.write("/VTKHDF/Types", g.types);
  w.write("/VTKHDF/CellData/face", g.face);
  w.write("/VTKHDF/CellData/loop", g.loop);
  w.write("/VTKHDF/CellData/edge", g.edge);
  w.write("/VTKHDF/PointData/u", g.u);
  w.write("/VTKHDF/PointData/v", g.v);
  w.write("/VTKHDF/PointData/size", g.size);
}

void write_table(Hdf5Writer& w, const FailureArtifact& a) {
  std::vector<FaceId> face;
  std::vector<std::string> name, cause, remedy;
  std::vector<Vec3> xyz;
  for (const FaceFailure& f : a.failures) {
    face.push_back(f.face);
    name.push_back(static_cast<std::size_t>(f.face) < a.face_name.size() ? a.face_name[f.face] : "");
    cause.push_back(f.cause);
    remedy.push_back(f.remedy);
    xyz.push_back(f.xyz);
  }
  w.write("/st/failure/face", face);
  w.write_strings("/st/failure/name", name);
  w.write_strings("/st/failure/cause", cause);
  w.write_strings("/st/failure/remedy", remedy);
  w.write("/st/failure/xyz", xyz);
}

}  // namespace

std::string failures_path(const std::string& output) {
  std::filesystem::path path(output);
  return path.replace_filename(path.stem().string() + ".failures.hdf").string();
}

std::string write_failures(const std::string& path, const FailureArtifact& a) {
  ArtifactHeader header = a.header;
  header.schema = "failures";
  header.schema_version = kFailuresVersion;
  Grid grid;
  for (const FaceAttempt& f : a.attempts) grid.add(f);
  Hdf5Writer w(path, header);
  write_grid(w, grid);
  write_table(w, a);
  return w.commit();
}

void remove_failures(const std::string& path) {
  if (!std::filesystem::exists(path)) return;
  try {
    if (read_header(path).schema != "failures") return;
  } catch (const Error&) {
    return;
  }
  if (std::remove(path.c_str()) != 0)
    throw Error(ExitCode::kOutput,
                path + ": the failures of an earlier run cannot be removed (" + std::strerror(errno) + "); remove it");
}

void export_failures(const std::string& artifact, const std::string& output) {
  if (!output.ends_with(".vtu"))
    throw Error(ExitCode::kUsage, output + ": failures are exported as .vtu; give that suffix");
  const Hdf5Reader r(artifact, "failures", kFailuresVersion);
  const auto points = r.read<Vec3>("/VTKHDF/Points");
  auto offsets = r.read<std::int64_t>("/VTKHDF/Offsets");
  const auto types = r.read_rows<std::uint8_t>("/VTKHDF/Types", offsets.empty() ? 0 : offsets.size() - 1);
  if (!offsets.empty()) offsets.erase(offsets.begin());  // .vtu: ends only
  VtuArrays a;
  std::string cell_data, point_data;
  for (const char* name : {"face", "loop", "edge"})
    cell_data += a.add(name, "Int32", r.read_rows<std::int32_t>("/VTKHDF/CellData/" + std::string(name), types.size()));
  for (const char* name : {"u", "v", "size"})
    point_data += a.add(name, "Float64", r.read_rows<double>("/VTKHDF/PointData/" + std::string(name), points.size()));
  const std::string geometry = "      <Points>\n" + a.add("Points", "Float64", points, 3) +
                               "      </Points>\n      <Cells>\n" +
                               a.add("connectivity", "Int64", r.read<std::int64_t>("/VTKHDF/Connectivity")) +
                               a.add("offsets", "Int64", offsets) + a.add("types", "UInt8", types) + "      </Cells>\n";
  TemporaryFile temporary(output);
  std::ofstream file(temporary.name(), std::ios::binary);
  file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n  <UnstructuredGrid>\n    <Piece NumberOfPoints=\""
       << points.size() << "\" NumberOfCells=\"" << types.size() << "\">\n      <CellData Scalars=\"face\">\n"
       << cell_data << "      </CellData>\n      <PointData>\n"
       << point_data << "      </PointData>\n"
       << geometry << "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_" << a.bytes()
       << "\n  </AppendedData>\n</VTKFile>\n";
  file.close();
  if (!file) throw Error(ExitCode::kOutput, output + ": cannot be written; check free space and permissions");
  temporary.commit();
}

}  // namespace st
