#include "geometry/import/bare_surfaces.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "geometry/brep/compound.h"
#include "geometry/brep/face_domain.h"
#include "geometry/brep/shape_queries.h"
#include "geometry/import/empty_faces.h"
#include "geometry/import/surface_kinks.h"

namespace st::occt {
namespace {

constexpr std::size_t kSides = 4;   // edges of a surface without trimming: one that has more was made to be sewn
constexpr int kStations = 8;        // across the surface, at which both sides of a knot are compared
constexpr double kBeside = 1e-3;    // of the span: normals there are those of the kink
constexpr double kFold = 2.6;       // radians: a side of the surface that turns by more runs back along itself
constexpr double kShrunk = 1e-6;    // of the surface's box: a line of constant u or v is a point
constexpr double kNoArea = 1e-7;    // of that box's square: the surface between two knots is a line
constexpr double kOnBounds = 1e-9;  // of the range of u or v

enum class Along { kU, kV };
enum class Cuts { kNeeded, kAll };  // kinks alone close without a cut

struct Range {
  double low = 0, high = 0;
};

/// A spline and how it is asked along one direction.
class SplineLines {
 public:
  SplineLines(const Handle(Geom_BSplineSurface) & spline, Along along, double size)
      : spline_(spline), along_(along), size_(size) {
    spline->Bounds(bounds_[0].low, bounds_[0].high, bounds_[1].low, bounds_[1].high);
  }

  /// Inner knots at which the surface is to be divided.
  std::vector<double> cuts(Cuts which) const {
    const bool is_u = along_ == Along::kU;
    const int n = is_u ? spline_->NbUKnots() : spline_->NbVKnots();
    const int degree = is_u ? spline_->UDegree() : spline_->VDegree();
    std::vector<double> result;
    for (int k = 2; k < n; ++k) {
      if ((is_u ? spline_->UMultiplicity(k) : spline_->VMultiplicity(k)) < degree) continue;
      const double before = knot(k - 1), at = knot(k), after = knot(k + 1);
      const double beside = kBeside * std::min(at - before, after - at);
      if (is_point(at) || has_area(before, at) != has_area(at, after) || folds(at, beside) ||
          (which == Cuts::kAll && is_kink(at, beside)))
        result.push_back(at);
    }
    return result;
  }

 private:
  double knot(int k) const { return along_ == Along::kU ? spline_->UKnot(k) : spline_->VKnot(k); }

  double across(double share) const {
    const Range& r = bounds_[along_ == Along::kU ? 1 : 0];
    return r.low + share * (r.high - r.low);
  }

  gp_Pnt point(double t, double s) const { return along_ == Along::kU ? spline_->Value(t, s) : spline_->Value(s, t); }

  gp_Vec normal(double t, double s) const {
    gp_Pnt p;
    gp_Vec du, dv;
    spline_->D1(along_ == Along::kU ? t : s, along_ == Along::kU ? s : t, p, du, dv);
    return du.Crossed(dv);
  }

  bool is_point(double t) const {
    const gp_Pnt first = point(t, across(0));
    for (int k = 1; k <= kStations; ++k)
      if (first.Distance(point(t, across(static_cast<double>(k) / kStations))) > kShrunk * size_) return false;
    return true;
  }

  bool has_area(double from, double to) const {
    double area = 0;
    for (int i = 0; i < kStations; ++i)
      for (int k = 0; k < kStations; ++k)
        area += normal(from + (to - from) * (i + 0.5) / kStations, across((k + 0.5) / kStations)).Magnitude();
    return area * (to - from) * (across(1) - across(0)) > kNoArea * size_ * size_ * kStations * kStations;
  }

  bool is_kink(double t, double beside) const {
    for (int k = 0; k < kStations; ++k) {
      const double s = across((k + 0.5) / kStations);
      if (turn(normal(t - beside, s), normal(t + beside, s)) > kLeastKink) return true;
    }
    return false;
  }

