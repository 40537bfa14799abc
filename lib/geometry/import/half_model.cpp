#include "geometry/import/half_model.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_Pln.hxx>
#include <iterator>

#include "base/axis.h"
#include "base/error.h"
#include "base/face_labels.h"
#include "geometry/brep/compound.h"
#include "geometry/brep/face_integral.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/face_turns.h"
#include "geometry/import/import.h"
#include "geometry/import/loop_joins.h"
#include "geometry/import/nested_solids.h"
#include "geometry/import/plane_loops.h"

namespace st::occt {
namespace {

constexpr const char* kSymmetryName = "symmetry";
constexpr const char* kFarFieldName = "farfield";

double coordinate(const gp_Pnt& p, int axis) { return p.Coord(axis + 1); }

gp_Dir axis_direction(int axis, int sign) {
  gp_XYZ d(0, 0, 0);
  d.SetCoord(axis + 1, sign);
  return gp_Dir(d);
}

/// A plane with the lengths that decide what is in it.
struct Cut {
  SymmetryPlane plane;
  double diagonal = 0;

  double beyond(double x) const { return plane.side * (x - plane.value); }
  bool is_near(const gp_Pnt& p) const {
    return std::fabs(coordinate(p, plane.axis) - plane.value) <= kInSymmetryPlane * diagonal;
  }
};

/// All of an edge, at 11 points.
bool is_in_plane(const TopoDS_Edge& edge, const Cut& cut) {
  if (BRep_Tool::Degenerated(edge)) return cut.is_near(BRep_Tool::Pnt(TopExp::FirstVertex(edge)));
  const BRepAdaptor_Curve curve(edge);
  for (int k = 0; k <= 10; ++k)
    if (!cut.is_near(curve.Value(curve.FirstParameter() + 0.1 * k * (curve.LastParameter() - curve.FirstParameter()))))
      return false;
  return true;
}

/// All of a face, at 25 points, with its normal across the plane: a narrow strip that stands on the plane is near it,
/// too.
bool is_in_plane(const TopoDS_Face& face, const Cut& cut) {
  const BRepAdaptor_Surface surface(face);
  gp_Pnt middle;
  gp_Vec du, dv;
  surface.D1(0.5 * (surface.FirstUParameter() + surface.LastUParameter()),
             0.5 * (surface.FirstVParameter() + surface.LastVParameter()), middle, du, dv);
  const gp_Vec normal = du.Crossed(dv);
  if (std::fabs(normal * gp_Vec(axis_direction(cut.plane.axis, 1))) < 0.9 * normal.Magnitude()) return false;
  for (int i = 0; i <= 4; ++i)
    for (int k = 0; k <= 4; ++k)
      if (!cut.is_near(surface.Value(
              surface.FirstUParameter() + 0.25 * i * (surface.LastUParameter() - surface.FirstUParameter()),
              surface.FirstVParameter() + 0.25 * k * (surface.LastVParameter() - surface.FirstVParameter()))))
        return false;
  return true;
}

// --- the body on one side ---

Vec3 kept_direction(const Cut& cut) {
  const gp_Dir d = axis_direction(cut.plane.axis, cut.plane.side);
  return {d.X(), d.Y(), d.Z()};
}

/// Throws Error(kGeometry) where the pieces of a face with turns, by `image`, are not as large as its kept side.
template <typename Image>
void require_turns(const std::vector<TurnedFace>& turned, const TopTools_IndexedMapOfShape& faces, const Image& image,
                   const std::string& path) {
  constexpr double kFacetError = 5e-3;  // of the face's area: facets of face_turns.cpp lack less
  for (const TurnedFace& t : turned) {
    const TopoDS_Shape pieces = image(faces(t.face));
    const double area = pieces.IsNull() ? 0 : area_of_faces(pieces);
    if (std::fabs(area - t.area) > kFacetError * area_of_faces(faces(t.face)))
      throw Error(ExitCode::kGeometry, path + ": face " + std::to_string(t.face) +
                                           " goes around its surface more than once, and OpenCASCADE loses turns of "
                                           "it at the symmetry plane; cut the model in the CAD system");
  }
}

/// Takes the kept side of every solid and loose face by a boolean; attributes follow the pieces.
void cut_model(ImportedShape& model, const Cut& cut, const Box3& box, const std::string& path) {
  gp_XYZ lo(box.lo.x, box.lo.y, box.lo.z), hi(box.hi.x, box.hi.y, box.hi.z);
  const gp_XYZ margin(cut.diagonal, cut.diagonal, cut.diagonal);
  lo -= margin;
  hi += margin;
  (cut.plane.side > 0 ? lo : hi).SetCoord(cut.plane.axis + 1, cut.plane.value);
  const TopoDS_Shape half_space = BRepPrimAPI_MakeBox(gp_Pnt(lo), gp_Pnt(hi)).Shape();
  TopTools_ListOfShape bodies, tools;
  for (TopExp_Explorer e(model.shape, TopAbs_SOLID); e.More(); e.Next()) bodies.Append(e.Current());
  for (TopExp_Explorer e(model.shape, TopAbs_SHELL, TopAbs_SOLID); e.More(); e.Next()) bodies.Append(e.Current());
  for (TopExp_Explorer e(model.shape, TopAbs_FACE, TopAbs_SHELL); e.More(); e.Next()) bodies.Append(e.Current());
  tools.Append(half_space);
  BRepAlgoAPI_Common common;
  common.SetArguments(bodies);
  common.SetTools(tools);
  common.SetNonDestructive(true);
  common.Build();
  const auto image = [&](const TopoDS_Shape& face) -> TopoDS_Shape {
    if (common.IsDeleted(face)) return {};
    const TopTools_ListOfShape& pieces = common.Modified(face);
    if (pieces.IsEmpty()) return face;
    return compound_of(pieces);
  };
  const TopTools_IndexedMapOfShape faces = model.faces;
  const std::vector<TurnedFace> turned =
      turned_faces_beyond(faces, kept_direction(cut), cut.plane.side * cut.plane.value);
  if (!common.IsDone() || common.HasErrors() || !model.replace(common.Shape(), image))
    throw Error(ExitCode::kGeometry,
                path + ": OpenCASCADE cannot cut the model at the symmetry plane; cut it in the CAD system");
  if (turned.empty()) return;
  std::vector<ImportFinding> own;
  join_loops(model, own);
  require_turns(turned, faces, image, path);
}

void keep_one_side(ImportedShape& model, Cut& cut, const Box3& box, std::vector<ImportFinding>& findings,
                   const std::string& path) {
  if (!choose_side(cut.plane, box, cut.diagonal, path + ": ")) return;
  cut_model(model, cut, box, path);
  findings.push_back({FindingKind::kCutAtSymmetry, "", box.center(), cut.diagonal, false});
}

// --- faces in the plane ---

gp_Pln plane_of(const Cut& cut) {
  gp_XYZ origin(0, 0, 0);
  origin.SetCoord(cut.plane.axis + 1, cut.plane.value);
  return gp_Pln(gp_Pnt(origin), axis_direction(cut.plane.axis, -cut.plane.side));
}

Faces faces_in_plane(const std::vector<TopoDS_Edge>& edges, const Cut& cut, const std::string& path) {
  std::vector<PlaneLoop> loops = closed_loops(edges, plane_of(cut));
  if (loops.empty())
    throw Error(ExitCode::kGeometry, path + ": the edges in the symmetry plane do not close; free edges at " +
                                         places(edges) + "; close the model there in the CAD system");
  return faces_between(loops, plane_of(cut));
}

/// A solid in the plane, or all that is in none.
struct Section {
  std::string name;
  bool is_far_field = false;  ///< by the names of its faces or part: what lies in it is a hole
  std::vector<PlaneLoop> loops = {};
  Faces faces = {};
};

std::string name_of(const ImportedShape& model, const TopoDS_Face& face) {
  const FaceAttributes& a = model.attributes[model.faces.FindIndex(face) - 1];
  const bool has_path = a.part_index != kNone && !model.parts[a.part_index].path.empty();
  return has_path ? model.parts[a.part_index].path : !a.part.empty() ? a.part : !a.name.empty() ? a.name : "unnamed";
}

bool is_far_field(const ImportedShape& model, const Faces& body) {
  return std::any_of(body.begin(), body.end(), [&](const TopoDS_Face& f) {
    const FaceAttributes& a = model.attributes[model.faces.FindIndex(f) - 1];
    return a.role == "farfield" || role_of_name(a.name) == "farfield" || role_of_name(a.part) == "farfield";
  });
}

/// The sections of the solids, each for itself: where one lies in another one's cavity, the loops of both together
/// would tell nothing. Empty when the edges of one do not close by themselves.
std::vector<Section> sections_of(const ImportedShape& model, const Faces& faces, const Cut& cut) {
  TopTools_IndexedMapOfShape free, loose;
  for (const TopoDS_Edge& e : free_edges(faces)) free.Add(e);
  for (TopExp_Explorer f(model.shape, TopAbs_FACE, TopAbs_SOLID); f.More(); f.Next()) loose.Add(f.Current());
  std::vector<TopTools_IndexedMapOfShape> owners{loose};
  for (TopExp_Explorer s(model.shape, TopAbs_SOLID); s.More(); s.Next())
    TopExp::MapShapes(s.Current(), TopAbs_FACE, owners.emplace_back());
  std::vector<Section> sections;
  for (const TopTools_IndexedMapOfShape& own : owners) {
    Faces body;
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(body),
                 [&](const TopoDS_Face& f) { return own.Contains(f); });
    std::vector<TopoDS_Edge> edges = free_edges(body);
    std::erase_if(edges, [&](const TopoDS_Edge& e) { return !free.Contains(e) || !is_in_plane(e, cut); });
    if (edges.empty()) continue;
    Section section{name_of(model, body[0]), is_far_field(model, body), closed_loops(edges, plane_of(cut))};
    if (section.loops.empty()) return {};
    section.faces = faces_between(section.loops, plane_of(cut));
    sections.push_back(std::move(section));
  }
  return sections;
}

/// A solid inside another one, or through it, has no section of its own: the plane would have faces on each other, or a
/// hole where there is material.
void require_apart(const std::vector<Section>& sections, const std::string& path) {
  for (const Section& inner : sections)
    for (const Section& outer : sections)
      for (std::size_t k = 0; &inner != &outer && !outer.is_far_field && k < inner.loops.size(); ++k) {
        const gp_Pnt p = point_of(inner.loops[k].wire);
        if (std::any_of(outer.faces.begin(), outer.faces.end(), [&](const TopoDS_Face& f) { return is_in(p, f); }))
          throw Error(ExitCode::kGeometry, path + ": in the symmetry plane the body \"" + inner.name +
                                               "\" lies inside \"" + outer.name + "\", at (" + format_number(p.X()) +
                                               ", " + format_number(p.Y()) + ", " + format_number(p.Z()) +
                                               "); make them one with --unite, or leave one out");
      }
}

// --- far field ---

/// Faces of the outer boundary, without the one in the plane.
Faces far_faces(const FarField& far, const Box3& box, const std::optional<Cut>& cut, double diagonal) {
  const double r = far.size * diagonal;
  gp_XYZ center(box.center().x, box.center().y, box.center().z);
  if (cut) center.SetCoord(cut->plane.axis + 1, cut->plane.value);
  TopoDS_Shape shape;
  if (far.kind == FarField::Kind::kBox) {
    gp_XYZ lo = center - gp_XYZ(r, r, r), hi = center + gp_XYZ(r, r, r);
    if (cut) (cut->plane.side > 0 ? lo : hi).SetCoord(cut->plane.axis + 1, cut->plane.value);
    shape = BRepPrimAPI_MakeBox(gp_Pnt(lo), gp_Pnt(hi)).Shape();
  } else if (cut) {
    shape =
        BRepPrimAPI_MakeSphere(gp_Ax2(gp_Pnt(center), axis_direction(cut->plane.axis, cut->plane.side)), r, 0, M_PI / 2)
            .Shape();
  } else {
    shape = BRepPrimAPI_MakeSphere(gp_Pnt(center), r).Shape();
  }
  Faces faces;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next())
    if (const TopoDS_Face f = TopoDS::Face(e.Current()); !cut || !is_in_plane(f, *cut)) faces.push_back(f);
  return faces;
}

