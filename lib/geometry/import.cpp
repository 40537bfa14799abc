#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Bnd_Box.hxx>
#include <BRepBndLib.hxx>
#include <GProp_GProps.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Edge.hxx>
#include <ShapeFix_Face.hxx>
#include <ShapeFix_Shape.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>

#include "base/error.h"
#include "base/length.h"
#include "geometry/cad_reader.h"
#include "geometry/model.h"
#include "geometry/occt_evaluators.h"

namespace st {
namespace {

constexpr double kSewRelative[] = {1e-6, 1e-5, 1e-4};  // of the diagonal, first that closes the model wins

Vec3 vec(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }


Box3 rough_box(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  Box3 result;
  if (box.IsVoid()) return result;
  result.add(vec(box.CornerMin()));
  result.add(vec(box.CornerMax()));
  return result;
}

bool is_constraint(const TopoDS_Shape& edge) { return edge.Orientation() == TopAbs_INTERNAL || edge.Orientation() == TopAbs_EXTERNAL; }

/// How often faces use each edge (a seam counts twice).
std::vector<int> edge_uses(const TopoDS_Shape& shape, TopTools_IndexedMapOfShape& edges) {
  edges.Clear();
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::vector<int> uses(edges.Extent(), 0);
  for (int f = 1; f <= faces.Extent(); ++f)
    for (TopExp_Explorer e(faces(f).Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next())
      if (!is_constraint(e.Current())) ++uses[edges.FindIndex(e.Current()) - 1];
  return uses;
}

int count_free_edges(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape edges;
  const std::vector<int> uses = edge_uses(shape, edges);
  int n = 0;
  for (int i = 0; i < edges.Extent(); ++i) n += uses[i] == 1 && !BRep_Tool::Degenerated(TopoDS::Edge(edges(i + 1)));
  return n;
}

double max_edge_tolerance(const TopoDS_Shape& shape) {
  double tolerance = 0;
  for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next())
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Edge(e.Current())));
  return tolerance;
}

std::string format_number(double x) {
  std::ostringstream s;
  s.precision(4);
  s << x;
  return s.str();
}

/// The import, step by step: read, collect, sew, repair, scale, tables.
class Importer {
 public:
  Importer(const std::string& path, const ImportOptions& options) : path_(path), options_(options) {}

  ImportResult run() {
    file_ = occt::read_cad(path_);
    result_.format = file_.format;
    collect_parts();
    sew_if_open();
    repair_loops();
    scale_to_unit();
    fill_tables();
    report_topology();
    store_brep();
    return std::move(result_);
  }

 private:
  struct FaceData {
    std::string name, layer, part;
    std::int32_t color = kNone;
  };

  void finding(const std::string& what, const std::string& entity, Vec3 xyz, double size, bool is_repair) {
    result_.findings.push_back({what, entity, xyz, size, is_repair});
    result_.n_repairs += is_repair;
  }

  void collect_parts() {
    BRep_Builder builder;
    TopoDS_Compound compound;
    builder.MakeCompound(compound);
    for (const auto& part : file_.parts) {
      if (part.faces.empty()) continue;
      builder.Add(compound, part.shape);
    }
    shape_ = compound;
    TopExp::MapShapes(shape_, TopAbs_FACE, faces_);
    if (faces_.Extent() == 0)
      throw Error(ExitCode::kGeometry, path_ + ": no face in the file (" + file_.format + "); export surfaces or solids, not wireframe or a mesh");
    face_data_.resize(faces_.Extent());
    for (const auto& part : file_.parts)
      for (const auto& face : part.faces) {
        const int i = faces_.FindIndex(face.face);
        if (i > 0) face_data_[i - 1] = {face.name, face.layer, part.name, face.color};
      }
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(shape_, TopAbs_EDGE, edges);
    for (const auto& part : file_.parts)
      for (const auto& edge : part.edges) edge_names_.emplace_back(edge.edge, edge.name);
  }