  /// Whether one of both sides across runs there and back.
  bool folds(double t, double beside) const {
    for (const double s : {across(0), across(1)})
      if (turn(tangent(t - beside, s), tangent(t + beside, s)) > kFold) return true;
    return false;
  }

  static double turn(const gp_Vec& before, const gp_Vec& after) {
    const double least = gp::Resolution();
    return before.Magnitude() > least && after.Magnitude() > least ? before.Angle(after) : 0;
  }

  gp_Vec tangent(double t, double s) const {
    gp_Pnt p;
    gp_Vec du, dv;
    spline_->D1(along_ == Along::kU ? t : s, along_ == Along::kU ? s : t, p, du, dv);
    return along_ == Along::kU ? du : dv;
  }

  Handle(Geom_BSplineSurface) spline_;
  Along along_;
  double size_;
  Range bounds_[2];
};

bool is_on_bounds(double x, Range r) {
  const double slack = kOnBounds * (r.high - r.low);
  return std::abs(x - r.low) <= slack || std::abs(x - r.high) <= slack;
}

/// The face's spline in the model's frame where it is not trimmed and has an edge for each side; null otherwise.
Handle(Geom_BSplineSurface) whole_spline(const TopoDS_Face& face) {
  auto spline = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
  if (spline.IsNull()) return {};
  if (spline->IsUPeriodic() || spline->IsVPeriodic()) {
    spline = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
    if (spline->IsUPeriodic()) spline->SetUNotPeriodic();
    if (spline->IsVPeriodic()) spline->SetVNotPeriodic();
  }
  Range u, v;
  spline->Bounds(u.low, u.high, v.low, v.high);
  const FaceDomain d = make_domain(face);
  if (d.loops.size() != 1 || d.loops[0].coedges.size() > kSides) return {};
  for (const CoedgeUv& c : d.loops[0].coedges)
    if (c.curve.IsNull()) return {};
  for (const Vec2 p : d.loops[0].polygon())
    if (!is_on_bounds(p.x, u) && !is_on_bounds(p.y, v)) return {};
  return spline;
}

/// Knots at which a surface is to be divided, ends included, both ways.
struct Grid {
  std::vector<double> u, v;

