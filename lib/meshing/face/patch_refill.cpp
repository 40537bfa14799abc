#include "meshing/face/patch_refill.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/corner_uv.h"
#include "meshing/face/face_mesher.h"
#include "meshing/face/face_patch.h"
#include "meshing/face/least_area.h"
#include "meshing/face/triangle_places.h"

namespace st {
namespace {

constexpr std::array kRings = {1, 2, 3};
constexpr std::size_t kMostNodes = 150;  // of a loop; the cost is cubic
constexpr int kMostTried = 300;   // places: a damaged surface has too many, and each takes a look at all triangles
constexpr double kFlat = 0.5;     // cosine between neighbours' normals: flatter ones are as good
constexpr double kNoArea = 1e-9;  // over the squared perimeter: twice the area of a triangle that has none
constexpr double kShape = 1e-2;   // share of the squared perimeter in a triangle's area: few slivers

using Side = std::pair<NodeId, NodeId>;
using BadTriangles = std::set<std::array<NodeId, 3>>;  // by their nodes

bool has_no_area(Vec3 a, Vec3 b, Vec3 c) {
  const double perimeter = distance(a, b) + distance(b, c) + distance(c, a);
  return norm(cross(b - a, c - a)) <= kNoArea * perimeter * perimeter;
}

/// Fills one loop.
class LoopFill {
 public:
  /// `beyond`: normals of the triangles outside by side, as they run along the loop; none at the rim of the patch.
  /// `taken`: pairs of nodes without a side inside, the lower first.
  LoopFill(std::span<const Vec3> xyz, const std::vector<NodeId>& loop, const std::map<Side, Vec3>& beyond,
           const std::set<Side>& taken)
      : xyz_(xyz), loop_(loop), n_(loop.size()), beyond_(beyond), taken_(taken), best_(n_ * n_) {}

  /// Empty: nothing without folds was found.
  std::vector<Triangle> run() {
    for (std::size_t gap = 2; gap < n_; ++gap)
      for (std::size_t i = 0; i + gap < n_; ++i) choose(i, i + gap);
    std::vector<Triangle> result;
    if (n_ < 3 || !(best_[n_ - 1].cosine > kFoldedCosine)) return result;
    for_each_split(
        n_, [&](std::size_t i, std::size_t k) { return best_[i * n_ + k].apex; },
        [&](std::size_t i, std::size_t j, std::size_t k) {
          result.push_back({{loop_[i], loop_[j], loop_[k]}});
        });
    return result;
  }

 private:
  /// Of the part of the loop from i to k.
  struct Best {
    double cosine = kFlat, area = 0;
    std::size_t apex = 0;
    Vec3 normal;  // of the triangle at the side from i to k
    bool beats(const Best& o) const { return cosine != o.cosine ? cosine > o.cosine : area < o.area; }
  };

  void choose(std::size_t i, std::size_t k) {
    const bool is_whole = i == 0 && k == n_ - 1;
    Best& best = best_[i * n_ + k];
    best.cosine = -2;
    best.area = std::numeric_limits<double>::infinity();
    if (!is_whole && taken_.contains(std::minmax(loop_[i], loop_[k]))) return;
    for (std::size_t j = i + 1; j < k; ++j) {
      const Vec3 a = xyz_[loop_[i]], b = xyz_[loop_[j]], c = xyz_[loop_[k]], normal = cross(b - a, c - a);
      const double perimeter = distance(a, b) + distance(b, c) + distance(c, a);
      Best own;
      own.apex = j;
      own.normal = normalized(normal);
      own.area = 0.5 * norm(normal) + kShape * perimeter * perimeter + best_[i * n_ + j].area + best_[j * n_ + k].area;
      own.cosine = std::min({kFlat, best_[i * n_ + j].cosine, best_[j * n_ + k].cosine, cosine(i, j, own.normal),
                             cosine(j, k, own.normal)});
      if (is_whole) own.cosine = std::min(own.cosine, beyond(loop_[k], loop_[i], own.normal));
      if (has_no_area(a, b, c)) own.cosine = -1;
      if (own.beats(best)) best = own;
    }
  }

  double cosine(std::size_t i, std::size_t j, Vec3 normal) const {
    if (j == i + 1) return beyond(loop_[i], loop_[j], normal);
    return dot(best_[i * n_ + j].normal, normal);
  }
  double beyond(NodeId a, NodeId b, Vec3 normal) const {
    const auto found = beyond_.find({a, b});
    return found == beyond_.end() ? kFlat : dot(found->second, normal);
  }

