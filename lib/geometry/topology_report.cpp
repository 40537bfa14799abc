#include "geometry/topology_report.h"

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>

namespace st::occt {

void report_topology(const ImportedShape& model, ImportResult& result) {
  ModelTables& t = result.tables;
  std::vector<int> uses(t.n_edges(), 0);
  for (EdgeId e : t.coedge_edge) ++uses[e];
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e]) continue;
    const Vec3 at = t.vertex_xyz[t.edge_vertices[2 * e]];
    if (uses[e] == 1) {
      ++result.n_free_edges;
      result.findings.push_back({"free edge", t.edge_label(e), at, t.edge_length[e], false});
    } else if (uses[e] > 2) {
      ++result.n_nonmanifold_edges;
      result.findings.push_back({"non-manifold edge", t.edge_label(e), at, t.edge_length[e], false});
    }
  }
  result.is_closed = t.n_shells > 0 && result.n_free_edges == 0;
  for (double a : t.face_area) result.area += a;
  if (result.is_closed) {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(model.shape, properties);
    result.volume = properties.Mass();
  }
}

}  // namespace st::occt
