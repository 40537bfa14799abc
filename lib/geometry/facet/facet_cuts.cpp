#include "geometry/facet/facet_cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/eigen.h"
#include "base/error.h"
#include "geometry/shape/flatten.h"
#include "geometry/shape/flatten_coarse.h"

namespace st {
namespace {

constexpr double kNearCut = 0.02;        // of the piece's diagonal: a rim so near to a cut makes slivers
constexpr double kNearRim = 4;           // what a length of such rim costs, in lengths of the cut
constexpr double kAcross = 10;           // what a cut costs that misses the rims of a tube: it leaves two tubes
constexpr double kOnPlane = 0.02;        // of a side's height: a node so near to the plane counts as on it
constexpr double kRounding = 1e-7;       // of the piece's diagonal: single precision; a node so near is on the plane
constexpr double kFlatBox = 0.2;         // of the diagonal: a piece is not cut across a shorter extent
constexpr std::size_t kSampled = 10000;  // triangles that tell where a cut may be
constexpr double kSharpRim = 0.9 * 2 * kPi;  // radians
constexpr std::size_t kLarge = 20000;        // triangles: a piece to be cut again and again is halved
constexpr std::size_t kSolved = 5000;        // triangles: larger patches are flattened by way of a coarse one
constexpr double kShares[] = {0.5, 0.4, 0.6, 0.3, 0.7};  // of the area on one side
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Where triangles of a piece lie, weighted by area.
struct Spread {
  std::vector<Vec3> middle;
  std::vector<double> area;
  double total = 0;
};

Spread spread_of(const FacetPatch& patch) {
  Spread s;
  for (const Corners& c : patch.corners) {
    const Vec3 a = patch.x[c[0]], b = patch.x[c[1]], d = patch.x[c[2]];
    s.middle.push_back((a + b + d) / 3);
    s.area.push_back(0.5 * norm(cross(b - a, d - a)));
    s.total += s.area.back();
  }
  return s;
}

/// Those of space, then those of inertia.
std::vector<Vec3> candidate_axes(const Spread& s) {
  Vec3 center{};
  for (std::size_t t = 0; t < s.area.size(); ++t) center += s.area[t] / s.total * s.middle[t];
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t t = 0; t < s.area.size(); ++t) {
    const Eigen::Vector3d d = to_eigen(s.middle[t] - center);
    inertia += s.area[t] / s.total * (d * d.transpose());
  }
  std::vector<Vec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3 axis : principal_axes(inertia).axis) axes.push_back(axis);
  return axes;
}

/// Places along the axis that have kShares of the area below, by a sample of the triangles.
std::vector<double> candidate_places(const Spread& s, Vec3 axis) {
  const std::size_t step = 1 + s.area.size() / kSampled;
  std::vector<std::pair<double, double>> along;
  double total = 0;
  for (std::size_t t = 0; t < s.area.size(); t += step) {
    along.emplace_back(dot(s.middle[t], axis), s.area[t]);
    total += s.area[t];
  }
  std::sort(along.begin(), along.end());
  std::vector<double> places;
  for (const double share : kShares) {
    if (s.area.size() > kLarge && !places.empty()) break;
    double sum = 0;
    const auto at =
        std::find_if(along.begin(), along.end() - 1, [&](const auto& a) { return (sum += a.second) >= share * total; });
    places.push_back(at->first);
  }
  return places;
}

/// Of own nodes above a plane; 0 where the plane passes so near that it would leave a sliver. `least`: what is nearer
/// than this is rounding, also where a side runs along the plane.
std::vector<double> heights(const FacetPatch& patch, Vec3 axis, double place, double least) {
  std::vector<double> height, reach(patch.x.size(), kInfinite);
  for (const Vec3 x : patch.x) height.push_back(dot(x, axis) - place);
  for (const Corners& c : patch.corners)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = c[k], b = c[(k + 1) % 3];
      const double step = std::abs(height[a] - height[b]);
      if (step > 0) reach[a] = std::min(reach[a], step), reach[b] = std::min(reach[b], step);
    }
  for (std::size_t i = 0; i < height.size(); ++i)
    if (reach[i] < kInfinite && std::abs(height[i]) < std::max(kOnPlane * reach[i], least)) height[i] = 0;
  return height;
}

