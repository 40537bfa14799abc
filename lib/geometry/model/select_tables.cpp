#include "geometry/model/select_tables.h"

namespace st {

std::vector<std::int32_t> places(const std::vector<std::int32_t>& ids, std::int32_t n_entities) {
  std::vector<std::int32_t> place(n_entities, kNone);
  for (std::size_t i = 0; i < ids.size(); ++i) place[ids[i]] = static_cast<std::int32_t>(i);
  return place;
}

void select_faces(const ModelTables& t, const std::vector<FaceId>& f, ModelTables& out) {
  out.face_is_reversed = gather(t.face_is_reversed, f);
  out.face_type = gather(t.face_type, f);
  out.face_uv_bounds = gather(t.face_uv_bounds, f, 4);
  out.face_tolerance = gather(t.face_tolerance, f);
  out.face_area = gather(t.face_area, f);
  out.face_width = gather(t.face_width, f);
  out.face_box = gather(t.face_box, f);
  out.face_color = gather(t.face_color, f);
  out.face_layer = gather(t.face_layer, f);
  out.face_shell = gather(t.face_shell, f);
  out.face_solid = gather(t.face_solid, f);
  out.labels = select_labels(t.labels, f);
}

void select_edges(const ModelTables& t, const std::vector<EdgeId>& e, const std::vector<VertexId>& v,
                  ModelTables& out) {
  out.vertex_xyz = gather(t.vertex_xyz, v);
  out.vertex_tolerance = gather(t.vertex_tolerance, v);
  const std::vector<std::int32_t> vertex_place = places(v, t.n_vertices());
  out.edge_vertices = gather(t.edge_vertices, e, 2);
  for (VertexId& vertex : out.edge_vertices) vertex = vertex_place[vertex];
  out.edge_range = gather(t.edge_range, e, 2);
  out.edge_length = gather(t.edge_length, e);
  out.edge_tolerance = gather(t.edge_tolerance, e);
  out.edge_is_degenerate = gather(t.edge_is_degenerate, e);
  out.edge_name = gather(t.edge_name, e);
  out.labels.edge_groups = select_groups(t.labels.edge_groups, places(e, t.n_edges()));
  out.labels.vertex_groups = select_groups(t.labels.vertex_groups, vertex_place);
}

}  // namespace st
