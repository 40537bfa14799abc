#include "mesh/triangle_tree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>

#include "base/assert.h"
#include "base/threads.h"
#include "mesh/float_box.h"

namespace st {
namespace {

/// Rounding to nearest is monotonic: boxes that meet in double precision meet here.
FloatBox rounded(const Box3& box) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {{f(box.lo.x), f(box.lo.y), f(box.lo.z)}, {f(box.hi.x), f(box.hi.y), f(box.hi.z)}};
}

// --- normals ---

/// What holds for all triangles of a set: one bit per direction within 60 degrees of all normals, and kOld.
using Common = std::uint32_t;

constexpr Common kOld = Common{1} << 31;  // were there before

constexpr float kMinCosine = 0.5f;  // of the angle between a normal and a direction: 60 degrees, the bound of a narrow
                                    // cone
constexpr double kSurelyHasArea = 1e-10;  // twice the area over the product of two sides: far above rounding
constexpr int kAxes = 13;  // through the faces, edges and corners of a cube; a cone of 33 degrees always fits one
constexpr float kEdge = 0.70710678f, kCorner = 0.57735027f;
constexpr FourFloats kAxisX[] = {{1, 0, 0, kEdge}, {kEdge, kEdge, kEdge, 0}, {0, kCorner, kCorner, kCorner}, {kCorner}};
constexpr FourFloats kAxisY[] = {
    {0, 1, 0, kEdge}, {-kEdge, 0, 0, kEdge}, {kEdge, kCorner, kCorner, -kCorner}, {-kCorner}};
constexpr FourFloats kAxisZ[] = {
    {0, 0, 1, 0}, {0, kEdge, -kEdge, kEdge}, {-kEdge, kCorner, -kCorner, kCorner}, {-kCorner}};

/// What holds for all triangles of an empty set.
constexpr Common kEverything = kOld | ((Common{1} << 2 * kAxes) - 1);

Common directions_near(Vec3 unit_normal) {
  const auto x = static_cast<float>(unit_normal.x), y = static_cast<float>(unit_normal.y),
             z = static_cast<float>(unit_normal.z);
  Common near = 0, opposite = 0;
  for (int k = 0; k < 4; ++k) {
    const FourFloats cosine = kAxisX[k] * x + kAxisY[k] * y + kAxisZ[k] * z;
    near |= bits_of(cosine > kMinCosine) << 4 * k;
    opposite |= bits_of(cosine < -kMinCosine) << 4 * k;
  }
  return near | opposite << kAxes;
}

/// A triangle's normal, not of unit length.
struct Normal {
  Vec3 way;
  double length2;
  /// nullopt where the triangle has no area.
  static std::optional<Normal> of(const TriangleGroups& mesh, TriangleId t) {
    const Triangle& tri = mesh.triangles[t];
    const Vec3 a = mesh.points[tri.n[0]], b = mesh.points[tri.n[1]], c = mesh.points[tri.n[2]];
    const Vec3 way = cross(b - a, c - a);
    const double length2 = norm2(way);
    const bool has_area =
        length2 > kSurelyHasArea * kSurelyHasArea * norm2(b - a) * norm2(c - a) || !is_degenerate(mesh.points, tri);
    return has_area ? std::optional(Normal{way, length2}) : std::nullopt;
  }
  bool has_direction() const { return length2 > 0; }
  Vec3 unit() const { return way / std::sqrt(length2); }
};

Common age_of(const TriangleGroups& mesh, TriangleId t) {
  return mesh.previous.empty() || mesh.previous[t] == kNone ? 0 : kOld;
}

constexpr TriangleId kTrianglesPerPiece = 16'384;

/// Whether WithinGroup::kUnlessAlike compares none within a group: nearly all groups, which need no tree then.
bool are_alike(const TriangleGroups& mesh, std::int32_t group) {
  const TriangleId first = mesh.begin[group], n = mesh.begin[group + 1] - first;
  std::vector<Common> pieces(static_cast<std::size_t>((n + kTrianglesPerPiece - 1) / kTrianglesPerPiece), kEverything);
  parallel_for(static_cast<std::size_t>(n), kTrianglesPerPiece, [&](std::size_t begin, std::size_t end) {
    Common common = kEverything;
    for (std::size_t i = begin; i < end && common != 0; ++i) {
      const TriangleId t = first + static_cast<TriangleId>(i);
      const std::optional<Normal> normal = Normal::of(mesh, t);
      if (!normal) continue;
      const Common age = common & age_of(mesh, t);
      common &= age | (normal->has_direction() ? directions_near(normal->unit()) : 0);
    }
    pieces[begin / kTrianglesPerPiece] = common;
  });
  Common all = kEverything;
  for (const Common piece : pieces) all &= piece;
  return all != 0;
}

// --- what a search has found ---

/// What a search has found so far, and for how much work.
class PairSearch {
 public:
  explicit PairSearch(std::int64_t most) : most_(most) {}

