#include "meshing/hole/moved_smoothing.h"

#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

/// A mesh on one of whose faces a node was put where its triangles are turned over.
struct Spoilt : ShapeMesh {
  SurfaceMesh moved;
  TriangleId begin = 0, end = 0;
  NodeId node = kNone;

  explicit Spoilt(const std::string& shape) : ShapeMesh(shape), moved(mesh) {
    while (end < mesh.n_triangles() && mesh.triangle_face[end] == mesh.triangle_face[0]) ++end;
    for (TriangleId t = begin; t < end && node == kNone; ++t)
      for (const NodeId n : mesh.triangles[t].n)
        if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kFace)) node = n;
    Vec2 by;  // past the side of the first of its triangles
    for (std::size_t c = 0; c < 3 * static_cast<std::size_t>(end); ++c)
      if (mesh.triangles[c / 3].n[c % 3] == node) {
        const Vec2* uv = &mesh.corner_uv[c - c % 3];
        by = 1.3 * (0.5 * (uv[(c + 1) % 3] + uv[(c + 2) % 3]) - uv[c % 3]);
        break;
      }
    for (std::size_t c = 0; c < 3 * static_cast<std::size_t>(end); ++c)
      if (mesh.triangles[c / 3].n[c % 3] == node) {
        moved.corner_uv[c] = moved.corner_uv[c] + by;
        moved.node_xyz[node] = model.surface(mesh.triangle_face[0])->point(moved.corner_uv[c]);
      }
  }
  double worst() const {
    double least = 1;
    for (TriangleId t = begin; t < end; ++t) least = std::min(least, moved_quality(mesh, moved, t, 1, {}));
    return least;
  }
};

class SmoothedFace : public testing::TestWithParam<const char*> {};

TEST_P(SmoothedFace, has_no_turned_triangle_any_more_and_stays_on_its_surface) {
  Spoilt s(GetParam());
  ASSERT_NE(s.node, kNone);
  ASSERT_LT(s.worst(), 0);
  const auto surface = s.model.surface(s.mesh.triangle_face[0]);
  smooth_moved_face(*surface, s.mesh, s.begin, s.end, 1, {}, s.moved);
  EXPECT_GT(s.worst(), 0.4);
  for (std::size_t c = 0; c < 3 * static_cast<std::size_t>(s.end); ++c) {
    const NodeId n = s.moved.triangles[c / 3].n[c % 3];
    if (s.mesh.node_entity_dim[n] != static_cast<std::uint8_t>(EntityDim::kFace)) {
      EXPECT_TRUE(s.moved.node_xyz[n] == s.mesh.node_xyz[n]) << "a node on the boundary";
    } else {
      EXPECT_LE(distance(surface->point(s.moved.corner_uv[c]), s.moved.node_xyz[n]), 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, SmoothedFace, testing::Values("box", "cylinder", "sphere"),
                         [](const auto& info) { return std::string(info.param); });

TEST(SmoothedFaceThatIsGood, stays_as_it_is) {
  const BoxMesh box;
  SurfaceMesh moved = box.mesh;
  smooth_moved_face(*box.model.surface(0), box.mesh, 0, box.mesh.n_triangles(), 1, {}, moved);
  for (NodeId n = 0; n < moved.n_nodes(); ++n) EXPECT_TRUE(moved.node_xyz[n] == box.mesh.node_xyz[n]);
}

TEST(SpreadBoundaryShift, takes_all_nodes_along_and_stretches_evenly_in_between) {
  const BoxMesh box;
  TriangleId end = 0;
  while (box.mesh.triangle_face[end] == box.mesh.triangle_face[0]) ++end;
  for (const bool is_stretched : {false, true}) {
    SurfaceMesh moved = box.mesh;
    std::vector<Vec2> by;
    for (std::size_t c = 0; c < 3 * static_cast<std::size_t>(end); ++c)
      by.push_back(is_stretched ? Vec2{0.1 * box.mesh.corner_uv[c].x, 0} : Vec2{3, 4});
    spread_boundary_shift(box.mesh, 0, end, by, moved);
    for (std::size_t c = 0; c < by.size(); ++c) {
      const NodeId n = moved.triangles[c / 3].n[c % 3];
      const Vec2 shift = moved.corner_uv[c] - box.mesh.corner_uv[c];
      if (box.mesh.node_entity_dim[n] != static_cast<std::uint8_t>(EntityDim::kFace)) {
        EXPECT_TRUE(shift == (Vec2{0, 0}));
      } else {
        EXPECT_NEAR(shift.x, by[c].x, is_stretched ? 0.03 * box.model.tables().reference_diagonal() : 1e-9);
        EXPECT_NEAR(shift.y, by[c].y, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace st::test
