#include "geometry/model/model_tables.h"

#include <BRep_Tool.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/boxes.h"
#include "base/error.h"
#include "base/threads.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/occt_evaluators.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/model/rectangle_width.h"

namespace st::occt {
namespace {

/// What a face's loops and surface tell of it.
struct FaceMeasure {
  struct Side {
    EdgeId edge;
    bool is_reversed;
  };
  Box2 bounds;
  double area = 0, width = 0, cone_volume = 0;
  Box3 box;
  std::optional<LoopCrossing> crossing;
  std::vector<std::vector<Side>> loops;
};

class TableWriter {
 public:
  TableWriter(const ImportedShape& model, const std::string& path)
      : model_(model), path_(path), origin_(model.box().center()) {}

  ModelOfFile run() {
    TopExp::MapShapes(model_.shape, TopAbs_EDGE, edges_);
    TopExp::MapShapes(model_.shape, TopAbs_VERTEX, vertices_);
    fill_vertices();
    fill_edges();
    fill_faces();
    fill_shells_and_solids();
    fill_parts();
    fill_groups();
    measures_.edge_box = std::move(edge_box_);
    return {std::move(tables_), std::move(measures_)};
  }

  ModelTables faces_alone(double scale) {
    ModelTables& t = tables_;
    for (int i = 0; i < model_.faces.Extent(); ++i) {
      const TopoDS_Face f = TopoDS::Face(model_.faces(i + 1));
      const Box3 box = early_box(TopoDS::Face(f.Oriented(TopAbs_FORWARD)));
      t.face_box.push_back({scale * box.lo, scale * box.hi});
      t.face_tolerance.push_back(scale * BRep_Tool::Tolerance(f));
      t.face_is_reversed.push_back(0);
      t.face_type.push_back(surface_type(BRep_Tool::Surface(f)));
      fill_labels(i);
    }
    fill_parts();
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
      const bool degenerate = BRep_Tool::Degenerated(e);  // what has no curve is none: it fails where it is used
      if (c.IsNull()) BRep_Tool::Range(e, t0, t1);
      if (v0.IsNull() && v1.IsNull())
        throw Error(ExitCode::kGeometry,
                    path_ + ": edge " + std::to_string(i) + " has no vertex; export the model again");
      if (v0.IsNull()) v0 = v1;
      if (v1.IsNull()) v1 = v0;
      t.edge_vertices.push_back(vertices_.FindIndex(v0) - 1);
      t.edge_vertices.push_back(vertices_.FindIndex(v1) - 1);
      t.edge_range.push_back(t0);
      t.edge_range.push_back(t1);
      t.edge_tolerance.push_back(BRep_Tool::Tolerance(e));
      t.edge_is_degenerate.push_back(degenerate);
    }
    measure_edges();
  }

