#include "geometry/shape/chart_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "base/assert.h"
#include "base/box_tree.h"
#include "base/boxes.h"
#include "base/closest_weights.h"
#include "base/eigen.h"

namespace st {
namespace {

// A projection looks so far from its guess in (u,v), in distances of the target from the guess' point: the opposite
// side of a thin wing is further away there.
constexpr double kReach = 4;

constexpr double kOpposite = 0.5;  // one more than the cosine: normals further apart are not of one surface
constexpr double kNeedle = 1e-3;   // height of a triangle over its longest side: flatter ones have no plane

Vec3 flat(Vec2 p) { return {p.x, p.y, 0}; }

double segment_distance2(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double length2 = dot(d, d), s = length2 > 0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
  const Vec2 r = p - (a + s * d);
  return dot(r, r);
}

std::array<double, 3> barycentric(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  const double det = cross(b - a, c - a), second = cross(p - a, c - a) / det, third = cross(b - a, p - a) / det;
  return {1 - second - third, second, third};
}

/// A form on vectors across the unit vector `from`, turned with it, without twist.
Eigen::Matrix3d turned(const Eigen::Matrix3d& form, Vec3 from, Vec3 to) {
  const double nearness = 1 + dot(from, to);
  if (nearness < kOpposite) return form;
  const Eigen::Matrix3d turn = Eigen::Matrix3d::Identity() - to_eigen(from + to) * to_eigen(to).transpose() / nearness;
  return turn * form * turn.transpose();
}

bool is_needle(const Chart& c, const Corners& n) {
  const Vec3 a = c.x[n[1]] - c.x[n[0]], b = c.x[n[2]] - c.x[n[0]];
  return norm(cross(a, b)) <= kNeedle * std::max({norm2(a), norm2(b), norm2(b - a)});
}

}  // namespace

double stretch(const Chart& c, const Corners& n) {
  const Vec2 p = c.uv[n[1]] - c.uv[n[0]], q = c.uv[n[2]] - c.uv[n[0]];
  const Vec3 x = c.x[n[1]] - c.x[n[0]], y = c.x[n[2]] - c.x[n[0]];
  const double det = cross(p, q);
  const Vec3 du = (q.y * x - p.y * y) / det, dv = (p.x * y - q.x * x) / det;
  const double half = 0.5 * (norm2(du) + norm2(dv)), off = 0.5 * (norm2(du) - norm2(dv));
  return std::sqrt(half + std::hypot(off, dot(du, dv)));
}

struct ChartSurface::Data {
  explicit Data(Chart c) : chart(std::move(c)) {
    std::vector<Box3> in_plane;
    for (const Corners& t : chart.corners) {
      in_plane.emplace_back();
      for (const std::int32_t n : t) in_plane.back().add(flat(chart.uv[n]));
    }
    plane_tree = BoxTree(in_plane);
    neighbours = find_neighbours(chart.corners);
    for (const Vec2 p : chart.uv) bounds.add(p);
    for (const Corners& t : chart.corners)
      if (!is_needle(chart, t)) largest_stretch = std::max(largest_stretch, stretch(chart, t));
    find_seeds();
  }

  /// A grid of about as many cells as triangles; for each the triangle where a walk to its middle ends, from the cell
  /// before. Under a composite triangles are few, slender and asked for often.
  void find_seeds() {
    constexpr double kCellsUnderComposite = 64, kMostCells = 1000;  // along each axis
    const double n = std::ceil(std::sqrt(static_cast<double>(chart.corners.size()))),
                 least = chart.normal.empty() ? kCellsUnderComposite : 1;
    n_cells = static_cast<std::int32_t>(std::clamp(n, least, kMostCells));
    std::int32_t at = 0;
    for (std::int32_t row = 0; row < n_cells; ++row)
      for (std::int32_t column = 0; column < n_cells; ++column) {
        const Vec2 share{(column + 0.5) / n_cells, (row + 0.5) / n_cells}, size = bounds.size();
        walk({bounds.lo.x + share.x * size.x, bounds.lo.y + share.y * size.y}, at);
        seeds.push_back(at);
      }
  }

  std::int32_t seed(Vec2 p) const {
    const auto cell = [&](double at, double lo, double size) {  // also where `at` is no number, or there is no size
      return static_cast<std::int32_t>(std::min(std::max(0.0, (at - lo) / size * n_cells), n_cells - 1.0));
    };
    const Vec2 size = bounds.size();
    return seeds[cell(p.y, bounds.lo.y, size.y) * n_cells + cell(p.x, bounds.lo.x, size.x)];
  }