/// The length of a cut and what it leaves.
class CutCost {
 public:
  CutCost(const FacetPatch& patch, const PatchTopology& topology)
      : patch_(patch), neighbours_(find_neighbours(patch.corners)), is_tube_(topology.loops.size() > 1) {
    Box3 box;
    for (const Vec3 x : patch.x) box.add(x);
    near_ = kNearCut * box.diagonal();
  }

  double operator()(const std::vector<double>& height) const {
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    if (!(*low < 0 && *high > 0)) return kInfinite;
    double cost = 0;
    bool meets_rim = false;
    for (std::size_t t = 0; t < patch_.corners.size(); ++t) {
      cost += cut_length(patch_.corners[t], height);
      for (int k = 0; k < 3; ++k) {
        if (neighbours_[t][k] != kNone) continue;
        const std::int32_t a = patch_.corners[t][k], b = patch_.corners[t][(k + 1) % 3];
        cost += kNearRim * near_length(a, b, height);
        meets_rim = meets_rim || height[a] * height[b] <= 0;
      }
    }
    return is_tube_ && !meets_rim ? kAcross * cost : cost;
  }

 private:
  double cut_length(const Corners& c, const std::vector<double>& height) const {
    std::array<Vec3, 6> on;
    std::size_t n = 0;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = c[k], b = c[(k + 1) % 3];
      if (height[a] == 0) on[n++] = patch_.x[a];
      if (height[a] * height[b] < 0)
        on[n++] = patch_.x[a] + (height[a] / (height[a] - height[b])) * (patch_.x[b] - patch_.x[a]);
    }
    return n == 2 ? distance(on[0], on[1]) : 0;
  }

  /// Of a rim side within the near distance of the plane.
  double near_length(std::int32_t a, std::int32_t b, const std::vector<double>& height) const {
    const double low = std::max(std::min(height[a], height[b]), -near_),
                 high = std::min(std::max(height[a], height[b]), near_), range = std::abs(height[a] - height[b]);
    if (high < low) return 0;
    return distance(patch_.x[a], patch_.x[b]) * (range > 0 ? std::min(1.0, (high - low) / range) : 1.0);
  }

  const FacetPatch& patch_;
  std::vector<Corners> neighbours_;
  bool is_tube_;
  double near_;
};

/// The rim node around which the triangles turn most, where that is so near to a full turn that no plane map can leave
/// both rim sides apart (at the end of a sharp wing's root); kNone where there is none.
std::int32_t sharpest_rim_node(const FacetPatch& patch, const PatchTopology& topology) {
  std::vector<double> turn(patch.x.size(), 0);
  for (const Corners& c : patch.corners)
    for (int k = 0; k < 3; ++k)
      turn[c[k]] += angle_between(patch.x[c[(k + 1) % 3]] - patch.x[c[k]], patch.x[c[(k + 2) % 3]] - patch.x[c[k]]);
  std::int32_t sharpest = kNone;
  double most = kSharpRim;
  for (const auto& loop : topology.loops)
    for (const std::int32_t n : loop)
      if (turn[n] > most) most = turn[n], sharpest = n;
  return sharpest;
}

