#include "mesh/merge_order.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/error.h"
#include "base/threads.h"
#include "mesh/adjacency.h"
#include "mesh/inner_edges.h"
#include "mesh/orient.h"

namespace st {
namespace {

constexpr std::int64_t kTrianglesAtOnce = 1'000'000;  // in memory, of several patches

/// A side of a triangle between two nodes on edges or vertices.
struct BoundarySide {
  std::int32_t low, high;  // boundary ids
  std::int32_t patch;
  std::int32_t runs_up;  // from low to high: 1
};

/// What the mesh as a whole needs of one patch.
struct PatchFacts {
  PatchUse use;
  std::vector<std::pair<std::int32_t, std::int32_t>> together;  // boundary ids of one component
  std::int32_t n_own_components = 0;                            // without a node on edges
  std::vector<BoundarySide> sides;
  InnerEdges inner;
  bool has_unused = false;
  double area = 0;
  Box3 box;
};

/// Ids and places of the nodes of one patch.
class PatchNodes {
 public:
  PatchNodes(const MergeInput& in, const FacePatch& p) : in_(in), p_(p) {
    for (std::int32_t i = 0; i < p.n_boundary; ++i)
      id_.push_back(boundary_id_of(static_cast<VertexId>(in.vertex_xyz.size()), in.edges, p, i));
  }
  std::int32_t id(std::int32_t boundary_node) const { return id_[boundary_node]; }
  Vec3 xyz(NodeId n) const {
    if (n >= p_.n_boundary) return p_.inner_xyz[n - p_.n_boundary];
    const std::size_t id = id_[n], n_vertices = in_.vertex_xyz.size();
    return id < n_vertices ? in_.vertex_xyz[id] : in_.edges.node_xyz[id - n_vertices];
  }
  /// Tells for each node which of the boundary nodes with its id comes first.
  std::vector<NodeId> firsts() const {
    std::vector<NodeId> order(id_.size()), first(id_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](NodeId a, NodeId b) { return std::tie(id_[a], a) < std::tie(id_[b], b); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool is_same = i > 0 && id_[order[i]] == id_[order[i - 1]];
      first[order[i]] = is_same ? first[order[i - 1]] : order[i];
    }
    return first;
  }

 private:
  const MergeInput& in_;
  const FacePatch& p_;
  std::vector<std::int32_t> id_;
};

void find_components(const FacePatch& p, const PatchNodes& nodes, const std::vector<std::uint8_t>& is_used,
                     PatchFacts& facts) {
  DisjointSets sets(static_cast<std::int64_t>(is_used.size()));
  for (const Triangle& t : p.triangles) {
    sets.join(t.n[0], t.n[1]);
    sets.join(t.n[1], t.n[2]);
  }
  for (NodeId n = 0; n < static_cast<NodeId>(is_used.size()); ++n) {
    if (!is_used[n]) continue;
    const NodeId lowest = sets.find(n);
    if (n >= p.n_boundary)
      facts.n_own_components += lowest == n;
    else if (lowest != n)
      facts.together.emplace_back(nodes.id(lowest), nodes.id(n));
  }
}

/// `p`: taken apart.
PatchFacts facts_of(const MergeInput& in, FacePatch p, std::int32_t patch) {
  PatchFacts facts;
  const PatchNodes nodes(in, p);
  std::vector<std::uint8_t> is_used = used_nodes(p);
  facts.use.n_triangles = static_cast<std::int64_t>(p.triangles.size());
  for (const Triangle& t : p.triangles) {
    const Vec3 a = nodes.xyz(t.n[0]);
    facts.area += 0.5 * norm(cross(nodes.xyz(t.n[1]) - a, nodes.xyz(t.n[2]) - a));
  }
  for (NodeId n = 0; n < static_cast<NodeId>(is_used.size()); ++n) {
    if (is_used[n]) facts.box.add(nodes.xyz(n));
    if (n >= p.n_boundary) facts.use.n_inner += is_used[n];
  }
  facts.has_unused = static_cast<std::size_t>(facts.use.n_inner) != p.inner_xyz.size();
  const std::vector<NodeId> first = nodes.firsts();
  for (std::int32_t i = 0; i < p.n_boundary; ++i) {
    if (!is_used[i]) continue;
    facts.use.boundary.push_back(nodes.id(i));
    is_used[first[i]] = 1;
  }
  for (Triangle& t : p.triangles)
    for (NodeId& n : t.n)
      if (n < p.n_boundary) n = first[n];
  for (const Triangle& t : p.triangles)
    for (int k = 0; k < 3; ++k) {
      const NodeId a = t.n[k], b = t.n[(k + 1) % 3];
      if (std::max(a, b) >= p.n_boundary || has_repeated_node(t)) continue;
      const auto [low, high] = std::minmax({nodes.id(a), nodes.id(b)});
      facts.sides.push_back({low, high, patch, low == nodes.id(a)});
    }
  find_components(p, nodes, is_used, facts);
  facts.inner = count_inner_edges(p);
  return facts;
}

/// Calls visit(sides of one edge between two nodes on boundaries).
template <class Visit>
void for_each_boundary_edge(std::span<const BoundarySide> sides, const Visit& visit) {
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) ++j;
    visit(sides.subspan(i, j - i));
  }
}

