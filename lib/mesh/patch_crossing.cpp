#include "mesh/patch_crossing.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include "base/assert.h"
#include "base/threads.h"
#include "mesh/float_box.h"
#include "mesh/pair_search.h"
#include "mesh/patch_blocks.h"

namespace st {
namespace {

/// Rounding to nearest is monotonic: boxes that meet in double precision meet here.
FloatBox rounded(const Box3& box) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {{f(box.lo.x), f(box.lo.y), f(box.lo.z)}, {f(box.hi.x), f(box.hi.y), f(box.hi.z)}};
}

// --- normals ---

/// One bit per direction that a set of normals agrees with: of all normals within 60 degrees.
using Directions = std::uint32_t;

constexpr float kMinCosine = 0.5f;  // of the angle between a normal and a direction: 60 degrees, the bound of a narrow
                                    // cone
constexpr double kSurelyHasArea = 1e-10;  // twice the area over the product of two sides: far above rounding
constexpr int kAxes = 13;  // through the faces, edges and corners of a cube; a cone of 33 degrees always fits one
constexpr float kEdge = 0.70710678f, kCorner = 0.57735027f;
constexpr float kAxisX[kAxes] = {1, 0, 0, kEdge, kEdge, kEdge, kEdge, 0, 0, kCorner, kCorner, kCorner, kCorner};
constexpr float kAxisY[kAxes] = {0, 1, 0, kEdge, -kEdge, 0, 0, kEdge, kEdge, kCorner, kCorner, -kCorner, -kCorner};
constexpr float kAxisZ[kAxes] = {0, 0, 1, 0, 0, kEdge, -kEdge, kEdge, -kEdge, kCorner, -kCorner, kCorner, -kCorner};

Directions directions_near(Vec3 unit_normal) {
  const auto x = static_cast<float>(unit_normal.x), y = static_cast<float>(unit_normal.y),
             z = static_cast<float>(unit_normal.z);
  Directions near = 0;
  for (int k = 0; k < kAxes; ++k) {
    const float cosine = kAxisX[k] * x + kAxisY[k] * y + kAxisZ[k] * z;
    near |= static_cast<Directions>(cosine > kMinCosine) << k | static_cast<Directions>(cosine < -kMinCosine)
                                                                    << (k + kAxes);
  }
  return near;
}

// --- a tree per face, built while it is descended ---

struct Item {
  FloatBox box;
  Directions near;
  TriangleId id;
};

struct TreeNode {
  FloatBox box;
  Directions near;          ///< directions that all triangles below agree with
  std::int32_t begin, end;  ///< range of items
  std::int32_t left;        ///< first of two children; kNone: not split (yet). Read and written as an atomic
  std::int32_t size() const { return end - begin; }
};

/// Several threads may test at once. Who first needs the children of a node makes them, alone; leaves never change.
class Forest {
 public:
  /// Trees of some faces, by `is_wanted` [n_faces].
  Forest(const PatchTriangles& mesh, const std::vector<char>& is_wanted)
      : mesh_(mesh),
        n_faces_(static_cast<std::int32_t>(mesh.face_begin.size()) - 1),
        items_(new Item[mesh.triangles.size()]),
        nodes_(new TreeNode[n_faces_ + 2 * mesh.triangles.size()]),  // a node has two children, none of them empty
        n_nodes_(n_faces_) {
    std::vector<Piece> pieces;
    for (FaceId f = 0; f < n_faces_; ++f) {
      const TriangleId end = is_wanted[f] ? mesh.face_begin[f + 1] : 0;
      for (TriangleId t = mesh.face_begin[f]; t < end; t += kItemsPerPiece)
        pieces.push_back({f, t, std::min(end, t + kItemsPerPiece), {}});
      nodes_[f] = {{}, 0, mesh.face_begin[f], mesh.face_begin[f], kNone};
    }
    parallel_for(pieces.size(), 1, [&](std::size_t i, std::size_t) { make_items(pieces[i]); });
    for (const Piece& piece : pieces) add_to_root(piece);
  }

  /// Nodes to be tested: within one, or between two.
  struct Job {
    std::int32_t a, b;
  };
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
    job.a == job.b ? test_within(job.a, found) : test_between(job.a, job.b, found);
  }

 private:
  bool is_large(const Job& job) const { return nodes_[job.a].size() + nodes_[job.b].size() > kLargeJob; }