/// Empty where every plane leaves all on one side.
std::vector<double> best_cut(const FacetPatch& patch, const PatchTopology& topology) {
  const std::int32_t sharpest = sharpest_rim_node(patch, topology);
  const Spread spread = spread_of(patch);
  const CutCost cost_of(patch, topology);
  Box3 box;
  for (const Vec3 x : patch.x) box.add(x);
  std::vector<double> best;
  double least = kInfinite;
  for (const Vec3 axis : candidate_axes(spread)) {
    double low = kInfinite, high = -kInfinite;
    for (const Vec3 x : patch.x) low = std::min(low, dot(x, axis)), high = std::max(high, dot(x, axis));
    if (high - low < kFlatBox * box.diagonal()) continue;
    const std::vector<double> places =
        sharpest != kNone ? std::vector{dot(patch.x[sharpest], axis)} : candidate_places(spread, axis);
    for (const double place : places) {
      std::vector<double> height = heights(patch, axis, place, kRounding * box.diagonal());
      if (const double cost = cost_of(height); cost < least) least = cost, best = std::move(height);
    }
  }
  return best;
}

/// Cuts what is open until nothing is.
class Cutter {
 public:
  explicit Cutter(FacetMesh& mesh) : mesh_(mesh) {}

  void run() {
    const std::int32_t n_regions = 1 + *std::max_element(mesh_.face.begin(), mesh_.face.end());
    std::vector<std::vector<std::int32_t>> regions(static_cast<std::size_t>(n_regions));
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t) regions[mesh_.face[t]].push_back(t);
    std::vector<std::int32_t> open;
    for (const auto& region : regions) add_pieces(region, open);
    std::reverse(open.begin(), open.end());  // the first region first
    while (!open.empty()) {
      const std::int32_t piece = open.back();
      open.pop_back();
      work_on(piece, open);
    }
    for (std::int32_t& face : mesh_.face) face = chart_[face];
  }

 private:
  /// New numbers for what hangs together.
  void add_pieces(const std::vector<std::int32_t>& triangles, std::vector<std::int32_t>& open) {
    for (const FacetPatch& patch : find_patches(mesh_, triangles)) {
      open.push_back(static_cast<std::int32_t>(chart_.size()));
      for (const std::int32_t t : patch.triangles) mesh_.face[t] = open.back();
      members_.push_back(patch.triangles);
      chart_.push_back(kNone);
    }
  }

  void work_on(std::int32_t piece, std::vector<std::int32_t>& open) {
    const std::vector<std::int32_t> triangles = std::exchange(members_[piece], {});
    const FacetPatch patch = std::move(find_patches(mesh_, triangles).front());
    const PatchTopology topology = find_topology(patch.x, patch.corners);
    if (const auto uv = lay_flat(patch, topology)) {
      for (std::size_t i = 0; i < patch.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) mesh_.uv[patch.triangles[i]][k] = (*uv)[patch.corners[i][k]];
      chart_[piece] = n_charts_++;
      return;
    }
    const std::vector<double> height = best_cut(patch, topology);
    if (height.empty()) fail(patch);
    const std::int32_t n_before = mesh_.n_triangles();
    divide(mesh_, patch, height);
    std::vector<std::int32_t> own = triangles;
    for (std::int32_t t = n_before; t < mesh_.n_triangles(); ++t)
      (mesh_.face[t] == piece ? own : members_[mesh_.face[t]]).push_back(t);
    add_pieces(own, open);
  }

  static std::optional<std::vector<Vec2>> lay_flat(const FacetPatch& patch, const PatchTopology& topology) {
    if (patch.corners.size() > kSolved)
      if (auto uv = flatten_coarse(patch.x, patch.corners, topology)) return uv;
    return flatten(patch.x, patch.corners, topology);
  }

  [[noreturn]] void fail(const FacetPatch& patch) const {
    const Vec3 x = patch.x.front();
    throw Error(
        ExitCode::kGeometry,
        fmt::format("{} facets at ({:.6g}, {:.6g}, {:.6g}) cannot be laid into a plane; repair the facets there",
                    patch.corners.size(), x.x, x.y, x.z));
  }

  FacetMesh& mesh_;
  std::vector<std::vector<std::int32_t>> members_;  // triangles of pieces that are open
  std::vector<std::int32_t> chart_;                 // number of each piece that is done
  std::int32_t n_charts_ = 0;
};

}  // namespace

void cut_into_charts(FacetMesh& mesh) { Cutter(mesh).run(); }

}  // namespace st
