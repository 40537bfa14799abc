#include "geometry/facet/facet_cuts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "base/eigen.h"
#include "base/threads.h"
#include "geometry/facet/facet_cones.h"
#include "geometry/facet/knife_sides.h"
#include "geometry/shape/flatten.h"
#include "geometry/shape/flatten_coarse.h"
#include "geometry/shape/known_neighbours.h"

namespace st {
namespace {

constexpr double kNearCut = 0.02;        // of the piece's diagonal: a rim so near to a cut makes slivers
constexpr double kNearRim = 4;           // what a length of such rim costs, in lengths of the cut
constexpr double kAcross = 10;           // what a cut costs that misses the rims of a tube: it leaves two tubes
constexpr double kOnPlane = 0.02;        // of a side's height: a node so near to the plane counts as on it
constexpr double kRounding = 1e-7;       // of the piece's diagonal: single precision; a node so near is on the plane
constexpr double kFlatBox = 0.2;         // of the diagonal: a piece is not cut across a shorter extent
constexpr std::size_t kSampled = 10000;  // triangles that tell where a cut may be
constexpr double kSharpRim = 0.9 * 2 * kPi;  // radians
constexpr std::size_t kLarge = 20000;        // triangles: a piece to be cut again and again is halved
constexpr std::size_t kSolved = 5000;        // triangles: larger patches are flattened by way of a coarse one
constexpr int kMostCuts = 6;  // of a region, one after the other, and half of the doublings of its triangles
constexpr double kShares[] = {0.5, 0.4, 0.6, 0.3, 0.7};  // of the area on one side
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Where triangles of a piece lie, weighted by area.
struct Spread {
  std::vector<Vec3> middle;
  std::vector<double> area;
  double total = 0;
};

Spread spread_of(const FacetPatch& patch) {
  Spread s;
  for (const Corners& c : patch.corners) {
    const Vec3 a = patch.x[c[0]], b = patch.x[c[1]], d = patch.x[c[2]];
    s.middle.push_back((a + b + d) / 3);
    s.area.push_back(0.5 * norm(cross(b - a, d - a)));
    s.total += s.area.back();
  }
  return s;
}

/// Those of space, then those of inertia.
std::vector<Vec3> candidate_axes(const Spread& s) {
  Vec3 center{};
  for (std::size_t t = 0; t < s.area.size(); ++t) center += s.area[t] / s.total * s.middle[t];
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t t = 0; t < s.area.size(); ++t) {
    const Eigen::Vector3d d = to_eigen(s.middle[t] - center);
    inertia += s.area[t] / s.total * (d * d.transpose());
  }
  std::vector<Vec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3 axis : principal_axes(inertia).axis) axes.push_back(axis);
  return axes;
}

/// Places along the axis that have kShares of the area below, by a sample of the triangles.
std::vector<double> candidate_places(const Spread& s, Vec3 axis) {
  const std::size_t step = 1 + s.area.size() / kSampled;
  std::vector<std::pair<double, double>> along;
  double total = 0;
  for (std::size_t t = 0; t < s.area.size(); t += step) {
    along.emplace_back(dot(s.middle[t], axis), s.area[t]);
    total += s.area[t];
  }
  std::sort(along.begin(), along.end());
  std::vector<double> places;
  for (const double share : kShares) {
    if (s.area.size() > kLarge && !places.empty()) break;
    double sum = 0;
    const auto at =
        std::find_if(along.begin(), along.end() - 1, [&](const auto& a) { return (sum += a.second) >= share * total; });
    places.push_back(at->first);
  }
  return places;
}

double longest_side(const FacetPatch& patch) {
  double longest2 = 0;
  for (const Corners& c : patch.corners)
    for (int k = 0; k < 3; ++k) longest2 = std::max(longest2, norm2(patch.x[c[(k + 1) % 3]] - patch.x[c[k]]));
  return std::sqrt(longest2);
}