  /// Of a large job: the same comparisons but one step down the trees, without those that need none.
  std::vector<Job> parts_of(Job job) {
    if (job.a == job.b) {
      if (nodes_[job.a].near != 0) return {};
      const std::int32_t left = split(job.a);
      return {{left, left}, {left + 1, left + 1}, {left, left + 1}};
    }
    if (!nodes_[job.a].box.meets(nodes_[job.b].box)) return {};
    const auto [left, other] = split_larger(job);
    return {{left, other}, {left + 1, other}};
  }

  /// The first child of the node of larger extent, or of the other one where that is a leaf, and the node that stays.
  std::pair<std::int32_t, std::int32_t> split_larger(Job job) {
    if (nodes_[job.a].box.extent() < nodes_[job.b].box.extent()) std::swap(job.a, job.b);
    if (const std::int32_t left = split(job.a); left != kNone) return {left, job.b};
    return {split(job.b), job.a};
  }

  void test_within(std::int32_t n, PairSearch& found) {
    if (nodes_[n].near != 0 || nodes_[n].size() < 2) return;
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
    if (!nodes_[a].box.meets(nodes_[b].box) || found.is_over()) return;
    if (const auto [left, other] = split_larger({a, b}); left != kNone) {
      test_between(left, other, found);
      test_between(left + 1, other, found);
      return;
    }
    for (std::int32_t i = nodes_[a].begin; i < nodes_[a].end; ++i)
      if (items_[i].box.meets(nodes_[b].box)) test_item(i, nodes_[b].begin, nodes_[b].end, found);
  }

  static constexpr std::int32_t kLeafSize = 12;
  static constexpr std::int32_t kLargeJob = 20'000;  // triangles: tested by several threads
  static constexpr std::int32_t kMaxLopsided = 8;    // a part smaller than 1/8 of the whole is no split
  static constexpr TriangleId kItemsPerPiece = 16'384;
  static constexpr std::size_t kLocks = 256;

  /// Without an id where the triangle has no area.
  Item item_of(TriangleId t) const {
    const Triangle& tri = mesh_.triangles[t];
    const Vec3 a = mesh_.points[tri.n[0]], b = mesh_.points[tri.n[1]], c = mesh_.points[tri.n[2]];
    const Vec3 normal = cross(b - a, c - a);
    const double length2 = norm2(normal);
    if (!(length2 > kSurelyHasArea * kSurelyHasArea * norm2(b - a) * norm2(c - a)) && is_degenerate(mesh_.points, tri))
      return {{}, 0, kNone};
    Box3 box{a, a};
    box.add(b);
    box.add(c);
    return {rounded(box), length2 > 0 ? directions_near(normal / std::sqrt(length2)) : 0, t};
  }

  /// Triangles [begin, end) of a face, and the node over their items, which are at the places of the first of them.
  struct Piece {
    FaceId face;
    TriangleId begin, end;
    TreeNode node;
  };

  void make_items(Piece& piece) {
    for (TriangleId t = piece.begin; t < piece.end; ++t) items_[t] = item_of(t);
    Item *first = items_.get() + piece.begin, *last = items_.get() + piece.end;
    last = std::remove_if(first, last, [](const Item& i) { return i.id == kNone; });
    piece.node = node_over(piece.begin, static_cast<std::int32_t>(last - items_.get()));
  }

  /// Pieces of a face come in their order.
  void add_to_root(const Piece& piece) {
    TreeNode& root = nodes_[piece.face];
    if (piece.node.size() == 0) return;
    if (root.end != piece.node.begin)
      std::copy_n(items_.get() + piece.node.begin, piece.node.size(), items_.get() + root.end);
    if (root.size() == 0) {
      root.box = piece.node.box;
      root.near = piece.node.near;
    } else {
      root.box.add(piece.node.box);
      root.near &= piece.node.near;
    }
    root.end += piece.node.size();
  }

  TreeNode node_over(std::int32_t begin, std::int32_t end) const {
    if (begin == end) return {{}, 0, begin, end, kNone};
    TreeNode node{items_[begin].box, items_[begin].near, begin, end, kNone};
    for (std::int32_t i = begin + 1; i < end; ++i) node.box.add(items_[i].box), node.near &= items_[i].near;
    return node;
  }

