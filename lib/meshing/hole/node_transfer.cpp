#include "meshing/hole/node_transfer.h"

#include <algorithm>
#include <limits>

#include "base/box_tree.h"
#include "base/closest_weights.h"
#include "base/threads.h"

namespace st {
namespace {

class StencilSearch {
 public:
  StencilSearch(const HoleMesh& old, const SurfaceMesh& now) : old_(old), now_(now), result_(now.node_xyz.size()) {}

  std::vector<NodeStencil> run() {
    std::vector<std::pair<FaceId, NodeId>> in_faces;
    for (NodeId n = 0; n < static_cast<NodeId>(result_.size()); ++n) {
      const NodeId before = now_.node_previous[n];
      if (before != kNone) {
        result_[n] = {{before, before, before}, {1, 0, 0}};
      } else if (now_.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kEdge)) {
        result_[n] = on_edge(now_.node_entity[n], now_.node_t[n]);
      } else {
        in_faces.emplace_back(now_.node_entity[n], n);
      }
    }
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < in_faces.size(); ++i)
      if (i == 0 || in_faces[i].first != in_faces[i - 1].first) first.push_back(i);
    first.push_back(in_faces.size());
    parallel_for(first.size() - 1, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) in_face(std::span(in_faces).subspan(first[k], first[k + 1] - first[k]));
    });
    return std::move(result_);
  }

 private:
  NodeStencil on_edge(EdgeId e, double t) const {
    const EdgeMesh& m = old_.edges;
    const auto begin = m.node_t.begin() + m.first_node(e), end = begin + m.n_nodes(e);
    const auto above = std::clamp(std::upper_bound(begin, end, t), begin + 1, end - 1);
    const auto i = above - m.node_t.begin();
    const double share = std::clamp((t - m.node_t[i - 1]) / (m.node_t[i] - m.node_t[i - 1]), 0.0, 1.0);
    return {{old_.edge_node[i - 1], old_.edge_node[i], old_.edge_node[i]}, {1 - share, share, 0}};
  }

  /// New nodes inside one face.
  void in_face(std::span<const std::pair<FaceId, NodeId>> nodes) {
    const FaceId f = nodes[0].first;
    const SurfaceMesh& m = old_.mesh;
    std::vector<Box3> boxes(static_cast<std::size_t>(old_.face_size(f)));
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (const NodeId n : m.triangles[old_.face_begin[f] + i].n) boxes[i].add(m.node_xyz[n]);
    const BoxTree tree(boxes);
    for (const auto& [face, node] : nodes) result_[node] = nearest(tree, old_.face_begin[f], now_.node_xyz[node]);
  }

  /// Of triangles as near as each other the one of lowest number.
  NodeStencil nearest(const BoxTree& tree, TriangleId first, Vec3 x) const {
    const SurfaceMesh& m = old_.mesh;
    double least = std::numeric_limits<double>::max();
    TriangleId found = kNone;
    NodeStencil stencil{};
    tree.visit_near(
        x, [&](std::int32_t, double d2) { return d2 <= least; },
        [&](std::int32_t item) {
          const NodeId* n = m.triangles[first + item].n;
          const auto w = closest_weights(x, m.node_xyz[n[0]], m.node_xyz[n[1]], m.node_xyz[n[2]]);
          const Vec3 foot = w[0] * m.node_xyz[n[0]] + w[1] * m.node_xyz[n[1]] + w[2] * m.node_xyz[n[2]];
          const double d2 = norm2(x - foot);
          if (d2 > least || (d2 == least && item > found)) return;
          least = d2, found = item;
          stencil = {{n[0], n[1], n[2]}, {w[0], w[1], w[2]}};
        });
    return stencil;
  }

  const HoleMesh& old_;
  const SurfaceMesh& now_;
  std::vector<NodeStencil> result_;
};

}  // namespace

std::vector<NodeStencil> find_node_stencils(const HoleMesh& old, const SurfaceMesh& now) {
  return StencilSearch(old, now).run();
}

std::vector<double> transfer_values(std::span<const NodeStencil> stencils, std::span<const double> values,
                                    std::size_t n_components) {
  std::vector<double> result;
  result.reserve(stencils.size() * n_components);
  for (const NodeStencil& s : stencils)
    for (std::size_t k = 0; k < n_components; ++k) {
      const auto value = [&](int i) { return values[static_cast<std::size_t>(s.n[i]) * n_components + k]; };
      result.push_back(s.weight[0] == 1 ? value(0)
                                        : s.weight[0] * value(0) + s.weight[1] * value(1) + s.weight[2] * value(2));
    }
  return result;
}

}  // namespace st