class OrderFinder {
 public:
  OrderFinder(const MergeInput& input, const PatchSource& source)
      : in_(input),
        source_(source),
        order_{{}, PatchNumbers(input.edges, input.vertex_xyz.size())},
        components_of_nodes_(static_cast<std::int64_t>(numbers().boundary.size())) {}

  MergeOrder run() {
    look_at_all();
    number();
    orient();
    count();
    return std::move(order_);
  }

 private:
  PatchNumbers& numbers() { return order_.numbers; }
  FaceId n_faces() const { return source_.face.empty() ? 0 : source_.face.back() + 1; }

  /// visit(begin, end) for patches that are in memory together.
  template <class Visit>
  void for_each_batch(const Visit& visit) const {
    for (std::size_t begin = 0, end = 0; begin < source_.size(); begin = end) {
      std::int64_t n = 0;
      for (end = begin; end < source_.size() && (end == begin || n + source_.n_triangles[end] <= kTrianglesAtOnce);
           ++end)
        n += source_.n_triangles[end];
      visit(begin, end);
    }
  }

  void look_at_all() {
    area_.assign(n_faces(), 0);
    for_each_batch([&](std::size_t begin, std::size_t end) {
      std::vector<PatchFacts> facts(end - begin);
      parallel_for(facts.size(), 1, [&](std::size_t i, std::size_t) {
        facts[i] = facts_of(in_, source_.shape(begin + i), static_cast<std::int32_t>(begin + i));
      });
      for (std::size_t i = 0; i < facts.size(); ++i) take(begin + i, facts[i]);
    });
    parallel_sort(sides_.begin(), sides_.end(), [](const BoundarySide& a, const BoundarySide& b) {
      return std::tie(a.low, a.high, a.patch, a.runs_up) < std::tie(b.low, b.high, b.patch, b.runs_up);
    });
  }

  void take(std::size_t patch, const PatchFacts& f) {
    numbers().add(f.use);
    for (const auto& [a, b] : f.together) components_of_nodes_.join(a, b);
    sides_.insert(sides_.end(), f.sides.begin(), f.sides.end());
    MergedFacts& all = order_.facts;
    all.n_components += f.n_own_components;
    all.n_boundary_edges += f.inner.n_open;
    all.n_nonmanifold_edges += f.inner.n_nonmanifold;
    all.n_misoriented_edges += f.inner.n_misoriented;
    is_balanced_.push_back(f.inner.is_balanced);
    order_.has_unused.push_back(f.has_unused);
    area_[source_.face[patch]] = f.area;
    box_.add(f.box);
  }

  void number() {
    numbers().number();
    order_.boundary.node_xyz.resize(numbers().n_boundary());
    numbers().place_boundary(in_.edges, in_.vertex_xyz, order_.boundary.node_xyz);
    describe_boundary(in_, numbers(), order_.boundary);
    const std::vector<NodeId>& number = numbers().boundary;
    for (std::size_t id = 0; id < number.size(); ++id)
      order_.facts.n_components +=
          number[id] != kNone && components_of_nodes_.find(static_cast<std::int32_t>(id)) == std::int64_t(id);
  }

  FaceId face_of(const BoundarySide& s) const { return source_.face[s.patch]; }

  std::vector<FaceLink> links() const {
    std::vector<FaceLink> links;
    for_each_boundary_edge(sides_, [&](std::span<const BoundarySide> sides) {
      if (sides.size() != 2) return;
      const auto [a, b] = std::minmax({face_of(sides[0]), face_of(sides[1])});
      if (a != b) links.push_back({a, b, sides[0].runs_up == sides[1].runs_up ? -1 : 1});
    });
    unite_links(links);
    return links;
  }

  void orient() {
    components_ = agree(links(), area_, is_turned_);
    face_component_ = component_of_face(components_, n_faces());
    find_open();
    measure();
    std::vector<std::uint8_t> is_inside_out(components_.size(), 0);
    if (std::any_of(components_.begin(), components_.end(), is_negative))
      is_inside_out = find_inside_out(all_triangles(), components_, face_component_);
    order_.orientation = report_orientation(is_turned_, components_, is_inside_out);
    for (const FaceId f : order_.orientation.inside_out_faces) is_turned_[f] ^= 1;
    if (!order_.orientation.inside_out_faces.empty()) measure();
    for (const FaceId f : source_.face) order_.is_turned.push_back(is_turned_[f]);
    order_.facts.area = 0;
    for (const double a : area_) order_.facts.area += a;
  }