  /// The first child of the node, made where it is not there yet; kNone for a leaf. Halves the box, or the items where
  /// that would leave a small part.
  std::int32_t split(std::int32_t n) {
    TreeNode& node = nodes_[n];
    if (node.size() <= kLeafSize) return kNone;
    const std::atomic_ref left(node.left);
    if (const std::int32_t known = left.load(std::memory_order_acquire); known != kNone) return known;
    const std::lock_guard lock(locks_[n % kLocks]);
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
    for (std::int32_t j = begin; j < end; ++j)
      if (items_[i].box.meets(items_[j].box)) found.test(mesh_.points, mesh_.triangles, items_[i].id, items_[j].id);
  }

  const PatchTriangles& mesh_;
  const std::int32_t n_faces_;
  std::unique_ptr<Item[]> items_;      // by face: where its triangles are
  std::unique_ptr<TreeNode[]> nodes_;  // node f is the root of face f; memory that is not used is never touched
  std::atomic<std::int32_t> n_nodes_;
  std::array<std::mutex, kLocks> locks_;
};

/// Of the triangles of each face.
std::vector<Box3> boxes_of_faces(const PatchTriangles& mesh) {
  std::vector<Box3> boxes(mesh.face_body.size());
  parallel_for(boxes.size(), 1, [&](std::size_t f, std::size_t) {
    for (TriangleId t = mesh.face_begin[f]; t < mesh.face_begin[f + 1]; ++t)
      for (const NodeId n : mesh.triangles[t].n) boxes[f].add(mesh.points[n]);
  });
  return boxes;
}

/// The pairs that these tests find, sorted. `is_wanted` [n_faces]: the faces of the jobs.
std::vector<TrianglePair> find_pairs(const PatchTriangles& mesh, const std::vector<char>& is_wanted,
                                     std::vector<Forest::Job> jobs, bool& was_ended) {
  Forest forest(mesh, is_wanted);
  jobs = forest.split_jobs(std::move(jobs));
  constexpr std::size_t kJobsPerPiece = 4;
  const std::size_t n_pieces = (jobs.size() + kJobsPerPiece - 1) / kJobsPerPiece;
  return find_bounded(n_pieces, most_comparisons(mesh.triangles.size()), was_ended,
                      [&](std::size_t piece, PairSearch& found) {
                        const std::size_t begin = piece * kJobsPerPiece;
                        for (std::size_t i = begin; i < std::min(begin + kJobsPerPiece, jobs.size()); ++i)
                          forest.test(jobs[i], found);
                      });
}

}  // namespace

std::vector<TrianglePair> find_crossing_patches(const PatchTriangles& mesh) {
  bool was_ended = false;
  return find_crossing_patches(mesh, was_ended);
}

std::vector<TrianglePair> find_crossing_patches(const PatchTriangles& mesh, bool& was_ended) {
  ST_ASSERT(mesh.face_begin.size() == mesh.face_body.size() + 1 && mesh.face_begin.front() == 0);
  ST_ASSERT(std::is_sorted(mesh.face_begin.begin(), mesh.face_begin.end()));
  ST_ASSERT(static_cast<std::size_t>(mesh.face_begin.back()) == mesh.triangles.size());
  ST_ASSERT(mesh.face_is_dirty.empty() || mesh.face_is_dirty.size() == mesh.face_body.size());
  const auto n_faces = static_cast<FaceId>(mesh.face_body.size());
  const auto is_dirty = [&](FaceId f) { return mesh.face_is_dirty.empty() || mesh.face_is_dirty[f]; };
  std::vector<Forest::Job> jobs;
  std::vector<char> is_wanted(mesh.face_body.size(), 0);
  const auto add = [&](FaceId f, FaceId g) {
    jobs.push_back({f, g});
    is_wanted[f] = is_wanted[g] = 1;
  };
  for (FaceId f = 0; f < n_faces; ++f)
    if (is_dirty(f)) add(f, f);
  for (const auto& [f, g] : meeting_pairs(boxes_of_faces(mesh)))
    if ((is_dirty(f) || is_dirty(g)) && mesh.face_body[f] == mesh.face_body[g]) add(f, g);
  return find_pairs(mesh, is_wanted, std::move(jobs), was_ended);
}

std::vector<TrianglePair> find_crossings_between(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                                 std::int32_t n_first, bool& was_ended) {
  const std::int32_t begin[] = {0, n_first, static_cast<std::int32_t>(triangles.size())}, body[] = {0, 0};
  ST_ASSERT(0 <= n_first && n_first <= begin[2]);
  was_ended = false;
  if (n_first == 0 || n_first == begin[2]) return {};
  return find_pairs({points, triangles, begin, body}, {1, 1}, {{0, 1}}, was_ended);
}

}  // namespace st
