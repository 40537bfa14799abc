#include "geometry/model/model_state.h"

#include <TopoDS.hxx>
#include <algorithm>

#include "geometry/brep/face_integral.h"
#include "geometry/model/model_editor.h"
#include "geometry/model/model_impl.h"

namespace st {

EdgeUses report_edge_uses(const ModelTables& t) {
  EdgeUses result;
  std::vector<int> uses(t.n_edges(), 0), turns(t.n_edges(), 0);
  for (FaceId f = 0; f < t.n_faces(); ++f)
    for (std::int32_t c = t.loop_coedge_offsets[t.face_loop_offsets[f]];
         c < t.loop_coedge_offsets[t.face_loop_offsets[f + 1]]; ++c) {
      ++uses[t.coedge_edge[c]];
      turns[t.coedge_edge[c]] += t.coedge_is_reversed[c] == t.face_is_reversed[f] ? 1 : -1;
    }
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e] || uses[e] == 0 || (uses[e] == 2 && turns[e] == 0)) continue;
    ++(uses[e] == 1 ? result.n_free : uses[e] == 2 ? result.n_contradictory : result.n_nonmanifold);
    const FindingKind kind = uses[e] == 1   ? FindingKind::kFreeEdge
                             : uses[e] == 2 ? FindingKind::kContradiction
                                            : FindingKind::kNonManifoldEdge;
    result.findings.push_back({kind, t.edge_label(e), t.vertex_xyz[t.edge_vertices[2 * e]], t.edge_length[e], false});
  }
  return result;
}

bool is_closed(const ModelTables& t, const EdgeUses& uses) {
  const auto is_in_shell = [](std::int32_t shell) { return shell != kNone; };
  return uses.n_free == 0 && uses.n_contradictory == 0 &&
         std::any_of(t.face_shell.begin(), t.face_shell.end(), is_in_shell);
}

double enclosed_volume(const Model& whole) {
  const Model& model = whole.cad();
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
