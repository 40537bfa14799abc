#include "meshing/hole/hole_reprojector.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/boxes.h"
#include "base/eigen.h"
#include "base/error.h"
#include "features/arc_table.h"
#include "geometry/model/edge_faces.h"
#include "mesh/quality.h"
#include "meshing/hole/moved_smoothing.h"
#include "meshing/topology/mesh_topology.h"
#include "meshing/topology/small_features.h"

namespace st {
namespace {

constexpr double kSpoiltQuality = 0.3;  // of a triangle: below, it is made again if it was better before
constexpr double kOnPoint = 1e-7;       // of the model's size: (u,v) that give a node's place as close as this need no
                                        // projection
constexpr double kSameParameters = 1e-4;  // likewise: a face whose boundary is as close to its old (u,v) was not
                                          // stretched
constexpr double kEvenStretch = 1.5;      // of the segments of an edge that keep their parameters: largest over least

constexpr auto kOnVertex = static_cast<std::uint8_t>(EntityDim::kVertex),
               kOnEdge = static_cast<std::uint8_t>(EntityDim::kEdge),
               kInFace = static_cast<std::uint8_t>(EntityDim::kFace);

double stretched(double x, double from_lo, double from_hi, double to_lo, double to_hi) {
  const double span = from_hi - from_lo;
  if (!(span > 0) || std::abs(to_lo - from_lo) + std::abs(to_hi - from_hi) <= 1e-9 * span) return x;
  return to_lo + (to_hi - to_lo) * (x - from_lo) / span;
}

/// (u,v) -> map (u,v) + offset.
struct FittedMap {
  Eigen::Matrix2d map;
  Eigen::Vector2d offset;

  Vec2 operator()(Vec2 uv) const { return to_vec2(Eigen::Vector2d(map * to_eigen(uv) + offset)); }
  bool is_mirrored() const { return map.determinant() < 0; }
};

/// Closest to the places, by least squares. nullopt: they are on a line.
std::optional<FittedMap> closest_map(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  const auto middle_of = [](const std::vector<Vec2>& all) {
    Vec2 sum;
    for (const Vec2 p : all) sum = sum + p;
    return (1.0 / static_cast<double>(all.size())) * sum;
  };
  if (from.empty()) return std::nullopt;
  const Vec2 p0 = middle_of(from), q0 = middle_of(to);
  Eigen::Matrix2d own = Eigen::Matrix2d::Zero(), both = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector2d p = to_eigen(from[i] - p0), q = to_eigen(to[i] - q0);
    own += p * p.transpose();
    both += q * p.transpose();
  }
  if (!(own.determinant() > 1e-12 * own.trace() * own.trace())) return std::nullopt;
  const Eigen::Matrix2d map = both * adjugate(own) / own.determinant();
  return FittedMap{map, to_eigen(q0) - map * to_eigen(p0)};
}

class Mover {
 public:
  Mover(const SurfaceMesh& old, const Model& model, const SizeField* smooth_for)
      : old_(old), model_(model), t_(model.tables()), sizes_(smooth_for), result_{old, {}} {
    if (sizes_ && sizes_->is_stretched()) squeeze_.resize(old.node_xyz.size());
  }

