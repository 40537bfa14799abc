#include "geometry/model/model_state.h"

#include <TopoDS.hxx>
#include <algorithm>

#include "geometry/brep/face_integral.h"
#include "geometry/model/model_editor.h"
#include "geometry/model/model_impl.h"

namespace st {

EdgeUses report_edge_uses(const ModelTables& t) {
  EdgeUses result;
  std::vector<int> uses(t.n_edges(), 0);
  for (const EdgeId e : t.coedge_edge) ++uses[e];
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e] || uses[e] == 2 || uses[e] == 0) continue;
    const bool is_free = uses[e] == 1;
    ++(is_free ? result.n_free : result.n_nonmanifold);
    result.findings.push_back({is_free ? FindingKind::kFreeEdge : FindingKind::kNonManifoldEdge, t.edge_label(e),
                               t.vertex_xyz[t.edge_vertices[2 * e]], t.edge_length[e], false});
  }
  return result;
}

bool is_closed(const ModelTables& t, int n_free_edges) {
  const auto is_in_shell = [](std::int32_t shell) { return shell != kNone; };
  return n_free_edges == 0 && std::any_of(t.face_shell.begin(), t.face_shell.end(), is_in_shell);
}

double enclosed_volume(const Model& model) {
  const ModelTables& t = model.tables();
  const Vec3 origin = t.box().center();
  double volume = 0;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    const TopoDS_Face face = TopoDS::Face(ModelEditor::brep(model).faces(f + 1).Oriented(TopAbs_FORWARD));
    volume += (t.face_is_reversed[f] ? -1 : 1) * occt::integrate_face(occt::make_domain(face), origin).volume;
  }
  return volume;
}

}  // namespace st
