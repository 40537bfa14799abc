// Regions as tasks: what is made as a whole, what of tiles, and what again.
#include "meshing/engine/region_tasks.h"

#include <gtest/gtest.h>

#include <set>

#include "meshing/face/face_boundary.h"
#include "support/backward_executor.h"
#include "support/meshed.h"

namespace st {
namespace {

/// The six sides of a box, in tiles of 1000 triangles where they are heavier; notes what is done.
struct BoxSides {
  const Model model = test::make_model("box");
  const UniformField field{1};
  const MeshTopology topology{model.tables()};
  const Refinements refinements{field};
  MeshOptions options;
  std::vector<double> weight;
  EdgeMesh edges;
  std::multiset<FaceId> whole, seams;
  std::set<FaceId> failing, unsound;  // from their tiles, or found to be so afterwards

  BoxSides() {
    set_verbosity(Verbosity::kQuiet);
    options.tile_triangles = 1000;
    for (const double area : model.tables().face_area) weight.push_back(kTrianglesPerWeight * area);
    weight[2] = 10;  // light
    edges = mesh_regions(model, topology, field, plan_all(topology), options, test::one_rank).edges;
  }

  void run(const Executor& executor) {
    const BoundaryNumbering numbering(topology, edges);
    const Regions sides{
        .face = [](FaceId f) { return f; },
        .boundary = [&](FaceId f, const Surface& s) { return make_face_boundary(model, s, f, numbering); },
        .places = [&](const FaceBoundary& boundary) { return boundary_places(boundary, numbering); }};
    RegionTasks({.cut = "cut",
                 .whole = "face",
                 .tile = "tile",
                 .seams = "seams",
                 .progress = "",
                 .unit = "",
                 .make_whole = [](FaceId f) { return packed(f + 100); },
                 .take_whole =
                     [&](FaceId f, Bytes&& result) {
                       EXPECT_EQ(result, packed(f + 100));
                       whole.insert(f);
                     },
                 .make_seams =
                     [&](FaceId f, TiledRegions& tiled) {
                       const auto surface = model.surface(f);
                       const FaceBoundary boundary = make_face_boundary(model, *surface, f, numbering);
                       return packed(tiled.seams(*surface, f, boundary, executor).mesh.corners.empty());
                     },
                 .take_seams =
                     [&](FaceId f, Bytes&& result) {
                       EXPECT_EQ(result, packed(false));
                       seams.insert(f);
                       return !failing.contains(f);
                     },
                 .finish = [&](TiledRegions&) { return std::vector<FaceId>(unsound.begin(), unsound.end()); }},
                TiledRegions(model, sides, field, refinements, options.of_face(), {}), "", weight, options, executor)
        .run({0, 1, 2, 3, 4, 5});
  }
};

TEST(RegionTasks, makes_heavy_regions_from_tiles_and_the_others_as_a_whole) {
  const test::BackwardExecutor backward;
  for (const Executor* executor :
       {static_cast<const Executor*>(&test::one_rank), static_cast<const Executor*>(&backward)}) {
    BoxSides sides;
    sides.run(*executor);
    EXPECT_TRUE(sides.whole.contains(2));
    EXPECT_GE(sides.seams.size(), 2u);
    for (FaceId f = 0; f < 6; ++f) EXPECT_EQ(sides.whole.count(f) + sides.seams.count(f), 1u) << f;
  }
}

TEST(RegionTasks, makes_again_as_a_whole_what_its_tiles_do_not_give) {
  BoxSides sides;
  sides.run(test::one_rank);
  const std::multiset<FaceId> cut = sides.seams;
  sides.whole.clear();
  sides.failing = {*cut.begin()};
  sides.unsound = {*cut.rbegin()};
  sides.run(test::one_rank);
  for (const FaceId f : {*cut.begin(), *cut.rbegin()}) EXPECT_EQ(sides.whole.count(f), 1u) << f;
  EXPECT_EQ(sides.whole.size(), 6 - cut.size() + 2);
}

TEST(RegionTasks, cuts_nothing_that_is_to_be_left_out) {
  BoxSides sides;
  sides.run(test::one_rank);
  const FaceId heavy = *sides.seams.begin();
  sides.whole.clear();
  sides.seams.clear();
  sides.options.left_out[heavy] = "it ended an earlier run";
  sides.run(test::one_rank);
  EXPECT_EQ(sides.seams.count(heavy), 0u);
  EXPECT_EQ(sides.whole.count(heavy), 1u);
}

}  // namespace
}  // namespace st