  void count(std::int64_t n_boxes) { n_compared_ += n_boxes; }
  bool is_over() const { return n_compared_ > most_; }
  /// Adds the pair where it crosses.
  void test(std::span<const Vec3> points, std::span<const Triangle> triangles, TriangleId s, TriangleId t) {
    constexpr std::int64_t kPerTest = 16;   // comparisons of boxes: an exact test takes as long
    constexpr std::int64_t kPerPair = 600;  // likewise: a pair takes memory, too
    n_compared_ += kPerTest;
    const auto [a, b] = std::minmax(s, t);
    int n_shared = 0;
    if (!triangles_cross(points, triangles[a], triangles[b], n_shared)) return;
    n_compared_ += kPerPair;
    pairs_.push_back({a, b, n_shared});
  }

  std::int64_t n_compared() const { return n_compared_; }
  const std::vector<TrianglePair>& pairs() const { return pairs_; }

 private:
  std::int64_t most_, n_compared_ = 0;
  std::vector<TrianglePair> pairs_;
};

// --- a tree per group, built while it is descended ---

struct Item {
  FloatBox box;
  Common common;
  TriangleId id;
};

struct TreeNode {
  FloatBox box;
  Common common;            ///< of all triangles below
  std::int32_t begin, end;  ///< range of items
  std::int32_t left;        ///< first of two children; kNone: not split (yet). Read and written as an atomic
  std::int32_t size() const { return end - begin; }
};

/// An item or a node that is compared with others.
class Compared {
 public:
  explicit Compared(const auto& part) : box_(part.box), common_(part.common) {}
  bool is_to_compare(const auto& other) const { return box_.meets(other.box) && (common_ & other.common & kOld) == 0; }

 private:
  ComparedBox box_;
  Common common_;
};
bool are_to_compare(const TreeNode& a, const TreeNode& b) { return Compared(a).is_to_compare(b); }

/// Several threads may test at once. Who first needs the children of a node makes them, alone; leaves never change.
class TriangleTrees {
 public:
  /// Trees of some groups, by `is_wanted` [n_groups].
  TriangleTrees(const TriangleGroups& groups, WithinGroup rule, const std::vector<char>& is_wanted)
      : mesh_(groups),
        rule_(rule),
        n_groups_(static_cast<std::int32_t>(groups.begin.size()) - 1),
        items_(new Item[groups.triangles.size()]),
        nodes_(new TreeNode[n_groups_ + 2 * groups.triangles.size()]),  // a node has two children, none of them empty
        n_nodes_(n_groups_),
        n_locks_(std::min(kMostLocks, 1 + groups.triangles.size() / kTrianglesPerLock)),
        locks_(new std::mutex[n_locks_]) {
    std::vector<Piece> pieces;
    for (std::int32_t g = 0; g < n_groups_; ++g) {
      const TriangleId end = is_wanted[g] ? groups.begin[g + 1] : 0;
      for (TriangleId t = groups.begin[g]; t < end; t += kTrianglesPerPiece)
        pieces.push_back({g, t, std::min(end, t + kTrianglesPerPiece), {}});
      nodes_[g] = {{}, 0, groups.begin[g], groups.begin[g], kNone};
    }
    parallel_for(pieces.size(), 1, [&](std::size_t i, std::size_t) { make_items(pieces[i]); });
    for (const Piece& piece : pieces) add_to_root(piece);
  }

  /// Nodes to be tested: within one, or between two. Node g is the root of group g.
  using Job = std::pair<std::int32_t, std::int32_t>;
  /// What is to be tested of these, as many small jobs.
  std::vector<Job> split_jobs(std::vector<Job> jobs) {
    std::vector<Job> small;
    while (!jobs.empty()) {
      const auto large = std::partition(jobs.begin(), jobs.end(), [&](const Job& job) { return !is_large(job); });
      small.insert(small.end(), jobs.begin(), large);
      jobs.erase(jobs.begin(), large);
      std::vector<std::vector<Job>> parts(jobs.size());
      parallel_for(jobs.size(), 1, [&](std::size_t i, std::size_t) { parts[i] = parts_of(jobs[i]); });
      jobs.clear();
      for (const std::vector<Job>& p : parts) jobs.insert(jobs.end(), p.begin(), p.end());
    }
    return small;
  }
  void test(const Job& job, PairSearch& found) {
    job.first == job.second ? test_within(job.first, found) : test_between(job.first, job.second, found);
  }

 private:
  bool is_large(const Job& job) const { return nodes_[job.first].size() + nodes_[job.second].size() > kLargeJob; }