  /// From triangle `t` towards p, across the side that p is farthest beyond; false where the rim is in the way.
  bool walk(Vec2 p, std::int32_t& t) const {
    constexpr int kMostSteps = 200;
    for (int step = 0; step < kMostSteps; ++step) {
      const Corners& c = chart.corners[t];
      const Vec2 a = chart.uv[c[0]] - p, b = chart.uv[c[1]] - p, d = chart.uv[c[2]] - p;
      const double w[3] = {cross(b, d), cross(d, a), cross(a, b)};  // twice the areas across from the corners
      const auto k = std::min_element(w, w + 3) - w;
      if (w[k] >= 0) return true;
      const std::int32_t next = neighbours[t][(k + 1) % 3];  // across the side that faces corner k
      if (next == kNone) return false;
      t = next;
    }
    return false;
  }

  /// The second fundamental form at the nodes, as a form on vectors in space: the mean of their triangles', in each of
  /// which the normal is linear.
  std::vector<Eigen::Matrix3d> find_bend() const {
    std::vector<Eigen::Matrix3d> bend(chart.x.size(), Eigen::Matrix3d::Zero());
    std::vector<double> total(chart.x.size(), 0);
    for (const Corners& t : chart.corners) {
      const Vec3 a = chart.x[t[0]], b = chart.x[t[1]], c = chart.x[t[2]], n2 = cross(b - a, c - a);
      const double area = norm(n2);
      if (!(area > 0)) continue;
      const Vec3 n = n2 / area;
      Eigen::Matrix3d form = Eigen::Matrix3d::Zero();
      for (int k = 0; k < 3; ++k) {
        const Vec3 side = chart.x[t[(k + 2) % 3]] - chart.x[t[(k + 1) % 3]], gradient = cross(n, side) / area;
        const Vec3 normal = chart.normal[t[k]], tilt = normal - dot(normal, n) * n;
        form -=
            0.5 * (to_eigen(tilt) * to_eigen(gradient).transpose() + to_eigen(gradient) * to_eigen(tilt).transpose());
      }
      for (const std::int32_t node : t) {
        bend[node] += area * turned(form, n, chart.normal[node]);
        total[node] += area;
      }
    }
    for (std::size_t i = 0; i < bend.size(); ++i)
      if (total[i] > 0) bend[i] /= total[i];
    return bend;
  }

  /// The closest of those triangles that `is_candidate`, and the weights of its corners there.
  template <class IsCandidate>
  Place closest(Vec3 p, const IsCandidate& is_candidate) const {
    Place best;
    double best2 = std::numeric_limits<double>::infinity();
    tree_in_space().visit_near(
        p, [&](std::int32_t, double d2) { return d2 < best2; },
        [&](std::int32_t t) {
          if (!is_candidate(t)) return;
          const Corners& c = chart.corners[t];
          const auto w = closest_weights(p, chart.x[c[0]], chart.x[c[1]], chart.x[c[2]]);
          const double d2 = norm2(w[0] * chart.x[c[0]] + w[1] * chart.x[c[1]] + w[2] * chart.x[c[2]] - p);
          if (d2 < best2) best = {t, w}, best2 = d2;
        });
    return best;
  }

  /// This and tree_in_space() are made when they are first asked for: many only ask which triangle holds (u,v).
  const std::vector<Eigen::Matrix3d>& bend() const {
    std::call_once(has_bend_, [&] { bend_ = find_bend(); });
    return bend_;
  }

  const BoxTree& tree_in_space() const {
    std::call_once(has_space_tree_, [&] {
      std::vector<Box3> boxes(chart.corners.size());
      for (std::size_t t = 0; t < boxes.size(); ++t)
        for (const std::int32_t n : chart.corners[t]) boxes[t].add(chart.x[n]);
      space_tree_ = BoxTree(boxes);
    });
    return space_tree_;
  }

  std::optional<Vec2> uv_of(const Place& at) const {
    if (at.triangle == kNone) return std::nullopt;
    const Corners& c = chart.corners[at.triangle];
    return at.weight[0] * chart.uv[c[0]] + at.weight[1] * chart.uv[c[1]] + at.weight[2] * chart.uv[c[2]];
  }

  SurfacePoint on_facet(const Place& at) const {
    const Corners& c = chart.corners[at.triangle];
    const Vec3 a = chart.x[c[1]] - chart.x[c[0]], b = chart.x[c[2]] - chart.x[c[0]];
    const Vec2 pa = chart.uv[c[1]] - chart.uv[c[0]], pb = chart.uv[c[2]] - chart.uv[c[0]];
    const double det = cross(pa, pb);
    return {chart.x[c[0]] + at.weight[1] * a + at.weight[2] * b, (pb.y * a - pa.y * b) / det,
            (pa.x * b - pb.x * a) / det};
  }

