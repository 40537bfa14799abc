#include "meshing/face/row_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kFlattest = 0.7;                  // length over height of a quadrilateral
constexpr double kShortest = 0.7, kLongest = 1.4;  // of the requested length: means of opposite sides
constexpr double kLeastColumns = 0.9;              // share of the columns that fit

/// One of the four sides: its points in the plane, and the shares of its way there, in space.
struct SidePoints {
  std::vector<Vec2> p;
  std::vector<double> share{0};

  SidePoints(const FaceWork& work, const std::vector<std::int32_t>& side) {
    const std::vector<MeshNode>& nodes = work.mesh.nodes;
    for (const std::int32_t n : side) p.push_back(nodes[n].p);
    for (std::size_t i = 1; i < side.size(); ++i)
      share.push_back(share.back() + distance(nodes[side[i - 1]].x, nodes[side[i]].x));
    for (double& s : share) s /= share.back();
  }
};

class Mapping {
 public:
  Mapping(FaceWork& work, const RowChain& chain)
      : w_(work),
        c_(chain),
        bottom_(work, chain.bottom),
        top_(work, chain.top),
        left_(work, chain.left),
        right_(work, chain.right) {}

  std::vector<NextLine> run() {
    std::vector<NextLine> lines;
    std::vector<char> joined(bottom_.p.size() - 1, 1);
    for (std::size_t k = 1; k < left_.p.size(); ++k) {
      lines.push_back(line_at(k));
      for (std::size_t i = 0; i < joined.size(); ++i) joined[i] = joined[i] && is_good(lines, k, i);
    }
    const auto n = static_cast<double>(std::count(joined.begin(), joined.end(), 1));
    if (n < kLeastColumns * static_cast<double>(joined.size())) return {};
    for (NextLine& line : lines) line.joined = joined;
    return lines;
  }

 private:
  NextLine line_at(std::size_t k) {
    NextLine line;
    line.columns.resize(bottom_.p.size());
    for (std::size_t i = 0; i < bottom_.p.size(); ++i) {
      NextLine::Column& column = line.columns[i];
      column.is_placed = true;
      column.existing = existing_at(i, k);
      if (column.existing != kNone) {
        column.node = w_.mesh.nodes[column.existing];
        continue;
      }
      column.node.p = between(i, k);
      w_.evaluate(column.node);
      w_.ask_sizes(column.node);
    }
    return line;
  }

  std::int32_t existing_at(std::size_t i, std::size_t k) const {
    if (k + 1 == left_.p.size()) return c_.top[i];
    if (i == 0) return c_.left[k];
    return i + 1 == bottom_.p.size() ? c_.right[k] : kNone;
  }

  Vec2 between(std::size_t i, std::size_t k) const {
    const double up = left_.share[k] + 0.5 * (bottom_.share[i] + top_.share[i]) * (right_.share[k] - left_.share[k]);
    const double s = bottom_.share[i] + up * (top_.share[i] - bottom_.share[i]);
    const double t = left_.share[k] + s * (right_.share[k] - left_.share[k]);
    const Vec2 corners = (1 - t) * ((1 - s) * bottom_.p.front() + s * bottom_.p.back()) +
                         t * ((1 - s) * top_.p.front() + s * top_.p.back());
    return (1 - t) * bottom_.p[i] + t * top_.p[i] + (1 - s) * left_.p[k] + s * right_.p[k] - corners;
  }

  bool is_good(const std::vector<NextLine>& lines, std::size_t k, std::size_t i) {
    const auto node = [&](std::size_t row, std::size_t column) -> const MeshNode& {
      return row == 0 ? w_.mesh.nodes[c_.bottom[column]] : lines[row - 1].columns[column].node;
    };
    const MeshNode &a = node(k - 1, i), &b = node(k - 1, i + 1), &c = node(k, i + 1), &d = node(k, i);
    const double length = distance(a.x, b.x) + distance(c.x, d.x), height = distance(a.x, d.x) + distance(b.x, c.x);
    return length > kFlattest * height && is_upright(a, b, c, d) &&
           dot(a.normal, c.normal) > std::cos(w_.max_turning) && is_asked(a, b, c, d, 0.5 * length, 0.5 * height);
  }

  /// Whether its mean length and height are what the field asks for at its middle, and not oblique to that.
  bool is_asked(const MeshNode& a, const MeshNode& b, const MeshNode& c, const MeshNode& d, double length,
                double height) {
    const LocalSize local = w_.field->local_on(0.25 * (a.x + b.x + c.x + d.x), a.normal, w_.hint);
    const auto fits = [&](double own, Vec3 way) {
      const double asked = local.in(way);
      return own >= kShortest * asked && own <= kLongest * asked;
    };
    const Vec3 along = b.x - a.x + c.x - d.x, up = d.x - a.x + c.x - b.x;
    return fits(length, along) && fits(height, up) && !is_oblique(*w_.field, local, along, up);
  }

  FaceWork& w_;
  const RowChain& c_;
  SidePoints bottom_, top_, left_, right_;
};

}  // namespace

std::vector<NextLine> mapped_lines(FaceWork& work, const RowChain& chain) {
  if (chain.bottom.size() < 4 || chain.bottom.size() != chain.top.size() || chain.left.size() < 2) return {};
  if (chain.left.size() != chain.right.size()) return {};
  return Mapping(work, chain).run();
}

}  // namespace st
