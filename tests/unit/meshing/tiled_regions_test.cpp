// Heavy faces as several tasks.
#include "meshing/engine/tiled_regions.h"

#include <gtest/gtest.h>

#include <iterator>
#include <limits>
#include <map>

#include "base/error.h"
#include "meshing/face/face_patch.h"
#include "support/backward_executor.h"
#include "support/meshed.h"
#include "unit/meshing/faces.h"

namespace st {
namespace {

MeshPlan weighed_plan(const MeshTopology& topology, double length) {
  MeshPlan plan = plan_all(topology);
  for (const double area : topology.tables().face_area) plan.face_weight.push_back(area / (length * length));
  return plan;
}

MeshResult mesh(const Model& model, const SizeField& field, double length, double tile, const Executor& executor,
                PatchesGo patches = PatchesGo::kToRoot) {
  set_verbosity(Verbosity::kQuiet);
  const MeshTopology topology(model.tables());
  MeshOptions options;
  options.tile_triangles = tile;
  options.patches = patches;
  return mesh_regions(model, topology, field, weighed_plan(topology, length), options, executor);
}

TEST(TiledFaces, make_the_same_mesh_in_whatever_order_tiles_are_done) {
  const Model model = test::make_model("drilled_block");
  const UniformField field(0.35);
  const test::BackwardExecutor backward;
  const MeshResult a = mesh(model, field, 0.35, 1000, test::one_rank), b = mesh(model, field, 0.35, 1000, backward);
  EXPECT_TRUE(a.failures.empty());
  EXPECT_EQ(a.n_crossing_pairs, 0);
  EXPECT_GT(backward.n_tasks, a.patches.size() + 20);
  for (std::size_t f = 0; f < a.patches.size(); ++f) {
    ASSERT_FALSE(a.patches[f].triangles.empty()) << f;
    EXPECT_EQ(packed(a.patches[f]), packed(b.patches[f])) << f;
  }
}

TEST(TiledFaces, that_are_stretched_do_not_wait_for_a_cut) {
  const Model model = test::make_model("drilled_block");
  for (const bool is_stretched : {false, true}) {
    const test::BackwardExecutor counter;
    if (is_stretched)
      mesh(model, test::StretchedField({0.35, 1, {0, 0, 1}}), 0.35, 1000, counter);
    else
      mesh(model, UniformField(0.35), 0.35, 1000, counter);
    EXPECT_EQ(counter.n_of["cut"] > 0, !is_stretched);
    EXPECT_EQ(counter.n_of["tile"] > 0, !is_stretched);
    EXPECT_EQ(counter.n_of["face"] > 0, is_stretched);
  }
}

TEST(TiledFaces, stay_in_sections_whose_rows_are_the_patch) {
  const Model model = test::make_model("drilled_block");
  const UniformField field(0.35);
  const MeshResult whole = mesh(model, field, 0.35, 1000, test::one_rank);
  MeshResult apart = mesh(model, field, 0.35, 1000, test::one_rank, PatchesGo::kNowhere);
  EXPECT_GT(apart.patches.size(), whole.patches.size() + 20);
  ASSERT_EQ(apart.own_places.size(), apart.patches.size());
  std::map<FaceId, std::vector<FacePatch>> by_face;
  std::map<FaceId, std::int64_t> n_triangles;
  for (std::size_t i = 0; i < apart.patches.size(); ++i) {
    FacePatch& rows = apart.patches[i];
    EXPECT_EQ(apart.own_places[i].triangle_begin, n_triangles[rows.face]);
    n_triangles[rows.face] += std::ssize(rows.triangles);
    by_face[rows.face].push_back(std::move(rows));
  }
  for (std::size_t f = 0; f < whole.patches.size(); ++f) {
    std::vector<FacePatch>& rows = by_face[static_cast<FaceId>(f)];
    EXPECT_EQ(n_triangles_of(apart.places[f]), static_cast<std::int64_t>(whole.patches[f].triangles.size()));
    EXPECT_EQ(packed(join_rows(std::move(rows))), packed(whole.patches[f])) << f;
  }
}

TEST(TiledFaces, are_whole_where_nothing_tells_how_heavy_they_are_or_no_tiles_are_wanted) {
  const Model model = test::make_model("box");
  const UniformField field(1);
  const MeshTopology topology(model.tables());
  set_verbosity(Verbosity::kQuiet);
  MeshOptions options;
  options.tile_triangles = 1000;
  const MeshResult unweighed = mesh_regions(model, topology, field, plan_all(topology), options, test::one_rank);
  const MeshResult none = mesh(model, field, 1, 0, test::one_rank), cut = mesh(model, field, 1, 1000, test::one_rank);
  bool differs = false;
  for (FaceId f = 0; f < 6; ++f) {
    EXPECT_EQ(packed(unweighed.patches[f]), packed(none.patches[f]));
    differs |= packed(cut.patches[f]) != packed(none.patches[f]);
  }
  EXPECT_TRUE(differs);
}

/// Cannot be asked near the middle of the side z = 20 of the box 60 x 40 x 20.
class NoSizeInTheMiddle : public UniformField {
 public:
  using SizeField::size;
  using UniformField::UniformField;
  double size(Vec3 x, int& hint) const override {
    if (x.z > 19.999 && distance(x, {30.2, 21.4, 20}) < 0.35) throw Error(ExitCode::kInternal, "no size");
    return UniformField::size(x, hint);
  }
};

TEST(TiledFaces, of_which_a_tile_fails_are_tried_whole_and_reported) {
  const Model box = test::make_model("box");
  const test::BackwardExecutor counted, without;
  const MeshResult r = mesh(box, NoSizeInTheMiddle(0.8), 0.8, 1000, counted);
  mesh(box, UniformField(0.8), 0.8, 1000, without);
  EXPECT_EQ(counted.n_of["face"], without.n_of["face"] + 1);
  EXPECT_EQ(counted.n_of["tile"], without.n_of["tile"]);
  ASSERT_EQ(r.failures.size(), 1u);
  EXPECT_NE(r.failures[0].cause.find("no size"), std::string::npos);
  for (FaceId f = 0; f < 6; ++f) EXPECT_EQ(r.patches[f].triangles.empty(), f == r.failures[0].face) << f;
}

/// A number of each first tile is none, as if a surface had said so, about the cuts or elsewhere.
class BrokenTile : public test::BackwardExecutor {
 public:
  explicit BrokenTile(bool is_in_band) : is_in_band_(is_in_band) {}
  void run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t)>& compute,
                       const std::function<void(std::int32_t, Bytes&&)>& collect) const override {
    BackwardExecutor::run_named_tasks(
        tasks,
        [&](std::int32_t task) {
          Bytes result = compute(task);
          const TaskLabel label = tasks.label(task);
          if (std::string(label.kind) != "tile" || label.part != 0) return result;
          SplitPiece tile;
          unpack(tasks.record(task, result), tile);
          (is_in_band_ ? tile.band.mesh.inner : tile.rest.mesh.inner).at(0).x.z =
              std::numeric_limits<double>::quiet_NaN();
          return tasks.restore(task, packed(tile));
        },
        collect);
  }

 private:
  bool is_in_band_;
};

TEST(TiledFaces, with_numbers_that_are_none_are_tried_whole) {
  const Model box = test::make_model("box");
  const test::BackwardExecutor sound;
  mesh(box, UniformField(0.8), 0.8, 1000, sound);
  const MeshResult whole = mesh(box, UniformField(0.8), 0.8, 0, test::one_rank);
  for (const bool is_in_band : {false, true}) {
    const BrokenTile broken(is_in_band);
    const MeshResult r = mesh(box, UniformField(0.8), 0.8, 1000, broken);
    EXPECT_GT(broken.n_of["cut"], 1u);
    EXPECT_EQ(broken.n_of["face"], sound.n_of["face"] + broken.n_of["cut"]);
    EXPECT_TRUE(r.failures.empty());
    for (FaceId f = 0; f < 6; ++f) {
      EXPECT_TRUE(has_numbers_only(r.patches[f])) << f;
      EXPECT_EQ(packed(r.patches[f]), packed(whole.patches[f])) << f;
    }
  }
}

}  // namespace
}  // namespace st