  double plane_distance2(std::int32_t t, Vec2 p) const {
    const Corners& c = chart.corners[t];
    const Vec2 a = chart.uv[c[0]], b = chart.uv[c[1]], d = chart.uv[c[2]];
    if (cross(b - a, p - a) >= 0 && cross(d - b, p - b) >= 0 && cross(a - d, p - d) >= 0) return 0;
    return std::min({segment_distance2(p, a, b), segment_distance2(p, b, d), segment_distance2(p, d, a)});
  }

  Chart chart;
  BoxTree plane_tree;  ///< of triangles in (u,v)
  std::vector<Corners> neighbours;
  Box2 bounds;                      ///< of (u,v)
  std::int32_t n_cells = 1;         ///< along each axis
  std::vector<std::int32_t> seeds;  ///< [n_cells^2] where walks begin
  double largest_stretch = 0;

 private:
  mutable std::once_flag has_bend_, has_space_tree_;
  mutable std::vector<Eigen::Matrix3d> bend_;  // [n_nodes] times two tangents: the normal part of a second derivative
  mutable BoxTree space_tree_;                 // of triangles in space
};

ChartSurface::ChartSurface(Chart chart) : ChartSurface(std::make_shared<const Data>(std::move(chart))) {}

ChartSurface::ChartSurface(std::shared_ptr<const Data> data) : data_(std::move(data)) {
  ST_ASSERT(!data_->chart.corners.empty());
  Box3 box;
  for (const Vec2 p : data_->chart.uv) box.add(flat(p));
  u_min_ = box.lo.x, u_max_ = box.hi.x;
  v_min_ = box.lo.y, v_max_ = box.hi.y;
  type_ = SurfaceType::kOther;
}

ChartSurface::~ChartSurface() = default;

std::unique_ptr<Surface> ChartSurface::copy() const { return std::unique_ptr<Surface>(new ChartSurface(data_)); }

double ChartSurface::largest_stretch() const { return data_->largest_stretch; }

ChartSurface::Place ChartSurface::locate(Vec2 p) const {
  Place place{data_->seed(p), {}};
  double best2 = 0;
  if (!data_->walk(p, place.triangle)) {  // beside the patch, or in the way of its rim
    best2 = data_->plane_distance2(place.triangle, p);
    data_->plane_tree.visit_near(
        flat(p), [&](std::int32_t, double d2) { return d2 < best2; },
        [&](std::int32_t t) {
          if (const double d2 = data_->plane_distance2(t, p); d2 < best2) place.triangle = t, best2 = d2;
        });
  }
  const Corners& c = data_->chart.corners[place.triangle];
  const auto& uv = data_->chart.uv;
  if (best2 > 0)
    place.weight = closest_weights(flat(p), flat(uv[c[0]]), flat(uv[c[1]]), flat(uv[c[2]]));
  else
    place.weight = barycentric(p, uv[c[0]], uv[c[1]], uv[c[2]]);
  return place;
}

SurfacePoint ChartSurface::evaluate(Vec2 p) const { return data_->on_facet(locate(p)); }

SurfacePoint2 ChartSurface::evaluate2(Vec2 p) const {
  const Place at = locate(p);
  const SurfacePoint facet = data_->on_facet(at);
  const Corners& c = data_->chart.corners[at.triangle];
  Vec3 mean{};
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double weight = std::clamp(at.weight[k], 0.0, 1.0);
    mean += weight * data_->chart.normal[c[k]];
    sum += weight;
  }
  const Vec3 normal = normalized(mean);
  const std::vector<Eigen::Matrix3d>& bends = data_->bend();
  Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k)
    bend += std::clamp(at.weight[k], 0.0, 1.0) * turned(bends[c[k]], data_->chart.normal[c[k]], normal);
  const Vec3 du = facet.du - dot(facet.du, normal) * normal, dv = facet.dv - dot(facet.dv, normal) * normal;
  const Eigen::Vector3d u = to_eigen(du), v = to_eigen(dv);
  return {
      facet.x, du, dv, u.dot(bend * u) / sum * normal, u.dot(bend * v) / sum * normal, v.dot(bend * v) / sum * normal};
}

bool ChartSurface::holds(Vec2 uv) const {
  constexpr double kRounding = 1e-9;  // of the bounds
  return norm(*data_->uv_of(locate(uv)) - uv) <= kRounding * norm(data_->bounds.size());
}

std::optional<Vec2> ChartSurface::exact_foot(Vec3 p) const {
  return data_->uv_of(data_->closest(p, [](std::int32_t) { return true; }));
}

std::optional<Vec2> ChartSurface::foot_near(Vec3 p, Vec2 guess) const {
  const Place at = locate(guess);
  const Vec2 from = *data_->uv_of(at);
  const double reach = kReach * distance(data_->on_facet(at).x, p);
  return data_->uv_of(
      data_->closest(p, [&](std::int32_t t) { return data_->plane_distance2(t, from) <= reach * reach; }));
}

}  // namespace st