  MovedMesh run() {
    require_same_topology();
    move_vertices();
    move_edges();
    const MeshTopology topology(t_, old_.merged);
    for (const MeshTopology::Strip& strip : topology.strips()) move_strip(strip);
    for (std::size_t begin = 0, end; begin < old_.triangles.size(); begin = end) {
      for (end = begin; end < old_.triangles.size() && old_.triangle_face[end] == old_.triangle_face[begin];) ++end;
      move_face(old_.triangle_face[begin], begin, end);
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] static void fail(const std::string& what) {
    throw Error(ExitCode::kMismatch,
                "--moved: the geometry does not have the topology of the mesh: " + what + "; mesh it with st-mesh");
  }

  std::vector<EdgeId> edges_of(FaceId f) const {
    std::vector<EdgeId> edges;
    for (const EdgeId e : t_.edges_of(f)) edges.push_back(e);
    std::sort(edges.begin(), edges.end());
    return edges;
  }

  /// Boundary nodes of each face's triangles must lie on its own edges, or on those of a face beside it (narrow faces
  /// may be closed).
  void require_same_topology() const {
    if (static_cast<std::int32_t>(old_.labels.face_name.size()) != t_.n_faces())
      fail("it has " + std::to_string(t_.n_faces()) + " faces, the mesh " +
           std::to_string(old_.labels.face_name.size()));
    const std::int32_t limit[] = {t_.n_vertices(), t_.n_edges(), t_.n_faces()};
    for (std::size_t n = 0; n < old_.node_xyz.size(); ++n)
      if (old_.node_entity_dim[n] > kInFace || old_.node_entity[n] < 0 ||
          old_.node_entity[n] >= limit[old_.node_entity_dim[n]])
        fail("it lacks the entity of node " + std::to_string(n));
    const EdgeFaces faces_at(t_);
    std::vector<FaceId> edge_seen(t_.n_edges(), kNone), vertex_seen(t_.n_vertices(), kNone);
    FaceId current = kNone;
    for (std::size_t i = 0; i < old_.triangles.size(); ++i) {
      const FaceId f = old_.triangle_face[i];
      if (f != current)
        for (EdgeId e : edges_of(current = f))
          for (const FaceId beside : faces_at[e])
            for (EdgeId near : edges_of(beside)) {
              edge_seen[near] = f;
              vertex_seen[t_.edge_vertices[2 * near]] = vertex_seen[t_.edge_vertices[2 * near + 1]] = f;
            }
      for (NodeId n : old_.triangles[i].n) {
        const std::int32_t entity = old_.node_entity[n];
        const bool fits = old_.node_entity_dim[n] == kOnVertex ? vertex_seen[entity] == f
                          : old_.node_entity_dim[n] == kOnEdge ? edge_seen[entity] == f
                                                               : entity == f;
        if (!fits)
          fail("node " + std::to_string(n) + " of " + t_.face_label(f) + " lies on an entity that does not bound it");
      }
    }
  }

  void move_vertices() {
    vertex_node_.assign(t_.n_vertices(), kNone);
    for (std::size_t n = 0; n < old_.node_xyz.size(); ++n) {
      if (old_.node_entity_dim[n] != kOnVertex) continue;
      vertex_node_[old_.node_entity[n]] = static_cast<NodeId>(n);
      result_.mesh.node_xyz[n] = t_.vertex_xyz[old_.node_entity[n]];
    }
  }

  void move_edges() {
    std::size_t end = 0;
    for (std::size_t n = 0; n < old_.node_xyz.size(); n = end) {
      end = n + 1;
      if (old_.node_entity_dim[n] != kOnEdge) continue;
      while (end < old_.node_xyz.size() && old_.node_entity_dim[end] == kOnEdge &&
             old_.node_entity[end] == old_.node_entity[n])
        ++end;
      move_edge(old_.node_entity[n], n, end);
    }
  }

  /// Nodes [begin, end) of an edge.
  void move_edge(EdgeId e, std::size_t begin, std::size_t end) {
    const NodeId first = vertex_node_[t_.edge_vertices[2 * e]], last = vertex_node_[t_.edge_vertices[2 * e + 1]];
    std::vector<double> share;
    double length = 0;
    Vec3 from = first == kNone ? old_.node_xyz[begin] : old_.node_xyz[first];
    for (std::size_t n = begin; n < end; ++n) {
      share.push_back(length += distance(from, old_.node_xyz[n]));
      from = old_.node_xyz[n];
    }
    length += last == kNone ? 0 : distance(from, old_.node_xyz[last]);
    const auto curve = model_.curve(e);
    std::optional<ArcTable> arc;
    if (!keeps_parameters(*curve, begin, end, first, last)) arc.emplace(*curve);
    for (std::size_t n = begin; n < end; ++n) {
      double& t = result_.mesh.node_t[n];
      if (arc) t = arc->parameter_at(share[n - begin] / length);
      result_.mesh.node_xyz[n] = curve->point(t);
    }
  }

  /// Nodes inside an edge.
  std::pair<std::size_t, std::size_t> nodes_on(EdgeId e) const {
    const auto first_not_below = [&](std::pair<std::uint8_t, std::int32_t> key) {
      std::size_t lo = 0, hi = old_.node_xyz.size();
      while (lo < hi) {
        const std::size_t middle = (lo + hi) / 2;
        std::pair(old_.node_entity_dim[middle], old_.node_entity[middle]) < key ? lo = middle + 1 : hi = middle;
      }
      return lo;
    };
    return {first_not_below({kOnEdge, e}), first_not_below({kOnEdge, e + 1})};
  }

  /// Where a strip is not closed both its edges have nodes, at the same shares of their lengths (mirror_nodes): so they
  /// do on the moved edges.
  void move_strip(const MeshTopology::Strip& strip) {
    const EdgeId kept = strip.kept, closed = strip.closed;
    const auto [begin, end] = nodes_on(kept);
    const auto [own_begin, own_end] = nodes_on(closed);
    if (own_begin == own_end) return;
    SurfaceMesh& m = result_.mesh;
    const EdgeMesh mirrored = mirror_nodes(*model_.curve(kept), std::span(m.node_t).subspan(begin, end - begin),
                                           *model_.curve(closed), strip.is_opposed);
    std::size_t last = 0;
    for (std::size_t own = own_begin; own < own_end; ++own) {
      std::size_t partner = begin;
      for (std::size_t n = begin; n < end; ++n)
        if (distance(old_.node_xyz[n], old_.node_xyz[own]) < distance(old_.node_xyz[partner], old_.node_xyz[own]))
          partner = n;
      const std::size_t i = partner - begin + 1, k = strip.is_opposed ? mirrored.node_t.size() - 1 - i : i;
      if (k <= last || k + 1 >= mirrored.node_t.size())
        fail("the nodes on the narrow strip of " + t_.face_label(strip.face) + " cannot be followed");
      last = k;
      m.node_t[own] = mirrored.node_t[k];
      m.node_xyz[own] = mirrored.node_xyz[k];
    }
  }

  /// Does every segment of an edge become about as much longer as the others when its nodes keep their parameters?
  bool keeps_parameters(const Curve& curve, std::size_t begin, std::size_t end, NodeId first, NodeId last) const {
    if (!(old_.node_t[begin] > curve.t_min() && old_.node_t[end - 1] < curve.t_max())) return false;
    double least = 1e300, most = 0;
    Vec3 from = first == kNone ? old_.node_xyz[begin] : old_.node_xyz[first], moved = curve.point(curve.t_min());
    const auto add = [&](Vec3 to, Vec3 moved_to) {
      const double before = distance(from, to), ratio = before > 0 ? distance(moved, moved_to) / before : 1;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
      from = to, moved = moved_to;
    };
    for (std::size_t n = begin; n < end; ++n) add(old_.node_xyz[n], curve.point(old_.node_t[n]));
    if (last != kNone) add(old_.node_xyz[last], curve.point(curve.t_max()));
    return most <= kEvenStretch * least;
  }

  /// Of the nodes on the boundary of a face: as the old mesh has them, and by the new trimming curves.
  std::pair<Box2, Box2> boundary_boxes(FaceId f, std::size_t begin, std::size_t end) const {
    Box2 before, after;
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k)
        if (old_.node_entity_dim[old_.triangles[i].n[k]] != kInFace) before.add(old_.corner_uv[3 * i + k]);
    for (const CoedgeId c : t_.coedges(f)) {
      const EdgeId e = t_.coedge_edge[c];
      const auto pcurve = model_.pcurve(f, c);
      if (!pcurve) continue;
      after.add(pcurve->point(t_.edge_range[2 * e]));
      after.add(pcurve->point(t_.edge_range[2 * e + 1]));
      const auto [first, last] = nodes_on(e);
      for (std::size_t n = first; n < last; ++n) after.add(pcurve->point(result_.mesh.node_t[n]));
    }
    return {before, after};
  }