// --- shells and solids ---

TopoDS_Shape oriented(const TopoDS_Shape& shell, bool outward) {
  return (volume_of(shell) > 0) == outward ? shell : shell.Reversed();
}

/// One solid: the shell with `far` in it turned outward, all others inward.
TopoDS_Shape fluid_of(const std::vector<TopoDS_Shape>& shells, const TopoDS_Face& far) {
  TopoDS_Solid solid;
  BRep_Builder builder;
  builder.MakeSolid(solid);
  for (const TopoDS_Shape& shell : shells) {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shell, TopAbs_FACE, faces);
    builder.Add(solid, oriented(shell, faces.Contains(far)));
  }
  return solid;
}

/// What is twice in the plane has no section: cut, it would be a part of the outer solid, or a hole in it.
void require_none_inside(const ImportedShape& model, const Cut& cut, const std::string& path) {
  const double value = cut.plane.value, near = kInSymmetryPlane * cut.diagonal;
  const auto is_at_plane = [&](const Box3& box) {
    return component(box.lo, cut.plane.axis) <= value + near && component(box.hi, cut.plane.axis) >= value - near;
  };
  const auto name = [&](const TopoDS_Solid& solid) {
    return name_of(model, TopoDS::Face(TopExp_Explorer(solid, TopAbs_FACE).Current()));
  };
  for (const NestedSolid& nested : nested_solids(model.shape, Cavities::kOutside, is_at_plane))
    throw Error(ExitCode::kGeometry, path + ": the solid \"" + name(nested.inner) + "\" lies inside the solid \"" +
                                         name(nested.outer) +
                                         "\", and the symmetry plane cuts both; make them one with "
                                         "--unite, or leave one out");
}

