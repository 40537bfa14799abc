#include "geometry/model/edit_model.h"

#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <gp_GTrsf2d.hxx>
#include <numeric>
#include <string>

#include "base/error.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/scaled_shape.h"
#include "geometry/model/edge_faces.h"
#include "geometry/model/model_editor.h"
#include "geometry/model/model_impl.h"
#include "geometry/model/model_tables.h"
#include "geometry/model/select_tables.h"

namespace st {
namespace {

template <class T>
void add_all(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::vector<FaceId> checked(const ModelTables& t, std::span<const FaceId> faces) {
  std::vector<char> seen(t.n_faces(), 0);
  for (const FaceId f : faces) {
    if (f < 0 || f >= t.n_faces())
      throw Error(ExitCode::kUsage, "face " + std::to_string(f + 1) + " is not in the model; it has " +
                                        std::to_string(t.n_faces()) + " faces");
    if (seen[f]) throw Error(ExitCode::kUsage, t.face_label(f) + " is named twice; name each face once");
    seen[f] = 1;
  }
  if (faces.empty()) throw Error(ExitCode::kUsage, "no face would be left; name at least one face to keep");
  return {faces.begin(), faces.end()};
}

/// Loops of the faces of a part.
void select_loops(const ModelTables& t, const std::vector<FaceId>& faces, const std::vector<EdgeId>& e,
                  ModelTables& out) {
  const std::vector<std::int32_t> edge_place = places(e, t.n_edges());
  out.face_loop_offsets = {0};
  out.loop_coedge_offsets = {0};
  out.coedge_edge.clear();
  out.coedge_is_reversed.clear();
  for (const FaceId f : faces) {
    for (const LoopId l : t.loops(f)) {
      for (const CoedgeId c : t.loop_coedges(l)) {
        out.coedge_edge.push_back(edge_place[t.coedge_edge[c]]);
        out.coedge_is_reversed.push_back(t.coedge_is_reversed[c]);
      }
      out.loop_coedge_offsets.push_back(out.n_coedges());
    }
    out.face_loop_offsets.push_back(out.n_loops());
  }
}

/// Ids in `whole` of the entities of a kind in `part`.
std::vector<std::int32_t> ids_of(const TopoDS_Shape& part, TopAbs_ShapeEnum kind,
                                 const TopTools_IndexedMapOfShape& whole) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(part, kind, map);
  std::vector<std::int32_t> ids;
  for (int i = 1; i <= map.Extent(); ++i) ids.push_back(whole.FindIndex(map(i)) - 1);
  return ids;
}

/// Ids in the whole of the vertices of `part`, found through its edges; through all vertices of the whole only for one
/// on no edge.
std::vector<VertexId> vertex_ids(const TopoDS_Shape& part, const std::vector<EdgeId>& edges, const ModelTables& t,
                                 const Model::Impl& whole) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(part, TopAbs_VERTEX, map);
  std::vector<VertexId> ids(map.Extent(), kNone);
  for (const EdgeId e : edges) {
    TopoDS_Vertex ends[2];
    TopExp::Vertices(TopoDS::Edge(whole.edges(e + 1).Oriented(TopAbs_FORWARD)), ends[0], ends[1], false);
    for (int end = 0; end < 2; ++end)
      if (!ends[end].IsNull())
        ids[map.FindIndex(ends[end]) - 1] = t.edge_vertices[2 * static_cast<std::size_t>(e) + end];
  }
  if (std::find(ids.begin(), ids.end(), kNone) == ids.end()) return ids;
  TopTools_IndexedMapOfShape all;
  TopExp::MapShapes(whole.shape, TopAbs_VERTEX, all);
  return ids_of(part, TopAbs_VERTEX, all);
}

/// What is known of the faces, which are the same in both, beyond their shapes. The B-Rep of a part has no shells any
/// more.
void copy_labels(const ModelTables& t, ModelTables& out) {
  out.face_color = t.face_color;
  out.face_layer = t.face_layer;
  out.labels = t.labels;
  out.face_shell = t.face_shell;
  out.face_solid = t.face_solid;
  out.n_shells = t.n_shells;
  out.n_solids = t.n_solids;
}

/// 0, 1, 2 ...
std::vector<std::int32_t> numbers(std::int32_t n) {
  std::vector<std::int32_t> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

gp_Trsf trsf_of(const Similarity& m) {
  const Vec3 a = m.scale * m.rotation[0], b = m.scale * m.rotation[1], c = m.scale * m.rotation[2];
  gp_Trsf t;
  t.SetValues(a.x, a.y, a.z, m.translation.x, b.x, b.y, b.z, m.translation.y, c.x, c.y, c.z, m.translation.z);
  return t;
}

/// Throws Error(kGeometry) where the faces in `moves` have edges or vertices in common with the others.
void require_apart(const ModelTables& t, const std::vector<char>& moves) {
  const EdgeFaces faces_at(t);
  std::vector<FaceId> at_vertex[2];  // a face at each vertex that stays, that moves
  at_vertex[0].assign(t.n_vertices(), kNone);
  at_vertex[1] = at_vertex[0];
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    for (const FaceId f : faces_at[e])
      for (const int end : {0, 1})
        at_vertex[moves[f] ? 1 : 0][t.edge_vertices[2 * static_cast<std::size_t>(e) + end]] = f;
  const auto fail = [&](const std::string& what, FaceId moving, FaceId staying) {
    throw Error(ExitCode::kGeometry, "the model would tear at " + what + ": " + t.face_label(moving) + " would move, " +
                                         t.face_label(staying) +
                                         " next to it would not; select whole bodies, or move everything");
  };
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    for (const FaceId b : faces_at[e])
      if (const FaceId a = faces_at[e][0]; moves[a] != moves[b])
        fail(t.edge_label(e), moves[a] ? a : b, moves[a] ? b : a);
  for (VertexId v = 0; v < t.n_vertices(); ++v)
    if (at_vertex[0][v] != kNone && at_vertex[1][v] != kNone)
      fail("vertex " + std::to_string(v + 1), at_vertex[1][v], at_vertex[0][v]);
}

/// Adds `more`, each raised by `shift` unless it is kNone.
void add_shifted(std::vector<std::int32_t>& to, std::span<const std::int32_t> more, std::int32_t shift) {
  for (const std::int32_t id : more) to.push_back(id == kNone ? kNone : id + shift);
}

void append_topology(ModelTables& t, const ModelTables& s) {
  const std::int32_t n_vertices = t.n_vertices(), n_edges = t.n_edges(), n_loops = t.n_loops(),
                     n_coedges = t.n_coedges();
  add_all(t.vertex_xyz, s.vertex_xyz);
  add_all(t.vertex_tolerance, s.vertex_tolerance);
  add_shifted(t.edge_vertices, s.edge_vertices, n_vertices);
  add_all(t.edge_range, s.edge_range);
  add_all(t.edge_length, s.edge_length);
  add_all(t.edge_tolerance, s.edge_tolerance);
  add_all(t.edge_is_degenerate, s.edge_is_degenerate);
  add_all(t.edge_name, s.edge_name);
  add_shifted(t.face_loop_offsets, std::span(s.face_loop_offsets).subspan(1), n_loops);
  add_shifted(t.loop_coedge_offsets, std::span(s.loop_coedge_offsets).subspan(1), n_coedges);
  add_shifted(t.coedge_edge, s.coedge_edge, n_edges);
  add_all(t.coedge_is_reversed, s.coedge_is_reversed);
  append_groups(t.labels.edge_groups, s.labels.edge_groups, n_edges);
  append_groups(t.labels.vertex_groups, s.labels.vertex_groups, n_vertices);
}

void append_faces(ModelTables& t, const ModelTables& s) {
  t.labels = append_labels(t.labels, t.n_faces(), s.labels, s.n_faces());
  add_all(t.face_is_reversed, s.face_is_reversed);
  add_all(t.face_type, s.face_type);
  add_all(t.face_uv_bounds, s.face_uv_bounds);
  add_all(t.face_tolerance, s.face_tolerance);
  add_all(t.face_area, s.face_area);
  add_all(t.face_width, s.face_width);
  add_all(t.face_box, s.face_box);
  add_all(t.face_color, s.face_color);
  add_all(t.face_layer, s.face_layer);
  add_shifted(t.face_shell, s.face_shell, t.n_shells);
  add_shifted(t.face_solid, s.face_solid, t.n_solids);
  t.n_shells += s.n_shells;
  t.n_solids += s.n_solids;
}

}  // namespace

SubModel extract(const Model& model, std::span<const FaceId> wanted) {
  const ModelTables& t = model.tables();
  const Model::Impl& whole = ModelEditor::brep(model);
  std::vector<FaceId> faces = checked(t, wanted);
  std::vector<TopoDS_Shape> shapes;
  for (const FaceId f : faces)
    shapes.push_back(whole.faces(f + 1).Oriented(t.face_is_reversed[f] ? TopAbs_REVERSED : TopAbs_FORWARD));
  const TopoDS_Compound part = occt::compound_of(shapes);
  std::vector<EdgeId> edges = ids_of(part, TopAbs_EDGE, whole.edges);
  std::vector<VertexId> vertices = vertex_ids(part, edges, t, whole);
  ModelTables out;
  select_faces(t, faces, out);
  select_edges(t, edges, vertices, out);
  select_loops(t, faces, edges, out);
  out.n_shells = t.n_shells;
  out.n_solids = t.n_solids;
  out.unit = t.unit;
  out.unit_in_m = t.unit_in_m;
  return {Model(std::move(out), occt::brep_bytes(part)), std::move(faces), std::move(edges), std::move(vertices)};
}

Model transform(const Model& model, const Similarity& motion) {
  const ModelTables& t = model.tables();
  const gp_Trsf trsf = trsf_of(motion);
  occt::ImportedShape moved;
  occt::ModelOfFile measured;
  try {
    moved.shape = occt::scaled_shape(ModelEditor::brep(model).shape, trsf).Shape();
    TopExp::MapShapes(moved.shape, TopAbs_FACE, moved.faces);
    moved.attributes.resize(moved.faces.Extent());
    measured = occt::make_tables(moved, "the transformed model");
  } catch (const Standard_Failure& e) {
    throw Error(ExitCode::kGeometry, std::string("OpenCASCADE cannot transform this model (") + e.GetMessageString() +
                                         "); transform it in the CAD system");
  }
  ModelTables& out = measured.tables;
  out.edge_name = t.edge_name;
  copy_labels(t, out);
  out.unit = t.unit;
  out.unit_in_m = t.unit_in_m;
  if (t.volume) out.volume = *t.volume * std::pow(motion.scale, 3);
  return Model(std::move(out), occt::brep_bytes(moved.shape));
}

Vec2 parameter_growth(const Model& model, FaceId f, double scale) {
  Similarity motion;
  motion.scale = scale;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(ModelEditor::brep(model).faces(f + 1)));
  gp_XY growth(1, 1);
  surface->ParametricTransformation(trsf_of(motion)).Transforms(growth);
  return {growth.X(), growth.Y()};
}

