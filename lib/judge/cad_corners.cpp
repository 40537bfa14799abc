#include "judge/cad_corners.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/disjoint_sets.h"
#include "mesh/adjacency.h"

namespace st {

/// One end of a coedge.
struct CadCorners::Side {
  EdgeId edge = kNone;
  VertexId vertex = kNone;
  Vec3 away;    // along the edge, away from the vertex
  Vec3 normal;  // du x dv there
};

CadCorners::CadCorners(const Model& model, const MergedFeatures& merged) : model_(model) {
  const ModelTables& t = model.tables();
  is_merged_.assign(t.n_edges(), 0);
  is_known_.assign(t.n_faces(), 0);
  DisjointSets joined(t.n_vertices());
  for (const EdgeId e : merged.edge) {
    is_merged_[e] = 1;
    joined.join(t.edge_vertices[2 * e], t.edge_vertices[2 * e + 1]);
  }
  for (VertexId v = 0; v < t.n_vertices(); ++v) representative_.push_back(joined.find(v));
}

double CadCorners::smallest_deg(FaceId face, VertexId vertex) {
  if (!is_known_[face]) measure_face(face);
  const auto found = smallest_.find({face, representative_[vertex]});
  return found == smallest_.end() ? 360 : found->second;
}

CadCorners::Side CadCorners::side_of(FaceId face, CoedgeId coedge, bool at_its_end) const {
  constexpr double kInside = 1e-3;  // of the edge: its derivative may vanish at its end
  const ModelTables& t = model_.tables();
  const EdgeId e = t.coedge_edge[coedge];
  const bool at_t_max = at_its_end != static_cast<bool>(t.coedge_is_reversed[coedge]);
  const double t0 = t.edge_range[2 * e], t1 = t.edge_range[2 * e + 1], at = at_t_max ? t1 : t0;
  const double inside = at + kInside * ((at_t_max ? t0 : t1) - at);
  const auto curve = model_.curve(e);
  const SurfacePoint s = model_.surface(face)->evaluate(model_.pcurve(face, coedge)->point(inside));
  return {e, representative_[t.edge_vertices[2 * e + at_t_max]], curve->point(inside) - curve->point(at),
          cross(s.du, s.dv)};
}

/// The interior is to the left in (u,v): the angle from the leaving edge to the arriving one, turning left about du x
/// dv.
double CadCorners::angle_deg(FaceId, const Side& arriving, const Side& leaving) const {
  const double between = degrees(angle_between(leaving.away, arriving.away));
  const Vec3 normal = normalized(arriving.normal) + normalized(leaving.normal);
  const bool turns_left = dot(normal, cross(leaving.away, arriving.away)) >= 0;
  const bool is_cusp = between < 1e-3;  // which side is inside cannot be said: a sharp corner is what is looked for
  return turns_left || is_cusp ? between : 360 - between;
}

void CadCorners::measure_face(FaceId face) {
  const ModelTables& t = model_.tables();
  is_known_[face] = 1;
  for (const LoopId l : t.loops(face)) {
    std::vector<CoedgeId> coedges;  // those that the mesh has
    for (const CoedgeId c : t.loop_coedges(l))
      if (!t.edge_is_degenerate[t.coedge_edge[c]] && !is_merged_[t.coedge_edge[c]]) coedges.push_back(c);
    for (std::size_t i = 0; i < coedges.size(); ++i) {
      const Side arriving = side_of(face, coedges[i], true),
                 leaving = side_of(face, coedges[(i + 1) % coedges.size()], false);
      if (arriving.vertex != leaving.vertex || arriving.edge == leaving.edge)
        continue;  // a gap; a seam at a pole, a closed edge
      const double angle = angle_deg(face, arriving, leaving);
      double& known = smallest_.try_emplace({face, arriving.vertex}, 360).first->second;
      known = std::min(known, angle);
    }
  }
}

}  // namespace st