/// Faces of solids that lie inside another one, in its cavities, too.
TopTools_IndexedMapOfShape inner_bodies(const TopoDS_Shape& shape, std::vector<ImportFinding>& findings) {
  TopTools_IndexedMapOfShape faces;
  for (const NestedSolid& nested : nested_solids(shape, Cavities::kInside)) {
    TopExp::MapShapes(nested.inner, TopAbs_FACE, faces);
    const Box3 box = rough_box(nested.inner);
    findings.push_back({FindingKind::kInnerBodyLeftOut, "", box.center(), box.diagonal(), false});
  }
  return faces;
}

/// Faces of the body in the order of their ids: with a far field neither those of cavities inside a solid and of bodies
/// inside another, which no flow reaches, nor those between two solids.
Faces body_faces(const ImportedShape& model, const std::optional<Cut>& cut, bool leave_cavities,
                 std::vector<ImportFinding>& findings) {
  TopTools_IndexedMapOfShape cavities;
  for (TopExp_Explorer e(model.shape, TopAbs_SOLID); leave_cavities && e.More(); e.Next()) {
    for (TopExp_Explorer s(e.Current(), TopAbs_SHELL); s.More(); s.Next())
      if (volume_of(s.Current()) < 0) {
        TopExp::MapShapes(s.Current(), TopAbs_FACE, cavities);
        const Box3 box = rough_box(s.Current());
        findings.push_back({FindingKind::kCavityLeftOut, "", box.center(), box.diagonal(), false});
      }
  }
  const TopTools_IndexedMapOfShape inner =
      leave_cavities ? inner_bodies(model.shape, findings) : TopTools_IndexedMapOfShape();
  std::vector<int> n_sides(model.faces.Extent() + 1, 0);
  for (TopExp_Explorer e(model.shape, TopAbs_FACE); leave_cavities && e.More(); e.Next())
    ++n_sides[model.faces.FindIndex(e.Current())];
  Faces faces;
  for (int i = 1; i <= model.faces.Extent(); ++i) {
    const TopoDS_Face f = TopoDS::Face(model.faces(i));
    if (n_sides[i] > 1) continue;
    if (!cavities.Contains(f) && !inner.Contains(f) && !(cut && is_in_plane(f, *cut))) faces.push_back(f);
  }
  return faces;
}