  /// Sews only a model with free edges; takes the smallest tolerance that closes it, else the one that leaves the fewest free edges.
  void sew_if_open() {
    int best_free = count_free_edges(shape_);
    if (best_free == 0) return;
    const int free_before = best_free;
    const double diagonal = rough_box(shape_).diagonal();
    const double base = std::max(2 * max_edge_tolerance(shape_), file_.resolution_mm);
    TopoDS_Shape best;
    std::vector<TopoDS_Shape> best_images;
    double best_tolerance = 0;
    for (double relative : kSewRelative) {
      const double tolerance = std::max(relative * diagonal, relative == kSewRelative[0] ? std::min(base, 1e-4 * diagonal) : 0.0);
      BRepBuilderAPI_Sewing sewing(tolerance);
      sewing.Add(shape_);
      try {
        sewing.Perform();
      } catch (const Standard_Failure&) {
        continue;
      }
      const TopoDS_Shape sewn = sewing.SewedShape();
      if (sewn.IsNull()) continue;
      const int n_free = count_free_edges(sewn);
      if (n_free >= best_free || !keeps_faces(sewing, sewn)) continue;
      best_free = n_free;
      best = sewn;
      best_tolerance = tolerance;
      best_images.clear();
      for (int i = 1; i <= faces_.Extent(); ++i)
        best_images.push_back(sewing.IsModifiedSubShape(faces_(i)) ? sewing.ModifiedSubShape(faces_(i)) : faces_(i));
      if (n_free == 0) break;
    }
    if (best.IsNull()) return;
    adopt_sewn(best, best_images);
    finding("sewn: " + std::to_string(free_before) + " free edges before, " + std::to_string(best_free) + " after, tolerance " +
                format_number(best_tolerance) + (file_.unit_in_mm ? " mm" : ""),
            "", {}, best_tolerance, true);
  }

  bool keeps_faces(BRepBuilderAPI_Sewing& sewing, const TopoDS_Shape& sewn) const {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(sewn, TopAbs_FACE, faces);
    if (faces.Extent() != faces_.Extent()) return false;
    for (int i = 1; i <= faces_.Extent(); ++i) {
      const TopoDS_Shape image = sewing.IsModifiedSubShape(faces_(i)) ? sewing.ModifiedSubShape(faces_(i)) : faces_(i);
      if (!faces.Contains(image)) return false;
    }
    return true;
  }

