#include "meshing/face/row_chains.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kLongSegment = 2;         // over the length across: such segments begin a chain
constexpr double kAlong = 0.8;             // cosine between a segment and the direction of a stretch
constexpr double kStraight = radians(30);  // a loop that turns by less goes on; to the left by more: it bounds the rows
constexpr std::size_t kShortRest = 3;      // segments: what is left up to a corner belongs to the chain
constexpr std::size_t kLeastSegments = 2;  // of a chain

class ChainFinder {
 public:
  explicit ChainFinder(const FaceWork& work) : nodes_(work.mesh.nodes) {
    const auto n = static_cast<std::size_t>(work.mesh.n_boundary);
    next_.assign(n, kNone);
    previous_.assign(n, kNone);
    std::vector<int> leaving(n, 0), arriving(n, 0);
    for (const auto& [a, b] : work.segments) {
      next_[a] = b;
      previous_[b] = a;
      ++leaving[a];
      ++arriving[b];
    }
    for (std::size_t i = 0; i < n; ++i)  // loops that touch, poles
      if (leaving[i] != 1 || arriving[i] != 1 || nodes_[i].is_pole) next_[i] = previous_[i] = kNone;
    for (std::size_t i = 0; i < n; ++i) {
      if (next_[i] != kNone && previous_[next_[i]] == kNone) next_[i] = kNone;
      if (previous_[i] != kNone && next_[previous_[i]] == kNone) previous_[i] = kNone;
    }
  }

  std::vector<RowChain> run() {
    std::vector<RowChain> chains;
    is_taken_.assign(next_.size(), 0);
    for (std::size_t i = 0; i < next_.size(); ++i) {
      const auto first = static_cast<std::int32_t>(i);
      if (is_taken_[i] || !is_long(first)) continue;
      RowChain chain = chain_from(first);
      if (chain.nodes.size() > kLeastSegments) chains.push_back(std::move(chain));
    }
    return chains;
  }

 private:
  /// Is the segment that leaves the node long, along a stretch?
  bool is_long(std::int32_t a) const {
    const std::int32_t b = next_[a];
    if (b == kNone) return false;
    const Vec3 d = nodes_[b].x - nodes_[a].x;
    const double length = norm(d);
    if (!(length > kLongSegment * 0.5 * (nodes_[a].request + nodes_[b].request))) return false;
    const auto is_along = [&](const MeshNode& n) {
      return std::abs(dot(d, n.squeeze)) > kAlong * length * norm(n.squeeze);
    };
    return (is_stretched(nodes_[a]) && is_along(nodes_[a])) || (is_stretched(nodes_[b]) && is_along(nodes_[b]));
  }

  double turning_at(std::int32_t n) const {
    const MeshNode& node = nodes_[n];
    return turning(node.x - nodes_[previous_[n]].x, nodes_[next_[n]].x - node.x, node.normal);
  }
  bool has_both(std::int32_t n) const { return next_[n] != kNone && previous_[n] != kNone; }
  bool goes_on(std::int32_t n) const { return has_both(n) && std::abs(turning_at(n)) < kStraight; }
  bool turns_to_side(std::int32_t n) const { return has_both(n) && turning_at(n) >= kStraight; }

  /// All nodes from `n` on, along `step`, up to where `ends` says so, that one with them; no longer than a loop.
  template <typename Ends>
  std::vector<std::int32_t> walk(std::int32_t n, const std::vector<std::int32_t>& step, const Ends& ends) const {
    std::vector<std::int32_t> way{n};
    while (way.size() < next_.size() && step[way.back()] != kNone && step[way.back()] != n) {
      way.push_back(step[way.back()]);
      if (ends(way.back())) break;
    }
    return way;
  }