  void measure_edges() {
    constexpr std::size_t kAtOnce = 8;
    ModelTables& t = tables_;
    t.edge_length.assign(edges_.Extent(), 0);
    edge_box_.resize(edges_.Extent());
    parallel_for(edge_box_.size(), kAtOnce, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        double t0 = 0, t1 = 0;
        const Handle(Geom_Curve) c = BRep_Tool::Curve(TopoDS::Edge(edges_(static_cast<int>(i) + 1)), t0, t1);
        if (t.edge_is_degenerate[i] || c.IsNull()) continue;
        const std::unique_ptr<Curve> curve = make_curve(c, t0, t1);
        t.edge_length[i] = arc_length(*curve, t0, t1, 32);
        edge_box_[i] = sampled_box(*curve);
      }
    });
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
    std::vector<FaceMeasure> measures(static_cast<std::size_t>(model_.faces.Extent()));
    parallel_for(measures.size(), 1, [&](std::size_t i, std::size_t) { measures[i] = measure(static_cast<int>(i)); });
    for (int i = 0; i < model_.faces.Extent(); ++i) {
      const FaceMeasure& m = measures[static_cast<std::size_t>(i)];
      const TopoDS_Face f = TopoDS::Face(model_.faces(i + 1));
      for (double b : {m.bounds.lo.x, m.bounds.hi.x, m.bounds.lo.y, m.bounds.hi.y}) t.face_uv_bounds.push_back(b);
      t.face_is_reversed.push_back(orientation[i] == TopAbs_REVERSED);
      t.face_type.push_back(surface_type(BRep_Tool::Surface(f)));
      t.face_tolerance.push_back(BRep_Tool::Tolerance(f));
      fill_labels(i);
      fill_loops(m);
      t.face_area.push_back(m.area);
      t.face_width.push_back(m.width);
      t.face_box.push_back(m.box);
      measures_.cone_volume.push_back(m.cone_volume);
      measures_.crossing.push_back(m.crossing);
    }
  }

  /// What the file says of a face.
  void fill_labels(int i) {
    tables_.labels.face_name.push_back(model_.attributes[i].name);
    tables_.face_layer.push_back(model_.attributes[i].layer);
    tables_.face_color.push_back(model_.attributes[i].color);
  }

  /// As measure() has it, of one face alone; of a face whose loops need repair the rough one.
  static Box3 early_box(const TopoDS_Face& face) {
    const Box3 rough = rough_box(face);
    try {
      Box3 sampled = sampled_box(make_domain(face));
      for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) sampled.add(edge_box(TopoDS::Edge(e.Current())));
      return common_box(rough, sampled);
    } catch (const Standard_Failure&) {
      return rough;
    }
  }

  /// Empty without a space curve.
  static Box3 edge_box(const TopoDS_Edge& edge) {
    double t0 = 0, t1 = 0;
    const Handle(Geom_Curve) c = BRep_Tool::Curve(edge, t0, t1);
    return BRep_Tool::Degenerated(edge) || c.IsNull() ? Box3() : sampled_box(*make_curve(c, t0, t1));
  }

  void fill_loops(const FaceMeasure& m) {
    ModelTables& t = tables_;
    for (const std::vector<FaceMeasure::Side>& loop : m.loops) {
      for (const FaceMeasure::Side& side : loop) {
        t.coedge_edge.push_back(side.edge);
        t.coedge_is_reversed.push_back(side.is_reversed);
      }
      t.loop_coedge_offsets.push_back(static_cast<std::int32_t>(t.coedge_edge.size()));
    }
    t.face_loop_offsets.push_back(static_cast<std::int32_t>(t.loop_coedge_offsets.size()) - 1);
  }

  /// Precondition: the edges' tables are filled.
  FaceMeasure measure(int i) const {
    const ModelTables& t = tables_;
    const TopoDS_Face f = TopoDS::Face(model_.faces(i + 1).Oriented(TopAbs_FORWARD));
    const FaceDomain domain = make_domain(f);
    const FaceIntegral integral = integrate_face(domain, origin_);
    FaceMeasure m;
    m.bounds = domain.bounds;
    m.area = std::fabs(integral.area);
    m.cone_volume = integral.volume;
    Box3 sampled = sampled_box(domain);
    double perimeter = 0, tolerance = BRep_Tool::Tolerance(f);
    for (const LoopUv& loop : domain.loops) {
      std::vector<FaceMeasure::Side>& sides = m.loops.emplace_back();
      for (const CoedgeUv& c : loop.coedges) {
        const EdgeId e = edges_.FindIndex(c.edge) - 1;
        sides.push_back({e, c.edge.Orientation() == TopAbs_REVERSED});
        perimeter += t.edge_length[e];
        tolerance = std::max(tolerance, t.edge_tolerance[e]);
        sampled.add(edge_box_[e]);
      }
    }
    m.width = rectangle_width(m.area, perimeter);
    m.box = rough_box(f);
    if (!m.box.is_empty() && !sampled.is_empty()) m.box = common_box(m.box, sampled);
    m.crossing = find_loop_crossing(domain, 2 * tolerance);
    return m;
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

  /// Parts that have a path, in the order of their first face.
  void fill_parts() {
    FaceLabels& labels = tables_.labels;
    std::vector<std::int32_t> number(model_.parts.size(), kNone);
    for (const FaceAttributes& face : model_.attributes) {
      const std::int32_t p = face.part_index;
      const bool has_part = p != kNone && static_cast<std::size_t>(p) < number.size() && !model_.parts[p].path.empty();
      if (has_part && number[p] == kNone) {
        number[p] = static_cast<std::int32_t>(labels.part_name.size());
        labels.part_name.push_back(model_.parts[p].name);
        labels.part_path.push_back(model_.parts[p].path);
      }
      labels.face_part.push_back(has_part ? number[p] : kNone);
    }
    if (labels.part_name.empty()) labels.face_part.clear();
  }

  static std::string name_in_file(const FaceAttributes& d) {
    return !d.name.empty() ? d.name : !d.part.empty() ? d.part : "default";
  }

  /// Names of faces of which only some have a recognised role, or not all the same.
  std::set<std::string> names_of_several_roles() const {
    std::map<std::string, std::string> role_of;
    std::set<std::string> names;
    for (const FaceAttributes& d : model_.attributes)
      if (const auto [it, is_new] = role_of.emplace(name_in_file(d), d.role); !is_new && it->second != d.role)
        names.insert(it->first);
    return names;
  }

  /// A face with a recognised role keeps the name that the file gives it, but not one that other faces have.
  void fill_groups() {
    ModelTables& t = tables_;
    const std::set<std::string> mixed = names_of_several_roles();
    std::map<std::string, std::int32_t> ids;
    for (int i = 0; i < model_.faces.Extent(); ++i) {
      const FaceAttributes& d = model_.attributes[i];
      const bool is_renamed = !d.role.empty() && (d.name.empty() || mixed.count(d.name) > 0);
      const std::string name = is_renamed ? d.role : name_in_file(d);
      const auto [it, is_new] = ids.emplace(name, static_cast<std::int32_t>(t.labels.group_name.size()));
      if (is_new) {
        t.labels.group_name.push_back(name);
        t.labels.group_role.push_back(d.role.empty() ? role_of_name(name) : d.role);
        t.labels.group_attributes.push_back("{}");
      }
      t.labels.face_group.push_back(it->second);
    }
  }

  const ImportedShape& model_;
  const std::string path_;
  Vec3 origin_;
  ModelTables tables_;
  FaceMeasures measures_;
  std::vector<Box3> edge_box_;
  TopTools_IndexedMapOfShape edges_, vertices_;
};

}  // namespace

ModelOfFile make_tables(const ImportedShape& model, const std::string& path) { return TableWriter(model, path).run(); }

ModelTables make_face_tables(const ImportedShape& model, double scale) {
  return TableWriter(model, "").faces_alone(scale);
}

}  // namespace st::occt