/// Of own nodes above a plane; 0 where the plane passes so near that it would leave a sliver. `least`: what is nearer
/// than this is rounding, also where a side runs along the plane. `longest`: side of the patch.
std::vector<double> heights(const FacetPatch& patch, Vec3 axis, double place, double least, double longest) {
  std::vector<double> height;
  height.reserve(patch.x.size());
  for (const Vec3 x : patch.x) height.push_back(dot(x, axis) - place);
  const double near = std::max(kOnPlane * longest, least);  // nodes further away are not on the plane
  std::vector<double> reach(patch.x.size(), kInfinite);
  for (const Corners& c : patch.corners) {
    if (std::min({std::abs(height[c[0]]), std::abs(height[c[1]]), std::abs(height[c[2]])}) > near) continue;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = c[k], b = c[(k + 1) % 3];
      const double step = std::abs(height[a] - height[b]);
      if (step > 0) reach[a] = std::min(reach[a], step), reach[b] = std::min(reach[b], step);
    }
  }
  for (std::size_t i = 0; i < height.size(); ++i)
    if (reach[i] < kInfinite && std::abs(height[i]) < std::max(kOnPlane * reach[i], least)) height[i] = 0;
  return height;
}

/// The length of a cut and what it leaves.
class CutCost {
 public:
  CutCost(const FacetPatch& patch, const PatchTopology& topology)
      : patch_(patch), loops_(topology.loops), is_tube_(topology.loops.size() > 1) {
    Box3 box;
    for (const Vec3 x : patch.x) box.add(x);
    near_ = kNearCut * box.diagonal();
  }

  double operator()(const std::vector<double>& height) const {
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    if (!(*low < 0 && *high > 0)) return kInfinite;
    double cost = 0;
    bool meets_rim = false;
    for (const Corners& c : patch_.corners) cost += cut_length(c, height);
    for (const auto& loop : loops_)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::int32_t a = loop[i], b = loop[(i + 1) % loop.size()];
        cost += kNearRim * near_length(a, b, height);
        meets_rim = meets_rim || height[a] * height[b] <= 0;
      }
    return is_tube_ && !meets_rim ? kAcross * cost : cost;
  }

 private:
  double cut_length(const Corners& c, const std::vector<double>& height) const {
    const double ha = height[c[0]], hb = height[c[1]], hc = height[c[2]];
    if ((ha > 0 && hb > 0 && hc > 0) || (ha < 0 && hb < 0 && hc < 0)) return 0;
    std::array<Vec3, 6> on;
    std::size_t n = 0;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = c[k], b = c[(k + 1) % 3];
      if (height[a] == 0) on[n++] = patch_.x[a];
      if (height[a] * height[b] < 0)
        on[n++] = patch_.x[a] + (height[a] / (height[a] - height[b])) * (patch_.x[b] - patch_.x[a]);
    }
    return n == 2 ? distance(on[0], on[1]) : 0;
  }

  /// Of a rim side within the near distance of the plane.
  double near_length(std::int32_t a, std::int32_t b, const std::vector<double>& height) const {
    const double low = std::max(std::min(height[a], height[b]), -near_),
                 high = std::min(std::max(height[a], height[b]), near_), range = std::abs(height[a] - height[b]);
    if (high < low) return 0;
    return distance(patch_.x[a], patch_.x[b]) * (range > 0 ? std::min(1.0, (high - low) / range) : 1.0);
  }

  const FacetPatch& patch_;
  const std::vector<std::vector<std::int32_t>>& loops_;
  bool is_tube_;
  double near_;
};

/// The rim node around which the triangles turn most, where that is so near to a full turn that no plane map can leave
/// both rim sides apart (at the end of a sharp wing's root); kNone where there is none.
std::int32_t sharpest_rim_node(const FacetPatch& patch, const PatchTopology& topology) {
  std::vector<std::uint8_t> is_rim(patch.x.size(), 0);
  for (const auto& loop : topology.loops)
    for (const std::int32_t n : loop) is_rim[n] = 1;
  std::vector<double> turn(patch.x.size(), 0);
  for (const Corners& c : patch.corners)
    for (int k = 0; k < 3; ++k)
      if (is_rim[c[k]] != 0)
        turn[c[k]] += angle_between(patch.x[c[(k + 1) % 3]] - patch.x[c[k]], patch.x[c[(k + 2) % 3]] - patch.x[c[k]]);
  std::int32_t sharpest = kNone;
  double most = kSharpRim;
  for (const auto& loop : topology.loops)
    for (const std::int32_t n : loop)
      if (turn[n] > most) most = turn[n], sharpest = n;
  return sharpest;
}

struct CutPlane {
  Vec3 axis;  ///< unit
  double place;
  double least, longest;  ///< of heights()

  std::vector<double> heights_of(const FacetPatch& patch) const { return heights(patch, axis, place, least, longest); }
};

