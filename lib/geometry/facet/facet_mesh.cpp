#include "geometry/facet/facet_mesh.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/sort_once.h"
#include "geometry/shape/known_neighbours.h"

namespace st {
namespace {

using NodePair = std::pair<std::int32_t, std::int32_t>;

FacetPatch make_patch(const FacetMesh& mesh, const std::vector<std::int32_t>& triangles,
                      const std::vector<std::int32_t>& members, const std::vector<std::int32_t>& fans,
                      std::vector<std::int32_t>& number) {
  FacetPatch patch;
  for (const std::int32_t i : members) {
    const std::int32_t t = triangles[i];
    patch.triangles.push_back(t);
    Corners own;
    for (int k = 0; k < 3; ++k) {
      std::int32_t& id = number[fans[3 * i + k]];
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

/// `place`: [triangles] scratch.
void add_neighbours(const std::vector<std::int32_t>& members, const std::vector<Corners>& neighbours,
                    std::vector<std::int32_t>& place, FacetPatch& patch) {
  const auto n = static_cast<std::int32_t>(members.size());
  for (std::int32_t i = 0; i < n; ++i) place[members[i]] = i;
  patch.neighbours.assign(members.size(), {kNone, kNone, kNone});
  for (std::int32_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t other = neighbours[members[i]][k];
      if (other == kNone) continue;
      const std::int32_t o = place[other];
      if (o >= n || members[o] != other) continue;  // of another patch
      const auto has = [&](std::int32_t node) { return std::ranges::count(patch.corners[o], node) > 0; };
      if (has(patch.corners[i][k]) && has(patch.corners[i][(k + 1) % 3])) patch.neighbours[i][k] = o;
    }
}

/// Divides triangles of a mesh at the new nodes of their sides.
class Divider {
 public:
  Divider(FacetMesh& mesh, CutNodes nodes) : mesh_(mesh), nodes_(std::move(nodes)) {}

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
    const auto it = nodes_.find(std::minmax(a.node, b.node));
    if (it == nodes_.end()) return false;
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
  CutNodes nodes_;
  std::map<NodePair, std::int32_t> normals_;
  std::int32_t first_ = kNone;  // the triangle that is divided
  bool is_taken_ = false;       // by a part of it
};

/// New nodes where sides of the patch cross the plane.
CutNodes make_nodes(FacetMesh& mesh, const FacetPatch& patch, const std::vector<double>& height) {
  CutNodes nodes;
  for (const Corners& c : patch.corners)
    for (int k = 0; k < 3; ++k) {
      std::int32_t a = c[k], b = c[(k + 1) % 3];
      if (!(height[a] * height[b] < 0)) continue;
      if (patch.node[a] > patch.node[b]) std::swap(a, b);
      const double share = height[a] / (height[a] - height[b]);
      const auto [it, is_new] =
          nodes.try_emplace({patch.node[a], patch.node[b]}, CutNode{static_cast<std::int32_t>(mesh.x.size()), share});
      if (is_new) mesh.x.push_back((1 - share) * patch.x[a] + share * patch.x[b]);
    }
  return nodes;
}

/// A side of a patch's triangle that lies in the plane of a cut.
struct SideOnPlane {
  std::int32_t low, high, triangle;
  int k;
  bool is_forward, is_above;  ///< from the lower node to the higher one; the triangle, of the plane

  bool operator<(const SideOnPlane& o) const {
    return std::tie(low, high, triangle) < std::tie(o.low, o.high, o.triangle);
  }
};

/// Heights of a patch's nodes, by nodes of the mesh, as far as triangles at the plane have them.
class HeightsAtPlane {
 public:
  explicit HeightsAtPlane(std::int32_t n_nodes) : n_nodes_(n_nodes) {}

  void add(std::int32_t node, double height) { height_[node] = height; }
  /// 0 for nodes that the cut has made.
  double operator()(std::int32_t node) const { return node < n_nodes_ ? height_.at(node) : 0.0; }

 private:
  std::int32_t n_nodes_;
  std::unordered_map<std::int32_t, double> height_;
};

/// Pairs of sides between both halves become lines.
void mark_lines(FacetMesh& mesh, std::vector<SideOnPlane>& sides) {
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0, j; i < sides.size(); i = j) {
    for (j = i + 1; j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high;) ++j;
    if (j - i != 2 || sides[i].is_above == sides[i + 1].is_above || sides[i].is_forward == sides[i + 1].is_forward)
      continue;
    for (const SideOnPlane& s : {sides[i], sides[i + 1]}) mesh.is_line[s.triangle][s.k] = 1;
  }
}

/// Those sides of a triangle whose nodes are both at height 0. `height`: of each corner.
void add_sides_on_plane(const FacetMesh& mesh, std::int32_t t, const std::array<double, 3>& height,
                        std::vector<SideOnPlane>& sides) {
  const bool is_above = std::any_of(height.begin(), height.end(), [](double h) { return h > 0; });
  for (int k = 0; k < 3; ++k) {
    const std::int32_t a = mesh.corners[t][k], b = mesh.corners[t][(k + 1) % 3];
    if (height[k] == 0 && height[(k + 1) % 3] == 0)
      sides.push_back({std::min(a, b), std::max(a, b), t, k, a < b, is_above});
  }
}

std::uint64_t key_of(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

}  // namespace

std::vector<FacetPatch> PatchFinder::find(std::vector<std::int32_t> triangles) {
  std::sort(triangles.begin(), triangles.end());
  number_.resize(mesh_.x.size(), kNone);
  std::vector<Corners> corners;
  corners.reserve(triangles.size());
  std::int32_t n_nodes = 0;
  for (const std::int32_t t : triangles) {
    Corners own;
    for (int k = 0; k < 3; ++k) {
      std::int32_t& number = number_[mesh_.corners[t][k]];
      own[k] = number == kNone ? number = n_nodes++ : number;
    }
    corners.push_back(own);
  }
  for (const std::int32_t t : triangles)
    for (const std::int32_t n : mesh_.corners[t]) number_[n] = kNone;
  const std::vector<Corners> neighbours = find_neighbours(corners);
  const auto n = static_cast<std::int32_t>(triangles.size());
  DisjointSets parts(n);
  std::vector<Corners> smooth = neighbours;  // but for those across lines
  for (std::int32_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      if (mesh_.is_line[triangles[i]][k]) smooth[i][k] = kNone;
      if (smooth[i][k] > i) parts.join(i, smooth[i][k]);
    }
  const std::vector<std::int32_t> fans = find_fans(corners, smooth);
  std::vector<std::int32_t> number(fans.size(), kNone), place(triangles.size());
  std::vector<FacetPatch> patches;
  for (const auto& members : parts.groups()) {
    patches.push_back(make_patch(mesh_, triangles, members, fans, number));
    add_neighbours(members, neighbours, place, patches.back());
  }
  return patches;
}

PatchDivider::PatchDivider(FacetMesh& mesh) : mesh_(mesh) {
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t) add_lines(t);
}

void PatchDivider::add_lines(std::int32_t triangle) {
  const Corners& c = mesh_.corners[triangle];
  for (int k = 0; k < 3; ++k)
    if (mesh_.is_line[triangle][k]) beside_[key_of(c[k], c[(k + 1) % 3])].push_back(triangle);
}

std::vector<std::int32_t> PatchDivider::find_divided(const FacetPatch& patch, const std::vector<double>& height,
                                                     const CutNodes& nodes) const {
  std::vector<std::int32_t> divided;
  for (std::size_t i = 0; i < patch.corners.size(); ++i) {
    const auto [a, b, c] = patch.corners[i];
    if (height[a] * height[b] < 0 || height[b] * height[c] < 0 || height[c] * height[a] < 0)
      divided.push_back(patch.triangles[i]);
  }
  for (const auto& [side, node] : nodes) {
    const auto line = beside_.find(key_of(side.first, side.second));
    if (line != beside_.end()) divided.insert(divided.end(), line->second.begin(), line->second.end());
  }
  sort_once(divided);
  return divided;
}

void PatchDivider::divide(const FacetPatch& patch, const std::vector<double>& height) {
  HeightsAtPlane at_plane(static_cast<std::int32_t>(mesh_.x.size()));
  const CutNodes nodes = make_nodes(mesh_, patch, height);
  const std::vector<std::int32_t> divided = find_divided(patch, height, nodes);
  std::vector<SideOnPlane> sides;
  std::vector<std::int32_t> parts;  // of own triangles
  Divider divider(mesh_, nodes);
  std::size_t i = 0;
  const auto add_whole_until = [&](std::int32_t end) {
    for (; i < patch.triangles.size() && patch.triangles[i] < end; ++i) {
      const Corners& c = patch.corners[i];
      add_sides_on_plane(mesh_, patch.triangles[i], {height[c[0]], height[c[1]], height[c[2]]}, sides);
    }
  };
  for (const std::int32_t t : divided) {
    add_whole_until(t);
    const bool is_own = i < patch.triangles.size() && patch.triangles[i] == t;
    if (is_own) {
      for (int k = 0; k < 3; ++k) at_plane.add(mesh_.corners[t][k], height[patch.corners[i][k]]);
      parts.push_back(t);
      ++i;
    }
    const std::int32_t n_before = mesh_.n_triangles();
    divider.divide(t);
    add_lines(t);
    for (std::int32_t part = n_before; part < mesh_.n_triangles(); ++part) {
      add_lines(part);
      if (is_own) parts.push_back(part);
    }
  }
  add_whole_until(std::numeric_limits<std::int32_t>::max());
  for (const std::int32_t t : parts) {
    const Corners& c = mesh_.corners[t];
    add_sides_on_plane(mesh_, t, {at_plane(c[0]), at_plane(c[1]), at_plane(c[2])}, sides);
  }
  mark_lines(mesh_, sides);
  for (const SideOnPlane& s : sides) add_lines(s.triangle);
}

void PatchDivider::part(const FacetPatch& patch, const std::vector<std::int32_t>& group) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::int32_t t = patch.triangles[i];
    for (int k = 0; k < 3; ++k)
      if (const std::int32_t other = patch.neighbours[i][k]; other != kNone && group[other] != group[i])
        mesh_.is_line[t][k] = 1;
    add_lines(t);
  }
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
