// The quadrilateral of two triangles, in which one diagonal may replace the other: internal to lib/meshing.
#pragma once

#include <cmath>

#include "meshing/face/front.h"

namespace st {

/// About edge a-b between triangles t and o, whose opposite nodes are c and d.
struct SwapQuad {
  std::int32_t t, o, a, b, c, d;
};

/// About edge k of t. False for a boundary segment or the rim.
inline bool quad_at(const Triangulation& m, std::int32_t t, int k, SwapQuad& q) {
  const PlaneTriangle& r = m.triangles[t];
  const std::int32_t o = r.n[k];
  if (o == kNone || (r.constrained >> k & 1)) return false;
  const PlaneTriangle& s = m.triangles[o];
  const int j = s.n[0] == t ? 0 : s.n[1] == t ? 1 : 2;
  q = {t, o, r.v[k], r.v[(k + 1) % 3], r.v[(k + 2) % 3], s.v[(j + 2) % 3]};
  return true;
}

/// May c-d replace a-b, which is edge k of t? Not between seam twins or nodes of a pole, nor along the surface much
/// further than through the air.
template <bool kStretched>
bool may_swap(const FaceWork& w, const SwapQuad& q, int k) {
  const auto& n = w.mesh.nodes;
  const MeshNode &nc = n[q.c], &nd = n[q.d];
  if ((nc.id != kNone && nc.id == nd.id) || are_one_pole(nc, nd) || !w.mesh.can_swap(q.t, k)) return false;
  const auto length = [&](std::int32_t i, std::int32_t j) {
    return std::sqrt(w.template edge_length2<kStretched>(i, j));
  };
  const double chord = side_length(nc, nd);
  return length(q.c, q.d) <= chord || length(q.a, q.b) > side_length(n[q.a], n[q.b]);
}

}  // namespace st
