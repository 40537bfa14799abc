#include "sizing/growth_limit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/lists_by_key.h"
#include "base/threads.h"
#include "sizing/mean_stretch.h"
#include "sizing/multiscale_metric.h"
#include "sizing/space_metric.h"
#include "sizing/tet_frame.h"

namespace st {
namespace {

constexpr double kSlack = 1e-9;  // of a gradient or a length that is limited: less is rounding

/// Of the nodes of a tetrahedron, alike.
MeanStretch mean_of_nodes(const BackgroundMesh& mesh, const std::array<std::int32_t, 4>& tet) {
  std::array<Vec3, 4> stretches;
  for (std::size_t k = 0; k < 4; ++k) stretches[k] = log_stretch(mesh.node_size[tet[k]]);
  return mean_stretch(stretches, std::array{0.25, 0.25, 0.25, 0.25});
}

/// Lowers the lengths of one tetrahedron until its gradient is no more than the slope: the largest alone where that is
/// enough, else all towards the smallest. False: nothing to do.
bool limit_tet(const std::array<Vec3, 4>& p, double slope, std::array<double, 4>& h) {
  if (is_flat(p)) return false;
  const TetFrame frame(p);
  const double steepness = norm(frame.gradient(h));
  if (!(steepness > (1 + kSlack) * slope)) return false;
  const auto [least, top] = std::minmax_element(h.begin(), h.end());
  // the gradient is g0 + h_top * row: of the values of h_top that hold it to the slope, the largest
  const double smallest = *least, was = *top;
  std::array<double, 4> without = h;
  without[static_cast<std::size_t>(top - h.begin())] = smallest;
  std::array<double, 4> unit{};
  unit[static_cast<std::size_t>(top - h.begin())] = 1;
  const Vec3 g = frame.gradient(without), row = frame.gradient(unit);
  const double a = norm2(row), b = dot(g, row), c = norm2(g) - slope * slope, root = b * b - a * c;
  if (root >= 0) {
    const double rise = (-b + std::sqrt(root)) / a;
    if (rise >= 0 && smallest + rise < was) {
      *top = smallest + rise;
      return true;
    }
  }
  for (double& value : h) value = smallest + (value - smallest) * (slope / steepness);
  return true;
}

/// What an edge at a node may be along, so that no more than `value` is requested in direction `d`.
double along_for(const LocalSize& size, Vec3 d, double value) {
  if (!(value > size.length)) return size.length;
  const double part = dot(d, size.direction), share = part * part;
  const double rest = 1 / (value * value) - (1 - share) / (size.length * size.length);
  return rest > 0 ? std::clamp(std::sqrt(share / rest), size.length, size.along) : size.along;
}

class GrowthLimiter {
 public:
  GrowthLimiter(double slope, BackgroundMesh& mesh)
      : mesh_(mesh),
        tets_of_(cells_of_nodes(mesh.tets, mesh.node_xyz.size())),
        slope_(slope),
        is_lowered_(mesh.node_xyz.size(), 0) {}

  void limit_lengths() {
    lower_all([&](const std::array<std::int32_t, 4>& tet, const auto& lowered) {
      std::array<double, 4> length = lengths_of(mesh_, tet);
      const std::array<double, 4> before = length;
      if (!limit_tet(corners_of(mesh_, tet), slope_, length)) return;
      for (std::size_t k = 0; k < 4; ++k) {
        if (!(length[k] < before[k])) continue;
        mesh_.node_size[tet[k]].length = length[k];
        lowered(tet[k]);
      }
    });
  }

  /// Likewise what is requested along the direction that a tetrahedron's nodes share, and along that of each.
  void limit_along() {
    if (std::none_of(mesh_.node_size.begin(), mesh_.node_size.end(), is_stretched)) return;
    lower_all([&](const std::array<std::int32_t, 4>& tet, const auto& lowered) {
      limit_in(tet, mean_of_nodes(mesh_, tet).direction, lowered);
      for (const std::int32_t node : tet)
        if (is_stretched(mesh_.node_size[node])) limit_in(tet, mesh_.node_size[node].direction, lowered);
    });
  }

