#include "geometry/flite/flite_loops.h"

#include <fmt/format.h>

#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "base/disjoint_sets.h"
#include "base/error.h"

namespace st {
namespace {

using Coedge = FliteTopology::Coedge;
using Loop = FliteTopology::Loop;

constexpr double kSevenDigits = 1e-6;   // two numbers of seven digits each, rounded apart
constexpr double kFinestDigits = 1e-8;  // of the diagonal: near the origin
constexpr double kLargestGap = 0.05;    // of the shorter segment

double polygon_length(const std::vector<Vec3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += distance(points[i - 1], points[i]);
  return length;
}

class TopologyBuilder {
 public:
  TopologyBuilder(const FliteFile& file, const std::string& path)
      : file_(file),
        path_(path),
        diagonal_(flite_box(file).diagonal()),
        sets_(2 * static_cast<std::int64_t>(file.segments.size())) {}

  FliteTopology build() {
    collect_ends();
    merge_close_ends();
    for (std::size_t r = 0; r < file_.regions.size(); ++r) close_gaps(file_.regions[r]);
    number_vertices();
    for (const FliteRegion& region : file_.regions) result_.loops.push_back(chain(region));
    return std::move(result_);
  }

 private:
  /// Ends 2 s and 2 s + 1 of every segment s; those of a point are one.
  void collect_ends() {
    result_.segments.resize(file_.segments.size());
    for (std::size_t s = 0; s < file_.segments.size(); ++s) {
      const std::vector<Vec3>& points = file_.curves[file_.segments[s].curve].points;
      ends_.push_back(points.front());
      ends_.push_back(points.back());
      length_.push_back(polygon_length(points));
      result_.segments[s].is_point = length_.back() <= flite_resolution(points.front(), diagonal_);
    }
  }

  void merge_close_ends() {
    std::vector<int> order(ends_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::pair(ends_[a].x, a) < std::pair(ends_[b].x, b); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const double tolerance = 2 * flite_resolution(ends_[order[i]], diagonal_);
      for (std::size_t k = i + 1; k < order.size() && ends_[order[k]].x <= ends_[order[i]].x + tolerance; ++k)
        if (distance(ends_[order[i]], ends_[order[k]]) <= tolerance) sets_.join(order[i], order[k]);
    }
  }

  /// Ends of a region's segments that meet an odd number of them.
  std::vector<int> loose_ends(const FliteRegion& region) {
    std::map<int, int> last, uses;
    for (const int s : region.segments)
      if (!result_.segments[s].is_point)
        for (const int end : {2 * s, 2 * s + 1}) last[sets_.find(end)] = end, ++uses[sets_.find(end)];
    std::vector<int> loose;
    for (const auto& [vertex, n] : uses)
      if (n % 2 == 1) loose.push_back(last[vertex]);
    return loose;
  }

  void close_gaps(const FliteRegion& region) {
    std::vector<int> loose = loose_ends(region);
    while (loose.size() >= 2) {
      std::size_t best_a = 0, best_b = 1;
      for (std::size_t a = 0; a < loose.size(); ++a)
        for (std::size_t b = a + 1; b < loose.size(); ++b)
          if (gap(loose[a], loose[b]) < gap(loose[best_a], loose[best_b])) best_a = a, best_b = b;
      const int a = loose[best_a], b = loose[best_b];
      if (gap(a, b) > kLargestGap * std::min(length_[a / 2], length_[b / 2])) fail(region, a, gap(a, b));
      sets_.join(a, b);
      loose = loose_ends(region);
    }
  }

  double gap(int a, int b) const { return distance(ends_[a], ends_[b]); }

  [[noreturn]] void fail(const FliteRegion& region, int end, double gap) const {
    const Vec3 p = ends_[end];
    throw Error(ExitCode::kInput,
                fmt::format("{}: line {}: region {}: its segments close no loop: segment {} ends at ({:.6g}, {:.6g}, "
                            "{:.6g}), and the nearest "
                            "other loose end is {:.4g} away; correct the region's list of segments",
                            path_, region.line, region.id, file_.segments[end / 2].id, p.x, p.y, p.z, gap));
  }

