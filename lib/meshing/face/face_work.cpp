#include "meshing/face/face_work.h"

#include "base/current_work.h"

namespace st {
namespace {

constexpr double kSingular = 0.02;  // of its mean: a derivative shorter than this makes no reliable normal

}  // namespace

Vec3 squeeze_of(const LocalSize& local, Vec3 normal) {
  const Vec3 s = local.squeeze();
  return s - dot(s, normal) * normal;
}

LocalSize FaceWork::ask_sizes(MeshNode& n) {
  const LocalSize local = field->local_on(n.x, n.normal, hint);
  n.request = n.h = local.length;
  n.squeeze = squeeze_of(local, n.normal);
  return local;
}

bool FaceWork::is_runaway() {
  if (mesh.nodes.size() < max_nodes) return false;
  if (find_max_nodes) max_nodes = std::exchange(find_max_nodes, nullptr)();
  return mesh.nodes.size() >= max_nodes;
}

void FaceWork::set_surface(const Surface& s) {
  surface = &s;
  plane = PlaneMap(s);
}

MeshNode FaceWork::plane_node(const FaceNode& node) const {
  MeshNode n{node};
  n.p = plane.to_plane(node.uv);
  evaluate(n);
  n.normal = reliable_normal(n);
  n.x = node.x;
  n.request = node.h;
  return n;
}

Vec3 FaceWork::reliable_normal(const MeshNode& n) const {
  if (norm(n.du) > kSingular && norm(n.dv) > kSingular) return n.normal;
  const Vec2 middle{0.5 * (surface->u_min() + surface->u_max()), 0.5 * (surface->v_min() + surface->v_max())};
  const Vec2 scale = plane.scale();
  MeshNode inside = n;
  inside.p = n.p + 0.01 * Vec2{(middle.x - n.uv.x) * scale.x, (middle.y - n.uv.y) * scale.y};
  evaluate(inside);
  return inside.normal;
}

void FaceWork::evaluate(MeshNode& n) const {
  throw_if_late();
  n.uv = plane.to_uv(n.p);
  const SurfacePoint s = surface->evaluate(n.uv);
  const Vec2 factors = plane.factors(n.uv);
  n.x = s.x;
  n.du = s.du / factors.x;
  n.dv = s.dv / factors.y;
  n.normal = normalized(cross(n.du, n.dv));
}

}  // namespace st
