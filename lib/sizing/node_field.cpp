#include "sizing/node_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "base/assert.h"
#include "base/axis.h"

namespace st {
namespace {

/// Weights of a triangle's corners at the point of it that is about closest to x.
struct Weights {
  double w[3];
};

Weights weights_at(Vec3 x, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  const double area2 = norm2(n);
  if (!(area2 > 0)) return {{1, 0, 0}};
  Weights r{
      {dot(cross(b - x, c - x), n) / area2, dot(cross(c - x, a - x), n) / area2, dot(cross(a - x, b - x), n) / area2}};
  double sum = 0;
  for (double& w : r.w) sum += w = std::max(w, 0.0);
  for (double& w : r.w) w /= sum;
  return r;
}

}  // namespace

NodeField::NodeField(const SurfaceMesh& mesh, std::vector<double> size, double slope)
    : mesh_(mesh), size_(std::move(size)), slope_(slope) {
  ST_ASSERT(size_.size() == mesh_.node_xyz.size() && slope_ > 0);
  ST_ASSERT(std::all_of(size_.begin(), size_.end(), [](double h) { return h > 0 && std::isfinite(h); }));
  triangles_of_ = cells_of_nodes(mesh_.triangles, size_.size());
  limit_growth();
  min_size_ = size_.empty() ? 0 : *std::min_element(size_.begin(), size_.end());
  tree_.resize(size_.size());
  std::iota(tree_.begin(), tree_.end(), 0);
  build_tree(0, tree_.size(), 0);
}

/// The largest lengths below the given ones that grow no faster: from the smallest on.
void NodeField::limit_growth() {
  using Entry = std::pair<double, NodeId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t n = 0; n < size_.size(); ++n) queue.push({size_[n], static_cast<NodeId>(n)});
  while (!queue.empty()) {
    const auto [h, node] = queue.top();
    queue.pop();
    if (h > size_[node]) continue;
    for (const TriangleId t : triangles_of_[node])
      for (NodeId n : mesh_.triangles[t].n) {
        const double allowed = h + slope_ * distance(mesh_.node_xyz[node], mesh_.node_xyz[n]);
        if (allowed < size_[n]) queue.push({size_[n] = allowed, n});
      }
  }
}

void NodeField::build_tree(std::size_t begin, std::size_t end, int axis) {
  if (end - begin < 2) return;
  const std::size_t middle = (begin + end) / 2;
  const auto key = [&](NodeId n) { return std::pair(component(mesh_.node_xyz[n], axis), n); };
  std::nth_element(tree_.begin() + begin, tree_.begin() + middle, tree_.begin() + end,
                   [&](NodeId a, NodeId b) { return key(a) < key(b); });
  build_tree(begin, middle, (axis + 1) % 3);
  build_tree(middle + 1, end, (axis + 1) % 3);
}

void NodeField::find_nearest(Vec3 x, std::size_t begin, std::size_t end, int axis, NodeId& best, double& best2) const {
  if (begin >= end) return;
  const std::size_t middle = (begin + end) / 2;
  const NodeId n = tree_[middle];
  const double d2 = norm2(mesh_.node_xyz[n] - x), off = component(x, axis) - component(mesh_.node_xyz[n], axis);
  if (d2 < best2 || (d2 == best2 && n < best)) best = n, best2 = d2;
  const int next = (axis + 1) % 3;
  const bool is_low = off < 0;
  is_low ? find_nearest(x, begin, middle, next, best, best2) : find_nearest(x, middle + 1, end, next, best, best2);
  if (off * off > best2) return;
  is_low ? find_nearest(x, middle + 1, end, next, best, best2) : find_nearest(x, begin, middle, next, best, best2);
}

double NodeField::size(Vec3 x, int& hint) const {
  NodeId node = hint >= 0 && hint < static_cast<int>(size_.size()) ? hint : 0;
  double best2 = norm2(mesh_.node_xyz[node] - x);
  find_nearest(x, 0, tree_.size(), 0, node, best2);
  hint = node;
  double length = size_[node], closest2 = best2;
  for (const TriangleId own : triangles_of_[node]) {
    const Triangle& t = mesh_.triangles[own];
    Vec3 at{0, 0, 0}, c[3] = {mesh_.node_xyz[t.n[0]], mesh_.node_xyz[t.n[1]], mesh_.node_xyz[t.n[2]]};
    const Weights w = weights_at(x, c[0], c[1], c[2]);
    double h = 0;
    for (int k = 0; k < 3; ++k) at += w.w[k] * c[k], h += w.w[k] * size_[t.n[k]];
    if (const double d2 = norm2(at - x); d2 < closest2) closest2 = d2, length = h;
  }
  return length;
}

}  // namespace st
