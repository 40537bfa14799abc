#include "meshing/face/row_ladder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/predicates.h"
#include "meshing/face/row_layer.h"
#include "meshing/face/row_line.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kNarrow = 2;                   // segments: wider columns are left to others
constexpr double kMostNarrow = 0.5;             // share of the columns
constexpr double kLargestAngle = radians(130);  // of a triangle
constexpr int kSteps = 16;                      // along a column, where sizes are asked for
constexpr double kMostRows = 100;

class Ladder {
 public:
  Ladder(FaceWork& work, const RowChain& chain) : w_(work), c_(chain) {}

  bool run() {
    std::size_t n_narrow = 0;
    for (std::size_t i = 0; i < n(); ++i) n_narrow += is_narrow(i);
    if (static_cast<double>(n_narrow) < kMostNarrow * static_cast<double>(n())) return false;
    for (std::size_t i = 0; i < n(); ++i) columns_.push_back(is_narrow(i) ? column(i) : Column{});
    for (std::size_t i = 0; i + 1 < n(); ++i)
      if (!columns_[i].empty() && !columns_[i + 1].empty()) lay(columns_[i], columns_[i + 1]);
    return true;
  }

 private:
  using Column = std::vector<std::int32_t>;  // nodes from the bottom to the top; empty: none

  std::size_t n() const { return c_.bottom.size(); }
  const MeshNode& node(std::int32_t i) const { return w_.mesh.nodes[i]; }
  Vec3 x(std::int32_t i) const { return node(i).x; }

  /// Of the segments beside a column, the shorter one.
  double segment(std::size_t i) const {
    const auto length = [&](std::size_t k) {
      return std::min(distance(x(c_.bottom[k]), x(c_.bottom[k + 1])), distance(x(c_.top[k]), x(c_.top[k + 1])));
    };
    if (i == 0) return length(0);
    return i + 1 == n() ? length(i - 1) : std::min(length(i - 1), length(i));
  }
  /// Through space and over the surface: both sides of a face around a nose are near each other.
  bool is_narrow(std::size_t i) const {
    const double most = kNarrow * segment(i);
    return distance(x(c_.bottom[i]), x(c_.top[i])) < most && way_over(c_.bottom[i], c_.top[i]) < most && !is_askew(i);
  }
  /// To metrics.
  bool is_askew(std::size_t i) const {
    const MeshNode& foot = node(c_.bottom[i]);
    const std::size_t k = std::min(i, n() - 2);
    return is_oblique(*w_.field, w_.field->local_on(foot.x, foot.normal, w_.hint),
                      x(c_.bottom[k + 1]) - x(c_.bottom[k]), x(c_.top[i]) - foot.x);
  }
  double way_over(std::int32_t from, std::int32_t to) const {
    double way = 0;
    MeshNode last = node(from), p;
    for (int k = 1; k <= kSteps; ++k) {
      p.p = node(from).p + static_cast<double>(k) / kSteps * (node(to).p - node(from).p);
      w_.evaluate(p);
      way += distance(p.x, last.x);
      last = p;
    }
    return way;
  }

  Column column(std::size_t i) {
    if (i == 0) return c_.left;
    if (i + 1 == n()) return c_.right;
    Column column{c_.bottom[i]};
    const std::vector<MeshNode> places = places_between(c_.bottom[i], c_.top[i]);
    for (const MeshNode& p : places) {
      const double height = distance(p.x, x(column.back()));
      column.push_back(layer_.insert(p, column.back()));
      if (column.back() == kNone) return {};
      layer_.settle(column.back(), height, segment(i));
    }
    column.push_back(c_.top[i]);
    return column;
  }

  /// At equal shares of the lengths that are asked for.
  std::vector<MeshNode> places_between(std::int32_t from, std::int32_t to) {
    const Vec2 a = node(from).p, b = node(to).p;
    std::vector<double> rows{0};
    Vec3 last = x(from);
    for (int k = 1; k <= kSteps; ++k) {
      MeshNode p;
      p.p = a + static_cast<double>(k) / kSteps * (b - a);
      w_.evaluate(p);
      const Vec3 way = p.x - last;
      rows.push_back(rows.back() + norm(way) / w_.field->length_along(0.5 * (p.x + last), way, w_.hint));
      last = p.x;
    }
    const double n_rows = std::max(1.0, std::round(std::min(rows.back(), kMostRows)));
    std::vector<MeshNode> places;
    std::size_t k = 1;
    for (double row = 1; row < n_rows; ++row) {
      const double wanted = row / n_rows * rows.back();
      while (k + 1 < rows.size() && rows[k] < wanted) ++k;
      MeshNode p;
      const double step = static_cast<double>(k - 1) + (wanted - rows[k - 1]) / (rows[k] - rows[k - 1]);
      p.p = a + step / kSteps * (b - a);
      w_.evaluate(p);
      w_.ask_sizes(p);
      places.push_back(p);
    }
    return places;
  }

  /// Between neighbouring columns, by the shorter diagonals.
  void lay(const Column& a, const Column& b) {
    std::vector<std::array<std::int32_t, 3>> corners;
    for (std::size_t i = 0, k = 0; i + 1 < a.size() || k + 1 < b.size();) {
      const bool is_left =
          k + 1 == b.size() || (i + 1 < a.size() && distance(x(a[i + 1]), x(b[k])) <= distance(x(a[i]), x(b[k + 1])));
      corners.push_back({a[i], b[k], is_left ? a[i + 1] : b[k + 1]});
      ++(is_left ? i : k);
    }
    if (std::all_of(corners.begin(), corners.end(), [&](const auto& c) { return is_fair(c); })) layer_.lay(corners);
  }

  bool is_fair(const std::array<std::int32_t, 3>& c) const {
    if (orient2d(node(c[0]).p, node(c[1]).p, node(c[2]).p) <= 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t here = c[k], next = c[(k + 1) % 3], last = c[(k + 2) % 3];
      if (angle_between(x(next) - x(here), x(last) - x(here)) > kLargestAngle) return false;
      if (angle_between(node(here).normal, node(next).normal) > w_.max_turning) return false;
    }
    return true;
  }

  FaceWork& w_;
  const RowChain& c_;
  RowLayer layer_{w_};
  std::vector<Column> columns_;
};

}  // namespace

bool lay_ladder(FaceWork& work, const RowChain& chain) {
  if (chain.bottom.size() < 3 || chain.bottom.size() != chain.top.size()) return false;
  return Ladder(work, chain).run();
}

}  // namespace st