  std::span<const Vec3> xyz_;
  const std::vector<NodeId>& loop_;
  const std::size_t n_;
  const std::map<Side, Vec3>& beyond_;
  const std::set<Side>& taken_;
  std::vector<Best> best_;  // [n*n]
};

Vec3 normal_of(std::span<const Vec3> xyz, const Triangle& t) {
  return normalized(cross(xyz[t.n[1]] - xyz[t.n[0]], xyz[t.n[2]] - xyz[t.n[0]]));
}

/// Sides of bad triangles across the patch, from rim to rim: another face may have one between the same nodes.
std::set<Side> chords_of(const FacePatch& patch, const TrianglePlace& place, const BadTriangles& bad) {
  std::set<Side> sides, chords;
  const auto visit = [&](const Triangle& t, const auto& add) {
    for (int k = 0; k < 3; ++k) add(t.n[k], t.n[(k + 1) % 3]);
  };
  for (const std::size_t t : place.triangles)
    visit(patch.triangles[t], [&](NodeId a, NodeId b) { sides.insert({a, b}); });
  for (const std::size_t t : place.triangles)
    if (bad.contains(std::to_array(patch.triangles[t].n)))
      visit(patch.triangles[t], [&](NodeId a, NodeId b) {
        if (std::max(a, b) < patch.n_boundary && sides.contains({b, a})) chords.insert(std::minmax(a, b));
      });
  return chords;
}

/// What is outside a place between nodes of its loop.
struct Outside {
  std::map<Side, Vec3> beyond;
  std::set<Side> taken;
};

/// By place: these have no node in common.
std::vector<Outside> look_outside(std::span<const Vec3> xyz, const std::vector<Triangle>& triangles,
                                  const std::vector<TrianglePlace>& places) {
  std::vector<std::int32_t> loop_of(xyz.size(), kNone);
  std::vector<std::uint8_t> is_in(triangles.size(), 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const NodeId n : places[i].loop) loop_of[n] = static_cast<std::int32_t>(i);
    for (const std::size_t t : places[i].triangles) is_in[t] = 1;
  }
  std::vector<Outside> all(places.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; !is_in[t] && k < 3; ++k) {
      const NodeId a = triangles[t].n[k], b = triangles[t].n[(k + 1) % 3];
      if (loop_of[a] == kNone || loop_of[a] != loop_of[b]) continue;
      all[loop_of[a]].beyond[{b, a}] = normal_of(xyz, triangles[t]);
      all[loop_of[a]].taken.insert(std::minmax(a, b));
    }
  return all;
}

/// The patch without triangles of places, with others at its end.
void exchange(const std::vector<std::uint8_t>& is_gone, const std::vector<Triangle>& added, FacePatch& patch) {
  const std::vector<Vec2> before = corner_uvs(patch);
  std::map<NodeId, Vec2> uv;
  std::vector<Triangle> triangles;
  std::vector<Vec2> after;
  std::vector<TriangleId> previous;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    for (std::size_t k = 0; is_gone[t] && k < 3; ++k) uv.emplace(patch.triangles[t].n[k], before[3 * t + k]);
    if (is_gone[t]) continue;
    triangles.push_back(patch.triangles[t]);
    for (std::size_t k = 0; k < 3; ++k) after.push_back(before[3 * t + k]);
    if (!patch.triangle_previous.empty()) previous.push_back(patch.triangle_previous[t]);
  }
  for (const Triangle& t : added) {
    triangles.push_back(t);
    for (const NodeId n : t.n) after.push_back(uv.at(n));
    if (!patch.triangle_previous.empty()) previous.push_back(kNone);
  }
  patch.triangles = std::move(triangles);
  set_corner_uvs(after, patch);
  patch.triangle_previous = std::move(previous);
}

}  // namespace

std::vector<std::size_t> find_flawed(std::span<const Vec3> xyz, const FacePatch& patch) {
  std::vector<std::size_t> flawed;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    const NodeId* n = patch.triangles[t].n;
    if (has_no_area(xyz[n[0]], xyz[n[1]], xyz[n[2]])) flawed.push_back(t);
  }
  EdgeTable(patch.triangles, static_cast<std::int64_t>(xyz.size()))
      .for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
        if (sides.size() != 2) return;
        const Triangle &a = patch.triangles[sides[0] / 3], &b = patch.triangles[sides[1] / 3];
        if (dot(normal_of(xyz, a), normal_of(xyz, b)) < kFoldedCosine)
          flawed.push_back(static_cast<std::size_t>(sides[0] / 3));
      });
  return flawed;
}

int refill(std::span<const Vec3> xyz, std::span<const std::size_t> bad, FacePatch& patch) {
  BadTriangles left;
  for (const std::size_t t : bad) left.insert(std::to_array(patch.triangles[t].n));
  int n_filled = 0, n_tried = 0;
  for (const int rings : kRings) {
    if (left.empty() || n_tried == kMostTried) break;
    std::vector<std::size_t> seeds;
    for (std::size_t t = 0; t < patch.triangles.size(); ++t)
      if (left.contains(std::to_array(patch.triangles[t].n))) seeds.push_back(t);
    const std::vector<TrianglePlace> places =
        places_about(patch.triangles, static_cast<std::int64_t>(xyz.size()), seeds, rings);
    std::vector<Outside> outside = look_outside(xyz, patch.triangles, places);
    std::vector<std::uint8_t> is_gone(patch.triangles.size(), 0);
    std::vector<Triangle> added;
    for (std::size_t i = 0; i < places.size() && n_tried < kMostTried; ++i, ++n_tried) {
      const auto& [triangles, n_seeds, loop] = places[i];
      if (loop.size() < 3 || loop.size() > kMostNodes) continue;
      outside[i].taken.merge(chords_of(patch, places[i], left));
      const std::vector<Triangle> fill = LoopFill(xyz, loop, outside[i].beyond, outside[i].taken).run();
      if (fill.empty()) continue;
      added.insert(added.end(), fill.begin(), fill.end());
      for (const std::size_t t : triangles) {
        left.erase(std::to_array(patch.triangles[t].n));
        is_gone[t] = 1;
      }
      ++n_filled;
    }
    if (!added.empty()) exchange(is_gone, added, patch);
  }
  if (n_filled > 0) drop_unused_nodes(patch);
  return n_filled;
}

}  // namespace st
