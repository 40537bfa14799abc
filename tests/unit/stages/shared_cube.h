// A cube of five pieces of triangles, checked in shares and as a whole.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/log.h"
#include "mesh/adjacency.h"
#include "stages/check_json.h"
#include "stages/check_shares.h"
#include "unit/io/temporary_directory.h"
#include "unit/mesh/shapes.h"

namespace st::test {

struct SharedCube {
  TemporaryDirectory dir;
  SurfaceMesh mesh = shapes::cube(80);
  CheckStageOptions options;

  explicit SharedCube(const std::function<void(SurfaceMesh&)>& change = [](SurfaceMesh&) {}) {
    set_verbosity(Verbosity::kQuiet);
    for (std::int64_t n = 0; n < mesh.n_nodes(); ++n)
      mesh.node_xyz[n].x += 1e-3 * std::sin(0.1 * n);  // no triangle as another
    change(mesh);
    MeshArtifact artifact;
    artifact.header.schema = "mesh";
    artifact.header.tool = "test";
    artifact.header.options_json = "{}";
    artifact.mesh = mesh;
    options.mesh = dir / "m.hdf";
    options.thresholds.min_quality = 0.8;
    write_mesh(options.mesh, artifact);
  }

  std::optional<SharedFindings> measure(std::int64_t per_share) const {
    const SharedMesh shared(options);
    CheckBasis basis;
    basis.options = &options;
    Progress progress("checking", 1);
    return measure_shares(basis, shared.file, SerialExecutor(), progress, per_share);
  }
  std::string report_of_shares(std::int64_t per_share) const {
    SharedFindings found = *measure(per_share);
    Findings f;
    f.crossings = check_crossings(found.crossing.mesh, found.pairs, found.component, found.was_ended, {});
    report_parts(found.basis, found.parts, mesh.labels, f);
    return check_report_json("m", mesh, f, 0, ReportDetail::kFull);
  }
  /// Of the mesh in memory.
  std::string report() const {
    const CheckBasis basis = CheckBasis::of(mesh, nullptr, nullptr, options);
    Progress progress("checking", 1);
    Findings f;
    f.crossings = check_crossings(mesh);
    CheckParts parts = measure_share(basis, mesh, TriangleCorners(mesh), OwnTriangles::all(mesh), {}, progress, 1);
    report_parts(basis, parts, mesh.labels, f);
    return check_report_json("m", mesh, f, 0, ReportDetail::kFull);
  }
};

}  // namespace st::test