  /// All lengths of metrics.
  void limit_metrics() {
    std::vector<std::uint8_t> is_waiting(mesh_.tets.size(), 0);
    constexpr std::size_t kPerPiece = 4096;
    parallel_for(mesh_.tets.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t)
        for_longer_metrics(mesh_.tets[t], [&](std::int32_t, const SymmetricTensor&) { is_waiting[t] = 1; });
    });
    lower(std::move(is_waiting), [&](const std::array<std::int32_t, 4>& tet, const auto& lowered) {
      for_longer_metrics(tet, [&](std::int32_t node, const SymmetricTensor& bound) {
        SymmetricTensor& metric = mesh_.node_metric[node];
        metric = intersection(metric, bound);
        mesh_.node_size[node] = size_of_metric(metric);
        lowered(node);
      });
    });
  }

  std::int64_t n_lowered() const { return std::count(is_lowered_.begin(), is_lowered_.end(), 1); }

 private:
  static bool is_stretched(const LocalSize& s) { return s.along > s.length; }

  template <class Lowered>
  void limit_in(const std::array<std::int32_t, 4>& tet, Vec3 direction, const Lowered& lowered) {
    if (direction == Vec3{}) return;
    std::array<double, 4> length{};
    for (std::size_t k = 0; k < 4; ++k) length[k] = mesh_.node_size[tet[k]].in(direction);
    const std::array<double, 4> before = length;
    if (!limit_tet(corners_of(mesh_, tet), slope_, length)) return;
    for (std::size_t k = 0; k < 4; ++k) {
      LocalSize& size = mesh_.node_size[tet[k]];
      if (!(length[k] < before[k]) || !is_stretched(size)) continue;
      const double along = along_for(size, direction, length[k]);
      if (!(along < (1 - kSlack) * size.along)) continue;
      size.along = along;
      lowered(tet[k]);
    }
  }

  /// Calls found(node, bound) for nodes whose metric is longer than that of another one allows.
  template <class Found>
  void for_longer_metrics(const std::array<std::int32_t, 4>& tet, const Found& found) const {
    constexpr double kMetricSlack = 0.01;  // of a length
    for (const std::int32_t from : tet) {
      std::optional<GrowingMetric> growing;
      for (const std::int32_t node : tet) {
        const double rise = slope_ * distance(mesh_.node_xyz[from], mesh_.node_xyz[node]);
        if (node == from || mesh_.node_size[node].along <= mesh_.node_size[from].length + rise) continue;
        if (!growing) growing.emplace(mesh_.node_metric[from]);
        const SymmetricTensor bound = growing->after(rise);
        if (is_longer(mesh_.node_metric[node], bound, kMetricSlack)) found(node, bound);
      }
    }
  }

  template <class Limit>
  void lower_all(const Limit& limit) {
    lower(std::vector<std::uint8_t>(mesh_.tets.size(), 1), limit);
  }
  /// Calls limit(tet, lowered) until no tetrahedron lowers a node any more, first of those that wait.
  template <class Limit>
  void lower(std::vector<std::uint8_t> is_waiting, const Limit& limit) {
    std::vector<std::int32_t> waiting, next;
    for (std::size_t t = 0; t < is_waiting.size(); ++t)
      if (is_waiting[t]) waiting.push_back(static_cast<std::int32_t>(t));
    const auto lowered = [&](std::int32_t node) {
      is_lowered_[node] = 1;
      for (const std::int32_t other : tets_of_[node])
        if (!is_waiting[other]) {
          is_waiting[other] = 1;
          next.push_back(other);
        }
    };
    for (; !waiting.empty(); waiting.swap(next), next.clear())
      for (const std::int32_t t : waiting) {
        is_waiting[t] = 0;
        limit(mesh_.tets[t], lowered);
      }
  }

  BackgroundMesh& mesh_;
  const ListsByKey<> tets_of_;  // by node
  const double slope_;
  std::vector<std::uint8_t> is_lowered_;  // [nodes]
};

}  // namespace

std::int64_t limit_growth(double slope, BackgroundMesh& mesh) {
  GrowthLimiter limiter(slope, mesh);
  limiter.limit_lengths();
  limiter.limit_along();
  return limiter.n_lowered();
}

std::int64_t limit_metrics(double slope, BackgroundMesh& mesh) {
  GrowthLimiter limiter(slope, mesh);
  limiter.limit_metrics();
  limiter.limit_lengths();
  return limiter.n_lowered();
}

}  // namespace st
