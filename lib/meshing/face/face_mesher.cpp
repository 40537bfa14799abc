#include "meshing/face/face_mesher.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/limits.h"
#include "meshing/face/face_check.h"
#include "meshing/face/front.h"
#include "meshing/face/stretch.h"

namespace st {
namespace {

constexpr double kSnap = 1e-3;       // of the length: nearer nodes of one id are one (docs/design/kernel.md)
constexpr double kSnapPlane = 0.05;  // likewise in the scaled plane, where the surface is singular and all steps are
                                     // short
constexpr int kAreaProbe = 10;       // grid of the expected number of nodes
constexpr double kMaxNodesOfFace = kMaxTriangles / 2.0;  // two triangles to a node
constexpr double kRunaway = 30;                          // times the expected number of nodes
constexpr double kPerBoundary = 0.25;  // nodes inside by those of the boundary, squared: four times what a square has

/// Work on one face: the named steps of meshing.
class FaceMesher {
 public:
  FaceMesher(const Surface& surface, const FaceBoundary& boundary) : surface_(surface), boundary_(boundary) {
    work_.set_surface(surface);
  }

  std::vector<RefinementPoint> prepare() {
    add_nodes();
    add_segments();
    std::vector<RefinementPoint> places;
    for (const LoopConflict& c : work_.mesh.build(work_.segments)) places.push_back(place_of(c));
    return places;
  }

  FaceMesh mesh(const SizeField& field, const FaceMeshOptions& options) {
    FaceMesh result;
    if (boundary_.nodes.size() < 3) {
      result.cause = FailureCause::kShortLoops;
      return result;
    }
    result.refinement = prepare();
    if (!result.refinement.empty()) {
      result.cause = FailureCause::kCrossingLoops;
      return result;
    }
    work_.field = &field;
    if (field.is_stretched())
      for (std::int32_t i = 0; i < work_.mesh.n_boundary; ++i) {
        MeshNode& n = work_.mesh.nodes[i];
        const LocalSize local = field.local_on(n.x, n.normal, work_.hint);
        n.squeeze = squeeze_of(local, n.normal);
        if (field.has_metrics()) n.h = n.request = local.length;  // another face at the edge may ask for less
      }
    work_.max_turning = radians(options.max_turning_deg);
    work_.max_nodes = most_nodes(0);
    work_.find_max_nodes = [&] { return most_nodes(expected_nodes()); };
    advance_front(work_);
    if (work_.is_runaway()) {
      result.cause = FailureCause::kTooManyNodes;
      collect(result);
      return result;
    }
    if (options.enhance_rounds > 0 && !field.is_stretched()) work_.mesh.sort_along_curve();  // rows are in order
    enhance(work_, options.enhance_rounds);
    collect(result);
    check_edges(boundary_, result);
    if (result.cause != FailureCause::kOutsideLoops) check_folds(work_.mesh, result);
    return result;
  }

 private:
  /// Plane nodes; nodes of the same id that nearly coincide become one.
  void add_nodes() {
    std::map<std::int32_t, std::vector<std::int32_t>> same;
    node_of_.resize(boundary_.nodes.size());
    for (std::size_t i = 0; i < boundary_.nodes.size(); ++i) {
      const FaceNode& b = boundary_.nodes[i];
      const MeshNode n = work_.plane_node(b);
      std::vector<std::int32_t>& twins = same[b.id];
      std::int32_t found = kNone;
      for (std::int32_t t : twins) {
        const MeshNode& o = work_.mesh.nodes[t];
        const Vec2 d = o.p - n.p;
        if (norm(d.x * n.du + d.y * n.dv) < kSnap * b.h && norm(d) < kSnapPlane * b.h) found = t;
        if (d.x == 0 && d.y == 0) found = t;
      }
      if (found == kNone) {
        found = static_cast<std::int32_t>(work_.mesh.nodes.size());
        work_.mesh.nodes.push_back(n);
        local_to_boundary_.push_back(static_cast<std::int32_t>(i));
        twins.push_back(found);
      }
      node_of_[i] = found;
    }
    for (const auto& [id, twins] : same)  // a degenerate edge of no extent is no pole
      if (twins.size() == 1) work_.mesh.nodes[twins[0]].is_pole = false;
  }

  void add_segments() {
    for (const auto& [a, b] : boundary_.segments)
      if (node_of_[a] != node_of_[b]) work_.segments.push_back({node_of_[a], node_of_[b]});
  }

  RefinementPoint place_of(const LoopConflict& c) const {
    const auto& n = work_.mesh.nodes;
    Vec3 x = 0.25 * (n[c.node_a].x + n[c.node_b].x + n[c.other_a].x + n[c.other_b].x);
    const double h = std::max(
        {distance(n[c.node_a].x, n[c.node_b].x), distance(n[c.other_a].x, n[c.other_b].x), 1e-3 * n[c.node_a].h});
    return {x, 0.5 * h};
  }

  /// By area over squared length.
  double expected_nodes() {
    const double du = (surface_.u_max() - surface_.u_min()) / kAreaProbe,
                 dv = (surface_.v_max() - surface_.v_min()) / kAreaProbe;
    double n = 0;
    for (int i = 0; i < kAreaProbe; ++i)
      for (int j = 0; j < kAreaProbe; ++j) {
        const SurfacePoint s =
            surface_.evaluate({surface_.u_min() + (i + 0.5) * du, surface_.v_min() + (j + 0.5) * dv});
        const double h = work_.field->size(s.x, work_.hint);
        const double share = norm(cross(s.du, s.dv)) * du * dv / (h * h);
        if (std::isfinite(share)) n += share;
      }
    return n;
  }

  /// What so many nodes, of the area, and the boundary explain, with a wide margin.
  std::size_t most_nodes(double n) const {
    const double boundary = static_cast<double>(boundary_.nodes.size());
    return static_cast<std::size_t>(
        std::min(kMaxNodesOfFace, kRunaway * n + kPerBoundary * boundary * boundary + 10000));
  }

  void collect(FaceMesh& result) const {
    const Triangulation& m = work_.mesh;
    const std::int32_t n_local = m.n_boundary, first_inner = n_local + 4;
    const std::int32_t n_boundary = static_cast<std::int32_t>(boundary_.nodes.size());
    std::vector<std::int32_t> number(m.nodes.size(), kNone);
    for (std::int32_t i = 0; i < n_local; ++i) number[i] = local_to_boundary_[i];
    for (const PlaneTriangle& t : m.triangles) {
      if (t.state == kOutside || t.state == kDead) continue;
      int n_pole = 0;
      for (std::int32_t v : t.v) n_pole += m.nodes[v].is_pole;
      if (n_pole >= 2 && has_pole_side(m, t)) continue;
      for (std::int32_t v : t.v) {
        if (number[v] == kNone && v >= first_inner) {
          number[v] = n_boundary + static_cast<std::int32_t>(result.inner.size());
          result.inner.push_back(m.nodes[v]);
        }
        result.corners.push_back(number[v]);
      }
    }
  }

  const Surface& surface_;
  const FaceBoundary& boundary_;
  FaceWork work_;
  std::vector<std::int32_t> node_of_, local_to_boundary_;
};

}  // namespace

FaceMesh mesh_face(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
                   const FaceMeshOptions& options) {
  return FaceMesher(surface, boundary).mesh(field, options);
}

}  // namespace st
