// Without OpenCASCADE: who asks for tables alone does not load it.
#include "geometry/model/model.h"

namespace st {
namespace {

std::string label(const char* kind, int id, const std::string& name) {
  std::string text = std::string(kind) + " " + std::to_string(id + 1);
  if (!name.empty()) text += " \"" + name + "\"";
  return text;
}

}  // namespace

Box3 ModelTables::box() const {
  Box3 b;
  for (const Box3& f : face_box) b.add(f);
  return b;
}

Box3 ModelTables::wall_box() const {
  const auto has_role = [&](FaceId f, const char* role) { return labels.group_role[labels.face_group[f]] == role; };
  bool is_domain = false;
  for (FaceId f = 0; f < n_faces(); ++f) is_domain = is_domain || has_role(f, "farfield");
  Box3 b;
  for (FaceId f = 0; f < n_faces(); ++f)
    if (!is_outer_role(labels.group_role[labels.face_group[f]]) && !(is_domain && has_role(f, "interface")))
      b.add(face_box[f]);
  return b.is_empty() ? box() : b;
}

std::string ModelTables::face_label(FaceId f) const { return label("face", f, labels.face_name[f]); }
std::string ModelTables::edge_label(EdgeId e) const { return label("edge", e, edge_name[e]); }

void ModelTables::edge_faces(std::vector<std::int32_t>& offsets, std::vector<FaceId>& faces) const {
  offsets.assign(n_edges() + 1, 0);
  for (EdgeId e : coedge_edge) ++offsets[e + 1];
  for (EdgeId e = 0; e < n_edges(); ++e) offsets[e + 1] += offsets[e];
  faces.resize(coedge_edge.size());
  std::vector<std::int32_t> next(offsets.begin(), offsets.end() - 1);
  for (FaceId f = 0; f < n_faces(); ++f)
    for (const LoopId l : loops(f))
      for (const CoedgeId c : loop_coedges(l)) faces[next[coedge_edge[c]]++] = f;
}

}  // namespace st
