#include "geometry/facet/facet_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/disjoint_sets.h"

namespace st {
namespace {

using NodePair = std::pair<std::int32_t, std::int32_t>;

/// Calls visit(triangle, side, other, other's side) for each of `corners` and each inner side of it that is no line.
template <class Visit>
void visit_smooth_sides(const FacetMesh& mesh, const std::vector<std::int32_t>& triangles, const Visit& visit) {
  std::vector<Corners> corners;
  for (const std::int32_t t : triangles) corners.push_back(mesh.corners[t]);
  const std::vector<Corners> neighbours = find_neighbours(corners);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(triangles.size()); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t other = neighbours[i][k];
      if (other == kNone || mesh.is_line[triangles[i]][k]) continue;
      for (int m = 0; m < 3; ++m)
        if (corners[other][m] == corners[i][(k + 1) % 3] && corners[other][(m + 1) % 3] == corners[i][k])
          visit(i, k, other, m);
    }
}

FacetPatch make_patch(const FacetMesh& mesh, const std::vector<std::int32_t>& triangles,
                      const std::vector<std::int32_t>& members, DisjointSets& fans, std::vector<std::int32_t>& number) {
  FacetPatch patch;
  for (const std::int32_t i : members) {
    const std::int32_t t = triangles[i];
    patch.triangles.push_back(t);
    Corners own;
    for (int k = 0; k < 3; ++k) {
      std::int32_t& id = number[fans.find(3 * i + k)];
      if (id == kNone) {
        id = static_cast<std::int32_t>(patch.x.size());
        patch.x.push_back(mesh.x[mesh.corners[t][k]]);
        patch.node.push_back(mesh.corners[t][k]);
        patch.normal.push_back(mesh.corner_normal[t][k]);
      }
      own[k] = id;
    }
    patch.corners.push_back(own);
  }
  return patch;
}

/// A new node on a side.
struct Split {
  std::int32_t node;
  double share;  ///< of the way from the lower node to the higher one
};

/// Divides triangles of a mesh at the new nodes of their sides.
class Divider {
 public:
  Divider(FacetMesh& mesh, std::map<NodePair, Split> splits) : mesh_(mesh), splits_(std::move(splits)) {}

  void divide(std::int32_t t) {
    std::array<Corner, 3> c, m;
    std::array<std::uint8_t, 3> is_split{};
    const auto line = mesh_.is_line[t];
    for (int k = 0; k < 3; ++k) c[k] = {mesh_.corners[t][k], mesh_.corner_normal[t][k], mesh_.uv[t][k]};
    for (int k = 0; k < 3; ++k) is_split[k] = find_middle(c[k], c[(k + 1) % 3], m[k]);
    const int n = is_split[0] + is_split[1] + is_split[2];
    if (n == 0) return;
    first_ = t;
    is_taken_ = false;
    if (n == 3) {
      for (int k = 0; k < 3; ++k) add({m[k], c[(k + 1) % 3], m[(k + 1) % 3]}, {line[k], line[(k + 1) % 3], 0});
      return add({m[0], m[1], m[2]}, {0, 0, 0});
    }
    int j = 0;  // the only side with a new node, or the only one without
    while (is_split[j] != (n == 1)) ++j;
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    if (n == 1) {
      add({m[j], c[k], c[l]}, {line[j], line[k], 0});
      return add({m[j], c[l], c[j]}, {0, line[l], line[j]});
    }
    add({m[k], c[l], m[l]}, {line[k], line[l], 0});
    const auto diagonal = [&](const Corner& a, const Corner& b) { return distance(mesh_.x[a.node], mesh_.x[b.node]); };
    if (diagonal(c[j], m[k]) <= diagonal(c[k], m[l])) {
      add({c[j], c[k], m[k]}, {line[j], line[k], 0});
      add({c[j], m[k], m[l]}, {0, 0, line[l]});
    } else {
      add({c[j], c[k], m[l]}, {line[j], 0, line[l]});
      add({c[k], m[k], m[l]}, {line[k], 0, 0});
    }
  }

 private:
  struct Corner {
    std::int32_t node = kNone, normal = kNone;
    Vec2 uv;
  };

  bool find_middle(const Corner& a, const Corner& b, Corner& middle) {
    const auto it = splits_.find(std::minmax(a.node, b.node));
    if (it == splits_.end()) return false;
    const double share = a.node < b.node ? it->second.share : 1 - it->second.share;
    const auto [known, is_new] =
        normals_.try_emplace(std::minmax(a.normal, b.normal), static_cast<std::int32_t>(mesh_.normal.size()));
    if (is_new)
      mesh_.normal.push_back(normalized((1 - share) * mesh_.normal[a.normal] + share * mesh_.normal[b.normal]));
    middle = {it->second.node, known->second, (1 - share) * a.uv + share * b.uv};
    return true;
  }