SubModel transform_faces(const Model& model, std::span<const FaceId> wanted, const Similarity& motion) {
  const ModelTables& t = model.tables();
  std::vector<char> moves(t.n_faces(), 0);
  for (const FaceId f : checked(t, wanted)) moves[f] = 1;
  require_apart(t, moves);
  std::vector<FaceId> rest_faces, order(t.n_faces());  // order: of the model's faces in the rest with the part behind
                                                       // it
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (!moves[f]) {
      order[f] = static_cast<FaceId>(rest_faces.size());
      rest_faces.push_back(f);
    }
  for (std::size_t i = 0; i < wanted.size(); ++i) order[wanted[i]] = static_cast<FaceId>(rest_faces.size() + i);
  if (rest_faces.empty())
    return {transform(model, motion), numbers(t.n_faces()), numbers(t.n_edges()), numbers(t.n_vertices())};

  SubModel rest = extract(model, rest_faces);
  const SubModel part = extract(model, wanted);
  const SubModel both = extract(append(rest.model, transform(part.model, motion)), order);
  add_all(rest.edges, part.edges);
  add_all(rest.vertices, part.vertices);
  const std::vector<EdgeId> edges = gather(rest.edges, both.edges);
  const std::vector<VertexId> vertices = gather(rest.vertices, both.vertices);
  ModelTables out = both.model.tables();
  copy_labels(t, out);
  out.labels.edge_groups = select_groups(t.labels.edge_groups, places(edges, t.n_edges()));
  out.labels.vertex_groups = select_groups(t.labels.vertex_groups, places(vertices, t.n_vertices()));
  if (motion.scale == 1) out.volume = t.volume;
  return {Model(std::move(out), both.model.brep()), numbers(t.n_faces()), edges, vertices};
}

Model append(const Model& first, const Model& second) {
  ModelTables t = first.tables();
  const ModelTables& s = second.tables();
  if (t.unit != s.unit || t.unit_in_m != s.unit_in_m)
    throw Error(ExitCode::kMismatch,
                "one model is in '" + t.unit + "', the other in '" + s.unit + "'; import both with the same --unit");
  append_topology(t, s);
  append_faces(t, s);
  t.volume = first.tables().volume && s.volume ? std::optional(*first.tables().volume + *s.volume) : std::nullopt;
  // from bytes: shapes that both models share would count once
  const Model copy(s, second.brep());
  return Model(std::move(t),
               occt::brep_bytes(occt::compound_of({ModelEditor::brep(first).shape, ModelEditor::brep(copy).shape})));
}

}  // namespace st
