#include "stages/share_crossings.h"

#include <gtest/gtest.h>

#include "unit/stages/shared_cube.h"

namespace st {
namespace {

TEST(ShareCrossings, are_those_of_the_mesh_but_for_those_inside_a_share) {
  const test::SharedCube cube([](SurfaceMesh& m) {
    for (const TriangleId t : {20'000, 40'000, 60'000}) m.node_xyz[m.triangles[t].n[0]] = {0.9, -0.2, 1.3};
  });
  const SharedMesh shared(cube.options);
  const std::vector<TriangleId> begin = {0, 32'768, 65'536, static_cast<TriangleId>(cube.mesh.n_triangles())};
  const SerialExecutor one_rank;
  ShareCrossings crossings(shared.file, one_rank);
  for (std::size_t k = 0; k + 1 < begin.size(); ++k) crossings.add(shared.file.share(begin[k], begin[k + 1]));
  CheckParts parts;
  crossings.find(parts);
  std::vector<std::pair<TriangleId, TriangleId>> found, expected;
  for (const TrianglePair& p : parts.pairs) found.emplace_back(p.a, p.b);
  const auto share_of = [&](TriangleId t) { return std::upper_bound(begin.begin(), begin.end(), t) - begin.begin(); };
  for (const TrianglePair& p : find_crossing_triangles(cube.mesh.node_xyz, cube.mesh.triangles))
    if (share_of(p.a) != share_of(p.b)) expected.emplace_back(p.a, p.b);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
  EXPECT_GT(expected.size(), 10u);
  EXPECT_GT(parts.n_compared, 0);
}

}  // namespace
}  // namespace st
