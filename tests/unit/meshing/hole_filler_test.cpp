// Holes: their boundaries in (u,v), their fills, and what of the mesh stays as it was.
#include "meshing/hole/hole_filler.h"

#include "base/error.h"
#include "mesh/checks.h"
#include "unit/meshing/hole_case.h"

namespace st::test {
namespace {

/// Where the sides around a node are much shorter than the size, the mesh grows from them.
void expect_sizes_of_sides(const FaceBoundary& b) {
  std::vector<double> length(b.nodes.size(), 0), n(b.nodes.size(), 0);
  for (const auto& [i, j] : b.segments)
    for (const std::int32_t k : {i, j})
      if (const double l = distance(b.nodes[i].x, b.nodes[j].x); l > 0) length[k] += l, ++n[k];
  for (std::size_t i = 0; i < n.size(); ++i) EXPECT_LE(0.6 * b.nodes[i].h * n[i], 1.0001 * length[i]);
}

/// Loops: an even number of segments at each node, of parity one between any two.
void expect_closed(const FaceBoundary& b) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  for (const auto& [i, j] : b.segments) ++uses[std::minmax(i, j)];
  std::vector<int> degree(b.nodes.size(), 0);
  for (const auto& [ends, n] : uses)
    if (n % 2) ++degree[ends.first], ++degree[ends.second];
  for (std::size_t i = 0; i < degree.size(); ++i) EXPECT_EQ(degree[i] % 2, 0) << "node " << i;
}

/// The hole is on the left of its boundary.
void expect_on_the_left(const FaceBoundary& b) {
  double twice_area = 0;
  std::vector<int> balance(b.nodes.size(), 0);
  for (const auto& [i, j] : b.segments) {
    const Vec2 from = b.nodes[i].uv - b.nodes[0].uv, to = b.nodes[j].uv - b.nodes[0].uv;
    twice_area += from.x * to.y - from.y * to.x;
    ++balance[i], --balance[j];
  }
  EXPECT_GT(twice_area, 0);
  for (std::size_t i = 0; i < balance.size(); ++i) EXPECT_EQ(balance[i], 0) << "node " << i;
}

/// A solid whose sizes fall towards its first vertex, as at a corner.
class HoleFiller : public testing::TestWithParam<const char*> {};

TEST_P(HoleFiller, fills_a_corner_and_keeps_the_rest_to_the_bit) {
  const ShapeMesh solid(GetParam(), 0.05);
  const LinearField finer = finer_at_a_corner(solid);
  const Refilled hole(solid, finer);
  ASSERT_GT(hole.marks.n_triangles(), 0);
  ASSERT_LT(hole.marks.n_triangles(), solid.mesh.n_triangles());
  if (GetParam() == std::string("box")) {
    ASSERT_EQ(marked_runs(hole.holes, hole.marks).size(), 3u) << "one on each edge at the corner";
  }
  const SurfaceMesh after = hole.merged();
  EXPECT_TRUE(check_topology(after, edges_of(after)).passes());
  EXPECT_EQ(check_shape(after, edges_of(after)).folds.count, 0);
  EXPECT_NEAR(measure_mesh(after).area, measure_mesh(solid.mesh).area, 0.02 * measure_mesh(solid.mesh).area);
  EXPECT_GT(after.n_triangles(), solid.mesh.n_triangles());
  std::int64_t n_kept = 0;
  for (std::size_t i = 0; i < after.triangles.size(); ++i) {
    const TriangleId previous = after.triangle_previous[i];
    if (previous == kNone) continue;
    ++n_kept;
    EXPECT_FALSE(hole.marks.triangle[previous]);
    for (int k = 0; k < 3; ++k) {
      const NodeId n = after.triangles[i].n[k], old = solid.mesh.triangles[previous].n[k];
      EXPECT_EQ(after.node_previous[n], old);
      EXPECT_TRUE(after.node_xyz[n] == solid.mesh.node_xyz[old]);
      EXPECT_TRUE(after.corner_uv[3 * i + k] == solid.mesh.corner_uv[3 * previous + k]);
    }
  }
  EXPECT_EQ(n_kept, solid.mesh.n_triangles() - hole.marks.n_triangles());
}

TEST_P(HoleFiller, closes_the_boundary_of_every_hole) {
  const ShapeMesh solid(GetParam(), 0.05);
  const LinearField finer = finer_at_a_corner(solid);
  const Refilled hole(solid, finer);
  for (const auto& of_face : hole.bounds)
    for (const FaceBoundary& b : of_face) {
      ASSERT_GE(b.segments.size(), 3u);
      expect_closed(b);
      expect_sizes_of_sides(b);
      expect_on_the_left(b);
    }
}

TEST_P(HoleFiller, takes_the_sides_to_triangles_that_stay_as_they_are) {
  const ShapeMesh solid(GetParam(), 0.05);
  const LinearField finer = finer_at_a_corner(solid);
  const Refilled hole(solid, finer);
  int n_free = 0;
  for (FaceId f = 0; f < solid.model.tables().n_faces(); ++f)
    for (std::size_t h = 0; h < hole.rims[f].size(); ++h) {
      const HoleRim& rim = hole.rims[f][h];
      const FaceBoundary& b = hole.bounds[f][h];
      std::set<std::pair<std::int32_t, std::int32_t>> segments;
      for (const auto& [i, j] : b.segments) segments.insert({b.nodes[i].id, b.nodes[j].id});
      std::set<std::pair<NodeId, NodeId>> sides;
      for (const HoleRim::Side& s : rim.free_sides) sides.insert({rim.nodes[s.first].id, rim.nodes[s.second].id});
      for (const HoleRim::Side& s : rim.free_sides) {
        if (sides.count({rim.nodes[s.second].id, rim.nodes[s.first].id})) continue;  // to a pole, from both sides
        const std::int32_t first = hole.numbering.number(rim.nodes[s.first].id),
                           second = hole.numbering.number(rim.nodes[s.second].id);
        if (first == second) continue;
        EXPECT_TRUE(segments.contains(rim.is_turned ? std::pair{second, first} : std::pair{first, second}))
            << first << " - " << second;
        ++n_free;
      }
      for (const FaceNode& n : b.nodes) {
        if (hole.numbering.is_inner(n.id)) {
          EXPECT_TRUE(n.x == solid.mesh.node_xyz[n.id - hole.numbering.first_inner + hole.holes.inner_begin[0]]);
        }
      }
    }
  EXPECT_GT(n_free, 3);
}

TEST_P(HoleFiller, refills_whole_faces_as_they_were_made) {
  const ShapeMesh solid(GetParam(), 0.1);
  HoleMarkOptions options;
  for (TriangleId t = 0; t < solid.mesh.n_triangles(); ++t) options.redo.push_back(t);
  const Refilled all(solid, solid.field, options);
  ASSERT_EQ(all.marks.n_triangles(), solid.mesh.n_triangles());
  ASSERT_TRUE(marked_runs(all.holes, all.marks).empty()) << "the edges stay";
  for (const auto& of_face : all.rims) {
    ASSERT_EQ(of_face.size(), 1u);
    EXPECT_TRUE(of_face[0].is_whole_face);
  }
  const SurfaceMesh after = all.merged();
  ASSERT_EQ(after.n_triangles(), solid.mesh.n_triangles());
  EXPECT_TRUE(after.node_xyz == solid.mesh.node_xyz) << "st-mesh and st-remesh fill a face alike";
  EXPECT_TRUE(after.corner_uv == solid.mesh.corner_uv);
  EXPECT_EQ(std::count(after.triangle_previous.begin(), after.triangle_previous.end(), kNone), after.n_triangles());
}

TEST_P(HoleFiller, without_fills_leaves_a_face_as_it_was) {
  const ShapeMesh solid(GetParam(), 0.1);
  const Refilled none(solid, solid.field, nothing_changes());
  ASSERT_EQ(none.marks.n_triangles(), 0);
  const SurfaceMesh after = none.merged();
  EXPECT_TRUE(after.node_xyz == solid.mesh.node_xyz);
  EXPECT_TRUE(after.node_size == solid.mesh.node_size);
  for (TriangleId t = 0; t < solid.mesh.n_triangles(); ++t) EXPECT_EQ(after.triangle_previous[t], t);
}

INSTANTIATE_TEST_SUITE_P(, HoleFiller, testing::ValuesIn(kSolids),
                         [](const auto& info) { return std::string(info.param); });

TEST(HoleBoundary, has_the_segments_of_a_seam_twice) {
  const ShapeMesh tube("cylinder", 0.05);
  const ModelTables& t = tube.model.tables();
  EdgeId seam = kNone;
  FaceId face = kNone;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    std::map<EdgeId, int> uses;
    for (CoedgeId c = t.loop_coedge_offsets[t.face_loop_offsets[f]];
         c < t.loop_coedge_offsets[t.face_loop_offsets[f + 1]]; ++c)
      if (++uses[t.coedge_edge[c]] == 2) seam = t.coedge_edge[c], face = f;
  }
  ASSERT_NE(seam, kNone);
  const HoleMesh holes(tube.mesh, t);
  const std::int32_t first = holes.edges.edge_offsets[seam], last = holes.edges.edge_offsets[seam + 1] - 1;
  ASSERT_GE(last - first, 6);
  HoleMarkOptions options;  // the triangles at the seam's middle node, and one layer
  options.layers = 1;
  const NodeId middle = holes.edge_node[(first + last) / 2];
  for (TriangleId i = 0; i < tube.mesh.n_triangles(); ++i)
    if (std::count(tube.mesh.triangles[i].n, tube.mesh.triangles[i].n + 3, middle)) options.redo.push_back(i);
  const Refilled hole(tube, tube.field, options);
  ASSERT_EQ(hole.rims[face].size(), 2u) << "one on each side of the seam, which bounds the face in (u,v)";
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;  // of segments of the seam, by their ids
  std::map<std::int32_t, std::set<double>> u_of;
  for (const FaceBoundary& b : hole.bounds[face]) {
    for (const auto& [i, j] : b.segments) {
      const auto on_seam = [&](std::int32_t id) {
        const auto e = hole.numbering.is_inner(id) ? BoundaryNumbering::Entity{} : hole.numbering.boundary.entity(id);
        return !hole.numbering.is_inner(id) && e.dim == EntityDim::kEdge && e.entity == seam;
      };
      if (on_seam(b.nodes[i].id) && on_seam(b.nodes[j].id)) ++uses[{b.nodes[i].id, b.nodes[j].id}];
      if (on_seam(b.nodes[i].id)) u_of[b.nodes[i].id].insert(b.nodes[i].uv.x);
    }
  }
  ASSERT_GE(uses.size(), 4u);
  for (const auto& [ends, n] : uses) {
    EXPECT_EQ(n, 1);
    EXPECT_EQ(uses.count({ends.second, ends.first}), 1u) << "the other side runs the other way";
  }
  for (const auto& [id, u] : u_of) {
    ASSERT_EQ(u.size(), 2u);
    EXPECT_NEAR(*u.rbegin() - *u.begin(), 2 * kPi, 1e-9);
  }
}