  /// In place of the divided one, then at the end.
  void add(const std::array<Corner, 3>& c, const std::array<std::uint8_t, 3>& line) {
    const Corners nodes{c[0].node, c[1].node, c[2].node}, normals{c[0].normal, c[1].normal, c[2].normal};
    const std::array<Vec2, 3> uv{c[0].uv, c[1].uv, c[2].uv};
    if (std::exchange(is_taken_, true)) {
      mesh_.corners.push_back(nodes);
      mesh_.corner_normal.push_back(normals);
      mesh_.uv.push_back(uv);
      mesh_.is_line.push_back(line);
      mesh_.part.push_back(mesh_.part[first_]);
      mesh_.face.push_back(mesh_.face[first_]);
      return;
    }
    mesh_.corners[first_] = nodes;
    mesh_.corner_normal[first_] = normals;
    mesh_.uv[first_] = uv;
    mesh_.is_line[first_] = line;
  }

  FacetMesh& mesh_;
  std::map<NodePair, Split> splits_;
  std::map<NodePair, std::int32_t> normals_;
  std::int32_t first_ = kNone;  // the triangle that is divided
  bool is_taken_ = false;       // by a part of it
};

/// New nodes where sides of the patch cross the plane.
std::map<NodePair, Split> make_nodes(FacetMesh& mesh, const FacetPatch& patch, const std::vector<double>& height) {
  std::map<NodePair, Split> splits;
  for (const Corners& c : patch.corners)
    for (int k = 0; k < 3; ++k) {
      std::int32_t a = c[k], b = c[(k + 1) % 3];
      if (!(height[a] * height[b] < 0)) continue;
      if (patch.node[a] > patch.node[b]) std::swap(a, b);
      const double share = height[a] / (height[a] - height[b]);
      const auto [it, is_new] =
          splits.try_emplace({patch.node[a], patch.node[b]}, Split{static_cast<std::int32_t>(mesh.x.size()), share});
      if (is_new) mesh.x.push_back((1 - share) * patch.x[a] + share * patch.x[b]);
    }
  return splits;
}

}  // namespace

std::vector<FacetPatch> find_patches(const FacetMesh& mesh, std::vector<std::int32_t> triangles) {
  std::sort(triangles.begin(), triangles.end());
  const auto n = static_cast<std::int64_t>(triangles.size());
  DisjointSets parts(n), fans(3 * n);
  visit_smooth_sides(mesh, triangles, [&](std::int32_t i, int k, std::int32_t other, int m) {
    parts.join(i, other);
    fans.join(3 * i + k, 3 * other + (m + 1) % 3);
    fans.join(3 * i + (k + 1) % 3, 3 * other + m);
  });
  std::vector<std::int32_t> number(static_cast<std::size_t>(3 * n), kNone);
  std::vector<FacetPatch> patches;
  for (const auto& members : parts.groups()) patches.push_back(make_patch(mesh, triangles, members, fans, number));
  return patches;
}

void divide(FacetMesh& mesh, const FacetPatch& patch, const std::vector<double>& height) {
  std::vector<double> node_height(mesh.x.size(), 0);
  for (std::size_t i = 0; i < patch.node.size(); ++i) node_height[patch.node[i]] = height[i];
  const std::map<NodePair, Split> splits = make_nodes(mesh, patch, height);
  node_height.resize(mesh.x.size(), 0);
  std::vector<std::uint8_t> is_end(mesh.x.size(), 0);
  for (const auto& [nodes, split] : splits) is_end[nodes.first] = is_end[nodes.second] = 1;
  std::vector<std::uint8_t> is_own(mesh.corners.size(), 0);
  for (const std::int32_t t : patch.triangles) is_own[t] = 1;
  Divider divider(mesh, splits);
  for (std::int32_t t = 0, n = mesh.n_triangles(); t < n; ++t) {
    const Corners& c = mesh.corners[t];
    if (is_end[c[0]] + is_end[c[1]] + is_end[c[2]] < 2) continue;
    divider.divide(t);
    is_own.resize(mesh.corners.size(), is_own[t]);
  }
  std::vector<std::int32_t> own;
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t)
    if (is_own[t]) own.push_back(t);
  const auto is_above = [&](std::int32_t t) {
    return std::any_of(mesh.corners[t].begin(), mesh.corners[t].end(),
                       [&](std::int32_t node) { return node_height[node] > 0; });
  };
  visit_smooth_sides(mesh, own, [&](std::int32_t i, int k, std::int32_t other, int m) {
    if (is_above(own[i]) == is_above(own[other])) return;
    mesh.is_line[own[i]][k] = 1;
    mesh.is_line[own[other]][m] = 1;
  });
}

void keep_triangles(FacetMesh& mesh, const std::vector<std::uint8_t>& is_kept) {
  const auto pick = [&](auto& rows) {
    std::size_t n = 0;
    for (std::size_t t = 0; t < is_kept.size(); ++t)
      if (is_kept[t]) rows[n++] = rows[t];
    rows.resize(n);
  };
  pick(mesh.corners), pick(mesh.corner_normal), pick(mesh.is_line), pick(mesh.part), pick(mesh.face), pick(mesh.uv);
}

}  // namespace st
