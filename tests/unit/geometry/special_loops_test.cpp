// Loops of the faces that break meshers, as polygons in (u,v): each encloses exactly its face, once and
// counter-clockwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>

#include "broken/broken_shapes.h"
#include "geometry/import/import.h"
#include "geometry/model/model.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

Model broken_model(const std::string& shape) {
  const TemporaryDirectory dir;
  test::write_broken(shape, dir / "model.brep");
  ImportResult r = import_model(dir / "model.brep", {});
  return Model(std::move(r.tables), std::move(r.brep));
}

struct Polygon {
  std::vector<Vec2> points;  ///< (u,v), closed by its last side
  double gap = 0;            ///< largest distance between the end of a coedge and the start of the next

  double area() const {
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) sum += 0.5 * cross(points[i], points[(i + 1) % points.size()]);
    return sum;
  }
  /// How often the polygon runs around p, counter-clockwise positive.
  int winding(Vec2 p) const {
    int turns = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 a = points[i], b = points[(i + 1) % points.size()];
      if ((a.y <= p.y) != (b.y <= p.y) && (cross(b - a, p - a) > 0) == (b.y > a.y)) turns += b.y > a.y ? 1 : -1;
    }
    return turns;
  }
};

constexpr int kSteps = 400;  // per coedge

std::vector<Vec2> coedge_points(const Model& model, FaceId f, CoedgeId c) {
  const ModelTables& t = model.tables();
  const double* range = &t.edge_range[2 * t.coedge_edge[c]];
  const auto pcurve = model.pcurve(f, c);
  std::vector<Vec2> points;
  for (int k = 0; k <= kSteps; ++k) points.push_back(pcurve->point(range[0] + (range[1] - range[0]) * k / kSteps));
  if (t.coedge_is_reversed[c]) std::reverse(points.begin(), points.end());
  return points;
}

std::vector<Polygon> loops_of(const Model& model, FaceId f) {
  const ModelTables& t = model.tables();
  std::vector<Polygon> loops;
  for (const LoopId l : t.loops(f)) {
    Polygon loop;
    for (const CoedgeId c : t.loop_coedges(l)) {
      const std::vector<Vec2> points = coedge_points(model, f, c);
      if (!loop.points.empty()) loop.gap = std::max(loop.gap, norm(points.front() - loop.points.back()));
      loop.points.insert(loop.points.end(), points.begin(), points.end());
    }
    loop.gap = std::max(loop.gap, norm(loop.points.front() - loop.points.back()));
    loops.push_back(std::move(loop));
  }
  return loops;
}

int winding(const std::vector<Polygon>& loops, Vec2 p) {
  int sum = 0;
  for (const Polygon& l : loops) sum += l.winding(p);
  return sum;
}

struct SpecialFace {
  const char* shape;
  int n_loops, n_coedges;
  double uv_area;  ///< by mathematics; 0: the whole rectangle of the surface's parameters
  std::function<bool(Vec3)> is_cut_out = [](Vec3) { return false; };
};

std::ostream& operator<<(std::ostream& out, const SpecialFace& face) { return out << face.shape; }

/// The bore of radius 3 across the seam (u = 0) of the cylinder of radius 10 and height 30, at half its height.
bool in_bore(Vec3 x) { return x.x > 0 && x.y * x.y + (x.z - 15) * (x.z - 15) < 9; }

/// Area of that bore in (u,v), by the midpoint rule.
double bore_area() {
  const double u_max = std::asin(0.3);
  double area = 0;
  for (int i = 0; i < 200000; ++i) {
    const double y = 10 * std::sin(u_max * (i + 0.5) / 200000);
    area += 4 * std::sqrt(9 - y * y) * u_max / 200000;
  }
  return area;
}

class SpecialLoops : public testing::TestWithParam<SpecialFace> {};

TEST_P(SpecialLoops, enclose_their_face_once_and_nothing_else) {
  const SpecialFace& wanted = GetParam();
  const Model model = test::make_model(wanted.shape);
  const ModelTables& t = model.tables();
  const auto loops = loops_of(model, 0);
  EXPECT_EQ(loops.size(), static_cast<std::size_t>(wanted.n_loops));
  EXPECT_EQ(t.loop_coedge_offsets[t.face_loop_offsets[1]], wanted.n_coedges);
  double area = 0;
  for (const Polygon& l : loops) {
    EXPECT_LE(l.gap, 1e-6);
    area += l.area();
  }
  const auto surface = model.surface(0);
  const double* b = &t.face_uv_bounds[0];
  const double rectangle = (surface->u_max() - surface->u_min()) * (surface->v_max() - surface->v_min());
  const double uv_area = wanted.uv_area > 0 ? wanted.uv_area : rectangle;
  EXPECT_NEAR(area, uv_area, 1e-4 * uv_area);
  int n_inside = 0;
  for (int i = -5; i < 45; ++i)
    for (int j = -5; j < 45; ++j) {
      const Vec2 p{b[0] + (b[1] - b[0]) * (i + 0.317) / 40, b[2] + (b[3] - b[2]) * (j + 0.419) / 40};
      const bool in_bounds = i >= 0 && i < 40 && j >= 0 && j < 40,
                 is_inside = in_bounds && !wanted.is_cut_out(surface->point(p));
      EXPECT_EQ(winding(loops, p), is_inside) << p.x << ' ' << p.y;
      n_inside += is_inside;
    }
  EXPECT_GT(n_inside, 1000);
}