/// Through the node `sharpest` if there is one, or such that it parts `knives` if they are given. nullopt where every
/// plane leaves all on one side, or no knife side is parted.
std::optional<CutPlane> best_cut(const FacetPatch& patch, const PatchTopology& topology, std::int32_t sharpest,
                                 const KnifeSides* knives) {
  const Spread spread = spread_of(patch);
  const CutCost cost_of(patch, topology);
  Box3 box;
  for (const Vec3 x : patch.x) box.add(x);
  const double longest = longest_side(patch);
  std::optional<CutPlane> best;
  double least = kInfinite;
  for (const Vec3 axis : candidate_axes(spread)) {
    double low = kInfinite, high = -kInfinite;
    for (const Vec3 x : patch.x) low = std::min(low, dot(x, axis)), high = std::max(high, dot(x, axis));
    if (high - low < kFlatBox * box.diagonal()) continue;
    std::vector<double> places;
    if (sharpest != kNone) places.push_back(dot(patch.x[sharpest], axis));
    if (sharpest == kNone || knives) std::ranges::copy(candidate_places(spread, axis), std::back_inserter(places));
    for (const double place : places) {
      const CutPlane plane{axis, place, kRounding * box.diagonal(), longest};
      const std::vector<double> height = plane.heights_of(patch);
      const double cost = cost_of(height);
      if (cost < least && (!knives || knives->are_parted_by(height))) least = cost, best = plane;
    }
  }
  return best;
}

/// A large patch with a sharp rim is not coarsened: only a plane has a map then.
std::optional<std::vector<Vec2>> lay_flat(const FacetPatch& patch, const PatchTopology& topology, bool has_sharp_rim) {
  if (patch.corners.size() <= kSolved) return flatten(patch.x, patch.corners, topology);
  if (has_sharp_rim && !is_disc_with_holes(topology)) return std::nullopt;
  if (has_sharp_rim) return unroll(patch.x, patch.corners, topology);
  if (auto uv = flatten_coarse(patch.x, patch.corners, topology)) return uv;
  return flatten(patch.x, patch.corners, topology);
}

/// A piece with its parameters, or with the plane that cuts it; with neither where no plane helps.
struct Piece {
  FacetPatch patch;
  int n_cuts_left;
  std::optional<std::vector<Vec2>> uv;
  std::optional<CutPlane> plane;

  void work() {
    const PatchTopology topology = find_topology(patch.x, patch.corners, patch.neighbours);
    const std::int32_t sharpest = sharpest_rim_node(patch, topology);
    const KnifeSides knives(patch);
    if (knives.any() && n_cuts_left > 0 && !is_folded(patch)) plane = best_cut(patch, topology, sharpest, &knives);
    if (plane) return;
    uv = lay_flat(patch, topology, sharpest != kNone);
    if (!uv && patch.corners.size() == 1) uv = lay_alone();
    if (!uv && n_cuts_left > 0 && !is_folded(patch)) plane = best_cut(patch, topology, sharpest, nullptr);
  }

  std::vector<Vec2> lay_alone() const {
    const Corners& c = patch.corners.front();
    const std::array<Vec2, 3> place = lay_triangle(patch.x[c[0]], patch.x[c[1]], patch.x[c[2]]);
    std::vector<Vec2> result(3);
    for (int k = 0; k < 3; ++k) result[c[k]] = place[k];
    return result;
  }
};

/// Cuts in rounds: all pieces are worked on, by several threads, then those without parameters are cut one by one.
class Cutter {
 public:
  explicit Cutter(FacetMesh& mesh) : mesh_(mesh), finder_(mesh), divider_(mesh) {}

