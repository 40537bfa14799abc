#include "meshing/face/row_across.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/predicates.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kMostAcross = 5;          // heights: a node across is looked for
constexpr double kMostLean = radians(35);  // of the way to it
constexpr double kMostAside = 0.2;         // of a quadrilateral's length: how far it may lie aside
constexpr std::size_t kLeastRun = 4;       // edges across, end to end

class AcrossFinder {
 public:
  AcrossFinder(const FaceWork& work, const RowAhead& ahead) : m_(work.mesh), a_(ahead) {}

  std::int32_t across(std::size_t i) const {
    if (a_.line.has_arrived(i)) return a_.line.nodes[i];
    const MeshNode& from = node(i);
    const double reach = kMostAcross * a_.height[i];
    const auto step = tangent_step(from.du, from.dv, reach * a_.across[i]);
    if (!step) return kNone;
    const auto [left, right] = m_.side_met(a_.line.nodes[i], from.p + *step);
    std::int32_t found = kNone;
    double least = kMostAside * least_width(i);
    for (const std::int32_t k : {left, right}) {
      if (k == kNone) continue;
      const Vec3 way = m_.nodes[k].x - from.x;
      const double aside = std::abs(dot(way, a_.along[i]));
      if (!(aside < least && norm(way) < reach && angle_between(way, a_.across[i]) < kMostLean)) continue;
      least = aside;
      found = k;
    }
    return found;
  }

  bool is_edge(std::int32_t a, std::int32_t b) const { return a != kNone && b != kNone && a != b && m_.is_fixed(a, b); }

 private:
  const MeshNode& node(std::size_t i) const { return m_.nodes[a_.line.nodes[i]]; }
  double width(std::size_t i) const { return distance(node(i).x, node(i + 1).x); }
  /// Of the quadrilaterals at a column.
  double least_width(std::size_t i) const {
    double least = std::numeric_limits<double>::max();
    if (i > 0 && a_.joined[i - 1]) least = width(i - 1);
    return i < a_.joined.size() && a_.joined[i] ? std::min(least, width(i)) : least;
  }

  const Triangulation& m_;
  const RowAhead& a_;
};

}  // namespace

void find_across(const FaceWork& work, const RowAhead& ahead, std::size_t first, std::size_t last,
                 std::vector<std::int32_t>& nodes) {
  const AcrossFinder finder(work, ahead);
  for (std::size_t i = first; i <= last; ++i) nodes[i] = finder.across(i);
  for (std::size_t from = first, i = first; i <= last; ++i) {
    if (i < last && finder.is_edge(nodes[i], nodes[i + 1])) continue;
    bool is_run = i - from >= kLeastRun;
    for (std::size_t k = from; k <= i; ++k) is_run |= ahead.line.has_arrived(k);
    if (!is_run) std::fill_n(nodes.begin() + static_cast<std::ptrdiff_t>(from), i + 1 - from, kNone);
    from = i + 1;
  }
}

}  // namespace st
