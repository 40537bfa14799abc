#include "meshing/face/row_blocks.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "meshing/face/ridge_lines.h"
#include "meshing/face/row_chains.h"
#include "meshing/face/row_ladder.h"
#include "meshing/face/row_layer.h"
#include "meshing/face/stretch.h"

namespace st {
namespace {

constexpr double kEven = 1.0001;  // diagonals that are as long: always the same one; docs/design/heuristics.md

using Side = std::pair<std::int32_t, std::int32_t>;

/// Of a boundary node: rows begin there, or end there at their side.
enum Use : char { kFree, kChain, kLine };

/// The rows along one chain.
class RowBlock {
 public:
  RowBlock(FaceWork& work, RowChain chain, std::vector<Use>& is_used)
      : w_(work), m_(work.mesh), chain_(std::move(chain)), is_used_(is_used) {
    line_.nodes = chain_.nodes;
    line_.joined.assign(line_.nodes.size() - 1, 1);
    line_.lowest.assign(line_.nodes.size(), 0);
    line_.highest = line_.lowest;
    line_.is_closed = chain_.is_closed;
    is_inside_ = chain_.nodes.front() >= m_.n_boundary;
    for (const std::int32_t n : chain_.nodes)
      if (!is_inside_) is_used_[n] = kChain;
    height_ = w_.mesh.nodes[chain_.nodes[chain_.nodes.size() / 2]].request;
  }

  /// All rows of a narrow face up to the side across; false: none.
  bool lay_columns() {
    if (is_top_laid() || !lay_ladder(w_, chain_)) return false;
    for (const auto* side : {&chain_.bottom, &chain_.top})
      for (const std::int32_t n : *side) is_used_[n] = kLine;
    line_.joined.assign(line_.joined.size(), 0);
    return true;
  }

  /// One row more; false where there is none.
  bool grow() {
    const RowSides sides = find_sides();
    if (is_exhausted_) return false;
    NextLine next = next_line(w_, line_, sides);
    if (std::none_of(next.joined.begin(), next.joined.end(), [](char j) { return j; })) return false;
    insert(next);
    for (std::size_t i = 0; i < next.joined.size(); ++i)
      next.joined[i] = line_.joined[i] && is_whole(next, i) && force(i, next);
    advance(next);
    return std::any_of(line_.joined.begin(), line_.joined.end(), [](char j) { return j; });
  }

  /// Of the last row.
  double height() const { return height_; }

  /// Edges of the lines behind which no row lies.
  void add_ends(std::vector<Side>& sides) const {
    sides.insert(sides.end(), ended_.begin(), ended_.end());
    for (std::size_t i = 0; (n_rows_ > 0 || is_inside_) && i < line_.joined.size(); ++i)
      if (line_.joined[i]) sides.push_back({line_.nodes[i], line_.nodes[i + 1]});
  }

 private:
  bool is_top_laid() const {
    for (std::size_t i = 1; i < chain_.top.size(); ++i)
      if (const std::int32_t t = m_.left_of(chain_.top[i], chain_.top[i - 1]).first;
          t != kNone && m_.triangles[t].state == kLaid)
        return true;
    return false;
  }

  static bool is_whole(const NextLine& next, std::size_t i) {
    return next.joined[i] && next.columns[i].existing != kNone && next.columns[i + 1].existing != kNone;
  }

  RowSides find_sides() {
    RowSides sides;
    const auto next_of = [&](const std::vector<std::int32_t>& way, std::int32_t now) {
      if (n_rows_ + 1 >= way.size() || way[n_rows_] != now) return kNone;
      return way[n_rows_ + 1];
    };
    sides.first = next_of(chain_.before, line_.nodes.front());
    sides.last = next_of(chain_.after, line_.nodes.back());
    for (std::int32_t* n : {&sides.first, &sides.last}) {
      if (*n == kNone) continue;
      is_exhausted_ |= is_used_[*n] == kLine;
      if (is_used_[*n] == kChain) *n = kNone;  // other rows begin there
    }
    return sides;
  }

  /// The nodes of every column of the line.
  void insert(NextLine& next) {
    for (std::size_t i = 0; i < next.columns.size(); ++i) {
      NextLine::Column& c = next.columns[i];
      if (line_.nodes[i] == kNone) continue;
      const bool is_wanted = (i > 0 && next.joined[i - 1]) || (i < next.joined.size() && next.joined[i]) ||
                             (line_.is_closed && i == 0 && next.joined.back());
      if (!is_wanted || c.existing != kNone) continue;
      if (line_.is_closed && i + 1 == next.columns.size()) {
        c.existing = next.columns[0].existing;
        continue;
      }
      c.existing = layer_.insert(c.node, line_.nodes[i]);
    }
  }

