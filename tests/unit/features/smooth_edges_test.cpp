// Edges across which the surface goes on smoothly.
#include "features/smooth_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace st {
namespace {

std::ptrdiff_t count_smooth(const std::string& shape) {
  const std::vector<std::uint8_t> is_smooth = find_smooth_edges(test::make_model(shape));
  return std::count(is_smooth.begin(), is_smooth.end(), 1);
}

TEST(SmoothEdges, are_none_of_a_box) { EXPECT_EQ(count_smooth("box"), 0); }

TEST(SmoothEdges, are_the_seams_of_a_torus) { EXPECT_EQ(count_smooth("torus"), 2); }

TEST(SmoothEdges, are_all_cuts_of_a_wing_but_not_its_rims_and_trailing_edge) {
  const Model model = test::make_model("wing_of_8");
  const std::vector<std::uint8_t> is_smooth = find_smooth_edges(model);
  const ModelTables& t = model.tables();
  ASSERT_EQ(t.n_faces(), 10);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const Vec3 a = t.vertex_xyz[t.edge_vertices[2 * e]], b = t.vertex_xyz[t.edge_vertices[2 * e + 1]];
    const bool is_rim = a.z == b.z && (a.z == 0 || a.z == 30);
    const bool is_trailing = std::min(a.x, b.x) > 9.99;
    EXPECT_EQ(is_smooth[e] != 0, !is_rim && !is_trailing) << "edge " << e + 1;
  }
}

/// Counts what is shared out.
class CountingExecutor : public SerialExecutor {
 public:
  int size() const override { return 3; }
  void run_tasks(std::int32_t n_tasks, const std::vector<std::int32_t>& order,
                 const std::function<Bytes(std::int32_t)>& compute,
                 const std::function<void(std::int32_t, Bytes&&)>& collect) const override {
    n_tasks_ += n_tasks;
    SerialExecutor::run_tasks(n_tasks, order, compute, collect);
  }
  std::int32_t n_tasks() const { return n_tasks_; }

 private:
  mutable std::int32_t n_tasks_ = 0;
};

TEST(SmoothEdges, are_looked_at_by_all_ranks) {
  const Model model = test::make_model("wing_of_200");
  const CountingExecutor executor;
  EXPECT_EQ(find_smooth_edges(model, executor), find_smooth_edges(model));
  EXPECT_EQ(executor.n_tasks(), (model.tables().n_edges() + 63) / 64);
  EXPECT_GE(executor.n_tasks(), 2);
}

TEST(SmoothEdges, are_told_apart_half_way) {
  const Model model = test::make_model("cylinder");
  const ModelTables& t = model.tables();
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  int n_smooth = 0;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const auto begin = faces.begin() + offsets[e];
    const bool is_smooth = is_smooth_half_way(model, e, {begin, faces.begin() + offsets[e + 1]}, radians(30));
    EXPECT_EQ(is_smooth, *begin == *(begin + 1)) << "the seam alone";
    n_smooth += is_smooth;
  }
  EXPECT_EQ(n_smooth, 1);
}

}  // namespace
}  // namespace st
