// check_ranks FOLDER: st-check says the same of sound and of broken meshes at every number of ranks as one process that
// has the whole mesh. Exit code 0, or 1 for a failed check.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/log.h"
#include "comm/communicator.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/mesh_file.h"
#include "stages/check_shares.h"
#include "stages/check_stage.h"
#include "support/meshed.h"

namespace st {
namespace {

constexpr double kLength = 0.48;  // six pieces and more on the box of 60 x 40 x 20

/// The first triangle of a face, from `from` on, whose nodes all lie inside it.
TriangleId inner_triangle(const SurfaceMesh& m, TriangleId from, FaceId face = kNone) {
  for (TriangleId t = from; t < m.n_triangles(); ++t)
    if ((face == kNone || m.triangle_face[t] == face) &&
        std::ranges::all_of(m.triangles[t].n, [&](NodeId i) { return m.node_entity_dim[i] == 2; }))
      return t;
  throw std::runtime_error("no triangle inside a face");
}

Vec3& corner(SurfaceMesh& m, TriangleId t, int k) { return m.node_xyz[m.triangles[t].n[k]]; }

void remove_triangle(SurfaceMesh& m, TriangleId t) {
  m.triangles.erase(m.triangles.begin() + t);
  m.triangle_face.erase(m.triangle_face.begin() + t);
  m.triangle_group.erase(m.triangle_group.begin() + t);
  m.corner_uv.erase(m.corner_uv.begin() + 3 * t, m.corner_uv.begin() + 3 * t + 3);
}

/// Triangles before and behind the border of each piece: where shares of any number of ranks meet.
template <class Do>
void at_borders(SurfaceMesh& m, const Do& change) {
  const auto piece = static_cast<TriangleId>(kTrianglesPerPiece);
  for (TriangleId t = piece; t < m.n_triangles(); t += piece)
    for (const TriangleId from : {t - 40, t - 1, t, t + 40})
      if (from < m.n_triangles() - 200) change(inner_triangle(m, from));
}

struct Case {
  const char* name;
  std::function<void(SurfaceMesh&)> make;
  bool is_shared = true;  ///< else the first rank checks it as a whole
};

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
      {"sound", [](SurfaceMesh&) {}},
      {"hole", [](SurfaceMesh& m) { at_borders(m, [&](TriangleId t) { remove_triangle(m, t); }); }},
      {"turned",
       [](SurfaceMesh& m) {
         at_borders(m, [&](TriangleId t) { std::swap(m.triangles[t].n[1], m.triangles[t].n[2]); });
       }},
      {"fold",
       [](SurfaceMesh& m) {
         at_borders(m, [&](TriangleId t) {
           const Vec3 a = corner(m, t, 0), b = corner(m, t, 1), c = corner(m, t, 2);
           corner(m, t, 0) = a + 2.2 * (0.5 * (b + c) - a);
         });
       }},
      {"flat",
       [](SurfaceMesh& m) {
         at_borders(m, [&](TriangleId t) { corner(m, t, 0) = 0.5 * (corner(m, t, 1) + corner(m, t, 2)); });
       }},
      {"twice",
       [](SurfaceMesh& m) { at_borders(m, [&](TriangleId t) { m.triangles[t + 1] = Triangle(m.triangles[t]); }); }},
      {"repeated",
       [](SurfaceMesh& m) { at_borders(m, [&](TriangleId t) { m.triangles[t].n[1] = m.triangles[t].n[0]; }); }},
      {"crossing",
       [](SurfaceMesh& m) {  // the top through the bottom, which another rank has
         for (TriangleId k = 0; k < 3; ++k) {
           Vec3& x = corner(m, inner_triangle(m, 100 * k, 5), 0);
           x.z = corner(m, inner_triangle(m, 0, 4), 0).z - 0.3;
         }
       }},
      {"off", [](SurfaceMesh& m) { at_borders(m, [&](TriangleId t) {
                                     corner(m, t, 0) += Vec3{0.2, 0.3, 0.4};
                                   }); }},
      {"same_place", [](SurfaceMesh& m) { corner(m, inner_triangle(m, 900), 0) = Vec3(corner(m, 70'000, 1)); }},
      {"pinched",
       [](SurfaceMesh& m) {  // two faces far from each other get a common node
         m.triangles[inner_triangle(m, 300)].n[0] = m.triangles[inner_triangle(m, 60'000)].n[0];
       }},
      {"other_order", [](SurfaceMesh& m) { std::swap(m.triangle_face.front(), m.triangle_face.back()); }, false},
      {"no_triangles",
       [](SurfaceMesh& m) {
         m.triangles.clear(), m.triangle_face.clear(), m.triangle_group.clear(), m.corner_uv.clear();
       },
       false}};
  return list;
}

/// What does not differ between two runs.
std::string without_time(const StageSummary& s, const std::string& report) {
  auto json = nlohmann::json::parse(s.json), full = nlohmann::json::parse(report);
  json.erase("seconds");
  json.erase("processor_seconds");
  full.erase("seconds");
  return json.dump() + full.dump() + s.line.substr(0, s.line.rfind(", ")) + std::to_string(static_cast<int>(s.code));
}

class CheckRanks {
 public:
  CheckRanks(const Communicator& comm, std::string folder) : comm_(comm), folder_(std::move(folder)) {
    if (!comm.is_root()) return;
    ImportResult import = test::import_shape("box");
    GeometryArtifact g;
    g.header = header("geometry");
    g.tables = import.tables;
    g.brep = import.brep;
    g.is_closed = true;
    hash_ = write_geometry(path("geometry.hdf"), g);
    good_ = test::Meshed(Model(std::move(import.tables), std::move(import.brep)), kLength).mesh;
  }

  void run(const Case& c) {
    if (comm_.is_root()) write(c);
    comm_.barrier();
    CheckStageOptions o;
    o.mesh = path("mesh.hdf");
    o.geometry = path("geometry.hdf");
    o.text = CheckText::kWhole;
    o.thresholds.min_quality = 0.7;
    o.thresholds.min_angle_deg = 35;
    std::string report, whole_report;
    const StageSummary found = run_check(o, comm_, &report);
    if (comm_.is_root()) {
      const std::string expected = without_time(run_check(o, &whole_report), whole_report);
      if (without_time(found, report) != expected) {
        std::fprintf(stderr, "%s: with ranks:\n%s\nas a whole:\n%s\n", c.name, without_time(found, report).c_str(),
                     expected.c_str());
        throw std::runtime_error(std::string(c.name) + ": ranks say another thing than one process");
      }
    }
    require_shared(c);
    comm_.barrier();
  }

 private:
  static ArtifactHeader header(const char* schema) {
    ArtifactHeader h;
    h.schema = schema;
    h.tool = "test";
    h.options_json = "{}";
    return h;
  }
  std::string path(const char* name) const { return folder_ + "/" + name; }
  void write(const Case& c) const {
    MeshArtifact m;
    m.header = header("mesh");
    m.header.geometry_hash = hash_;
    m.mesh = good_;
    c.make(m.mesh);
    write_mesh(path("mesh.hdf"), m);
  }
  /// The comparison shows nothing of a mesh that one rank has checked.
  void require_shared(const Case& c) const {
    const MeshFile file(path("mesh.hdf"));
    CheckStageOptions o;
    CheckBasis basis;
    basis.options = &o;
    Progress progress("checking", 1);
    const bool is_shared = measure_shares(basis, file, comm_, progress).has_value();
    if (is_shared != (c.is_shared && comm_.size() > 1))
      throw std::runtime_error(std::string(c.name) + (is_shared ? " was shared" : " was not shared"));
  }

  const Communicator& comm_;
  const std::string folder_;
  std::string hash_;
  SurfaceMesh good_;
};

}  // namespace
}  // namespace st

int main(int argc, char** argv) {
  const st::Communicator comm;
  st::set_verbosity(st::Verbosity::kQuiet);
  if (argc != 2) {
    std::fputs("usage: check_ranks FOLDER\n", stderr);
    return 2;
  }
  try {
    st::CheckRanks ranks(comm, argv[1]);
    for (const st::Case& c : st::cases()) ranks.run(c);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "check_ranks: rank %d: %s\n", comm.rank(), e.what());
    comm.abort(1);
  }
  return 0;
}