TEST_P(SpecialLoops, run_along_a_seam_once_up_and_once_down_a_period_apart) {
  const Model model = test::make_model(GetParam().shape);
  const ModelTables& t = model.tables();
  std::map<EdgeId, std::vector<CoedgeId>> uses;
  for (CoedgeId c = 0; c < t.loop_coedge_offsets[t.face_loop_offsets[1]]; ++c) uses[t.coedge_edge[c]].push_back(c);
  const double* b = &t.face_uv_bounds[0];
  for (const auto& [edge, coedges] : uses) {
    if (coedges.size() == 1) continue;
    ASSERT_EQ(coedges.size(), 2u) << "edge " << edge;
    EXPECT_NE(t.coedge_is_reversed[coedges[0]], t.coedge_is_reversed[coedges[1]]) << "edge " << edge;
    const auto up = coedge_points(model, 0, coedges[0]), down = coedge_points(model, 0, coedges[1]);
    for (int k = 0; k <= kSteps; ++k) {
      const Vec2 apart = up[k] - down[kSteps - k];
      EXPECT_NEAR(std::max(std::abs(apart.x) / (b[1] - b[0]), std::abs(apart.y) / (b[3] - b[2])), 1, 1e-6)
          << "edge " << edge;
      EXPECT_NEAR(std::min(std::abs(apart.x), std::abs(apart.y)), 0, 1e-6) << "edge " << edge;
    }
  }
}

const double kPi2 = kPi * kPi;
INSTANTIATE_TEST_SUITE_P(
    , SpecialLoops,
    testing::Values(SpecialFace{"sphere", 1, 4, 2 * kPi2}, SpecialFace{"cone_side", 1, 4, 2 * kPi* std::sqrt(500.0)},
                    SpecialFace{"torus", 1, 4, 4 * kPi2}, SpecialFace{"closed_tube", 1, 4, 0},
                    SpecialFace{"periodic_tube", 1, 4, 0},
                    SpecialFace{"disc", 1, 1, 100 * kPi, [](Vec3 x) { return x.x * x.x + x.y * x.y > 100; }},
                    SpecialFace{"annulus", 2, 2, 84 * kPi,
                                [](Vec3 x) {
                                  const double rr = x.x * x.x + x.y * x.y;
                                  return rr > 100 || rr < 16;
                                }},
                    SpecialFace{"drilled_cylinder", 1, 8, 60 * kPi - bore_area(), in_bore}),
    [](const auto& info) { return std::string(info.param.shape); });

TEST(BrokenLoops, of_a_face_without_area_go_there_and_back) {
  const Model model = broken_model("flat");
  const auto loops = loops_of(model, 0);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_LE(loops[0].gap, 1e-9);
  EXPECT_NEAR(loops[0].area(), 0, 1e-9);
  EXPECT_EQ(loops[0].points.size(), 3u * (kSteps + 1));
}

TEST(BrokenLoops, that_cross_themselves_run_around_one_part_the_other_way) {
  const Model model = broken_model("bow_tie");
  const auto loops = loops_of(model, 0);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_LE(loops[0].gap, 1e-9);
  std::map<int, int> counts;
  const double* b = &model.tables().face_uv_bounds[0];
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j)
      ++counts[winding(loops, {b[0] + (b[1] - b[0]) * (i + 0.317) / 40, b[2] + (b[3] - b[2]) * (j + 0.419) / 40})];
  EXPECT_EQ(counts.size(), 3u);
  EXPECT_NEAR(counts[1], counts[-1], 40);
  EXPECT_GT(counts[1], 100);
}

TEST(BrokenLoops, of_a_thin_face_are_the_rectangle_it_is) {
  const auto loops = loops_of(broken_model("sliver"), 0);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_NEAR(loops[0].area(), 0.1, 1e-9);
}

}  // namespace
}  // namespace st
