#include "stages/check_parts.h"

#include <gtest/gtest.h>

#include "unit/stages/shared_cube.h"

namespace st {
namespace {

TEST(CheckParts, of_two_shares_and_as_bytes_are_those_of_the_whole) {
  const test::SharedCube cube;
  const SharedMesh shared(cube.options);
  const CheckBasis basis = CheckBasis::of(cube.mesh, nullptr, nullptr, cube.options);
  Progress progress("checking", 1);
  CheckParts all;
  const auto n = static_cast<TriangleId>(cube.mesh.n_triangles());
  for (const auto& [begin, end] : {std::pair<TriangleId, TriangleId>(0, 32'768), {32'768, n}}) {
    const MeshSelection share = shared.file.share(begin, end);
    CheckParts parts;
    unpack(packed(measure_share(basis, share.mesh, TriangleCorners(share.mesh), share.own(), {}, progress, 1)), parts);
    all.add(parts, basis.counts);
  }
  CheckParts whole =
      measure_share(basis, cube.mesh, TriangleCorners(cube.mesh), OwnTriangles::all(cube.mesh), {}, progress, 1);
  EXPECT_EQ(all.topology.n_edges, n * 3 / 2);
  EXPECT_EQ(all.bad.quality.count, whole.bad.quality.count);
  EXPECT_GT(whole.bad.quality.count, 0);
  Findings f, g;
  all.topology.set_parts({cube.mesh.n_nodes(), 1}, n);
  report_parts(basis, all, cube.mesh.labels, f);
  report_parts(basis, whole, cube.mesh.labels, g);
  EXPECT_EQ(check_report_json("m", cube.mesh, f, 0, ReportDetail::kFull),
            check_report_json("m", cube.mesh, g, 0, ReportDetail::kFull));
}

}  // namespace
}  // namespace st
