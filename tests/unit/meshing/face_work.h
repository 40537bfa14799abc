// The state between the front and the enhancer, made by hand and judged.
#pragma once

#include <optional>

#include "meshing/face/front.h"
#include "unit/meshing/faces.h"

namespace st::test {

/// A face before its front starts, as mesh_face prepares it. `boundary` and `field` outlive it.
struct Prepared {
  FaceWork work;
  std::vector<std::int32_t> to_boundary;  ///< [n_boundary of the triangulation]
  const FaceBoundary& boundary;

  Prepared(const Surface& surface, const FaceBoundary& b, const SizeField& field) : boundary(b) {
    work.surface = &surface;
    work.field = &field;
    work.max_nodes = 1'000'000;
    const SurfacePoint middle =
        surface.evaluate({0.5 * (surface.u_min() + surface.u_max()), 0.5 * (surface.v_min() + surface.v_max())});
    work.plane.u = PlaneAxis(norm(middle.du));
    work.plane.v = PlaneAxis(norm(middle.dv));
    std::vector<std::int32_t> of;
    for (std::size_t i = 0; i < b.nodes.size(); ++i) of.push_back(add(b.nodes[i], static_cast<std::int32_t>(i)));
    std::vector<std::pair<std::int32_t, std::int32_t>> segments;
    for (const auto& [first, second] : b.segments)
      if (of[first] != of[second]) segments.push_back({of[first], of[second]});
    EXPECT_TRUE(work.mesh.build(segments).empty());
  }

  /// An inner node at (u,v), which joins the triangulation by its cavity.
  std::int32_t insert(Vec2 uv) {
    Triangulation& m = work.mesh;
    MeshNode n;
    n.p = work.plane.to_plane(uv);
    work.evaluate(n);
    n.h = n.request = work.field->size(n.x);
    std::int32_t at = kNone;
    for (std::size_t i = 0; i < m.triangles.size() && at == kNone; ++i)
      if (is_inside(m.triangles[i]) && holds(m.triangles[i], n.p)) at = static_cast<std::int32_t>(i);
    if (at == kNone || !m.find_cavity(n.p, metric_of(n), at)) return kNone;
    m.nodes.push_back(n);
    m.added_node();
    m.fill_cavity(static_cast<std::int32_t>(m.nodes.size()) - 1);
    return static_cast<std::int32_t>(m.nodes.size()) - 1;
  }

  static bool is_inside(const PlaneTriangle& t) { return t.state != kOutside && t.state != kDead; }
  std::int32_t first_inner() const { return work.mesh.n_boundary + 4; }
  bool is_there(std::int32_t node) const { return work.mesh.triangle_at(node) != kNone; }
  int n_inner() const {
    int n = 0;
    for (std::int32_t i = first_inner(); i < static_cast<std::int32_t>(work.mesh.nodes.size()); ++i) n += is_there(i);
    return n;
  }
  int valence(std::int32_t node) const {
    int n = 0;
    for (const PlaneTriangle& t : work.mesh.triangles)
      n += is_inside(t) && (t.v[0] == node || t.v[1] == node || t.v[2] == node);
    return n;
  }

  /// As mesh_face hands it over; what lies on a pole has no area and is left out.
  FaceMesh mesh() const {
    FaceMesh result;
    const auto& nodes = work.mesh.nodes;
    std::vector<std::int32_t> number = to_boundary;
    number.resize(nodes.size(), kNone);
    for (const PlaneTriangle& t : work.mesh.triangles) {
      if (!is_inside(t) || has_pole_side(t)) continue;
      for (const std::int32_t v : t.v) {
        if (number[v] == kNone) {
          number[v] = static_cast<std::int32_t>(boundary.nodes.size() + result.inner.size());
          result.inner.push_back(nodes[v]);
        }
        result.corners.push_back(number[v]);
      }
    }
    return result;
  }

  /// The smallest cosine between the normals of a triangle and of the surface at its nodes; poles have none.
  double worst_cosine() const {
    double worst = 1;
    for (const PlaneTriangle& t : work.mesh.triangles) {
      if (!is_inside(t) || has_pole_side(t)) continue;
      const MeshNode &a = work.mesh.nodes[t.v[0]], &b = work.mesh.nodes[t.v[1]], &c = work.mesh.nodes[t.v[2]];
      const Vec3 normal = normalized(cross(b.x - a.x, c.x - a.x));
      for (const MeshNode* n : {&a, &b, &c})
        if (norm2(n->normal) > 0) worst = std::min(worst, dot(normal, n->normal));
    }
    return worst;
  }

 private:
  bool has_pole_side(const PlaneTriangle& t) const {
    const auto& n = work.mesh.nodes;
    for (int k = 0; k < 3; ++k) {
      const MeshNode &a = n[t.v[k]], &b = n[t.v[(k + 1) % 3]];
      if (a.is_pole && b.is_pole && a.id == b.id) return true;
    }
    return false;
  }
  bool holds(const PlaneTriangle& t, Vec2 p) const {
    bool all = true;
    for (int k = 0; k < 3; ++k)
      all = all && orient2d(work.mesh.nodes[t.v[k]].p, work.mesh.nodes[t.v[(k + 1) % 3]].p, p) >= 0;
    return all;
  }
  /// One plane node for all that have an id and a place in common.
  std::int32_t add(const FaceNode& b, std::int32_t index) {
    MeshNode n{b};
    n.p = work.plane.to_plane(b.uv);
    for (std::size_t i = 0; i < work.mesh.nodes.size(); ++i)
      if (work.mesh.nodes[i].id == b.id && norm(work.mesh.nodes[i].p - n.p) < 1e-6 * b.h)
        return static_cast<std::int32_t>(i);
    work.evaluate(n);
    if (b.is_pole) n.normal = {};
    n.x = b.x;
    n.request = b.h;
    work.mesh.nodes.push_back(n);
    to_boundary.push_back(index);
    return static_cast<std::int32_t>(work.mesh.nodes.size()) - 1;
  }
};

/// Boundary nodes and segments as they were, to the bit.
class BoundaryWatch {
 public:
  explicit BoundaryWatch(const Prepared& p) : p_(p), nodes_(p.work.mesh.nodes) {
    nodes_.resize(p.work.mesh.n_boundary);
    segments_ = segments();
  }
  void expect_unchanged() const {
    ASSERT_EQ(p_.work.mesh.n_boundary, static_cast<std::int32_t>(nodes_.size()));
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      EXPECT_TRUE(p_.work.mesh.nodes[i].x == nodes_[i].x && p_.work.mesh.nodes[i].p == nodes_[i].p) << i;
      EXPECT_TRUE(p_.work.mesh.nodes[i].h == nodes_[i].h && p_.work.mesh.nodes[i].id == nodes_[i].id) << i;
    }
    EXPECT_EQ(segments(), segments_);
  }

 private:
  std::set<std::pair<std::int32_t, std::int32_t>> segments() const {
    std::set<std::pair<std::int32_t, std::int32_t>> found;
    for (const PlaneTriangle& t : p_.work.mesh.triangles)
      for (int k = 0; k < 3; ++k)
        if (t.state != kDead && (t.constrained >> k & 1)) found.insert({t.v[k], t.v[(k + 1) % 3]});
    return found;
  }
  const Prepared& p_;
  std::vector<MeshNode> nodes_;
  std::set<std::pair<std::int32_t, std::int32_t>> segments_;
};

}  // namespace st::test