void require_free_edges_in_plane(const Faces& faces, const std::optional<Cut>& cut,
                                 const std::vector<ImportFinding>& findings, const std::string& path) {
  std::vector<TopoDS_Edge> open;
  const std::vector<TopoDS_Edge> all = free_edges(faces);
  for (const TopoDS_Edge& e : all)
    if (!cut || !is_in_plane(e, *cut)) open.push_back(e);
  const bool was_left = std::any_of(findings.begin(), findings.end(),
                                    [](const ImportFinding& f) { return f.kind == FindingKind::kOpeningLeft; });
  const std::string advice = was_left ? "--cap left openings as they are, so close them in the CAD system"
                                      : std::string("--cap closes openings in planes, the CAD system others") +
                                            (cut ? "" : ", --symmetry what ends at its plane");
  if (!open.empty())
    throw Error(ExitCode::kGeometry, path + ": the model is open" + (cut ? " away from the symmetry plane" : "") +
                                         ": " + std::to_string(open.size()) + " free edges at " + places(open) + "; " +
                                         advice);
  if (cut && all.empty())
    throw Error(ExitCode::kGeometry,
                path + ": the model does not touch the symmetry plane; check the axis and the value of --symmetry");
}

/// `shape` made of faces of `model` and of new ones with given names.
void take(ImportedShape& model, const TopoDS_Shape& shape, const Faces& plane_faces, const Faces& far) {
  model.replace(shape, [](const TopoDS_Shape& face) { return face; });
  for (const auto& [faces, name] : {std::pair{&plane_faces, kSymmetryName}, std::pair{&far, kFarFieldName}})
    for (const TopoDS_Face& f : *faces)
      if (const int i = model.faces.FindIndex(f); i > 0) model.attributes[i - 1].name = name;
}