TEST(HoleBoundary, has_a_pole_where_its_triangles_go) {
  const ShapeMesh ball("sphere", 0.05);
  const LinearField finer({0, 0, 10}, 0.3 * ball.field.min_size(), 0.3);
  const Refilled hole(ball, finer);
  ASSERT_FALSE(hole.bounds[0].empty());
  std::map<std::int32_t, int> pole_nodes;
  for (const FaceBoundary& b : hole.bounds[0])
    for (const FaceNode& n : b.nodes)
      if (n.is_pole) {
        ++pole_nodes[n.id];
        EXPECT_LE(distance(n.x, {0, 0, 10}), 1e-9);
      }
  ASSERT_EQ(pole_nodes.size(), 1u) << "one vertex";
  EXPECT_GE(pole_nodes.begin()->second, 3) << "at several places in (u,v)";
  EXPECT_TRUE(check_topology(hole.merged(), edges_of(hole.merged())).passes());
}

TEST(HolePlaces, count_along_edges_and_along_the_runs_between_them) {
  const ShapeMesh box("box", 0.05);
  const LinearField finer = finer_at_a_corner(box);
  const Refilled hole(box, finer);
  int n_runs = 0;
  for (FaceId f = 0; f < 6; ++f)
    for (const FaceBoundary& b : hole.bounds[f]) {
      const std::vector<BoundaryPlace> places = hole_places(b, hole.numbering);
      ASSERT_EQ(places.size(), b.nodes.size());
      for (const auto& [i, j] : b.segments) {
        const bool from_run = hole.numbering.is_inner(b.nodes[i].id), to_run = hole.numbering.is_inner(b.nodes[j].id);
        if (from_run && to_run) {
          EXPECT_EQ(places[j].index, places[i].index + 1);
          EXPECT_GT(places[j].to_end, 0);
        } else if (from_run != to_run) {
          EXPECT_EQ(places[to_run ? i : j].to_end, 0) << "where a run begins or ends";
          n_runs += to_run;
        } else if (places[i].to_end > 0 && places[j].to_end > 0) {
          EXPECT_EQ(std::abs(places[j].index - places[i].index), 1);
        }
      }
    }
  EXPECT_EQ(n_runs, 3) << "one on each face at the corner";
}

