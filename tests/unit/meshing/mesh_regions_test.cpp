// Whole models through mesh_regions() at one rank: what is merged from their patches is the closed model.
#include "meshing/engine/mesh_regions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/log.h"
#include "mesh/checks.h"
#include "mesh/quality.h"
#include "support/meshed.h"

namespace st {
namespace {

using test::Meshed;

struct Solid {
  const char* shape;
  double length, area, volume, error;
  std::int64_t euler;
};

void PrintTo(const Solid& s, std::ostream* out) { *out << s.shape; }

class MeshedSolid : public testing::TestWithParam<Solid> {
 protected:
  void SetUp() override { set_verbosity(Verbosity::kQuiet); }
};

TEST_P(MeshedSolid, is_closed_oriented_and_whole) {
  const Solid s = GetParam();
  const Meshed m(s.shape, s.length);
  EXPECT_TRUE(m.result.failures.empty());
  EXPECT_TRUE(m.result.folds.empty());
  EXPECT_EQ(m.result.n_crossing_pairs, 0);
  const TopologyReport topology = check_topology(m.mesh, edges_of(m.mesh));
  EXPECT_TRUE(topology.passes());
  EXPECT_EQ(topology.pinched_nodes.count, 0);
  EXPECT_EQ(topology.euler, s.euler);
  EXPECT_TRUE(check_shape(m.mesh, edges_of(m.mesh)).passes());
  EXPECT_TRUE(check_crossings(m.mesh).passes());
}

TEST_P(MeshedSolid, has_the_area_and_volume_of_the_cad_and_points_outward) {
  const Solid s = GetParam();
  const Meshed m(s.shape, s.length);
  EXPECT_TRUE(m.orientation.turned_faces.empty()) << "patches disagree";
  EXPECT_EQ(m.orientation.turned_components, 0) << "inside out";
  const MeshMeasure measure = measure_mesh(m.mesh);
  EXPECT_NEAR(measure.volume, s.volume, s.error * s.volume);
  EXPECT_NEAR(measure.area, s.area, s.error * s.area);
  for (FaceId f = 0; f < m.model.tables().n_faces(); ++f)
    EXPECT_NEAR(measure.face_area[f], m.model.tables().face_area[f], 1.5 * s.error * m.model.tables().face_area[f])
        << "face " << f;
}

TEST_P(MeshedSolid, keeps_the_nodes_of_edges_and_vertices_on_them) {
  const Meshed m(GetParam().shape, GetParam().length);
  const ModelTables& t = m.model.tables();
  for (NodeId n = 0; n < m.mesh.n_nodes(); ++n) {
    if (m.mesh.node_entity_dim[n] == 0) {
      EXPECT_TRUE(m.mesh.node_xyz[n] == t.vertex_xyz[m.mesh.node_entity[n]]);
    }
    if (m.mesh.node_entity_dim[n] == 1) {
      EXPECT_LE(distance(m.mesh.node_xyz[n], m.model.curve(m.mesh.node_entity[n])->point(m.mesh.node_t[n])), 1e-12);
    }
  }
}

TEST_P(MeshedSolid, is_the_same_every_time) {
  const Meshed a(GetParam().shape, GetParam().length), b(GetParam().shape, GetParam().length);
  ASSERT_EQ(a.mesh.n_triangles(), b.mesh.n_triangles());
  for (NodeId n = 0; n < a.mesh.n_nodes(); ++n) EXPECT_TRUE(a.mesh.node_xyz[n] == b.mesh.node_xyz[n]);
  for (std::int64_t i = 0; i < a.mesh.n_triangles(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(a.mesh.triangles[i].n[k], b.mesh.triangles[i].n[k]);
}

INSTANTIATE_TEST_SUITE_P(
    , MeshedSolid,
    testing::Values(Solid{"box", 4, 8800, 48000, 1e-12, 2}, Solid{"loose_box", 4, 8800, 48000, 1e-12, 2},
                    Solid{"two_boxes", 2, 1200, 2000, 1e-12, 4}, Solid{"sphere", 1, 400 * kPi, 4000 * kPi / 3, 0.01, 2},
                    Solid{"cylinder", 1, 800 * kPi, 3000 * kPi, 0.01, 2},
                    Solid{"cone", 1, 100 * kPi*(1 + std::sqrt(5.0)), 2000 * kPi / 3, 0.01, 2},
                    Solid{"torus", 1, 480 * kPi* kPi, 1440 * kPi* kPi, 0.01, 0},
                    Solid{"drilled_block", 2, 8800 - 32 * kPi + 160 * kPi, 48000 - 320 * kPi, 0.02, 0}),
    [](const auto& info) { return std::string(info.param.shape); });

TEST(MeshRegions, turns_a_mirrored_part_outward) {
  set_verbosity(Verbosity::kQuiet);
  const Meshed a("drilled_cylinder", 1.5), b("mirrored_cylinder", 1.5);
  const double volume = measure_mesh(a.mesh).volume;
  EXPECT_GT(volume, 0);
  EXPECT_NEAR(measure_mesh(b.mesh).volume, volume, 0.005 * volume);
  EXPECT_TRUE(a.orientation.turned_faces.empty() && b.orientation.turned_faces.empty());
  EXPECT_EQ(a.orientation.turned_components + b.orientation.turned_components, 0);
  EXPECT_TRUE(check_topology(b.mesh, edges_of(b.mesh)).passes());
}

TEST(MeshRegions, refines_a_tube_thinner_than_the_size_until_it_closes) {
  set_verbosity(Verbosity::kQuiet);
  const Meshed m("thin_cylinder", 0.5);
  EXPECT_TRUE(m.result.failures.empty());
  EXPECT_TRUE(check_topology(m.mesh, edges_of(m.mesh)).passes());
  EXPECT_EQ(check_topology(m.mesh, edges_of(m.mesh)).euler, 2);
}

TEST(MeshRegions, closes_a_solid_smaller_than_the_size) {
  set_verbosity(Verbosity::kQuiet);
  for (const char* shape : {"box", "sphere", "cylinder", "cone", "torus", "drilled_cylinder"}) {
    const Meshed m(shape, 200);
    EXPECT_TRUE(m.result.failures.empty()) << shape;
    EXPECT_TRUE(check_topology(m.mesh, edges_of(m.mesh)).passes()) << shape;
    EXPECT_GT(measure_mesh(m.mesh).volume, 0) << shape;
  }
}

TEST(MeshRegions, closes_the_tip_of_a_slender_cone_and_a_needle) {
  set_verbosity(Verbosity::kQuiet);
  for (double size : {0.1, 0.4, 3.0}) {  // the tip has less way around it than up to it at any size
    const Meshed m("slender_cone", size);
    EXPECT_TRUE(m.result.failures.empty()) << size;
    EXPECT_TRUE(check_topology(m.mesh, edges_of(m.mesh)).passes()) << size;
    EXPECT_EQ(check_topology(m.mesh, edges_of(m.mesh)).euler, 2) << size;
    EXPECT_LT(m.result.n_refinements, 200) << size;
  }
}

TEST(MeshRegions, keeps_two_faces_along_common_edges_apart) {
  set_verbosity(Verbosity::kQuiet);
  for (double size : {1.2, 2.0, 3.0}) {  // sides 2 wide: no node inside either of them
    const Meshed m("shallow_prism", size);
    EXPECT_TRUE(m.result.failures.empty()) << size;
    EXPECT_TRUE(check_topology(m.mesh, edges_of(m.mesh)).passes()) << size;
    EXPECT_GT(measure_mesh(m.mesh).volume, 0) << size;
  }
}

TEST(MeshRegions, leaves_an_open_model_open_at_its_free_edges_only) {
  set_verbosity(Verbosity::kQuiet);
  const Meshed m("plate_with_hole", 2);
  const ModelTables& t = m.model.tables();
  const std::vector<std::uint8_t> may_be_open(t.n_edges(), 1);
  EXPECT_TRUE(check_topology(m.mesh, edges_of(m.mesh), {t.edge_vertices, may_be_open, {}}).is_closed());
  EXPECT_FALSE(check_topology(m.mesh, edges_of(m.mesh)).is_closed());
}

TEST(MeshRegions, joins_three_faces_at_one_edge) {
  set_verbosity(Verbosity::kQuiet);
  const Meshed m("t_junction", 1);
  EXPECT_TRUE(m.result.failures.empty());
  EXPECT_EQ(check_topology(m.mesh, edges_of(m.mesh)).nonmanifold_edges.count, 10);
  EXPECT_NEAR(measure_mesh(m.mesh).area, 150, 1e-6);
}

TEST(MeshRegions, meets_a_sheet_that_stands_on_a_face_in_common_nodes) {
  set_verbosity(Verbosity::kQuiet);
  const Meshed m("baffled_box", 1);
  EXPECT_TRUE(m.result.failures.empty());
  EXPECT_EQ(check_topology(m.mesh, edges_of(m.mesh)).nonmanifold_edges.count, 4);
  EXPECT_EQ(check_crossings(m.mesh).crossings.count, 0);
  EXPECT_EQ(check_crossings(m.mesh).contacts.count, 0);
  EXPECT_NEAR(measure_mesh(m.mesh).area, 616, 1e-6);
}

TEST(MeshRegions, meshes_poles_as_well_as_any_other_place) {
  set_verbosity(Verbosity::kQuiet);
  for (const double length : {0.7, 1.0, 1.2, 1.5, 1.8, 2.2, 2.7}) {
    const QualityStats quality =
        measure_quality(Meshed("sphere", length).mesh, edges_of(Meshed("sphere", length).mesh)).model;
    EXPECT_GT(quality.min_angle_deg, 32) << length;
    EXPECT_GT(quality.mean, 0.98) << length;
  }
}

TEST(MeshRegions, refines_walls_thinner_than_their_chords_until_they_stand_apart) {
  set_verbosity(Verbosity::kQuiet);
  for (const double length : {1.5, 2.0, 3.0}) {
    const Meshed m("thin_pipe", length);
    EXPECT_EQ(m.result.n_crossing_pairs, 0) << length;
    EXPECT_TRUE(check_topology(m.mesh, edges_of(m.mesh)).is_closed());
  }
}

TEST(MeshRegions, makes_no_hole_where_refining_cannot_part_what_crosses) {
  set_verbosity(Verbosity::kQuiet);
  for (const double length : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
    const Meshed m("spindle_torus", length);
    EXPECT_TRUE(m.result.failures.empty()) << length;
    EXPECT_TRUE(check_topology(m.mesh, edges_of(m.mesh)).is_closed()) << length;
  }
}

TEST(MeshRegions, enhances_as_many_rounds_as_the_options_say) {
  set_verbosity(Verbosity::kQuiet);
  const Meshed none("sphere", 1, {.enhance_rounds = 0}), five("sphere", 1);
  EXPECT_GT(measure_quality(five.mesh, edges_of(five.mesh)).model.mean,
            measure_quality(none.mesh, edges_of(none.mesh)).model.mean + 0.001);
}

TEST(MeshRegions, redoes_nothing_when_nothing_is_to_be_redone) {
  set_verbosity(Verbosity::kQuiet);
  const Meshed m("cylinder", 1);
  const MeshResult again = mesh_regions(
      m.model, m.topology, m.field, plan_again(m.topology, {}, m.result.edges, m.result.patches), {}, test::one_rank);
  EXPECT_EQ(again.edges.node_t, m.result.edges.node_t);
  ASSERT_EQ(again.patches.size(), m.result.patches.size());
  for (std::size_t f = 0; f < again.patches.size(); ++f) {
    EXPECT_EQ(again.patches[f].triangles.size(), m.result.patches[f].triangles.size());
    for (std::size_t i = 0; i < again.patches[f].inner_xyz.size(); ++i)
      EXPECT_TRUE(again.patches[f].inner_xyz[i] == m.result.patches[f].inner_xyz[i]);
  }
}

TEST(MeshRegions, redoes_one_face_on_the_nodes_its_neighbours_keep) {
  set_verbosity(Verbosity::kQuiet);
  const Meshed m("box", 4);
  const UniformField fine(1);
  const MeshResult again = mesh_regions(
      m.model, m.topology, fine, plan_again(m.topology, {2}, m.result.edges, m.result.patches), {}, test::one_rank);
  EXPECT_EQ(again.edges.node_t, m.result.edges.node_t);
  for (FaceId f = 0; f < 6; ++f) {
    const std::size_t before = m.result.patches[f].triangles.size(), after = again.patches[f].triangles.size();
    if (f == 2) {
      EXPECT_GT(after, 2 * before);
    } else {
      EXPECT_EQ(after, before);
    }
  }
  OrientationReport report;
  EXPECT_TRUE(check_topology(test::merged(m.topology, again, report), edges_of(test::merged(m.topology, again, report)))
                  .passes());
}

}  // namespace
}  // namespace st