  /// Do the old (u,v) of the nodes on the boundary, so mapped, give their new places?
  template <class Map>
  bool fits(const Surface& surface, std::size_t begin, std::size_t end, const Map& map) const {
    const double tolerance = kSameParameters * t_.reference_diagonal();
    for (std::size_t c = 3 * begin; c < 3 * end; ++c) {
      const NodeId n = old_.triangles[c / 3].n[c % 3];
      if (old_.node_entity_dim[n] != kInFace &&
          distance(surface.point(map(old_.corner_uv[c])), result_.mesh.node_xyz[n]) > tolerance)
        return false;
    }
    return true;
  }

  /// Of the old (u,v) of a plane, whose axes in it are anyone's choice, by its boundary.
  std::optional<FittedMap> map_of_plane(const Surface& plane, std::size_t begin, std::size_t end, Vec2 guess) const {
    std::vector<Vec2> from, to;
    for (std::size_t c = 3 * begin; c < 3 * end; ++c) {
      const NodeId n = old_.triangles[c / 3].n[c % 3];
      if (old_.node_entity_dim[n] == kInFace) continue;
      const auto there = project_near(plane, result_.mesh.node_xyz[n], guess);
      if (!there) return std::nullopt;
      from.push_back(old_.corner_uv[c]);
      to.push_back(*there);
    }
    return closest_map(from, to);
  }

