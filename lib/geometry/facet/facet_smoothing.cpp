#include "geometry/facet/facet_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/lists_by_key.h"
#include "base/threads.h"
#include "geometry/shape/known_neighbours.h"

namespace st {
namespace {

constexpr int kRounds = 20;              // of the filter
constexpr double kEdge = 0.5;            // cosine: facets that turn by 60 degrees do not count for each other
constexpr double kCorner = 0.7;          // cosine: a line that turns by 45 degrees has a corner there
constexpr double kUpright = 0.5;         // cosine to the normal that is aimed at: below, a facet may not turn further
constexpr int kMostPasses = 20;          // that take back moves
constexpr double kPull = 0.5;            // of a node to the middle of its neighbours along a line
constexpr double kPush = -0.53;          // and back, so that rings do not shrink (Taubin, 1995)
constexpr double kAll = 0.999;           // of the way that a node may go
constexpr double kRough = 0.005;         // of a side: what stands out by less is no noise
constexpr double kDisorder = 0.4;        // of sides whose ends differ: 0.58 is noise alone, surfaces have below 0.2
constexpr std::size_t kPerPiece = 4096;  // facets or nodes that a thread takes at once

template <class Body>
void for_all(std::size_t n, const Body& body) {
  parallel_for(n, kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

class FacetSmoother {
 public:
  FacetSmoother(FacetInput& input, double most)
      : corners_(input.corners),
        x_(input.x),
        given_(input.x),
        most_(most),
        around_(cells_of_nodes(input.corners, input.x.size())),
        neighbours_(find_neighbours(input.corners)) {
    for (auto* each : {&normal_, &mean_, &guide_, &aim_, &middle_}) each->resize(corners_.size());
    for (auto* each : {&area_, &spread_}) each->resize(corners_.size());
  }

  SmoothedFacets run() {
    for (int round = 0; round < kRounds; ++round) {
      measure();
      guide();
      filter();
      follow(kPull);
      follow(kPush);
    }
    SmoothedFacets moved;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double way = distance(x_[i], given_[i]);
      moved.mean += way / static_cast<double>(x_.size());
      if (way > kAll * most_) moved.at_most += 1 / static_cast<double>(x_.size());
    }
    return moved;
  }

 private:
  /// Facets with a common node, t itself as well; those with two nodes twice.
  template <class Visit>
  void for_each_around(std::size_t t, const Visit& visit) const {
    for (const std::int32_t n : corners_[t])
      for (const std::int32_t other : around_[static_cast<std::size_t>(n)]) visit(static_cast<std::size_t>(other));
  }

  void measure() {
    for_all(corners_.size(), [&](std::size_t t) {
      const Vec3 n = area_normal(x_, corners_[t]);
      area_[t] = norm(n);
      normal_[t] = area_[t] > 0 ? (1 / area_[t]) * n : Vec3{};
      middle_[t] = middle(t);
    });
  }

  Vec3 middle(std::size_t t) const {
    const Corners& c = corners_[t];
    return (1.0 / 3) * (x_[c[0]] + x_[c[1]] + x_[c[2]]);
  }

  /// The mean normal of the flattest patch that has the facet: at an edge one on its own side.
  void guide() {
    for_all(corners_.size(), [&](std::size_t t) {
      Vec3 sum{};
      double area = 0;
      for_each_around(t, [&](std::size_t other) {
        sum += area_[other] * normal_[other];
        area += area_[other];
      });
      const double length = norm(sum);
      mean_[t] = length > 0 ? (1 / length) * sum : Vec3{};
      spread_[t] = area > 0 ? 1 - length / area : 1;
    });
    for_all(corners_.size(), [&](std::size_t t) {
      std::size_t best = t;
      for_each_around(t, [&](std::size_t other) {
        if (dot(mean_[other], normal_[t]) < kEdge) return;
        if (spread_[other] < spread_[best] || (spread_[other] == spread_[best] && other < best)) best = other;
      });
      guide_[t] = mean_[best];
    });
  }

  void filter() {
    for_all(corners_.size(), [&](std::size_t t) {
      double reach2 = 0;
      int n = 0;
      for_each_around(t, [&](std::size_t other) {
        reach2 += norm2(middle_[other] - middle_[t]);
        ++n;
      });
      Vec3 sum{};
      for_each_around(t, [&](std::size_t other) {
        const double alike = (dot(guide_[other], guide_[t]) - kEdge) / (1 - kEdge);
        if (alike <= 0) return;
        const double far = reach2 > 0 ? norm2(middle_[other] - middle_[t]) * n / (2 * reach2) : 0;
        sum += area_[other] * alike * alike * std::exp(-far) * normal_[other];
      });
      const double length = norm(sum);
      aim_[t] = length > 0 ? (1 / length) * sum : normal_[t];
    });
  }

  /// Moves nodes to where their facets get the normals that are aimed at.
  void follow(double along_lines) {
    std::vector<Vec3> next(x_.size());
    for_all(corners_.size(), [&](std::size_t t) { middle_[t] = middle(t); });
    for_all(x_.size(), [&](std::size_t i) {
      Vec3 move{};
      for (const std::int32_t t : around_[i]) move += dot(aim_[t], middle_[t] - x_[i]) * aim_[t];
      if (!around_[i].empty()) move = (1 / static_cast<double>(around_[i].size())) * move;
      const Vec3 way = x_[i] + move + along_lines * off_line(i) - given_[i];
      const double length = norm(way);
      next[i] = given_[i] + (length > most_ ? most_ / length : 1) * way;
    });
    take_back(next);
    x_ = std::move(next);
  }

  /// From node i to the middle of the two next ones along a line of sharp or free sides, square to these; 0 elsewhere.
  Vec3 off_line(std::size_t i) const {
    std::array<std::int32_t, 2> beside{};
    std::size_t n = 0;
    const auto add = [&](std::int32_t node) {
      if (n < 2) beside[n] = node;
      ++n;
    };
    for (const std::int32_t t : around_[i]) {
      const int k =
          static_cast<int>(std::ranges::find(corners_[t], static_cast<std::int32_t>(i)) - corners_[t].begin());
      const std::int32_t out = neighbours_[t][k], in = neighbours_[t][(k + 2) % 3];
      if (out == kNone || dot(aim_[t], aim_[out]) < kEdge) add(corners_[t][(k + 1) % 3]);
      if (in == kNone) add(corners_[t][(k + 2) % 3]);
    }
    if (n != 2) return {};
    const Vec3 a = x_[i] - x_[beside[0]], b = x_[beside[1]] - x_[i], along = normalized(a + b);
    if (dot(a, b) < kCorner * norm(a) * norm(b)) return {};
    const Vec3 off = 0.5 * (b - a);
    return off - dot(off, along) * along;
  }

  double uprightness(const std::vector<Vec3>& x, std::size_t t) const {
    const Vec3 n = area_normal(x, corners_[t]);
    const double area = norm(n);
    return area > 0 ? dot(n, aim_[t]) / area : -1;
  }

  /// Moves that turn a facet over, or towards it.
  void take_back(std::vector<Vec3>& next) const {
    std::vector<std::uint8_t> falls(corners_.size());
    for (int pass = 0; pass < kMostPasses; ++pass) {
      for_all(corners_.size(), [&](std::size_t t) {
        const double after = uprightness(next, t);
        falls[t] = after < kUpright && after < uprightness(x_, t);
      });
      bool is_any = false;
      for (std::size_t t = 0; t < corners_.size(); ++t) {
        if (!falls[t]) continue;
        for (const std::int32_t n : corners_[t]) next[n] = x_[n];
        is_any = true;
      }
      if (!is_any) return;
    }
  }

  const std::vector<Corners>& corners_;
  std::vector<Vec3>& x_;
  const std::vector<Vec3> given_;
  const double most_;
  const ListsByKey<> around_;  // facets of nodes
  const std::vector<Corners> neighbours_;
  std::vector<Vec3> normal_, mean_, guide_, aim_, middle_;  // [facets]
  std::vector<double> area_, spread_;                       // [facets] times two; of a facet's patch
};

}  // namespace

SmoothedFacets smooth_facets(FacetInput& input, double most) { return FacetSmoother(input, most).run(); }

double find_noise(const FacetInput& input) {
  const std::size_t n = input.x.size();
  std::vector<Vec3> normal(n), middle(n);
  std::vector<double> length(n), out(n);
  std::vector<std::int32_t> sides(n);
  const auto for_each_side = [&](const auto& visit) {  // twice where two facets have it
    for (const Corners& c : input.corners)
      for (int k = 0; k < 3; ++k) visit(static_cast<std::size_t>(c[k]), static_cast<std::size_t>(c[(k + 1) % 3]));
  };
  for (const Corners& c : input.corners)
    for (const std::int32_t i : c) normal[i] += area_normal(input.x, c);
  for_each_side([&](std::size_t a, std::size_t b) {
    middle[a] += input.x[b];
    length[a] += distance(input.x[a], input.x[b]);
    ++sides[a];
  });
  std::vector<double> off;
  for (std::size_t i = 0; i < n; ++i) {
    if (sides[i] == 0) continue;
    out[i] = dot(normalized(normal[i]), input.x[i] - (1.0 / sides[i]) * middle[i]);
    off.push_back(std::abs(out[i]));
    if (off.back() < kRough * length[i] / sides[i]) out[i] = 0;
  }
  std::size_t rough = 0, differ = 0, all = 0;
  for_each_side([&](std::size_t a, std::size_t b) {
    ++all;
    if (out[a] == 0 || out[b] == 0) return;
    ++rough;
    differ += (out[a] > 0) != (out[b] > 0);
  });
  if (2 * rough < all || static_cast<double>(differ) < kDisorder * static_cast<double>(rough)) return 0;
  const auto half = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), half, off.end());
  return *half / 0.73;  // the median of a normal distribution is 0.67 of its deviation, six neighbours add to that
}

}  // namespace st
