// The kernel alone: mesh_face on surfaces of each kind, with one length everywhere and with an octree's lengths.
//   kernel_bench [--benchmark_filter=REGEX] ...     Google Benchmark's own options; counters: triangles, triangles/s,
//   mean and least quality
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "geometry/shape/analytic.h"
#include "geometry/shape/bspline.h"
#include "mesh/quality.h"
#include "meshing/face/face_mesher.h"
#include "sizing/octree_field.h"

namespace {

using namespace st;

constexpr Frame kFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr double kTriangleArea = 0.43301270189221932;  // sqrt(3)/4: of an equilateral triangle of side 1

/// A face to mesh: the whole parameter rectangle of a surface. Opposite sides of a period are a seam, collapsed sides
/// poles.
struct Case {
  std::unique_ptr<Surface> surface;
  bool is_u_periodic = false, is_v_periodic = false, has_poles = false;
  double area = 0;
};

/// Area by the midpoint rule.
double area_of(const Surface& s) {
  constexpr int kSteps = 400;
  const double du = (s.u_max() - s.u_min()) / kSteps, dv = (s.v_max() - s.v_min()) / kSteps;
  double area = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const SurfacePoint p = s.evaluate({s.u_min() + (i + 0.5) * du, s.v_min() + (j + 0.5) * dv});
      area += norm(cross(p.du, p.dv)) * du * dv;
    }
  return area;
}

/// A bicubic patch of n x n spans on [0, length_u] x [0, 1], gently waved, knots uniform.
std::unique_ptr<Surface> make_patch(int n, double length_u) {
  constexpr int kDegree = 3;
  std::vector<double> knots(kDegree, 0.0);
  for (int i = 0; i <= n; ++i) knots.push_back(static_cast<double>(i) / n);
  knots.insert(knots.end(), kDegree, 1.0);
  const int n_poles = n + kDegree;
  std::vector<Pole> poles;
  for (int i = 0; i < n_poles; ++i)
    for (int j = 0; j < n_poles; ++j) {
      const double u = static_cast<double>(i) / (n_poles - 1), v = static_cast<double>(j) / (n_poles - 1);
      poles.push_back({{length_u * u, v, 0.1 * std::sin(5 * u) * std::cos(4 * v), 1}});
    }
  return std::make_unique<BsplineSurface>(KnotSpans(kDegree, knots, 0), KnotSpans(kDegree, knots, 0), std::move(poles),
                                          n_poles, false, Box2{{0, 0}, {1, 1}});
}

enum Kind : int { kPlane, kSphere, kNurbs, kStretched, kCylinder, kTorus };

Case make_case(int kind) {
  Case c;
  switch (kind) {
    case kPlane:
      c.surface = std::make_unique<PlaneSurface>(kFrame, 0, 1, 0, 1);
      break;
    case kSphere:
      c = {std::make_unique<AxialSurface>(SurfaceType::kSphere, kFrame, 1, 0, 0, 2 * kPi, -kPi / 2, kPi / 2), true,
           false, true};
      break;
    case kNurbs:
      c.surface = make_patch(10, 1);
      break;
    case kStretched:  // iso-lines of u are 1000 times as fast as those of v
      c.surface = make_patch(10, 1000);
      break;
    case kCylinder:
      c = {std::make_unique<AxialSurface>(SurfaceType::kCylinder, kFrame, 1, 0, 0, 2 * kPi, 0, 4), true, false, false};
      break;
    default:
      c = {std::make_unique<AxialSurface>(SurfaceType::kTorus, kFrame, 2, 0.5, 0, 2 * kPi, 0, 2 * kPi), true, true,
           false};
  }
  c.area = area_of(*c.surface);
  return c;
}

/// Parameters in [0, 1] that cut a side into segments of the requested length.
std::vector<double> cut_side(const Surface& s, Vec2 from, Vec2 to, const SizeField& field) {
  constexpr int kSteps = 4096;
  std::vector<double> integral(1, 0);
  Vec3 last = s.point(from);
  for (int i = 1; i <= kSteps; ++i) {
    const Vec3 x = s.point(from + (static_cast<double>(i) / kSteps) * (to - from));
    integral.push_back(integral.back() + distance(x, last) / field.size(0.5 * (x + last)));
    last = x;
  }
  const int n = std::max(3, static_cast<int>(std::lround(integral.back())));
  std::vector<double> cut(1, 0);
  for (int k = 1, i = 1; k < n; ++k) {
    const double wanted = integral.back() * k / n;
    while (integral[i] < wanted) ++i;
    cut.push_back((i - 1 + (wanted - integral[i - 1]) / (integral[i] - integral[i - 1])) / kSteps);
  }
  cut.push_back(1);
  return cut;
}