  /// Puts the corners of a face where the map takes them, but those on its boundary onto its edges.
  template <class Map>
  void place_nodes(const Surface& surface, std::size_t begin, std::size_t end, const Map& map) {
    const double tolerance = kOnPoint * t_.reference_diagonal();
    SurfaceMesh& m = result_.mesh;
    std::vector<Vec2> shift;
    for (std::size_t c = 3 * begin; c < 3 * end; ++c) {
      const NodeId n = old_.triangles[c / 3].n[c % 3];
      Vec2& uv = m.corner_uv[c];
      const Vec2 mapped = uv = map(uv);
      if (old_.node_entity_dim[n] != kInFace && distance(surface.point(uv), m.node_xyz[n]) > tolerance)
        if (const auto there = project_near(surface, m.node_xyz[n], uv)) uv = *there;
      shift.push_back(uv - mapped);
    }
    if (sizes_ && !fits(surface, begin, end, map))
      spread_boundary_shift(old_, static_cast<TriangleId>(begin), static_cast<TriangleId>(end), shift, m);
    for (std::size_t c = 3 * begin; c < 3 * end; ++c)
      if (const NodeId n = old_.triangles[c / 3].n[c % 3]; old_.node_entity_dim[n] == kInFace)
        m.node_xyz[n] = surface.point(m.corner_uv[c]);
  }

  void move_face(FaceId f, std::size_t begin, std::size_t end) {
    const auto surface = model_.surface(f);
    auto [before, after] = boundary_boxes(f, begin, end);
    if (fits(*surface, begin, end, [](Vec2 uv) { return uv; })) after = before;
    const auto by_box = [&, from = before, to = after](Vec2 uv) {
      return Vec2{stretched(uv.x, from.lo.x, from.hi.x, to.lo.x, to.hi.x),
                  stretched(uv.y, from.lo.y, from.hi.y, to.lo.y, to.hi.y)};
    };
    std::optional<FittedMap> turned;
    if (t_.face_type[f] == SurfaceType::kPlane && !fits(*surface, begin, end, by_box))
      turned = map_of_plane(*surface, begin, end, 0.5 * (after.lo + after.hi));
    const auto map = [&](Vec2 uv) { return turned ? (*turned)(uv) : by_box(uv); };
    place_nodes(*surface, begin, end, map);
    const double side = turned && turned->is_mirrored() ? -1 : 1;
    const auto first = static_cast<TriangleId>(begin), last = static_cast<TriangleId>(end);
    find_squeeze(first, last);
    if (sizes_) smooth_moved_face(*surface, old_, first, last, side, squeeze_, result_.mesh);
    note_spoilt(first, last, side);
  }

  /// Of nodes that triangles [begin, end) have, at their new places.
  void find_squeeze(TriangleId begin, TriangleId end) {
    int hint = 0;
    for (TriangleId t = begin; t < end && !squeeze_.empty(); ++t) {
      const NodeId* nodes = old_.triangles[t].n;
      const std::vector<Vec3>& x = result_.mesh.node_xyz;
      const Vec3 normal = normalized(cross(x[nodes[1]] - x[nodes[0]], x[nodes[2]] - x[nodes[0]]));
      for (const NodeId n : old_.triangles[t].n) squeeze_[n] = sizes_->local_on(x[n], normal, hint).squeeze();
    }
  }

  /// `side`: -1 where areas in (u,v) change their signs.
  void note_spoilt(TriangleId begin, TriangleId end, double side) {
    const TriangleCorners before(old_, squeeze_);
    for (TriangleId i = begin; i < end; ++i) {
      const double q = moved_quality(old_, result_.mesh, i, side, squeeze_);
      const auto [a, b, c] = before(i);
      if (q <= 0 || (q < kSpoiltQuality && q < triangle_quality(a, b, c))) result_.spoilt.push_back(i);
    }
  }

  const SurfaceMesh& old_;
  const Model& model_;
  const ModelTables& t_;
  const SizeField* sizes_;     // null: nothing is smoothed
  std::vector<Vec3> squeeze_;  // [n_nodes] of those; empty: they are not stretched
  MovedMesh result_;
  std::vector<NodeId> vertex_node_;
};

}  // namespace

MovedMesh move_mesh(const SurfaceMesh& old, const Model& model, const SizeField* smooth_for) {
  return Mover(old, model, smooth_for).run();
}

}  // namespace st