  /// Of a large job: the same comparisons but one step down the trees, without those that need none.
  std::vector<Job> parts_of(Job job) {
    if (job.first == job.second) {
      if (nodes_[job.first].common != 0) return {};
      const std::int32_t left = split(job.first);
      return {{left, left}, {left + 1, left + 1}, {left, left + 1}};
    }
    if (!are_to_compare(nodes_[job.first], nodes_[job.second])) return {};
    const auto [left, other] = split_larger(job);
    return {{left, other}, {left + 1, other}};
  }

  /// The first child of the node of larger extent, or of the other one where that is a leaf, and the node that stays.
  std::pair<std::int32_t, std::int32_t> split_larger(Job job) {
    if (nodes_[job.first].box.extent() < nodes_[job.second].box.extent()) std::swap(job.first, job.second);
    if (const std::int32_t left = split(job.first); left != kNone) return {left, job.second};
    return {split(job.second), job.first};
  }

  void test_within(std::int32_t n, PairSearch& found) {
    if (nodes_[n].common != 0 || nodes_[n].size() < 2) return;
    const std::int32_t left = split(n);
    if (left == kNone) {
      for (std::int32_t i = nodes_[n].begin; i < nodes_[n].end; ++i) test_item(i, i + 1, nodes_[n].end, found);
      return;
    }
    test_within(left, found);
    test_within(left + 1, found);
    test_between(left, left + 1, found);
  }
  void test_between(std::int32_t a, std::int32_t b, PairSearch& found) {
    found.count(1);
    if (!are_to_compare(nodes_[a], nodes_[b]) || found.is_over()) return;
    if (const auto [left, other] = split_larger({a, b}); left != kNone) {
      test_between(left, other, found);
      test_between(left + 1, other, found);
      return;
    }
    const TreeNode &first = nodes_[a], &second = nodes_[b];
    const Compared with_second(second);
    for (std::int32_t i = first.begin; i < first.end; ++i)
      if (with_second.is_to_compare(items_[i])) test_item(i, second.begin, second.end, found);
  }

  static constexpr std::int32_t kLeafSize = 12;
  static constexpr std::int32_t kLargeJob = 20'000;  // triangles: tested by several threads
  static constexpr std::int32_t kMaxLopsided = 8;    // a part smaller than 1/8 of the whole is no split
  static constexpr std::size_t kMostLocks = 256, kTrianglesPerLock = 256;

  /// Without an id where the triangle has no area.
  Item item_of(TriangleId t) const {
    const std::optional<Normal> normal = Normal::of(mesh_, t);
    if (!normal) return {{}, 0, kNone};
    Box3 box;
    for (const NodeId n : mesh_.triangles[t].n) box.add(mesh_.points[n]);
    const bool has_directions = rule_ == WithinGroup::kUnlessAlike && normal->has_direction();
    return {rounded(box), age_of(mesh_, t) | (has_directions ? directions_near(normal->unit()) : 0), t};
  }

  /// Triangles [begin, end) of a group, and the node over their items, which are at the places of the first of them.
  struct Piece {
    std::int32_t group;
    TriangleId begin, end;
    TreeNode node;
  };

  void make_items(Piece& piece) {
    for (TriangleId t = piece.begin; t < piece.end; ++t) items_[t] = item_of(t);
    Item *first = items_.get() + piece.begin, *last = items_.get() + piece.end;
    last = std::remove_if(first, last, [](const Item& i) { return i.id == kNone; });
    piece.node = node_over(piece.begin, static_cast<std::int32_t>(last - items_.get()));
  }

  /// Pieces of a group come in their order.
  void add_to_root(const Piece& piece) {
    TreeNode& root = nodes_[piece.group];
    if (piece.node.size() == 0) return;
    if (root.end != piece.node.begin)
      std::copy_n(items_.get() + piece.node.begin, piece.node.size(), items_.get() + root.end);
    if (root.size() == 0) {
      root.box = piece.node.box;
      root.common = piece.node.common;
    } else {
      root.box.add(piece.node.box);
      root.common &= piece.node.common;
    }
    root.end += piece.node.size();
  }

  TreeNode node_over(std::int32_t begin, std::int32_t end) const {
    if (begin == end) return {{}, 0, begin, end, kNone};
    BoxOverBoxes box(items_[begin].box);
    Common common = items_[begin].common;
    for (std::int32_t i = begin + 1; i < end; ++i) box.add(items_[i].box), common &= items_[i].common;
    return {box.box(), common, begin, end, kNone};
  }