  RowChain chain_from(std::int32_t seed) {
    const auto end_forward = [&](std::int32_t n) { return !goes_on(n) || !is_long(n); };
    const auto end_back = [&](std::int32_t n) { return !goes_on(n) || !is_long(previous_[n]); };
    std::vector<std::int32_t> forward = walk(seed, next_, end_forward);
    std::vector<std::int32_t> back =
        goes_on(seed) && is_long(previous_[seed]) ? walk(seed, previous_, end_back) : std::vector<std::int32_t>{seed};
    extend(forward, next_);
    extend(back, previous_);
    RowChain chain;
    chain.nodes.assign(back.rbegin(), back.rend());
    chain.is_closed = forward.back() == previous_[seed] && goes_on(seed) && goes_on(forward.back());
    if (chain.is_closed) chain.nodes = {seed};
    chain.nodes.insert(chain.nodes.end(), forward.begin() + 1, forward.end());
    for (const std::int32_t n : chain.nodes) is_taken_[n] = 1;
    if (chain.is_closed) {
      chain.nodes.push_back(seed);
      return chain;
    }
    is_taken_[chain.nodes.back()] = 0;  // another chain may begin there
    const auto ends_side = [&](std::int32_t n) { return !goes_on(n); };
    if (turns_to_side(chain.nodes.front())) chain.before = walk(chain.nodes.front(), previous_, ends_side);
    if (turns_to_side(chain.nodes.back())) chain.after = walk(chain.nodes.back(), next_, ends_side);
    find_four_sides(chain);
    return chain;
  }

  void find_four_sides(RowChain& chain) const {
    const auto is_corner = [&](std::int32_t n) { return !goes_on(n); };
    const auto after = [&](const std::vector<std::int32_t>& side) { return walk(side.back(), next_, is_corner); };
    std::vector<std::int32_t> bottom = walk(chain.nodes.front(), next_, is_corner);
    if (!is_corner(chain.nodes.front())) {
      const std::vector<std::int32_t> back = walk(chain.nodes.front(), previous_, is_corner);
      bottom.insert(bottom.begin(), back.rbegin(), back.rend() - 1);
    }
    std::vector<std::int32_t> right = after(bottom), top = after(right), left;
    if (top.back() == bottom.front() && !make_four(bottom, right, top, left)) return;
    if (left.empty()) left = after(top);
    if (left.back() != bottom.front() || top.size() < 2 || left.size() + right.size() < 3) return;
    std::reverse(top.begin(), top.end());
    std::reverse(left.begin(), left.end());
    chain.bottom = std::move(bottom);
    chain.right = std::move(right);
    chain.top = std::move(top);
    chain.left = std::move(left);
  }

  /// A wedge has three sides: at its apex, between two of as many nodes, the fourth is that node alone.
  static bool make_four(const std::vector<std::int32_t>& bottom, std::vector<std::int32_t>& right,
                        std::vector<std::int32_t>& top, std::vector<std::int32_t>& left) {
    if (top.size() == bottom.size() && right.size() < bottom.size()) {
      left = {bottom.front()};
      return true;
    }
    if (right.size() != bottom.size() || top.size() >= bottom.size()) return false;
    left = std::exchange(top, std::exchange(right, {bottom.back()}));
    return true;
  }

  /// The short rest up to a corner.
  void extend(std::vector<std::int32_t>& way, const std::vector<std::int32_t>& step) const {
    std::vector<std::int32_t> rest;
    std::int32_t n = way.back();
    while (goes_on(n) && rest.size() < kShortRest) rest.push_back(n = step[n]);
    if (!goes_on(n)) way.insert(way.end(), rest.begin(), rest.end());
  }

  const std::vector<MeshNode>& nodes_;
  std::vector<std::int32_t> next_, previous_;  // along the loops; kNone where that is not one node
  std::vector<char> is_taken_;
};

}  // namespace

double turning(Vec3 first, Vec3 second, Vec3 normal) {
  return std::atan2(dot(cross(first, second), normal), dot(first, second));
}

std::vector<RowChain> find_row_chains(const FaceWork& work) { return ChainFinder(work).run(); }

}  // namespace st
