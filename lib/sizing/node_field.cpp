#include "sizing/node_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "base/assert.h"

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

std::vector<NodeId> all_below(std::size_t n_nodes) {
  std::vector<NodeId> all(n_nodes);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

NodeField::NodeField(const SurfaceMesh& mesh, std::vector<double> size, double slope)
    : mesh_(mesh),
      size_(std::move(size)),
      slope_(slope),
      triangles_of_(cells_of_nodes(mesh.triangles, mesh.node_xyz.size())),
      nearest_(mesh.node_xyz, all_below(mesh.node_xyz.size())) {
  ST_ASSERT(size_.size() == mesh_.node_xyz.size() && slope_ > 0);
  ST_ASSERT(std::all_of(size_.begin(), size_.end(), [](double h) { return h > 0 && std::isfinite(h); }));
  limit_growth();
  min_size_ = size_.empty() ? 0 : *std::min_element(size_.begin(), size_.end());
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

double NodeField::size(Vec3 x, int& hint) const {
  const NodeId node = nearest_.find(x, hint >= 0 && hint < static_cast<int>(size_.size()) ? hint : kNone);
  hint = node;
  double length = size_[node], closest2 = norm2(mesh_.node_xyz[node] - x);
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