  /// Sewing permutes faces and drops solids: face ids follow the original order, closed shells become outward solids.
  void adopt_sewn(const TopoDS_Shape& sewn, const std::vector<TopoDS_Shape>& images) {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(sewn, TopAbs_FACE, faces);
    std::vector<FaceData> data(faces.Extent());
    for (std::size_t i = 0; i < images.size(); ++i) data[faces.FindIndex(images[i]) - 1] = face_data_[i];
    std::vector<int> first_original(faces.Extent(), 0);
    for (std::size_t i = 0; i < images.size(); ++i) first_original[faces.FindIndex(images[i]) - 1] = static_cast<int>(i);
    BRep_Builder builder;
    TopoDS_Compound compound;
    builder.MakeCompound(compound);
    struct Piece {
      int first;
      TopoDS_Shape shape;
    };
    std::vector<Piece> pieces;
    TopTools_IndexedMapOfShape in_shell;
    for (TopExp_Explorer e(sewn, TopAbs_SHELL); e.More(); e.Next()) {
      TopTools_IndexedMapOfShape members;
      TopExp::MapShapes(e.Current(), TopAbs_FACE, members);
      int first = 1 << 30;
      for (int i = 1; i <= members.Extent(); ++i) {
        first = std::min(first, first_original[faces.FindIndex(members(i)) - 1]);
        in_shell.Add(members(i));
      }
      TopoDS_Shape piece = in_original_order(e.Current(), [&](const TopoDS_Shape& f) { return first_original[faces.FindIndex(f) - 1]; });
      if (count_free_edges(piece) == 0) piece = outward_solid(TopoDS::Shell(piece));
      pieces.push_back({first, piece});
    }
    for (int i = 1; i <= faces.Extent(); ++i)
      if (!in_shell.Contains(faces(i))) pieces.push_back({first_original[i - 1], faces(i)});
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.first < b.first; });
    for (const Piece& p : pieces) builder.Add(compound, p.shape);
    shape_ = compound;
    faces_.Clear();
    TopExp::MapShapes(shape_, TopAbs_FACE, faces_);
    face_data_.assign(faces_.Extent(), {});
    for (int i = 1; i <= faces.Extent(); ++i)
      if (const int k = faces_.FindIndex(faces(i)); k > 0) face_data_[k - 1] = data[i - 1];
  }

  /// The shell with its faces in ascending order of `rank(face)`.
  template <class Rank>
  static TopoDS_Shape in_original_order(const TopoDS_Shape& shell, const Rank& rank) {
    std::vector<std::pair<int, TopoDS_Shape>> members;
    for (TopoDS_Iterator f(shell, false, false); f.More(); f.Next())
      members.emplace_back(rank(f.Value().Located(shell.Location() * f.Value().Location())), f.Value());
    std::stable_sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    TopoDS_Shape ordered = shell.EmptyCopied();
    BRep_Builder builder;
    for (const auto& [first, face] : members) builder.Add(ordered, face);
    ordered.Closed(shell.Closed());
    return ordered;
  }

  static TopoDS_Shape outward_solid(const TopoDS_Shell& shell) {
    try {
      BRepBuilderAPI_MakeSolid maker(shell);
      if (!maker.IsDone()) return shell;
      TopoDS_Solid solid = maker.Solid();
      BRepLib::OrientClosedSolid(solid);
      return solid;
    } catch (const Standard_Failure&) {
      return shell;
    }
  }

  /// Faces without loops get their natural bounds; wires that cannot be walked, edges without a trimming curve and unequal parameters are repaired.
  void repair_loops() {
    const int n_bad = count_bad_wires();
    if (n_bad > 0) {
      ShapeFix_Shape fix(shape_);
      fix.Perform();
      if (replace_shape(fix.Shape(), [&](const TopoDS_Shape& s) { return fix.Context()->Apply(s); }))
        finding("loops: " + std::to_string(n_bad) + " loops or faces that could not be walked were rebuilt", "", {}, 0, true);
    }
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(shape_, TopAbs_EDGE, edges);
    int n_parameters = 0;
    for (int i = 1; i <= edges.Extent(); ++i) {
      const TopoDS_Edge e = TopoDS::Edge(edges(i));
      if (BRep_Tool::Degenerated(e) || (BRep_Tool::SameParameter(e) && BRep_Tool::SameRange(e))) continue;
      BRepLib::SameParameter(e, BRep_Tool::Tolerance(e));
      ++n_parameters;
    }
    if (n_parameters) finding("parameters of " + std::to_string(n_parameters) + " edges made equal to their trimming curves'", "", {}, 0, true);
    int n_pcurves = 0;
    for (int i = 1; i <= faces_.Extent(); ++i) {
      const TopoDS_Face f = TopoDS::Face(faces_(i).Oriented(TopAbs_FORWARD));
      const bool planar = occt::surface_type(BRep_Tool::Surface(f)) == SurfaceType::kPlane;
      for (TopExp_Explorer e(f, TopAbs_EDGE); e.More(); e.Next()) {
        const TopoDS_Edge edge = TopoDS::Edge(e.Current());
        double t0, t1;
        Standard_Boolean stored = true;
        if (planar) {
          BRep_Tool::CurveOnSurface(edge, f, t0, t1, &stored);
          if (!stored) BRepLib::BuildPCurveForEdgeOnPlane(edge, f);
        } else if (BRep_Tool::CurveOnSurface(edge, f, t0, t1, &stored).IsNull()) {
          ShapeFix_Edge().FixAddPCurve(edge, f, BRep_Tool::IsClosed(edge, f));
          ++n_pcurves;
        }
      }
    }
    if (n_pcurves) finding("trimming curves of " + std::to_string(n_pcurves) + " edges were missing and rebuilt", "", {}, 0, true);
  }

  int count_bad_wires() const {
    int n = 0;
    for (int i = 1; i <= faces_.Extent(); ++i) {
      const TopoDS_Face f = TopoDS::Face(faces_(i).Oriented(TopAbs_FORWARD));
      int n_wires = 0;
      for (TopoDS_Iterator w(f); w.More(); w.Next()) {
        if (w.Value().ShapeType() != TopAbs_WIRE) continue;
        ++n_wires;
        int n_edges = 0, n_walked = 0;
        for (TopExp_Explorer e(w.Value(), TopAbs_EDGE); e.More(); e.Next()) n_edges += !is_constraint(e.Current());
        for (BRepTools_WireExplorer e(TopoDS::Wire(w.Value()), f); e.More(); e.Next()) ++n_walked;
        n += n_edges != n_walked;
      }
      n += n_wires == 0;
    }
    return n;
  }

  template <class Image>
  bool replace_shape(const TopoDS_Shape& shape, const Image& image) {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    std::vector<FaceData> data(faces.Extent());
    for (int i = 1; i <= faces_.Extent(); ++i)
      for (TopExp_Explorer e(image(faces_(i)), TopAbs_FACE); e.More(); e.Next())
        if (const int k = faces.FindIndex(e.Current()); k > 0) data[k - 1] = face_data_[i - 1];
    if (faces.Extent() == 0) return false;
    shape_ = shape;
    faces_ = faces;
    face_data_ = data;
    return true;
  }

  void scale_to_unit() {
    ModelTables& t = result_.tables;
    double target_mm = file_.unit_in_mm.value_or(1.0);
    if (!options_.unit.empty()) {
      const auto metres = unit_in_metres(options_.unit);
      if (!metres) throw Error(ExitCode::kUsage, "--unit: '" + options_.unit + "' is not a unit of length; use mm, cm, m, in or ft");
      target_mm = *metres * 1000;
      t.unit = options_.unit;
      t.unit_in_m = *metres;
    } else if (file_.unit_in_mm) {
      static const std::pair<double, const char*> kNames[] = {{1, "mm"},     {10, "cm"},    {1000, "m"},    {25.4, "in"},
                                                              {304.8, "ft"}, {1e-3, "um"}, {1e6, "km"}, {914.4, "yd"}, {0.0254, "mil"}};
      t.unit = format_number(target_mm) + "mm";
      for (const auto& [mm, name] : kNames)
        if (std::abs(target_mm - mm) < 1e-6 * mm) t.unit = name;
      t.unit_in_m = target_mm / 1000;
    }
    if (file_.has_mixed_units) finding("the file holds several units of length; everything was converted to " + t.unit, "", {}, 0, false);
    // a file without a unit is taken to be in the unit that --unit names: nothing to scale
    if (!file_.unit_in_mm || std::abs(target_mm - 1.0) < 1e-12) return;
    gp_Trsf scale;
    scale.SetScaleFactor(1.0 / target_mm);
    BRepBuilderAPI_Transform transform(shape_, scale, true);
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(transform.Shape(), TopAbs_FACE, faces);
    if (faces.Extent() != faces_.Extent()) throw Error(ExitCode::kGeometry, path_ + ": the model cannot be scaled to its unit; give --unit mm");
    for (auto& [edge, name] : edge_names_) edge = transform.ModifiedShape(edge);
    shape_ = transform.Shape();
    faces_ = faces;
  }

  void fill_tables() {
    TopExp::MapShapes(shape_, TopAbs_EDGE, edges_);
    TopExp::MapShapes(shape_, TopAbs_VERTEX, vertices_);
    fill_vertices();
    fill_edges();
    fill_faces();
    fill_shells_and_solids();
    fill_groups();
  }

  void fill_vertices() {
    ModelTables& t = result_.tables;
    for (int i = 1; i <= vertices_.Extent(); ++i) {
      t.vertex_xyz.push_back(vec(BRep_Tool::Pnt(TopoDS::Vertex(vertices_(i)))));
      t.vertex_tolerance.push_back(BRep_Tool::Tolerance(TopoDS::Vertex(vertices_(i))));
    }
  }

  void fill_edges() {
    ModelTables& t = result_.tables;
    t.edge_name.resize(edges_.Extent());
    for (const auto& [edge, name] : edge_names_)
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
      t.edge_length.push_back(degenerate ? 0.0 : arc_length(*occt::make_curve(c, t0, t1), t0, t1, 32));
    }
  }

  void fill_faces() {
    ModelTables& t = result_.tables;
    std::vector<TopAbs_Orientation> orientation(faces_.Extent(), TopAbs_FORWARD);
    std::vector<char> seen(faces_.Extent(), 0);
    for (TopExp_Explorer e(shape_, TopAbs_FACE); e.More(); e.Next()) {
      const int i = faces_.FindIndex(e.Current()) - 1;
      if (seen[i]) continue;
      seen[i] = 1;
      orientation[i] = e.Current().Orientation();
    }
    t.face_loop_offsets.push_back(0);
    t.loop_coedge_offsets.push_back(0);
    for (int i = 0; i < faces_.Extent(); ++i) {
      const TopoDS_Face f = TopoDS::Face(faces_(i + 1).Oriented(TopAbs_FORWARD));
      double u0, u1, v0, v1;
      BRepTools::UVBounds(f, u0, u1, v0, v1);
      for (double b : {u0, u1, v0, v1}) t.face_uv_bounds.push_back(b);
      t.face_is_reversed.push_back(orientation[i] == TopAbs_REVERSED);
      t.face_type.push_back(occt::surface_type(BRep_Tool::Surface(f)));
      t.face_tolerance.push_back(BRep_Tool::Tolerance(f));
      GProp_GProps properties;
      BRepGProp::SurfaceProperties(f, properties);
      t.face_area.push_back(std::abs(properties.Mass()));
      t.face_box.push_back(rough_box(f));
      t.face_name.push_back(face_data_[i].name);
      t.face_layer.push_back(face_data_[i].layer);
      t.face_color.push_back(face_data_[i].color);
      fill_loops(f);
    }
  }

  struct Loop {
    std::vector<TopoDS_Edge> edges;
    double area = 0;  // signed, in (u,v)
  };

  void fill_loops(const TopoDS_Face& f) {
    ModelTables& t = result_.tables;
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
    ModelTables& t = result_.tables;
    t.face_shell.assign(faces_.Extent(), kNone);
    t.face_solid.assign(faces_.Extent(), kNone);
    const auto number = [&](TopAbs_ShapeEnum kind, std::vector<std::int32_t>& ids) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(shape_, kind, map);
      for (int i = 1; i <= map.Extent(); ++i)
        for (TopExp_Explorer e(map(i), TopAbs_FACE); e.More(); e.Next())
          if (std::int32_t& id = ids[faces_.FindIndex(e.Current()) - 1]; id == kNone) id = i - 1;
      return map.Extent();
    };
    t.n_shells = number(TopAbs_SHELL, t.face_shell);
    t.n_solids = number(TopAbs_SOLID, t.face_solid);
  }

  void fill_groups() {
    ModelTables& t = result_.tables;
    std::map<std::string, std::int32_t> ids;
    for (int i = 0; i < faces_.Extent(); ++i) {
      const FaceData& d = face_data_[i];
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

  void report_topology() {
    ModelTables& t = result_.tables;
    std::vector<int> uses(t.n_edges(), 0);
    for (EdgeId e : t.coedge_edge) ++uses[e];
    for (EdgeId e = 0; e < t.n_edges(); ++e) {
      if (t.edge_is_degenerate[e]) continue;
      const Vec3 at = t.vertex_xyz[t.edge_vertices[2 * e]];
      if (uses[e] == 1) {
        ++result_.n_free_edges;
        finding("free edge", t.edge_label(e), at, t.edge_length[e], false);
      } else if (uses[e] > 2) {
        ++result_.n_nonmanifold_edges;
        finding("non-manifold edge", t.edge_label(e), at, t.edge_length[e], false);
      }
    }
    result_.is_closed = t.n_shells > 0 && result_.n_free_edges == 0;
    for (double a : t.face_area) result_.area += a;
    if (result_.is_closed) {
      GProp_GProps properties;
      BRepGProp::VolumeProperties(shape_, properties);
      result_.volume = properties.Mass();
    }
    if (options_.require_closed && !result_.is_closed)
      throw Error(ExitCode::kGeometry, path_ + ": the model is open: " + std::to_string(result_.n_free_edges) +
                                           " free edges; close it in the CAD system, or import without --require-closed");
  }

  void store_brep() {
    std::ostringstream stream(std::ios::binary);
    BinTools::Write(shape_, stream);
    const std::string bytes = stream.str();
    result_.brep.resize(bytes.size());
    std::memcpy(result_.brep.data(), bytes.data(), bytes.size());
  }

  std::string path_;
  ImportOptions options_;
  occt::CadFile file_;
  ImportResult result_;
  TopoDS_Shape shape_;
  TopTools_IndexedMapOfShape faces_, edges_, vertices_;
  std::vector<FaceData> face_data_;
  std::vector<std::pair<TopoDS_Shape, std::string>> edge_names_;
};

}  // namespace

ImportResult import_model(const std::string& path, const ImportOptions& options) {
  try {
    return Importer(path, options).run();
  } catch (const Standard_Failure& e) {
    throw Error(ExitCode::kGeometry, path + ": OpenCASCADE failed on this model (" +
                                         (e.GetMessageString() && *e.GetMessageString() ? e.GetMessageString() : e.DynamicType()->Name()) +
                                         "); repair it in the CAD system");
  }
}

}  // namespace st