/// The four sides of the parameter rectangle; seam twins have equal ids and equal parameters, a pole one id.
FaceBoundary make_boundary(const Case& c, const SizeField& field) {
  const Surface& s = *c.surface;
  const Vec2 corner[4] = {
      {s.u_min(), s.v_min()}, {s.u_max(), s.v_min()}, {s.u_max(), s.v_max()}, {s.u_min(), s.v_max()}};
  std::vector<double> along_u = cut_side(s, corner[0], corner[1], field);
  const std::vector<double> along_v = cut_side(s, corner[1], corner[2], field);
  if (c.has_poles) {
    along_u.clear();
    for (int i = 0; i <= 8; ++i) along_u.push_back(i / 8.0);
  }
  FaceBoundary boundary;
  const auto id = [&](double u, double v) {  // a place in the unit square, seams and poles folded onto each other
    const auto n_u = static_cast<std::int32_t>(along_u.size()), n_v = static_cast<std::int32_t>(along_v.size());
    auto i = static_cast<std::int32_t>(std::lower_bound(along_u.begin(), along_u.end(), u) - along_u.begin());
    auto j = static_cast<std::int32_t>(std::lower_bound(along_v.begin(), along_v.end(), v) - along_v.begin());
    if (c.is_u_periodic && i == n_u - 1) i = 0;
    if (c.is_v_periodic && j == n_v - 1) j = 0;
    if (c.has_poles && (j == 0 || j == n_v - 1)) i = 0;
    return i * n_v + j;
  };
  const auto add = [&](double u, double v) {
    const Vec2 uv{u == 1 ? s.u_max() : s.u_min() + u * (s.u_max() - s.u_min()),
                  v == 1 ? s.v_max() : s.v_min() + v * (s.v_max() - s.v_min())};
    const Vec3 x = s.point(uv);
    boundary.nodes.push_back({uv, x, field.size(x), id(u, v), c.has_poles && (v == 0 || v == 1)});
  };
  const std::size_t n_u = along_u.size() - 1, n_v = along_v.size() - 1;
  for (std::size_t i = 0; i < n_u; ++i) add(along_u[i], 0);
  for (std::size_t j = 0; j < n_v; ++j) add(1, along_v[j]);
  for (std::size_t i = n_u; i > 0; --i) add(along_u[i], 1);
  for (std::size_t j = n_v; j > 0; --j) add(0, along_v[j]);
  const auto n = static_cast<std::int32_t>(boundary.nodes.size());
  for (std::int32_t k = 0; k < n; ++k) boundary.segments.emplace_back(k, (k + 1) % n);
  return boundary;
}

/// An octree of samples all over the surface, of one length.
std::unique_ptr<SizeField> make_octree_field(const Surface& s, double length) {
  constexpr int kSamples = 200;
  std::vector<RasterBox> boxes;
  Box3 box;
  for (int i = 0; i <= kSamples; ++i)
    for (int j = 0; j <= kSamples; ++j) {
      const Vec3 x = s.point(
          {s.u_min() + (s.u_max() - s.u_min()) * i / kSamples, s.v_min() + (s.v_max() - s.v_min()) * j / kSamples});
      box.add(x);
      boxes.push_back({x, static_cast<float>(8 * length), static_cast<float>(length), 0});
    }
  struct Storage {
    RasterOctree raster;
    std::vector<CellLength> cells;
  };
  const auto storage = std::make_shared<Storage>();
  storage->raster = build_octree(box, boxes);
  const auto most = static_cast<float>(length);
  storage->cells.assign(storage->raster.shape.leaf_keys.size(), {most, {0, 0, 0}, most});
  return std::make_unique<OctreeField>(OctreeFieldData{storage->raster.shape.view(), storage->cells, {}, 0.2, 1},
                                       storage);
}

void report_quality(const Case& c, const FaceBoundary& boundary, const FaceMesh& mesh, benchmark::State& state) {
  const auto n_boundary = static_cast<std::int32_t>(boundary.nodes.size());
  const auto at = [&](std::size_t k) {
    const std::int32_t n = mesh.corners[k];
    return n < n_boundary ? boundary.nodes[n].x : mesh.inner[n - n_boundary].x;
  };
  double sum = 0, least = 1, area = 0;
  for (std::size_t k = 0; k < mesh.corners.size(); k += 3) {
    const double q = triangle_quality(at(k), at(k + 1), at(k + 2));
    sum += q, least = std::min(least, q);
    area += 0.5 * norm(cross(at(k + 1) - at(k), at(k + 2) - at(k)));
  }
  const auto n = static_cast<double>(mesh.corners.size() / 3);
  state.counters["triangles"] = n;
  state.counters["triangles/s"] = benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["mean_q"] = sum / n;
  state.counters["min_q"] = least;
  state.counters["folds"] = mesh.n_folds;
  if (std::fabs(area / c.area - 1) > 0.01) state.SkipWithError("the mesh does not cover the face");
}

/// Arguments: kind of surface, triangles wanted, 1 for lengths from an octree.
void mesh_one_face(benchmark::State& state, int kind, bool has_octree) {
  const Case c = make_case(kind);
  const double length = std::sqrt(c.area / static_cast<double>(state.range(0)) / kTriangleArea);
  const std::unique_ptr<SizeField> field =
      has_octree ? make_octree_field(*c.surface, length) : std::make_unique<UniformField>(length);
  const FaceBoundary boundary = make_boundary(c, *field);
  FaceMesh mesh;
  for (auto _ : state) mesh = mesh_face(*c.surface, boundary, *field, {});
  if (mesh.cause != FailureCause::kNone) return state.SkipWithError(text_of(mesh.cause));
  report_quality(c, boundary, mesh, state);
}

void register_all() {
  const char* const names[] = {"plane", "sphere", "nurbs_10x10", "nurbs_stretched_1000", "cylinder", "torus"};
  for (int kind = kPlane; kind <= kTorus; ++kind)
    for (const bool has_octree : {false, true})
      benchmark::RegisterBenchmark((std::string(names[kind]) + (has_octree ? "/octree" : "/uniform")).c_str(),
                                   mesh_one_face, kind, has_octree)
          ->Arg(100'000)
          ->Arg(1'000'000)
          ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
