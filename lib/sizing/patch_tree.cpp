#include "sizing/patch_tree.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/boxes.h"

namespace st {
namespace {

/// The prism over a patch as three slabs along its own axes.
struct Prism {
  Vec3 x, axes[3];
  double lo[3], hi[3];
  Box3 box;

  Prism(const Paraboloid& p, const Box3& own, double reach)
      : x(p.x), axes{p.axis_s, p.axis_t, p.normal}, lo{p.s_lo, p.t_lo, 0}, hi{p.s_hi, p.t_hi, 0} {
    box.add(own);
    // Normals of a curved patch lean outward: what it sees at `reach` is as much wider.
    const double lean_s =
        reach * (std::abs(p.k_ss) * std::max(-p.s_lo, p.s_hi) + std::abs(p.k_st) * std::max(-p.t_lo, p.t_hi));
    const double lean_t =
        reach * (std::abs(p.k_tt) * std::max(-p.t_lo, p.t_hi) + std::abs(p.k_st) * std::max(-p.s_lo, p.s_hi));
    lo[0] -= lean_s, hi[0] += lean_s, lo[1] -= lean_t, hi[1] += lean_t;
    const double sag = std::max({std::abs(p.height(p.s_lo, p.t_lo)), std::abs(p.height(p.s_lo, p.t_hi)),
                                 std::abs(p.height(p.s_hi, p.t_lo)), std::abs(p.height(p.s_hi, p.t_hi))});
    lo[2] = -reach - sag, hi[2] = reach + sag;
    for (int corner = 0; corner < 8; ++corner)
      box.add(x + ((corner & 1) ? hi[0] : lo[0]) * axes[0] + ((corner & 2) ? hi[1] : lo[1]) * axes[1] +
              ((corner & 4) ? hi[2] : lo[2]) * axes[2]);
  }

  /// Can the prism meet the box? Tests the axes of both, not their cross products.
  bool meets(const Box3& b) const {
    if (!meet(b, box)) return false;
    const Vec3 center = b.center() - x, half = 0.5 * (b.hi - b.lo);
    for (int k = 0; k < 3; ++k) {
      const double middle = dot(center, axes[k]);
      const double radius = half.x * std::abs(axes[k].x) + half.y * std::abs(axes[k].y) + half.z * std::abs(axes[k].z);
      if (middle - radius > hi[k] || middle + radius < lo[k]) return false;
    }
    return true;
  }
};

}  // namespace

PatchTree::PatchTree(std::span<const GapPatch> patches) : patches_(patches) {
  for (const GapPatch& p : patches) {
    boxes_.push_back(p.shape.box());
    cones_.push_back(cone_of(p.shape));
  }
  tree_ = BoxTree(boxes_);
  const std::span<const BoxTree::Node> nodes = tree_.nodes();
  node_cones_.resize(nodes.size());
  for (std::size_t at = nodes.size(); at-- > 0;) {  // children first
    const BoxTree::Node& node = nodes[at];
    Cone& cone = node_cones_[at];
    if (node.right != 0) {
      cone = united(node_cones_[at + 1], node_cones_[node.right]);
      continue;
    }
    cone = cones_[tree_.items()[node.begin]];
    for (std::int32_t i = node.begin + 1; i < node.end; ++i) cone = united(cone, cones_[tree_.items()[i]]);
  }
}

PatchTree::Cone PatchTree::make_cone(Vec3 axis, double angle) {
  return {axis, angle, std::cos(angle), std::sin(angle)};
}

PatchTree::Cone PatchTree::cone_of(const Paraboloid& p) {
  double cosine = 1;
  for (const double s : {p.s_lo, p.s_hi})
    for (const double t : {p.t_lo, p.t_hi}) cosine = std::min(cosine, dot(p.normal, p.normal_at(s, t)));
  return make_cone(p.normal, std::acos(std::max(cosine, -1.0)));
}

PatchTree::Cone PatchTree::united(const Cone& a, const Cone& b) {
  const double between = angle_between(a.axis, b.axis);
  if (between + b.angle <= a.angle) return a;
  if (between + a.angle <= b.angle) return b;
  const double angle = 0.5 * (a.angle + b.angle + between);
  const Vec3 side = normalized(b.axis - dot(a.axis, b.axis) * a.axis);
  if (angle >= kPi || side == Vec3{}) return make_cone(a.axis, kPi);
  const double turn = angle - a.angle;
  return make_cone(normalized(std::cos(turn) * a.axis + std::sin(turn) * side), angle);
}

void PatchTree::find_facing(std::size_t patch, double reach, std::vector<std::int32_t>& found) const {
  ST_ASSERT(patch < patches_.size() && reach >= 0);
  found.clear();
  const Prism prism(patches_[patch].shape, boxes_[patch], reach);
  const Cone& own = cones_[patch];
  const double opposed = std::acos(kFacing) - own.angle;  // the axes may be this far apart, less the other cone's angle
  const double cosine = std::cos(opposed), sine = std::sin(opposed);
  const auto may_face = [&](const Cone& cone) {
    return cone.angle >= opposed || dot(own.axis, cone.axis) <= cosine * cone.cosine + sine * cone.sine;
  };
  tree_.visit_near(
      prism.x,
      [&](std::int32_t node, double) { return may_face(node_cones_[node]) && prism.meets(tree_.nodes()[node].box); },
      [&](std::int32_t id) {
        if (static_cast<std::size_t>(id) != patch && may_face(cones_[id]) && prism.meets(boxes_[id]))
          found.push_back(id);
      });
}

}  // namespace st