  /// The first child of the node, made where it is not there yet; kNone for a leaf. Halves the box, or the items where
  /// that would leave a small part.
  std::int32_t split(std::int32_t n) {
    TreeNode& node = nodes_[n];
    if (node.size() <= kLeafSize) return kNone;
    const std::atomic_ref left(node.left);
    if (const std::int32_t known = left.load(std::memory_order_acquire); known != kNone) return known;
    const std::lock_guard lock(locks_[static_cast<std::size_t>(n) % n_locks_]);
    if (const std::int32_t known = left.load(std::memory_order_acquire); known != kNone) return known;
    const int axis = node.box.longest_axis();
    const auto key = [axis](const FloatBox& box) { return box.lo[axis] + box.hi[axis]; };
    Item *first = &items_[node.begin], *last = first + node.size();
    Item* middle = std::partition(first, last, [&, at = key(node.box)](const Item& i) { return key(i.box) < at; });
    if (std::min(middle - first, last - middle) * kMaxLopsided < node.size()) {
      middle = first + node.size() / 2;
      std::nth_element(first, middle, last, [&](const Item& i, const Item& j) {
        return std::pair(key(i.box), i.id) < std::pair(key(j.box), j.id);
      });
    }
    const auto at = static_cast<std::int32_t>(middle - items_.get());
    const std::int32_t child = n_nodes_.fetch_add(2);
    nodes_[child] = node_over(node.begin, at);
    nodes_[child + 1] = node_over(at, node.end);
    left.store(child, std::memory_order_release);
    return child;
  }

  /// Compares item i with the items [begin, end).
  void test_item(std::int32_t i, std::int32_t begin, std::int32_t end, PairSearch& found) const {
    found.count(end - begin);
    const Compared item(items_[i]);
    for (std::int32_t j = begin; j < end; ++j)
      if (item.is_to_compare(items_[j])) found.test(mesh_.points, mesh_.triangles, items_[i].id, items_[j].id);
  }

  const TriangleGroups& mesh_;
  const WithinGroup rule_;
  const std::int32_t n_groups_;
  std::unique_ptr<Item[]> items_;      // by group: where its triangles are
  std::unique_ptr<TreeNode[]> nodes_;  // memory that is not used is never touched
  std::atomic<std::int32_t> n_nodes_;
  const std::size_t n_locks_;
  std::unique_ptr<std::mutex[]> locks_;
};

/// Runs search(i, PairSearch&) for i in [0, n), on all threads, until all together took more than `most` comparisons;
/// each should end when it is_over(). What counts are the first searches that are enough for that, so the result does
/// not depend on the number of threads: their pairs, sorted by (a, b).
template <class Search>
std::vector<TrianglePair> find_bounded(std::size_t n, std::int64_t most, bool& was_ended, std::int64_t& n_compared,
                                       const Search& search) {
  std::vector<PairSearch> parts(n, PairSearch(most));
  std::vector<char> is_done(n, 0);
  std::atomic<std::int64_t> sum = 0;
  parallel_for(n, 1, [&](std::size_t i, std::size_t) {
    if (sum > most) return;
    search(i, parts[i]);
    is_done[i] = 1;
    sum += parts[i].n_compared();
  });
  std::vector<TrianglePair> pairs;
  n_compared = 0;
  for (std::size_t i = 0; i < n && n_compared <= most; ++i) {
    if (!is_done[i]) search(i, parts[i]);  // one that a later one overtook
    n_compared += parts[i].n_compared();
    pairs.insert(pairs.end(), parts[i].pairs().begin(), parts[i].pairs().end());
  }
  was_ended = n_compared > most;
  std::sort(pairs.begin(), pairs.end(),
            [](const TrianglePair& x, const TrianglePair& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  return pairs;
}

}  // namespace

std::vector<TrianglePair> find_pairs(const TriangleGroups& groups, WithinGroup rule,
                                     std::vector<std::pair<std::int32_t, std::int32_t>> searches, bool& was_ended,
                                     std::int64_t* n_compared) {
  constexpr std::size_t kJobsPerPiece = 4;
  was_ended = false;
  std::int64_t n_own = 0;
  std::int64_t& n_all = n_compared ? *n_compared : n_own;
  if (rule == WithinGroup::kUnlessAlike && searches.size() == 1 && searches[0].first == searches[0].second &&
      are_alike(groups, searches[0].first))
    return {};
  std::vector<char> is_wanted(groups.begin.size() - 1, 0);
  for (const auto& [g, h] : searches) is_wanted[g] = is_wanted[h] = 1;
  TriangleTrees trees(groups, rule, is_wanted);
  const std::vector<TriangleTrees::Job> jobs = trees.split_jobs(std::move(searches));
  const std::size_t n_pieces = (jobs.size() + kJobsPerPiece - 1) / kJobsPerPiece;
  return find_bounded(n_pieces, most_comparisons(groups.triangles.size()), was_ended, n_all,
                      [&](std::size_t piece, PairSearch& found) {
                        const std::size_t begin = piece * kJobsPerPiece;
                        for (std::size_t i = begin; i < std::min(begin + kJobsPerPiece, jobs.size()); ++i)
                          trees.test(jobs[i], found);
                      });
}

}  // namespace st
