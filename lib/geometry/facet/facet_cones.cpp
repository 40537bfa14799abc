#include "geometry/facet/facet_cones.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "base/axis.h"

namespace st {
namespace {

constexpr double kCone = 0.5;        // cosine of 60 degrees: a projection stretches by 2 at most
constexpr int kScrap = 30;           // facets: so few between two cones go to one of them
constexpr double kScrapCone = 0.17;  // cosine of 80 degrees: to the middle of that cone

/// By the axis along which the patch is longest: the half of the triangles that lies higher is 1.
std::vector<std::int32_t> halves(const FacetPatch& patch) {
  const std::size_t n = patch.corners.size();
  Box3 box;
  for (const Vec3 x : patch.x) box.add(x);
  const int axis = longest_axis(box);
  const auto along = [&](std::size_t t) {
    const auto& [a, b, c] = patch.corners[t];
    return component(patch.x[a] + patch.x[b] + patch.x[c], axis);
  };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  std::vector<std::int32_t> group(n, 0);
  for (std::size_t i = n / 2; i < n; ++i) group[order[i]] = n > 1 ? 1 : 0;
  return group;
}

std::vector<Vec3> normals_of(const FacetPatch& patch) {
  std::vector<Vec3> normal;
  for (const Corners& c : patch.corners)
    normal.push_back(normalized(cross(patch.x[c[1]] - patch.x[c[0]], patch.x[c[2]] - patch.x[c[0]])));
  return normal;
}

/// Groups of facets that grow from a seed each, within a cone around its normal.
class Cones {
 public:
  explicit Cones(const FacetPatch& patch) : patch_(patch), normal_(normals_of(patch)), group_(normal_.size(), kNone) {}

  std::vector<std::int32_t> run() {
    std::vector<double> area;
    for (const Corners& c : patch_.corners)
      area.push_back(norm(cross(patch_.x[c[1]] - patch_.x[c[0]], patch_.x[c[2]] - patch_.x[c[0]])));
    std::vector<std::int32_t> order(area.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return area[a] > area[b]; });
    for (const std::int32_t t : order)
      if (group_[t] == kNone) grow(t);
    hand_over_scraps();
    return std::move(group_);
  }

 private:
  void grow(std::int32_t seed) {
    const auto own = static_cast<std::int32_t>(members_.size());
    members_.push_back({seed});
    axis_.push_back(normal_[seed]);
    group_[seed] = own;
    for (std::size_t i = 0; i < members_[own].size(); ++i)
      for (const std::int32_t other : patch_.neighbours[members_[own][i]]) {
        if (other == kNone || group_[other] != kNone || !(dot(normal_[other], axis_[own]) >= kCone)) continue;
        group_[other] = own;
        members_[own].push_back(other);
      }
  }

  /// What is left between the cones, as along a nose, goes to the one that it has the longest side in common with.
  void hand_over_scraps() {
    for (std::size_t g = members_.size(); g-- > 1;) {
      if (members_[g].size() > kScrap) continue;
      const std::int32_t to = neighbour_of(static_cast<std::int32_t>(g));
      if (to == kNone) continue;
      for (const std::int32_t t : members_[g]) group_[t] = to;
      members_[to].insert(members_[to].end(), members_[g].begin(), members_[g].end());
      members_[g].clear();
    }
  }

  /// The group across the longest common rim, into whose cone all of `own` fits; kNone: none.
  std::int32_t neighbour_of(std::int32_t own) const {
    std::map<std::int32_t, double> common;
    for (const std::int32_t t : members_[own])
      for (int k = 0; k < 3; ++k) {
        const std::int32_t other = patch_.neighbours[t][k];
        const Corners& c = patch_.corners[t];
        if (other != kNone && group_[other] != own)
          common[group_[other]] += distance(patch_.x[c[k]], patch_.x[c[(k + 1) % 3]]);
      }
    std::int32_t best = kNone;
    for (const auto& [group, length] : common) {
      const Vec3 axis = axis_[group];
      const auto is_inside = [&](std::int32_t t) { return dot(normal_[t], axis) >= kScrapCone; };
      if ((best == kNone || length > common[best]) && std::ranges::all_of(members_[own], is_inside)) best = group;
    }
    return best;
  }

  const FacetPatch& patch_;
  std::vector<Vec3> normal_, axis_;                 // of triangles; of groups
  std::vector<std::int32_t> group_;                 // of triangles
  std::vector<std::vector<std::int32_t>> members_;  // of groups; none: handed over
};

}  // namespace

bool is_folded(const FacetPatch& patch) {
  const std::vector<Vec3> normal = normals_of(patch);
  for (std::size_t t = 0; t < normal.size(); ++t)
    for (const std::int32_t other : patch.neighbours[t])
      if (other != kNone && dot(normal[t], normal[other]) < kKnife) return true;
  return false;
}

std::vector<std::int32_t> part_by_normals(const FacetPatch& patch) {
  std::vector<std::int32_t> group = Cones(patch).run();
  const bool is_parted = std::ranges::any_of(group, [&](std::int32_t g) { return g != group.front(); });
  return is_parted ? group : halves(patch);
}

}  // namespace st