  /// Vertices in the order of their first end, each in the middle of its ends.
  void number_vertices() {
    std::map<int, int> number;
    std::vector<int> n_ends;
    for (std::size_t end = 0; end < ends_.size(); ++end) {
      const auto [it, is_new] = number.emplace(sets_.find(static_cast<int>(end)), static_cast<int>(number.size()));
      if (is_new) result_.vertices.emplace_back(), n_ends.push_back(0);
      (end % 2 == 0 ? result_.segments[end / 2].start : result_.segments[end / 2].end) = it->second;
      result_.vertices[it->second] += ends_[end];
      ++n_ends[it->second];
    }
    for (std::size_t v = 0; v < n_ends.size(); ++v) result_.vertices[v] = result_.vertices[v] / n_ends[v];
    result_.vertex_gap.assign(n_ends.size(), 0.0);
    for (std::size_t end = 0; end < ends_.size(); ++end) {
      const int v = number[sets_.find(static_cast<int>(end))];
      result_.vertex_gap[v] = std::max(result_.vertex_gap[v], distance(ends_[end], result_.vertices[v]));
    }
  }

  int head(Coedge c) const {
    return c.is_reversed ? result_.segments[c.segment].end : result_.segments[c.segment].start;
  }
  int tail(Coedge c) const {
    return c.is_reversed ? result_.segments[c.segment].start : result_.segments[c.segment].end;
  }

  /// Walks from end to end; a loop is complete where the walk comes to a vertex it has been at, or, where the region
  /// has a seam, to an end that nothing leaves.
  std::vector<Loop> chain(const FliteRegion& region) const {
    std::vector<int> left;
    for (const int s : region.segments)
      if (!result_.segments[s].is_point) left.push_back(s);
    const bool has_seam = std::set<int>(left.begin(), left.end()).size() < left.size();
    std::vector<Loop> loops;
    Loop walk;
    while (!left.empty()) {
      const auto next = take_next(walk, left);
      if (next) walk.push_back(*next);
      if (!next || !has_seam || left.empty()) cut_off_loop(walk, has_seam, loops);
      if (!next && !walk.empty()) break;
    }
    if (!walk.empty() || loops.empty())
      throw Error(
          ExitCode::kInput,
          fmt::format("{}: line {}: region {}: its segments close no loop; correct the region's list of segments",
                      path_, region.line, region.id));
    return loops;
  }

  /// Moves the end of the walk that is a loop, all of it where it has a seam.
  void cut_off_loop(Loop& walk, bool is_whole, std::vector<Loop>& loops) const {
    for (std::size_t k = 0; k < (is_whole ? 1 : walk.size()); ++k)
      if (head(walk[k]) == tail(walk.back())) {
        loops.emplace_back(walk.begin() + static_cast<std::ptrdiff_t>(k), walk.end());
        walk.resize(k);
        return;
      }
  }

  /// The first segment left at the end of the walk, another one than that just walked where there is a choice; none
  /// where nothing leaves.
  std::optional<Coedge> take_next(const Loop& walk, std::vector<int>& left) const {
    const int at = walk.empty() ? result_.segments[left[0]].start : tail(walk.back());
    int best = -1;
    for (int k = static_cast<int>(left.size()) - 1; k >= 0; --k) {
      const auto& s = result_.segments[left[k]];
      const bool is_back = !walk.empty() && left[k] == walk.back().segment;
      if ((s.start == at || s.end == at) && (best < 0 || !is_back)) best = k;
    }
    if (best < 0) return {};
    const Coedge next{left[best], result_.segments[left[best]].start != at};
    left.erase(left.begin() + best);
    return next;
  }

  const FliteFile& file_;
  const std::string& path_;
  double diagonal_;
  std::vector<Vec3> ends_;
  std::vector<double> length_;  // [segments]
  DisjointSets sets_;           // of ends
  FliteTopology result_;
};

}  // namespace

double flite_resolution(Vec3 p, double diagonal) {
  return std::max(kSevenDigits * std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}), kFinestDigits * diagonal);
}

Box3 flite_box(const FliteFile& file) {
  Box3 box;
  for (const FliteCurve& curve : file.curves)
    for (const Vec3 p : curve.points) box.add(p);
  return box;
}

FliteTopology flite_topology(const FliteFile& file, const std::string& path) {
  return TopologyBuilder(file, path).build();
}

}  // namespace st
