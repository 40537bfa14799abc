#include "meshing/associate/curved_sides.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/shape/projection.h"

namespace st {
namespace {

// Of a side's length. A quarter of a circle rises by a fifth; beyond a third an element of second order may fold.
constexpr double kMaxRise = 1.0 / 3;

/// A side with the first triangle that has it: the side runs from corner `k` to the next.
struct Side {
  std::array<NodeId, 2> ends;
  TriangleId triangle;
  int k;
  auto key() const { return std::tuple(ends, triangle, k); }
};

std::array<NodeId, 2> ascending(NodeId a, NodeId b) { return {std::min(a, b), std::max(a, b)}; }

/// Every side of an element once, ascending. Sides inside quadrilaterals are none.
std::vector<Side> element_sides(const SurfaceMesh& mesh, const QuadPairs& elements) {
  std::vector<std::array<NodeId, 2>> inside;
  for (const Quadrilateral& q : elements.quads) {
    inside.push_back(ascending(q.n[0], q.n[2]));
    inside.push_back(ascending(q.n[1], q.n[3]));
  }
  std::sort(inside.begin(), inside.end());
  std::vector<Side> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      sides.push_back(
          {ascending(mesh.triangles[t].n[k], mesh.triangles[t].n[(k + 1) % 3]), static_cast<TriangleId>(t), k});
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key() < b.key(); });
  sides.erase(std::unique(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.ends == b.ends; }),
              sides.end());
  std::erase_if(sides, [&](const Side& s) { return std::binary_search(inside.begin(), inside.end(), s.ends); });
  return sides;
}

/// Finds the CAD edge of a side.
class Segments {
 public:
  explicit Segments(const SurfaceMesh& mesh) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.segment_edge.size(); ++i)
      order_.push_back({ends(i), static_cast<std::int32_t>(i)});
    std::sort(order_.begin(), order_.end());
  }
  /// Number of the segment between these nodes, kNone.
  std::int32_t find(const std::array<NodeId, 2>& wanted) const {
    const auto at = std::lower_bound(order_.begin(), order_.end(), std::pair(wanted, std::int32_t{0}));
    return at != order_.end() && at->first == wanted ? at->second : kNone;
  }

 private:
  std::array<NodeId, 2> ends(std::size_t i) const {
    return ascending(mesh_.segment_nodes[2 * i], mesh_.segment_nodes[2 * i + 1]);
  }
  const SurfaceMesh& mesh_;
  std::vector<std::pair<std::array<NodeId, 2>, std::int32_t>> order_;
};

/// Evaluators, each made when it is first needed.
class Evaluators {
 public:
  explicit Evaluators(const Model& model)
      : model_(model), curves_(model.tables().n_edges()), surfaces_(model.tables().n_faces()) {}
  const Curve& curve(EdgeId e) {
    if (!curves_[e]) curves_[e] = model_.curve(e);
    return *curves_[e];
  }
  const Surface& surface(FaceId f) {
    if (!surfaces_[f]) surfaces_[f] = model_.surface(f);
    return *surfaces_[f];
  }

 private:
  const Model& model_;
  std::vector<std::unique_ptr<Curve>> curves_;
  std::vector<std::unique_ptr<Surface>> surfaces_;
};

/// On the edge, between the parameters of the segment's nodes.
std::optional<Vec3> point_on_edge(const SurfaceMesh& mesh, std::int32_t segment, const Curve& curve, Vec3 middle) {
  const auto t_of = [&](NodeId n, double at_vertex) {
    return mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex) ? at_vertex : mesh.node_t[n];
  };
  const double t0 = t_of(mesh.segment_nodes[2 * segment], curve.t_min()),
               t1 = t_of(mesh.segment_nodes[2 * segment + 1], curve.t_max()), guess = 0.5 * (t0 + t1);
  const std::optional<double> t = project_near(curve, middle, guess);
  return curve.point(t && *t > t0 && *t < t1 ? *t : guess);
}

}  // namespace

MidNodes make_mid_nodes(const SurfaceMesh& mesh, const QuadPairs& elements, const Model& model,
                        std::int64_t& n_straight) {
  n_straight = 0;
  MidNodes nodes;
  Evaluators evaluators(model);
  const Segments segments(mesh);
  for (const Side& side : element_sides(mesh, elements)) {
    const auto [a, b] = side.ends;
    const Vec3 middle = 0.5 * (mesh.node_xyz[a] + mesh.node_xyz[b]);
    const std::int32_t segment = segments.find(side.ends);
    const FaceId face = mesh.triangle_face[side.triangle];
    std::optional<Vec3> x;
    if (segment != kNone) {
      x = point_on_edge(mesh, segment, evaluators.curve(mesh.segment_edge[segment]), middle);
    } else {
      const std::size_t corner = 3 * static_cast<std::size_t>(side.triangle);
      const Vec2 guess = 0.5 * (mesh.corner_uv[corner + side.k] + mesh.corner_uv[corner + (side.k + 1) % 3]);
      const Surface& surface = evaluators.surface(face);
      if (const std::optional<Vec2> uv = project_near(surface, middle, guess)) x = surface.point(*uv);
    }
    const bool is_near = x && distance(*x, middle) <= kMaxRise * distance(mesh.node_xyz[a], mesh.node_xyz[b]);
    n_straight += !is_near;
    nodes.ends.push_back(side.ends);
    nodes.xyz.push_back(is_near ? *x : middle);
    nodes.entity_dim.push_back(static_cast<std::uint8_t>(segment != kNone ? EntityDim::kEdge : EntityDim::kFace));
    nodes.entity.push_back(segment != kNone ? mesh.segment_edge[segment] : face);
  }
  return nodes;
}

}  // namespace st