TEST(HoleBoundary, refuses_marks_that_do_not_fit_the_new_nodes) {
  const ShapeMesh box("box", 0.05);
  const LinearField finer(box.model.tables().vertex_xyz[0], 0.2 * box.field.min_size(), 0.1);
  const Refilled hole(box, finer);
  HoleMarks others = hole.marks;
  others.segment.assign(others.segment.size(), 0);  // yet nodes inside the runs are gone
  int n_refused = 0;
  for (FaceId f = 0; f < 6; ++f)
    for (const HoleRim& rim : hole.rims[f]) {
      if (rim.cad_sides.empty()) continue;
      try {
        make_hole_boundary(box.model, *box.model.surface(f), rim, others, hole.numbering, finer);
      } catch (const Error& e) {
        n_refused += e.code() == ExitCode::kInternal;
      }
    }
  EXPECT_EQ(n_refused, 3) << "the faces at the corner";
}

TEST(HoleNumbering, gives_inner_nodes_consecutive_numbers_behind_those_on_edges) {
  const ShapeMesh box("box", 0.05);
  const LinearField finer = finer_at_a_corner(box);
  const Refilled hole(box, finer);
  const HoleNumbering& n = hole.numbering;
  for (NodeId i = 0; i < box.mesh.n_nodes(); ++i) {
    const std::int32_t id = n.number(i);
    if (i >= hole.holes.inner_begin[0]) {
      EXPECT_TRUE(n.is_inner(id));
      EXPECT_EQ(id - n.first_inner, i - hole.holes.inner_begin[0]);
    } else if (id == kNone) {
      EXPECT_EQ(box.mesh.node_entity_dim[i], static_cast<std::uint8_t>(EntityDim::kEdge)) << "vertices stay";
    } else {
      EXPECT_FALSE(n.is_inner(id));
      const auto entity = n.boundary.entity(id);
      EXPECT_EQ(static_cast<std::uint8_t>(entity.dim), box.mesh.node_entity_dim[i]);
      EXPECT_EQ(entity.entity, box.mesh.node_entity[i]);
    }
  }
}

}  // namespace
}  // namespace st::test