  void find_open() {
    for (std::size_t i = 0; i < source_.size(); ++i)
      if (const std::int32_t c = face_component_[source_.face[i]]; c != kNone && !is_balanced_[i])
        components_[c].is_closed = false;
    for_each_boundary_edge(sides_, [&](std::span<const BoundarySide> sides) {
      for (const BoundarySide& s : sides) {
        const std::int32_t c = face_component_[face_of(s)];
        if (c == kNone || !components_[c].is_closed) continue;
        std::int32_t balance = 0;
        for (const BoundarySide& r : sides)
          if (face_component_[face_of(r)] == c) balance += (r.runs_up != 0) != (is_turned_[face_of(r)] != 0) ? 1 : -1;
        components_[c].is_closed = balance == 0;
      }
    });
  }

  /// What the triangles of a patch add to volumes, each by itself.
  struct PatchVolumes {
    std::vector<double> of_mesh, of_component;
    Box3 box;  // of a component
  };

  PatchVolumes volumes_of(std::size_t patch) const {
    const Vec3 origin = box_.center();
    const FacePatch p = source_.shape(patch);
    const PatchNodes nodes(in_, p);
    const bool is_turned = is_turned_[p.face] != 0;
    PatchVolumes volumes;
    for (auto* all : {&volumes.of_mesh, &volumes.of_component}) all->reserve(p.triangles.size());
    for (const Triangle& t : p.triangles) {
      const Vec3 a = nodes.xyz(t.n[0]), b = nodes.xyz(t.n[is_turned ? 2 : 1]), d = nodes.xyz(t.n[is_turned ? 1 : 2]);
      volumes.of_mesh.push_back(dot(a - origin, cross(b - a, d - a)) / 6);
      if (face_component_[p.face] == kNone) continue;
      volumes.of_component.push_back(volume_of(a, b, d, origin));
      for (const Vec3 x : {a, b, d}) volumes.box.add(x);
    }
    return volumes;
  }

  /// Sums in the order of the triangles, as orient_outward() does.
  void measure() {
    for (FaceComponent& c : components_) c.volume = 0;
    order_.facts.volume = 0;
    for_each_batch([&](std::size_t begin, std::size_t end) {
      std::vector<PatchVolumes> volumes(end - begin);
      parallel_for(volumes.size(), 1, [&](std::size_t i, std::size_t) { volumes[i] = volumes_of(begin + i); });
      for (std::size_t i = 0; i < volumes.size(); ++i) {
        for (const double v : volumes[i].of_mesh) order_.facts.volume += v;
        if (volumes[i].box.is_empty()) continue;
        FaceComponent& c = components_[face_component_[source_.face[begin + i]]];
        for (const double v : volumes[i].of_component) c.volume += v;
        c.box.add(volumes[i].box);
      }
    });
  }

  /// Places, triangles and their faces, as they are turned now.
  SurfaceMesh all_triangles() const {
    const PatchNumbers& numbers = order_.numbers;
    SurfaceMesh mesh = numbers.make_mesh(in_.edges, in_.vertex_xyz);
    for (std::size_t i = 0; i < source_.size(); ++i) {
      numbers.place_patch(in_.edges, source_.shape(i), i, mesh);
      for (TriangleId t = numbers.triangle_begin[i]; is_turned_[source_.face[i]] && t < numbers.triangle_begin[i + 1];
           ++t)
        std::swap(mesh.triangles[t].n[1], mesh.triangles[t].n[2]);
    }
    return mesh;
  }

  void count() {
    MergedFacts& all = order_.facts;
    for_each_boundary_edge(sides_, [&](std::span<const BoundarySide> sides) {
      const auto runs_up = [&](const BoundarySide& s) { return (s.runs_up != 0) != (is_turned_[face_of(s)] != 0); };
      all.n_boundary_edges += sides.size() == 1;
      all.n_nonmanifold_edges += sides.size() > 2;
      all.n_misoriented_edges += sides.size() == 2 && runs_up(sides[0]) == runs_up(sides[1]);
    });
  }

  const MergeInput& in_;
  const PatchSource& source_;
  MergeOrder order_;
  DisjointSets components_of_nodes_;  // by boundary id
  std::vector<BoundarySide> sides_;
  std::vector<std::uint8_t> is_balanced_;  // [n_patches]
  std::vector<double> area_;               // [n_faces]
  Box3 box_;
  std::vector<FaceComponent> components_;
  std::vector<std::int32_t> face_component_;
  std::vector<std::uint8_t> is_turned_;  // [n_faces]
};

}  // namespace

MergeOrder find_merge_order(const MergeInput& input, const PatchSource& source) {
  return OrderFinder(input, source).run();
}

}  // namespace st
