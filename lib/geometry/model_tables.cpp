#include "geometry/model_tables.h"

#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <cctype>
#include <cmath>
#include <map>

#include "base/error.h"
#include "geometry/occt_evaluators.h"

namespace st::occt {
namespace {

class TableWriter {
 public:
  TableWriter(const ImportedShape& model, const std::string& path) : model_(model), path_(path) {}

  ModelTables run() {
    TopExp::MapShapes(model_.shape, TopAbs_EDGE, edges_);
    TopExp::MapShapes(model_.shape, TopAbs_VERTEX, vertices_);
    fill_vertices();
    fill_edges();
    fill_faces();
    fill_shells_and_solids();
    fill_groups();
    return std::move(tables_);
  }

 private:
  void fill_vertices() {
    ModelTables& t = tables_;
    for (int i = 1; i <= vertices_.Extent(); ++i) {
      t.vertex_xyz.push_back(vec(BRep_Tool::Pnt(TopoDS::Vertex(vertices_(i)))));
      t.vertex_tolerance.push_back(BRep_Tool::Tolerance(TopoDS::Vertex(vertices_(i))));
    }
  }

  void fill_edges() {
    ModelTables& t = tables_;
    t.edge_name.resize(edges_.Extent());
    for (const auto& [edge, name] : model_.edge_names)
      if (const int i = edges_.FindIndex(edge); i > 0) t.edge_name[i - 1] = name;
    for (int i = 1; i <= edges_.Extent(); ++i) {
      const TopoDS_Edge e = TopoDS::Edge(edges_(i).Oriented(TopAbs_FORWARD));
      TopoDS_Vertex v0, v1;
      TopExp::Vertices(e, v0, v1, false);
      double t0 = 0, t1 = 0;
      const Handle(Geom_Curve) c = BRep_Tool::Curve(e, t0, t1);
      const bool degenerate = BRep_Tool::Degenerated(e) || c.IsNull();
      if (c.IsNull()) BRep_Tool::Range(e, t0, t1);
      if (v0.IsNull() && v1.IsNull())
        throw Error(ExitCode::kGeometry, path_ + ": edge " + std::to_string(i) + " has no vertex; export the model again");
      if (v0.IsNull()) v0 = v1;
      if (v1.IsNull()) v1 = v0;
      t.edge_vertices.push_back(vertices_.FindIndex(v0) - 1);
      t.edge_vertices.push_back(vertices_.FindIndex(v1) - 1);
      t.edge_range.push_back(t0);
      t.edge_range.push_back(t1);
      t.edge_tolerance.push_back(BRep_Tool::Tolerance(e));
      t.edge_is_degenerate.push_back(degenerate);
      t.edge_length.push_back(degenerate ? 0.0 : arc_length(*make_curve(c, t0, t1), t0, t1, 32));
    }
  }

  void fill_faces() {
    ModelTables& t = tables_;
    std::vector<TopAbs_Orientation> orientation(model_.faces.Extent(), TopAbs_FORWARD);
    std::vector<char> seen(model_.faces.Extent(), 0);
    for (TopExp_Explorer e(model_.shape, TopAbs_FACE); e.More(); e.Next()) {
      const int i = model_.faces.FindIndex(e.Current()) - 1;
      if (seen[i]) continue;
      seen[i] = 1;
      orientation[i] = e.Current().Orientation();
    }
    t.face_loop_offsets.push_back(0);
    t.loop_coedge_offsets.push_back(0);
    for (int i = 0; i < model_.faces.Extent(); ++i) {
      const TopoDS_Face f = TopoDS::Face(model_.faces(i + 1).Oriented(TopAbs_FORWARD));
      double u0, u1, v0, v1;
      BRepTools::UVBounds(f, u0, u1, v0, v1);
      for (double b : {u0, u1, v0, v1}) t.face_uv_bounds.push_back(b);
      t.face_is_reversed.push_back(orientation[i] == TopAbs_REVERSED);
      t.face_type.push_back(surface_type(BRep_Tool::Surface(f)));
      t.face_tolerance.push_back(BRep_Tool::Tolerance(f));
      GProp_GProps properties;
      BRepGProp::SurfaceProperties(f, properties);
      t.face_area.push_back(std::abs(properties.Mass()));
      t.face_box.push_back(rough_box(f));
      t.face_name.push_back(model_.attributes[i].name);
      t.face_layer.push_back(model_.attributes[i].layer);
      t.face_color.push_back(model_.attributes[i].color);
      fill_loops(f);
    }
  }

