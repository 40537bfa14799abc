#include "meshing/engine/stretch_flaws.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/adjacency.h"
#include "meshing/face/flaw_mending.h"

namespace st {
namespace {

// Where each number comes from: docs/design/heuristics.md.
constexpr double kGrowthLeft = 1.6;     // what is aimed at there
constexpr double kShorter = 0.6;        // lengths along, in one round
constexpr double kLeastShorter = 0.35;  // at most
constexpr int kGentleTries = 3;         // then lengths that are alike become shorter
constexpr double kLast = 0.9;           // of lengths that are alike, then
constexpr double kAlike = 1.05;         // along over across: less is about the same
constexpr double kAround = 0.25;        // of the longest side, or the length along: so far about an angle, in no more
                                        // columns than must be
constexpr double kFarGrowth = 2.5;      // larger steps of size are eased
constexpr double kFurther = 3;          // times as far: what is not held, and steps beside it
const double kMostCosine = std::cos(kMostAngle), kFarCosine = std::cos(kFarAngle);

class FlawFinder {
 public:
  FlawFinder(std::span<const Vec3> points, std::span<const Triangle> triangles, const SizeField& present, int n_tries)
      : points_(points),
        triangles_(triangles),
        present_(present),
        n_tries_(n_tries),
        factor_(triangles.size(), 1),
        is_obtuse_(triangles.size(), 0),
        is_step_(triangles.size(), 0) {
    for (const Triangle& t : triangles) area_.push_back(0.5 * norm(cross(x(t, 1) - x(t, 0), x(t, 2) - x(t, 0))));
  }

  StretchFlaws run() {
    for (std::size_t t = 0; t < triangles_.size(); ++t) is_obtuse_[t] = is_obtuse(triangles_[t], kMostCosine);
    compare_neighbours();
    StretchFlaws flaws;
    bool is_long = false;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!is_obtuse_[t] && factor_[t] == 1) continue;
      const bool is_far = is_obtuse_[t] && is_obtuse(triangles_[t], kFarCosine);
      ++(is_obtuse_[t] ? flaws.n_obtuse : flaws.n_large);
      flaws.n_far += is_far;
      const RefinementPoint place = place_at(t, is_long);
      flaws.all.push_back({place.x, is_far ? FlawKind::kFar : is_obtuse_[t] ? FlawKind::kObtuse : FlawKind::kLarge});
      if (!is_far && !is_step_[t]) continue;
      if (is_long)
        (is_far ? flaws.stretched : flaws.steps).push_back(place);
      else if (is_far)
        flaws.obtuse.push_back(place);
    }
    return flaws;
  }

 private:
  Vec3 x(const Triangle& t, int k) const { return points_[t.n[k % 3]]; }

  /// Has it an angle with a cosine below this one, which is negative?
  bool is_obtuse(const Triangle& t, double cosine) const {
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = x(t, k + 1) - x(t, k), b = x(t, k + 2) - x(t, k);
      if (const double product = dot(a, b); product < 0 && product < cosine * norm(a) * norm(b)) return true;
    }
    return false;
  }

  /// The larger one of two neighbours becomes smaller.
  void compare_neighbours() {
    const EdgeTable edges(triangles_, static_cast<std::int64_t>(points_.size()));
    edges.for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
      if (sides.size() != 2) return;
      TriangleId small = sides[0] / 3, large = sides[1] / 3;
      double low = area_[small], high = area_[large];
      if (low > high) {
        std::swap(small, large);
        std::swap(low, high);
      }
      if (!(high > kMostGrowth * kMostGrowth * low)) return;
      if (high > kFarGrowth * kFarGrowth * low) is_step_[large] = 1;
      const double wanted = low > 0 ? kGrowthLeft * kGrowthLeft * low / high : 0;
      factor_[large] = std::min(factor_[large], std::max(kLeastShorter, wanted));
    });
  }

  /// `is_long`: lengths along differ from those across; they become no shorter than these, at last these.
  RefinementPoint place_at(std::size_t t, bool& is_long) const {
    const Triangle& r = triangles_[t];
    const double longest =
        std::max({distance(x(r, 0), x(r, 1)), distance(x(r, 1), x(r, 2)), distance(x(r, 2), x(r, 0))});
    RefinementPoint place{(x(r, 0) + x(r, 1) + x(r, 2)) / 3};
    int hint = 0;
    const Vec3 normal = normalized(cross(x(r, 1) - x(r, 0), x(r, 2) - x(r, 0)));
    const LocalSize local = present_.local_on(place.x, normal, hint);
    is_long = local.along > kAlike * local.length;
    const double factor = is_obtuse_[t] ? std::min(kShorter, factor_[t]) : factor_[t];
    const double shorter = factor * std::min(local.along, longest);
    if (!is_long && n_tries_ > kGentleTries)
      place.length = kLast * local.length;
    else
      place.length = std::max(is_long ? local.length : 0, shorter);
    place.radius = kAround * longest;
    return place;
  }

  std::span<const Vec3> points_;
  std::span<const Triangle> triangles_;
  const SizeField& present_;
  int n_tries_;
  std::vector<double> factor_;   // [triangles] of lengths along, by neighbours; 1: none is asked for
  std::vector<char> is_obtuse_;  // [triangles]
  std::vector<char> is_step_;    // [triangles] the larger one of a step that is eased
  std::vector<double> area_;     // [triangles]
};

}  // namespace

StretchFlaws find_stretch_flaws(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                const SizeField& present, int n_tries) {
  return FlawFinder(points, triangles, present, n_tries).run();
}

void StretchFlaws::add_unheld(RefinementPoint place, const LocalSize& present) {
  ++n_unheld;
  all.push_back({place.x, FlawKind::kUnheld});
  if (!(present.along > present.length)) return;  // what is not held there is not for stretch
  place.length = std::max(present.length, kShorter * present.along);
  place.radius = std::max(place.radius, (is_wide() ? kFurther : 1) * kAround * present.along);
  stretched.push_back(place);
}

RefinementPoint further(RefinementPoint step) {
  step.radius *= kFurther;
  return step;
}

bool StretchFlaws::is_beside_unheld(const RefinementPoint& step) const {
  const double reach = further(step).radius;
  return is_wide() && std::ranges::any_of(stretched, [&](const RefinementPoint& place) {
           return distance(place.x, step.x) < reach + place.radius;
         });
}

}  // namespace st
