#include "io/foreign/polygon_split.h"

namespace st {
namespace {

/// What is left of a polygon while ears are cut off.
class Ears {
 public:
  Ears(const std::vector<Vec3>& node_xyz, std::vector<std::int64_t> left) : x_(node_xyz), left_(std::move(left)) {
    for (std::size_t k = 0; k < left_.size(); ++k) normal_ += cross(at(k), at(k + 1));
  }

  std::size_t size() const { return left_.size(); }

  /// The corner whose neighbours are nearest to each other, of those that can be cut off.
  std::array<std::int64_t, 3> cut_next() {
    std::size_t best = 0;
    double shortest = -1;
    for (std::size_t k = 0; k < size(); ++k) {
      const double length = norm2(before(k) - after(k));
      if ((shortest < 0 || length < shortest) && is_ear(k)) best = k, shortest = length;
    }
    const std::array<std::int64_t, 3> ear = {left_[(best + size() - 1) % size()], left_[best],
                                             left_[(best + 1) % size()]};
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(best));
    return ear;
  }

 private:
  Vec3 at(std::size_t k) const { return x_[left_[k % size()]] - x_[left_[0]]; }
  Vec3 before(std::size_t k) const { return at(k + size() - 1); }
  Vec3 after(std::size_t k) const { return at(k + 1); }
  double turn(Vec3 a, Vec3 b, Vec3 c) const { return dot(cross(b - a, c - a), normal_); }

  bool is_ear(std::size_t k) const {
    const Vec3 a = before(k), b = at(k), c = after(k);
    if (turn(a, b, c) <= 0) return false;
    for (std::size_t j = k + 2; j < k + size() - 1; ++j) {
      const Vec3 p = at(j);
      const bool is_corner = p == a || p == b || p == c;
      if (!is_corner && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  const std::vector<Vec3>& x_;
  std::vector<std::int64_t> left_;
  Vec3 normal_;
};

}  // namespace

void split_polygon(const std::vector<Vec3>& node_xyz, std::span<const std::int64_t> corner,
                   std::vector<std::array<std::int64_t, 3>>& triangles) {
  std::vector<std::int64_t> own;
  for (const std::int64_t n : corner)
    if (own.empty() || own.back() != n) own.push_back(n);
  while (own.size() > 1 && own.front() == own.back()) own.pop_back();
  if (own.size() < 3) return;
  Ears ears(node_xyz, std::move(own));
  while (ears.size() > 2) triangles.push_back(ears.cut_next());
}

}  // namespace st