  struct Loop {
    std::vector<TopoDS_Edge> edges;
    double area = 0;  // signed, in (u,v)
  };

  void fill_loops(const TopoDS_Face& f) {
    ModelTables& t = tables_;
    std::vector<Loop> loops;
    for (TopoDS_Iterator w(f); w.More(); w.Next()) {
      if (w.Value().ShapeType() != TopAbs_WIRE) continue;
      Loop loop;
      for (BRepTools_WireExplorer e(TopoDS::Wire(w.Value()), f); e.More(); e.Next())
        if (!is_constraint(e.Current())) loop.edges.push_back(e.Current());
      if (loop.edges.empty()) continue;
      loop.area = uv_area(loop.edges, f);
      loops.push_back(std::move(loop));
    }
    std::stable_sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.area > b.area; });
    for (const Loop& loop : loops) {
      for (const TopoDS_Edge& e : loop.edges) {
        t.coedge_edge.push_back(edges_.FindIndex(e) - 1);
        t.coedge_is_reversed.push_back(e.Orientation() == TopAbs_REVERSED);
      }
      t.loop_coedge_offsets.push_back(static_cast<std::int32_t>(t.coedge_edge.size()));
    }
    t.face_loop_offsets.push_back(static_cast<std::int32_t>(t.loop_coedge_offsets.size()) - 1);
  }

  static double uv_area(const std::vector<TopoDS_Edge>& edges, const TopoDS_Face& f) {
    std::vector<Vec2> polygon;
    for (const TopoDS_Edge& e : edges) {
      double t0, t1;
      const Handle(Geom2d_Curve) c = BRep_Tool::CurveOnSurface(e, f, t0, t1);
      if (c.IsNull()) continue;
      const bool reversed = e.Orientation() == TopAbs_REVERSED;
      constexpr int kSamples = 16;
      for (int k = 0; k < kSamples; ++k) {
        const double s = reversed ? 1.0 - double(k) / kSamples : double(k) / kSamples;
        const gp_Pnt2d p = c->Value(t0 + s * (t1 - t0));
        polygon.push_back({p.X(), p.Y()});
      }
    }
    double area = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      area += 0.5 * cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
    return area;
  }

  void fill_shells_and_solids() {
    ModelTables& t = tables_;
    t.face_shell.assign(model_.faces.Extent(), kNone);
    t.face_solid.assign(model_.faces.Extent(), kNone);
    const auto number = [&](TopAbs_ShapeEnum kind, std::vector<std::int32_t>& ids) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(model_.shape, kind, map);
      for (int i = 1; i <= map.Extent(); ++i)
        for (TopExp_Explorer e(map(i), TopAbs_FACE); e.More(); e.Next())
          if (std::int32_t& id = ids[model_.faces.FindIndex(e.Current()) - 1]; id == kNone) id = i - 1;
      return map.Extent();
    };
    t.n_shells = number(TopAbs_SHELL, t.face_shell);
    t.n_solids = number(TopAbs_SOLID, t.face_solid);
  }

  void fill_groups() {
    ModelTables& t = tables_;
    std::map<std::string, std::int32_t> ids;
    for (int i = 0; i < model_.faces.Extent(); ++i) {
      const FaceAttributes& d = model_.attributes[i];
      const std::string name = !d.name.empty() ? d.name : !d.part.empty() ? d.part : "default";
      const auto [it, is_new] = ids.emplace(name, static_cast<std::int32_t>(t.group_name.size()));
      if (is_new) {
        t.group_name.push_back(name);
        t.group_role.push_back(role_of(name));
      }
      t.face_group.push_back(it->second);
    }
  }

  static std::string role_of(const std::string& name) {
    std::string s;
    for (unsigned char c : name)
      if (std::isalnum(c)) s += static_cast<char>(std::tolower(c));
    if (s.find("farfield") != std::string::npos) return "farfield";
    if (s.find("symmetry") != std::string::npos || s.rfind("sym", 0) == 0) return "symmetry";
    return "wall";
  }

  const ImportedShape& model_;
  const std::string& path_;
  ModelTables tables_;
  TopTools_IndexedMapOfShape edges_, vertices_;
};

}  // namespace

ModelTables make_tables(const ImportedShape& model, const std::string& path) { return TableWriter(model, path).run(); }

}  // namespace st::occt