  void run() {
    const std::int32_t n_regions = 1 + *std::max_element(mesh_.face.begin(), mesh_.face.end());
    std::vector<Group> groups(static_cast<std::size_t>(n_regions));
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t) groups[mesh_.face[t]].triangles.push_back(t);
    for (Group& region : groups)
      region.n_cuts_left = kMostCuts + static_cast<int>(std::bit_width(region.triangles.size()) / 2);
    while (!groups.empty()) groups = run_round(std::move(groups));
    number_charts();
  }

 private:
  /// Triangles that hang together or not.
  struct Group {
    std::vector<std::int32_t> triangles;
    std::int32_t parent = kNone;  ///< number of the piece that was cut
    int n_cuts_left = 0;          ///< by planes; a fold stays, however small the pieces are
  };

  std::vector<Group> run_round(std::vector<Group> groups) {
    std::vector<std::vector<Piece>> pieces(groups.size());
    parallel_for(groups.size(), 1 + groups.size() / kFinders, [&](std::size_t begin, std::size_t end) {
      PatchFinder finder(mesh_);
      for (std::size_t g = begin; g < end; ++g) {
        for (FacetPatch& patch : finder.find(std::move(groups[g].triangles)))
          pieces[g].push_back({std::move(patch), groups[g].n_cuts_left, {}, {}});
        parallel_for(pieces[g].size(), 1, [&](std::size_t i, std::size_t) { pieces[g][i].work(); });
      }
    });
    const auto first = static_cast<std::int32_t>(parent_.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (Piece& piece : pieces[g]) take(piece, groups[g].parent);
    std::vector<Group> next;
    std::int32_t number = first;
    for (std::vector<Piece>& of_group : pieces)
      for (Piece& piece : of_group) {
        if (!is_chart_[number]) next.push_back(cut(std::exchange(piece, {}), number));
        ++number;
      }
    for (Group& group : next) {
      const std::vector<std::int32_t> added = std::exchange(added_[group.parent], {});
      group.triangles.insert(group.triangles.end(), added.begin(), added.end());
    }
    return next;
  }

  /// As the next number.
  void take(Piece& piece, std::int32_t parent) {
    const FacetPatch& patch = piece.patch;
    for (const std::int32_t t : patch.triangles) mesh_.face[t] = static_cast<std::int32_t>(parent_.size());
    parent_.push_back(parent);
    is_chart_.push_back(piece.uv ? 1 : 0);
    added_.emplace_back();
    if (!piece.uv) return;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) mesh_.uv[patch.triangles[i]][k] = (*piece.uv)[patch.corners[i][k]];
    piece = {};
  }

  /// What it is after that. Without a plane it is parted along sides of its triangles.
  Group cut(Piece piece, std::int32_t number) {
    FacetPatch& patch = piece.patch;
    if (!added_[number].empty()) {  // cuts of others have divided triangles at its rim
      std::vector<std::int32_t> triangles = std::exchange(added_[number], {});
      triangles.insert(triangles.end(), patch.triangles.begin(), patch.triangles.end());
      patch = std::move(finder_.find(std::move(triangles)).front());
    }
    Group after{{}, number, piece.n_cuts_left - (piece.plane ? 1 : 0)};
    const std::int32_t n_before = mesh_.n_triangles();
    if (piece.plane)
      divider_.divide(patch, piece.plane->heights_of(patch));
    else
      divider_.part(patch, part_by_normals(patch));
    after.triangles = std::move(patch.triangles);
    for (std::int32_t t = n_before; t < mesh_.n_triangles(); ++t)
      (mesh_.face[t] == number ? after.triangles : added_[mesh_.face[t]]).push_back(t);
    return after;
  }

  /// The first region first; of the parts of a piece the last one.
  void number_charts() {
    std::vector<std::vector<std::int32_t>> parts(parent_.size());
    std::vector<std::int32_t> open, chart(parent_.size(), kNone);
    for (std::size_t i = parent_.size(); i-- > 0;)
      if (parent_[i] == kNone) open.push_back(static_cast<std::int32_t>(i));
    for (std::size_t i = 0; i < parent_.size(); ++i)
      if (parent_[i] != kNone) parts[parent_[i]].push_back(static_cast<std::int32_t>(i));
    std::int32_t n_charts = 0;
    while (!open.empty()) {
      const std::int32_t piece = open.back();
      open.pop_back();
      if (is_chart_[piece]) chart[piece] = n_charts++;
      open.insert(open.end(), parts[piece].begin(), parts[piece].end());
    }
    for (std::int32_t& face : mesh_.face) face = chart[face];
  }

  static constexpr std::size_t kFinders = 64;  // at most so many at once: each knows all nodes

  FacetMesh& mesh_;
  PatchFinder finder_;
  PatchDivider divider_;
  std::vector<std::int32_t> parent_;              // of each piece; kNone: it is of a region
  std::vector<std::uint8_t> is_chart_;            // pieces with parameters
  std::vector<std::vector<std::int32_t>> added_;  // triangles that cuts of others made of theirs in this round
};

}  // namespace

void cut_into_charts(FacetMesh& mesh) { Cutter(mesh).run(); }

}  // namespace st