  /// The quadrilateral a, b, d, c between columns i and i+1, cut by its shorter diagonal, which metrics measure.
  bool force(std::size_t i, const NextLine& next) {
    const std::int32_t a = line_.nodes[i], b = line_.nodes[i + 1];
    const std::int32_t c = next.columns[i].existing, d = next.columns[i + 1].existing;
    const auto length = [&](std::int32_t from, std::int32_t to) {
      return std::sqrt(length2(x(to) - x(from), m_.nodes[c], m_.nodes[d]));
    };
    if (a == c) return layer_.lay({{a, b, d}});
    if (b == d) return layer_.lay({{a, b, c}});
    if (length(a, d) <= kEven * length(b, c)) return layer_.lay({{a, b, d}, {d, c, a}});
    return layer_.lay({{a, b, c}, {d, c, b}});
  }
  Vec3 x(std::int32_t n) const { return m_.nodes[n].x; }

  /// `next` becomes the line.
  void advance(const NextLine& next) {
    ++n_rows_;
    double sum = 0;
    std::size_t n = 0;
    const std::size_t n_columns = next.columns.size();
    RowLine line{std::vector<std::int32_t>(n_columns, kNone),
                 std::vector<double>(n_columns, 0),
                 std::vector<double>(n_columns, 0),
                 next.joined,
                 line_.is_closed,
                 std::vector<char>(n_columns, 0),
                 std::vector<LocalSize>(n_columns)};
    for (std::size_t i = 0; i < next.joined.size(); ++i) {
      if (!next.joined[i]) continue;
      for (const std::size_t k : {i, i + 1}) {
        line.nodes[k] = next.columns[k].existing;
        line.arrived[k] = next.columns[k].is_across;
        line.asked[k] = next.columns[k].asked;
        const double height = distance(x(line_.nodes[k]), x(line.nodes[k]));
        settle(line.nodes[k], height, distance(x(next.columns[i].existing), x(next.columns[i + 1].existing)));
        const double lowest = line_.lowest[k];
        const bool is_lowest = lowest == 0 || height < lowest;
        line.lowest[k] = is_lowest ? height : lowest;
        line.highest[k] = is_lowest ? height : std::max(line_.highest[k], height);
        sum += height;
        ++n;
      }
    }
    for (std::size_t i = 0; i < next.joined.size(); ++i)
      if (line_.joined[i] && !next.joined[i] && n_rows_ > 1) ended_.push_back({line_.nodes[i], line_.nodes[i + 1]});
    if (n > 0) height_ = sum / static_cast<double>(n);
    line_ = std::move(line);
    open_at_gap(line_);
  }

  /// A node of a row stays. Its lengths are those that were laid, so that the front goes on from them.
  void settle(std::int32_t n, double height, double width) {
    if (n < m_.n_boundary)
      is_used_[n] = kLine;
    else if (!m_.nodes[n].is_laid)
      layer_.settle(n, height, width);
  }

  FaceWork& w_;
  Triangulation& m_;
  RowLayer layer_{w_};
  RowChain chain_;
  std::vector<Use>& is_used_;  // [boundary nodes]
  RowLine line_;
  std::vector<Side> ended_;
  std::size_t n_rows_ = 0;
  double height_ = 0;
  bool is_exhausted_ = false;
  bool is_inside_ = false;  // the chain is no part of a loop
};

RowChain chain_inside(const std::vector<std::int32_t>& nodes) {
  RowChain chain;
  chain.nodes = nodes;
  return chain;
}

}  // namespace

void open_at_gap(RowLine& line) {
  const auto gap = std::find(line.joined.begin(), line.joined.end(), 0);
  if (!line.is_closed || gap == line.joined.end()) return;
  line.is_closed = false;
  const auto for_columns = [&](const auto& change) {
    const auto change_known = [&](auto& of_columns) {
      if (!of_columns.empty()) change(of_columns);
    };
    change_known(line.nodes), change_known(line.arrived), change_known(line.asked);
    change_known(line.lowest), change_known(line.highest);
  };
  if (line.nodes.front() == kNone) for_columns([](auto& of_columns) { of_columns.front() = of_columns.back(); });
  for_columns([](auto& of_columns) { of_columns.pop_back(); });
  const auto begin_at = [n = gap - line.joined.begin() + 1](auto& of_columns) {
    std::rotate(of_columns.begin(), of_columns.begin() + n % std::ssize(of_columns), of_columns.end());
  };
  for_columns(begin_at);
  begin_at(line.joined);
  line.joined.pop_back();  // the gap
}

std::vector<Side> lay_row_blocks(FaceWork& work) {
  std::vector<Use> is_used(work.mesh.n_boundary, kFree);
  std::vector<RowBlock> blocks;
  for (RowChain& chain : find_row_chains(work)) blocks.emplace_back(work, std::move(chain), is_used);
  for (std::vector<std::int32_t>& line : lay_ridges(work))
    for (int side = 0; side < 2; ++side) {
      blocks.emplace_back(work, chain_inside(line), is_used);
      std::reverse(line.begin(), line.end());
    }
  std::priority_queue<std::pair<double, std::int32_t>> queue;  // minus height, minus block: the finest first
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (!blocks[i].lay_columns()) queue.push({-blocks[i].height(), -static_cast<std::int32_t>(i)});
  while (!queue.empty()) {
    const std::int32_t i = -queue.top().second;
    queue.pop();
    if (blocks[i].grow()) queue.push({-blocks[i].height(), -i});
  }
  std::vector<Side> ends;
  for (const RowBlock& b : blocks) b.add_ends(ends);
  return ends;
}

}  // namespace st