  bool is_cut() const { return u.size() > 2 || v.size() > 2; }
  void add(const Grid& other) {
    for (const auto list : {&Grid::u, &Grid::v}) {
      std::vector<double> both;
      std::set_union((this->*list).begin(), (this->*list).end(), (other.*list).begin(), (other.*list).end(),
                     std::back_inserter(both));
      this->*list = std::move(both);
    }
  }
  std::size_t size() const { return u.size() + v.size(); }
};

Grid grid_of(const Handle(Geom_BSplineSurface) & spline, double size, Cuts which) {
  Range u, v;
  spline->Bounds(u.low, u.high, v.low, v.high);
  Grid grid{SplineLines(spline, Along::kU, size).cuts(which), SplineLines(spline, Along::kV, size).cuts(which)};
  grid.u.insert(grid.u.begin(), u.low), grid.u.push_back(u.high);
  grid.v.insert(grid.v.begin(), v.low), grid.v.push_back(v.high);
  return grid;
}

/// The parts of a spline, in the order of the grid.
std::vector<Handle(Geom_BSplineSurface)> parts_of(const Handle(Geom_BSplineSurface) & spline, const Grid& grid) {
  std::vector<Handle(Geom_BSplineSurface)> parts;
  for (std::size_t i = 0; i + 1 < grid.u.size(); ++i)
    for (std::size_t j = 0; j + 1 < grid.v.size(); ++j) {
      parts.push_back(Handle(Geom_BSplineSurface)::DownCast(spline->Copy()));
      parts.back()->Segment(grid.u[i], grid.u[i + 1], grid.v[j], grid.v[j + 1]);
    }
  return parts;
}

/// Parts show cuts of their own. They go through the whole surface: the sides of neighbours have to end together.
Grid complete_grid(const Handle(Geom_BSplineSurface) & spline, double size) {
  Grid grid = grid_of(spline, size, Cuts::kNeeded);
  if (!grid.is_cut()) return grid;
  grid.add(grid_of(spline, size, Cuts::kAll));
  for (std::size_t n_before = 0; n_before < grid.size();) {
    n_before = grid.size();
    Grid all = grid;
    for (const Handle(Geom_BSplineSurface) & part : parts_of(spline, grid)) {
      const TopoDS_Face face = BRepBuilderAPI_MakeFace(part, Precision::Confusion()).Face();
      all.add(grid_of(part, rough_box(face).diagonal(), Cuts::kAll));
    }
    grid = std::move(all);
  }
  return grid;
}

/// Adds the parts of the face that have an area; itself where there is no cut. Returns whether others were left out.
bool add_parts(const TopoDS_Face& face, double diagonal, std::vector<TopoDS_Shape>& parts) {
  const Handle(Geom_BSplineSurface) spline = whole_spline(face);
  const Grid grid = spline.IsNull() ? Grid{} : complete_grid(spline, rough_box(face).diagonal());
  if (!grid.is_cut()) {
    parts.push_back(face);
    return false;
  }
  bool has_empty = false;
  for (const Handle(Geom_BSplineSurface) & part : parts_of(spline, grid)) {
    const TopoDS_Face piece = BRepBuilderAPI_MakeFace(part, Precision::Confusion()).Face();
    if (empty_box(piece, diagonal))
      has_empty = true;
    else
      parts.push_back(piece);
  }
  return has_empty;
}

using Parts = std::map<int, std::vector<TopoDS_Shape>>;  // by the number of the face

/// The shape with faces exchanged for their parts.
TopoDS_Shape with_parts(const TopoDS_Shape& shape, const ImportedShape& model, const Parts& parts) {
  TopoDS_Shape result = shape.EmptyCopied();
  BRep_Builder builder;
  for (TopoDS_Iterator child(shape, false, false); child.More(); child.Next()) {
    const TopoDS_Shape& s = child.Value();
    if (s.ShapeType() == TopAbs_COMPOUND || s.ShapeType() == TopAbs_SHELL) {
      builder.Add(result, with_parts(s, model, parts));
      continue;
    }
    const auto found = s.ShapeType() == TopAbs_FACE ? parts.find(model.faces.FindIndex(s)) : parts.end();
    if (found == parts.end())
      builder.Add(result, s);
    else
      for (const TopoDS_Shape& part : found->second) builder.Add(result, part);
  }
  return result;
}

}  // namespace

DividedSurfaces divide_bare_surfaces(ImportedShape& model, std::vector<ImportFinding>& findings) {
  Parts parts;
  DividedSurfaces divided;
  const double diagonal = model.box().diagonal();
  for (TopExp_Explorer f(model.shape, TopAbs_FACE, TopAbs_SOLID); f.More(); f.Next()) {
    const int i = model.faces.FindIndex(f.Current());
    if (!f.Current().Location().IsIdentity() || parts.count(i) > 0) continue;
    try {
      std::vector<TopoDS_Shape> found;
      const bool has_empty = add_parts(TopoDS::Face(f.Current().Oriented(TopAbs_FORWARD)), diagonal, found);
      if (found.size() < (has_empty ? 1 : 2)) continue;
      divided.has_empty_parts |= has_empty;
      const Box3 box = rough_box(f.Current());
      findings.push_back({FindingKind::kDividedSurface, model.file_label(i), box.center(), box.diagonal(), true,
                          std::to_string(found.size()) + " faces"});
      for (TopoDS_Shape& part : found) part.Orientation(f.Current().Orientation());
      parts[i] = std::move(found);
    } catch (const Standard_Failure&) {
      continue;
    }
  }
  divided.any = !parts.empty() &&
                model.replace(with_parts(model.shape, model, parts), [&](const TopoDS_Shape& face) -> TopoDS_Shape {
                  const auto found = parts.find(model.faces.FindIndex(face));
                  return found == parts.end() ? face : TopoDS_Shape(compound_of(found->second));
                });
  return divided;
}

}  // namespace st::occt