/// `border`: the faces of the body, and of the far field where there is one.
Faces symmetry_faces(const ImportedShape& model, const Faces& faces, const Faces& border, const Cut& cut,
                     const std::string& path) {
  const std::vector<Section> sections = sections_of(model, faces, cut);
  require_apart(sections, path);
  const bool has_far_field =
      border.size() > faces.size() ||
      std::any_of(sections.begin(), sections.end(), [](const Section& s) { return s.is_far_field; });
  if (sections.empty() || has_far_field) return faces_in_plane(free_edges(border), cut, path);
  Faces all;
  for (const Section& section : sections) all.insert(all.end(), section.faces.begin(), section.faces.end());
  return all;
}

}  // namespace

void make_flow_domain(ImportedShape& model, const Box3& box, double diagonal, const std::optional<SymmetryPlane>& plane,
                      const std::optional<FarField>& far, std::vector<ImportFinding>& findings,
                      const std::string& path) {
  std::optional<Cut> cut;
  if (plane) {
    cut = Cut{*plane, diagonal};
    if (!far) require_none_inside(model, *cut, path);
    keep_one_side(model, *cut, box, findings, path);
  }
  Faces faces = body_faces(model, cut, far.has_value(), findings);
  require_free_edges_in_plane(faces, cut, findings, path);
  const Faces outer = far ? far_faces(*far, box, cut, diagonal) : Faces{};
  Faces border = faces;
  border.insert(border.end(), outer.begin(), outer.end());
  const Faces symmetry = cut ? symmetry_faces(model, faces, border, *cut, path) : Faces{};
  faces.insert(faces.end(), symmetry.begin(), symmetry.end());
  faces.insert(faces.end(), outer.begin(), outer.end());
  const std::vector<TopoDS_Shape> shells = shells_of(faces);
  take(model, far ? fluid_of(shells, outer.front()) : TopoDS_Shape(compound_of(shells)), symmetry, outer);
}

}  // namespace st::occt
