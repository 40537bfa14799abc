#include "meshing/face/least_area.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/threads.h"

namespace st {
namespace {

constexpr double kShape = 1e-4;        // share of the squared perimeter in a triangle's cost: few slivers where flat
constexpr double kImpossible = 1e200;  // cost of a triangle with one node twice
constexpr std::size_t kApexesPerPiece = 4000;  // that one thread looks at, some ten microseconds

class LeastArea {
 public:
  LeastArea(std::vector<Vec3> x, std::vector<std::int32_t> id, std::vector<Vec3> middle, std::vector<double> side_cost)
      : n_(x.size()),
        x_(std::move(x)),
        id_(std::move(id)),
        middle_(std::move(middle)),
        side_cost_(std::move(side_cost)),
        least_(n_ * n_, 0),
        apex_(n_ * n_, 0) {}

  std::vector<std::array<std::size_t, 3>> run() {
    for (std::size_t gap = 2; gap < n_; ++gap)  // what a gap needs is there after the smaller ones
      parallel_for(n_ - gap, std::max<std::size_t>(1, kApexesPerPiece / gap), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) choose_apex(i, i + gap);
      });
    std::vector<std::array<std::size_t, 3>> result;
    if (n_ < 3 || least_[n_ - 1] >= kImpossible) return result;
    for_each_split(
        n_, [&](std::size_t i, std::size_t k) { return static_cast<std::size_t>(apex_[i * n_ + k]); },
        [&](std::size_t i, std::size_t j, std::size_t k) {
          result.push_back({i, j, k});
        });
    return result;
  }

 private:
  void choose_apex(std::size_t i, std::size_t k) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t j = i + 1; j < k; ++j) {
      const double cost = least_[i * n_ + j] + least_[j * n_ + k];
      if (cost >= best) continue;
      const double with = cost + triangle_cost(i, j, k);
      if (with < best) best = with, apex_[i * n_ + k] = static_cast<std::int32_t>(j);
    }
    least_[i * n_ + k] = best + side_cost_[i * n_ + k];
  }

  double triangle_cost(std::size_t i, std::size_t j, std::size_t k) const {
    if (id_[i] == id_[j] || id_[j] == id_[k] || id_[i] == id_[k]) return kImpossible;
    const Vec3 a = middle_[i * n_ + j], b = middle_[j * n_ + k], c = middle_[i * n_ + k];
    const auto area = [](Vec3 p, Vec3 q, Vec3 r) { return norm(cross(q - p, r - p)); };
    const double perimeter = distance(x_[i], x_[j]) + distance(x_[j], x_[k]) + distance(x_[k], x_[i]);
    return 0.5 * (area(x_[i], a, c) + area(x_[j], b, a) + area(x_[k], c, b) + area(a, b, c)) +
           kShape * perimeter * perimeter;
  }

  std::size_t n_;
  std::vector<Vec3> x_;
  std::vector<std::int32_t> id_;
  std::vector<Vec3> middle_;       // [n*n]
  std::vector<double> side_cost_;  // [n*n]
  std::vector<double> least_;      // [n*n] cost of the polygon i..k
  std::vector<std::int32_t> apex_;
};

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate_least_area(std::vector<Vec3> x, std::vector<std::int32_t> id,
                                                               std::vector<Vec3> middle,
                                                               std::vector<double> side_cost) {
  return LeastArea(std::move(x), std::move(id), std::move(middle), std::move(side_cost)).run();
}

}  // namespace st
