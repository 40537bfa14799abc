#include "meshing/face/row_ladder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/predicates.h"
#include "meshing/face/row_layer.h"
#include "meshing/face/row_shape.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kNarrow = 2;                   // segments: wider columns are left to others,
constexpr double kNarrowFlat = 6;               // if they are straight, and their rows are longer than high
constexpr double kStraight = 0.95;              // of the way over the surface, through space
constexpr double kLong = 1.5;                   // length over height of a row
constexpr double kMostNarrow = 0.5;             // share of the columns
constexpr double kLargestAngle = radians(130);  // of a triangle
constexpr int kSteps = 32;                      // along a column, where sizes are asked for
constexpr double kMostRows = 200;
constexpr double kKeepsRows = 0.75;  // by so many rows the sizes may differ from what the column before has

class Ladder {
 public:
  Ladder(FaceWork& work, const RowChain& chain) : w_(work), c_(chain) {}

  bool run() {
    std::size_t n_narrow = 0;
    for (std::size_t i = 0; i < n(); ++i) n_narrow += is_narrow(i);
    if (static_cast<double>(n_narrow) < kMostNarrow * static_cast<double>(n())) return false;
    ways_.resize(n());
    for (std::size_t i = 1; i + 1 < n(); ++i)
      if (is_narrow(i)) ways_[i] = way_over_rows(c_.bottom[i], c_.top[i]);
    const std::vector<int> n_rows = even_rows();
    for (std::size_t i = 0; i < n(); ++i) columns_.push_back(is_narrow(i) ? column(i, n_rows[i]) : Column{});
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
    const double through = distance(x(c_.bottom[i]), x(c_.top[i])), own = segment(i);
    if (!(through < kNarrowFlat * own) || is_askew(i)) return false;
    const double over = way_over(c_.bottom[i], c_.top[i]);
    if (std::max(over, through) < kNarrow * own) return true;
    return over < kNarrowFlat * own && through > kStraight * over && kLong * largest_height(i) < own;
  }
  double largest_height(std::size_t i) const {
    const Vec3 foot = x(c_.bottom[i]), way = x(c_.top[i]) - foot;
    double largest = 0;
    for (int k = 0; k <= kSteps; ++k) {
      const Vec3 at = foot + static_cast<double>(k) / kSteps * way;
      largest = std::max(largest, w_.field->length_along(at, way, w_.hint));
    }
    return largest;
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

  /// Up to equal shares of a column's way in the plane: the rows that the sizes ask for.
  std::vector<double> way_over_rows(std::int32_t from, std::int32_t to) {
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
    return rows;
  }

  /// Rows of each column: as many as before, where the sizes do not ask for others.
  std::vector<int> even_rows() const {
    std::vector<int> n_rows(n(), 0);
    double now = static_cast<double>(c_.left.size()) - 1;
    for (std::size_t i = 1; i + 1 < n(); ++i) {
      if (ways_[i].empty()) continue;
      const double asked = std::clamp(ways_[i].back(), 1.0, kMostRows);
      if (std::abs(asked - now) > kKeepsRows) now = std::round(asked);
      n_rows[i] = static_cast<int>(now);
    }
    return n_rows;
  }

  Column column(std::size_t i, int n_rows) {
    if (i == 0) return c_.left;
    if (i + 1 == n()) return c_.right;
    Column column{c_.bottom[i]};
    for (const MeshNode& p : places_between(c_.bottom[i], c_.top[i], ways_[i], n_rows)) {
      const double height = distance(p.x, x(column.back()));
      column.push_back(layer_.insert(p, column.back()));
      if (column.back() == kNone) return {};
      layer_.settle(column.back(), height, segment(i));
    }
    column.push_back(c_.top[i]);
    return column;
  }

  /// At equal shares of the rows that are asked for.
  std::vector<MeshNode> places_between(std::int32_t from, std::int32_t to, const std::vector<double>& rows,
                                       int n_rows) {
    std::vector<MeshNode> places;
    std::size_t k = 1;
    for (int row = 1; row < n_rows; ++row) {
      const double wanted = static_cast<double>(row) / n_rows * rows.back();
      while (k + 1 < rows.size() && rows[k] < wanted) ++k;
      MeshNode p;
      const double step = static_cast<double>(k - 1) + (wanted - rows[k - 1]) / (rows[k] - rows[k - 1]);
      p.p = node(from).p + step / kSteps * (node(to).p - node(from).p);
      w_.evaluate(p);
      w_.ask_sizes(p);
      places.push_back(p);
    }
    return places;
  }

  /// Between neighbouring columns, row for row; by the shorter diagonals where that makes obtuse angles.
  void lay(const Column& a, const Column& b) {
    const auto share = [](const Column& c, std::size_t i) {
      return static_cast<double>(2 * i + 1) / static_cast<double>(c.size() - 1);
    };
    const auto length = [&](std::int32_t from, std::int32_t to) {  // squared; metrics measure it
      const Vec3 way = x(to) - x(from);
      return w_.field->has_metrics() ? length2(way, node(from), node(to)) : dot(way, way);
    };
    const auto shorter = [&](std::size_t i, std::size_t k) { return length(a[i + 1], b[k]) <= length(a[i], b[k + 1]); };
    const auto in_step = [&](std::size_t i, std::size_t k) {
      const double way = share(a, i) - share(b, k);
      return std::abs(way) > 1e-9 ? way < 0 : shorter(i, k);
    };
    if (!lay(a, b, in_step)) lay(a, b, shorter);
  }

  /// `is_first`: the next triangle has a side of `a`.
  template <typename IsFirst>
  bool lay(const Column& a, const Column& b, const IsFirst& is_first) {
    std::vector<std::array<std::int32_t, 3>> corners;
    for (std::size_t i = 0, k = 0; i + 1 < a.size() || k + 1 < b.size();) {
      const bool is_left = k + 1 == b.size() || (i + 1 < a.size() && is_first(i, k));
      corners.push_back({a[i], b[k], is_left ? a[i + 1] : b[k + 1]});
      ++(is_left ? i : k);
    }
    return std::all_of(corners.begin(), corners.end(), [&](const auto& c) { return is_fair(c); }) &&
           layer_.lay(corners);
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
  std::vector<std::vector<double>> ways_;  // [columns] rows asked for up to equal shares; empty: it has its nodes
  std::vector<Column> columns_;
};

}  // namespace

bool lay_ladder(FaceWork& work, const RowChain& chain) {
  if (chain.bottom.size() < 3 || chain.bottom.size() != chain.top.size()) return false;
  return Ladder(work, chain).run();
}

}  // namespace st
