#include "meshing/face/patch_parameters.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/lists_by_key.h"
#include "geometry/shape/projection.h"
#include "mesh/merge.h"
#include "mesh/patch_blocks.h"

namespace st {
namespace {

double squared_distance(Vec2 a, Vec2 b) { return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y); }

class PatchParameters {
 public:
  PatchParameters(const Surface& surface, const FaceBoundary& boundary, const BoundaryNumbering& numbering,
                  FacePatch& patch)
      : surface_(surface),
        patch_(patch),
        xyz_(node_places(numbering.edges, numbering.tables.vertex_xyz, patch)),
        choices_(patch.n_boundary) {
    std::map<std::int32_t, std::vector<Vec2>> by_id;
    for (const FaceNode& n : boundary.nodes) by_id[n.id].push_back(n.uv);
    for (std::int32_t i = 0; i < patch.n_boundary; ++i)
      choices_[i] = by_id[boundary_id_of(numbering.tables.n_vertices(), numbering.edges, patch, i)];
  }

  FurthestNode run() {
    triangles_ = cells_of_nodes(patch_.triangles, xyz_.size());
    walk();
    set_corners();
    FurthestNode furthest;
    for (std::size_t i = 0; i < patch_.inner_xyz.size(); ++i) {
      const Vec3 x = patch_.inner_xyz[i];
      const double off = distance(surface_.point(patch_.inner_uv[i]), x);
      if (!(off <= furthest.distance)) furthest = {off, x};
    }
    return furthest;
  }

 private:
  Vec2 foot(Vec3 x, Vec2 guess) const {
    if (const auto uv = surface_.exact_foot(x)) return *uv;
    if (const auto uv = surface_.foot_near(x, guess)) return *uv;
    if (const auto uv = project_near(surface_, x, guess)) return *uv;
    return closest_point(surface_, x).uv;
  }

  /// From the nodes that the loops know once, which are no seams and no poles, then from all.
  void walk() {
    std::vector<char> is_known(xyz_.size(), 0);
    std::vector<NodeId> front;
    const auto go = [&](std::size_t i) {
      for (; i < front.size(); ++i)
        for (const TriangleId t : triangles_[front[i]])
          for (const NodeId n : patch_.triangles[t].n) {
            if (n < patch_.n_boundary || is_known[n]) continue;
            const NodeId from = front[i];
            const Vec2 guess =
                from < patch_.n_boundary ? choices_[from].front() : patch_.inner_uv[from - patch_.n_boundary];
            patch_.inner_uv[n - patch_.n_boundary] = foot(xyz_[n], guess);
            is_known[n] = 1;
            front.push_back(n);
          }
    };
    for (std::int32_t i = 0; i < patch_.n_boundary; ++i)
      if (choices_[i].size() == 1) front.push_back(i);
    go(0);
    const std::size_t n_done = front.size();
    for (std::int32_t i = 0; i < patch_.n_boundary; ++i)
      if (choices_[i].size() > 1) front.push_back(i);
    go(n_done);
  }

  /// Where the triangle is in (u,v): the middle of the corners that have only one.
  Vec2 middle(const Triangle& t) const {
    Vec2 sum;
    int n_known = 0;
    for (const NodeId n : t.n) {
      if (n < patch_.n_boundary && choices_[n].size() != 1) continue;
      const Vec2 uv = n < patch_.n_boundary ? choices_[n].front() : patch_.inner_uv[n - patch_.n_boundary];
      sum = {sum.x + uv.x, sum.y + uv.y};
      ++n_known;
    }
    if (n_known > 0) return {sum.x / n_known, sum.y / n_known};
    return closest_point(surface_, (xyz_[t.n[0]] + xyz_[t.n[1]] + xyz_[t.n[2]]) / 3).uv;
  }

  void set_corners() {
    patch_.uv_corner.clear();
    patch_.own_uv.clear();
    for (std::size_t i = 0; i < patch_.triangles.size(); ++i) {
      const Triangle& t = patch_.triangles[i];
      for (std::size_t k = 0; k < 3; ++k) {
        if (t.n[k] >= patch_.n_boundary) continue;
        const std::vector<Vec2>& all = choices_[t.n[k]];
        const Vec2 near = all.size() > 1 ? middle(t) : Vec2{};
        const auto nearest = std::min_element(all.begin(), all.end(), [&](Vec2 a, Vec2 b) {
          return squared_distance(a, near) < squared_distance(b, near);
        });
        patch_.uv_corner.push_back(static_cast<std::int32_t>(3 * i + k));
        patch_.own_uv.push_back(nearest == all.end() ? closest_point(surface_, xyz_[t.n[k]]).uv : *nearest);
      }
    }
  }

  const Surface& surface_;
  FacePatch& patch_;
  const std::vector<Vec3> xyz_;             // by node of the patch
  std::vector<std::vector<Vec2>> choices_;  // by boundary node: as often as the loops pass it
  ListsByKey<> triangles_;                  // by node
};

}  // namespace

FurthestNode set_parameters(const Surface& surface, const FaceBoundary& boundary, const BoundaryNumbering& numbering,
                            FacePatch& patch) {
  return PatchParameters(surface, boundary, numbering, patch).run();
}

}  // namespace st
