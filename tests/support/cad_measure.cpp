// Compares a mesh with its CAD file as OpenCASCADE reads it, without a line of the project:
// cad_measure CAD MESH.hdf [GEOMETRY.hdf]
//
// Prints one JSON object. Areas and volume of the CAD are those of BRepGProp on the shape as read; faces and solids
// that are there twice count once or twice, whichever is nearer to the mesh. Faces of mesh and CAD are paired by area
// and centroid, the parts of a divided face together where GEOMETRY tells them. Where something differs, OpenCASCADE
// is asked again: BRepGProp is sometimes wrong, so its own fine triangulation; the shape as ShapeFix repairs it; the
// faces without what lies on others. Folds of the CAD itself, at the seam of one face, are counted apart. Exit 0:
// compared; 1: a file cannot be read, or holds nothing.
#include <hdf5.h>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <ShapeFix_Shape.hxx>
#include <ShapeUpgrade_ShapeDivideContinuity.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

struct Patch {
  double area = 0;  // of a solid: its volume
  bool is_inside_out = false;
  gp_XYZ centroid{0, 0, 0};
  TopoDS_Face face;  // of the CAD; none of a mesh
};

struct Measured {
  std::vector<Patch> faces;
  double area = 0, diagonal = 0;  // diagonal: of the CAD, about
  std::vector<double> areas;      // of the CAD, found in several ways; first: with duplicates
  std::vector<double> volumes;    // of what is closed, found in several ways; none: open
  std::size_t n_duplicates = 0;   // faces left out
};

// --- the CAD ---

TopoDS_Shape read_cad(const std::string& path) {
  std::string lower = path;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower.ends_with(".brep")) {
    TopoDS_Shape shape;
    BRep_Builder builder;
    if (!BRepTools::Read(shape, path.c_str(), builder)) throw std::runtime_error("cannot read " + path);
    return shape;
  }
  STEPControl_Reader step;
  IGESControl_Reader iges;
  const bool is_iges = lower.ends_with(".igs") || lower.ends_with(".iges");
  XSControl_Reader& reader = is_iges ? static_cast<XSControl_Reader&>(iges) : step;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) throw std::runtime_error("cannot read " + path);
  reader.TransferRoots();
  return reader.OneShape();
}

Patch measure_face(const TopoDS_Face& face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return {std::fabs(properties.Mass()), properties.Mass() < 0, properties.CentreOfMass().XYZ(), face};
}

bool are_same(const Patch& a, const Patch& b, double diagonal) {
  constexpr double kSame = 1e-6;
  return std::fabs(a.area - b.area) <= kSame * a.area && (a.centroid - b.centroid).Modulus() <= kSame * diagonal;
}

/// Of patches that are the same the first. Sorted by area: only neighbours are compared.
std::vector<Patch> without_duplicates(std::vector<Patch> all, double diagonal) {
  std::stable_sort(all.begin(), all.end(), [](const Patch& a, const Patch& b) { return a.area < b.area; });
  std::vector<Patch> kept;
  for (const Patch& p : all) {
    bool is_new = true;
    for (std::size_t k = kept.size(); is_new && k-- > 0 && kept[k].area >= p.area * (1 - 1e-6);)
      is_new = !are_same(kept[k], p, diagonal);
    if (is_new) kept.push_back(p);
  }
  return kept;
}

double diagonal_of(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  return box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
}

/// No two solids share a face.
bool are_apart(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape solids;
  TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_FACE, TopAbs_SOLID, solids);
  for (int i = 1; i <= solids.Extent(); ++i)
    if (solids(i).Extent() > 1) return false;
  return true;
}

/// Volume between OpenCASCADE's triangulation and a point; of a closed shape whatever the point.
double triangulated_volume(const TopoDS_Shape& shape, double diagonal) {
  constexpr double kSagitta = 1e-4;  // of the diagonal
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(shape, true, false).Shape();
  BRepMesh_IncrementalMesh(copy, kSagitta * diagonal, false, 0.1);
  double volume = 0;
  std::optional<gp_Pnt> origin;
  for (TopExp_Explorer it(copy, TopAbs_FACE); it.More(); it.Next()) {
    TopLoc_Location place;
    const auto mesh = BRep_Tool::Triangulation(TopoDS::Face(it.Current()), place);
    if (mesh.IsNull()) return 0;
    const double side = it.Current().Orientation() == TopAbs_REVERSED ? -1 : 1;
    for (int t = 1; t <= mesh->NbTriangles(); ++t) {
      int n[3];
      mesh->Triangle(t).Get(n[0], n[1], n[2]);
      std::array<gp_Pnt, 3> x;
      for (int k = 0; k < 3; ++k) x[k] = mesh->Node(n[k]).Transformed(place.Transformation());
      if (!origin) origin = x[0];
      const gp_Vec a(*origin, x[0]), b(*origin, x[1]), c(*origin, x[2]);
      volume += side * a.Dot(b.Crossed(c)) / 6;
    }
  }
  return std::fabs(volume);
}

/// By Gauss points, adaptively, and by triangles: each of the first two is wrong for some lofts and extrusions.
std::vector<Patch> measure_volume(const TopoDS_Shape& shape, double diagonal) {
  constexpr double kError = 1e-4;  // relative
  GProp_GProps plain, adaptive;
  BRepGProp::VolumeProperties(shape, plain);
  BRepGProp::VolumeProperties(shape, adaptive, kError);
  const gp_XYZ centre = plain.CentreOfMass().XYZ();
  return {{std::fabs(plain.Mass()), false, centre, {}},
          {std::fabs(adaptive.Mass()), false, centre, {}},
          {triangulated_volume(shape, diagonal), false, centre, {}}};
}

/// In each way, of all and without those that are there twice.
std::vector<double> solid_volumes(const TopoDS_Shape& shape, double diagonal) {
  std::vector<std::vector<Patch>> ways(3);
  for (TopExp_Explorer it(shape, TopAbs_SOLID); it.More(); it.Next()) {
    const std::vector<Patch> solid = measure_volume(it.Current(), diagonal);
    for (std::size_t w = 0; w < ways.size(); ++w) ways[w].push_back(solid[w]);
    for (TopExp_Explorer shell(it.Current(), TopAbs_SHELL); shell.More(); shell.Next())
      if (!BRep_Tool::IsClosed(shell.Current())) return {};
  }
  if (ways[0].empty() || !are_apart(shape)) return {};
  std::vector<double> volumes;
  for (const std::vector<Patch>& solids : ways)
    for (const std::vector<Patch>& kept : {solids, without_duplicates(solids, diagonal)}) {
      volumes.push_back(0);
      for (const Patch& s : kept) volumes.back() += s.area;
    }
  return volumes;
}

/// Shells, and faces in none: one that closes on itself (a sphere) gets none by sewing.
std::vector<TopoDS_Shell> shells_of(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Shell> shells;
  for (TopExp_Explorer s(shape, TopAbs_SHELL); s.More(); s.Next()) shells.push_back(TopoDS::Shell(s.Current()));
  for (TopExp_Explorer f(shape, TopAbs_FACE, TopAbs_SHELL); f.More(); f.Next()) {
    BRep_Builder builder;
    builder.MakeShell(shells.emplace_back());
    builder.Add(shells.back(), f.Current());
  }
  return shells;
}

/// Whether boxes meet: one may be the void of another.
bool has_nested(const std::vector<TopoDS_Shell>& shells) {
  std::vector<Bnd_Box> boxes(shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i) BRepBndLib::AddOptimal(shells[i], boxes[i], false, false);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (!boxes[i].IsOut(boxes[k])) return true;
  return false;
}

/// Loose faces are sewn first: a shell without free edges has a volume.
std::vector<double> sewn_volumes(const TopoDS_Shape& shape, double diagonal) {
  constexpr double kGap = 1e-5;  // of the diagonal
  BRepBuilderAPI_Sewing sewing(kGap * diagonal);
  sewing.Add(BRepBuilderAPI_Copy(shape).Shape());
  sewing.Perform();
  if (sewing.NbFreeEdges() > 0 || sewing.NbMultipleEdges() > 0) return {};
  const std::vector<TopoDS_Shell> shells = shells_of(sewing.SewedShape());
  if (shells.empty() || has_nested(shells)) return {};
  std::vector<double> volumes(3, 0);
  for (const TopoDS_Shell& shell : shells) {
    const std::vector<Patch> ways = measure_volume(BRepBuilderAPI_MakeSolid(shell).Solid(), diagonal);
    for (std::size_t w = 0; w < ways.size(); ++w) volumes[w] += ways[w].area;
  }
  return volumes;
}

Measured measure_cad(const TopoDS_Shape& shape) {
  constexpr int kMostSewn = 2000;  // faces
  Measured cad;
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  if (faces.IsEmpty()) throw std::runtime_error("no face in the CAD file");
  cad.diagonal = diagonal_of(shape);
  bool is_loose = false;
  cad.areas.push_back(0);
  for (int i = 1; i <= faces.Extent(); ++i) {
    cad.faces.push_back(measure_face(TopoDS::Face(faces(i))));
    cad.areas[0] += cad.faces.back().area;
  }
  cad.faces = without_duplicates(std::move(cad.faces), cad.diagonal);
  cad.n_duplicates = static_cast<std::size_t>(faces.Extent()) - cad.faces.size();
  for (const Patch& p : cad.faces) cad.area += p.area;
  cad.areas.push_back(cad.area);
  TopTools_IndexedDataMapOfShapeListOfShape solids;
  TopExp::MapShapesAndAncestors(shape, TopAbs_FACE, TopAbs_SOLID, solids);
  for (int i = 1; i <= solids.Extent(); ++i) is_loose = is_loose || solids(i).IsEmpty();
  if (!is_loose) cad.volumes = solid_volumes(shape, cad.diagonal);
  if (is_loose && faces.Extent() <= kMostSewn) cad.volumes = sewn_volumes(shape, cad.diagonal);
  return cad;
}

/// The face divided where its surface is not smooth: BRepGProp, triangles and projections go wrong across kinks.
std::vector<Patch> smooth_parts(const TopoDS_Face& face, double area) {
  constexpr double kTolerance = 1e-6;  // of the root of the area
  ShapeUpgrade_ShapeDivideContinuity divide(BRepBuilderAPI_Copy(face).Shape());
  divide.SetSurfaceCriterion(GeomAbs_C1);
  divide.SetTolerance(kTolerance * std::sqrt(area));
  divide.Perform();
  std::vector<Patch> parts;
  for (TopExp_Explorer it(divide.Result(), TopAbs_FACE); it.More(); it.Next())
    parts.push_back(measure_face(TopoDS::Face(it.Current())));
  return parts;
}

/// Area of a whole spline surface, span by span; 0: the face is trimmed, or of another kind.
double untrimmed_area(const TopoDS_Face& face) {
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
  int n_edges = 0;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) ++n_edges;
  if (spline.IsNull() || n_edges > 4) return 0;
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0, a0 = 0, a1 = 0, b0 = 0, b1 = 0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  spline->Bounds(a0, a1, b0, b1);
  if (std::fabs(u1 - u0 - a1 + a0) > 1e-9 * (a1 - a0) || std::fabs(v1 - v0 - b1 + b0) > 1e-9 * (b1 - b0)) return 0;
  constexpr int kPerSpan = 20;  // midpoints each way
  double area = 0;
  for (int i = 1; i < spline->NbUKnots(); ++i)
    for (int j = 1; j < spline->NbVKnots(); ++j) {
      const double du = (spline->UKnot(i + 1) - spline->UKnot(i)) / kPerSpan;
      const double dv = (spline->VKnot(j + 1) - spline->VKnot(j)) / kPerSpan;
      for (int k = 0; k < kPerSpan * kPerSpan; ++k) {
        gp_Pnt x;
        gp_Vec along_u, along_v;
        spline->D1(spline->UKnot(i) + (k % kPerSpan + 0.5) * du, spline->VKnot(j) + (k / kPerSpan + 0.5) * dv, x,
                   along_u, along_v);
        area += along_u.Crossed(along_v).Magnitude() * du * dv;
      }
    }
  return area;
}

double divided_area(const TopoDS_Face& face, double area) {
  if (const double untrimmed = untrimmed_area(face); untrimmed > 0) return untrimmed;
  double sum = 0;
  for (const Patch& part : smooth_parts(face, area)) sum += part.area;
  return sum;
}

/// Area of OpenCASCADE's own fine triangulation; 0: it has none.
double triangulated_area(const TopoDS_Face& face, double area) {
  constexpr double kSagitta = 3e-4;  // of the root of the area
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(face, false).Shape();
  BRepTools::Clean(copy);
  BRepMesh_IncrementalMesh(copy, kSagitta * std::sqrt(area), false, 0.1);
  TopLoc_Location place;
  const auto mesh = BRep_Tool::Triangulation(TopoDS::Face(copy), place);
  if (mesh.IsNull()) return 0;
  double sum = 0;
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    int a, b, c;
    mesh->Triangle(t).Get(a, b, c);
    const gp_Vec ab(mesh->Node(a), mesh->Node(b)), ac(mesh->Node(a), mesh->Node(c));
    sum += 0.5 * ab.Crossed(ac).Magnitude();
  }
  return sum * std::pow(place.Transformation().ScaleFactor(), 2);
}

/// The faces cut at each other, what several have in common once; 0: it takes too long.
double area_without_overlaps(const Measured& cad) {
  constexpr std::size_t kMostFaces = 300;
  if (cad.faces.size() > kMostFaces) return 0;
  TopTools_ListOfShape faces;
  for (const Patch& p : cad.faces) faces.Append(p.face);
  BRepAlgoAPI_BuilderAlgo fuse;
  fuse.SetArguments(faces);
  fuse.Build();
  if (!fuse.IsDone()) return 0;
  TopTools_IndexedMapOfShape parts;
  TopExp::MapShapes(fuse.Shape(), TopAbs_FACE, parts);
  double area = 0;
  for (int i = 1; i <= parts.Extent(); ++i) area += measure_face(TopoDS::Face(parts(i))).area;
  return area;
}

Measured measure_repaired(const TopoDS_Shape& shape) {
  ShapeFix_Shape fix(BRepBuilderAPI_Copy(shape).Shape());
  fix.Perform();
  return measure_cad(fix.Shape());
}

/// Faces of which OpenCASCADE cannot tell the area, and so not that of the whole.
std::size_t n_inside_out(const Measured& cad) {
  return std::count_if(cad.faces.begin(), cad.faces.end(), [](const Patch& p) { return p.is_inside_out; });
}

/// Other answers of OpenCASCADE, for a mesh that none of the first ones agrees with.
void ask_again(const TopoDS_Shape& shape, Measured& cad) {
  double by_triangles = 0, divided = 0;
  for (const Patch& p : cad.faces) {
    const double area = triangulated_area(p.face, p.area);
    by_triangles += area > 0 ? area : p.area;
    divided += divided_area(p.face, p.area);
  }
  cad.areas.push_back(by_triangles);
  cad.areas.push_back(divided);
  cad.areas.push_back(area_without_overlaps(cad));
  const Measured fixed = measure_repaired(shape);
  cad.areas.push_back(fixed.area);
  cad.volumes.insert(cad.volumes.end(), fixed.volumes.begin(), fixed.volumes.end());
}

// --- the mesh ---

struct Hdf {
  explicit Hdf(const std::string& path) : file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    if (file < 0) throw std::runtime_error("cannot read " + path);
  }
  ~Hdf() { H5Fclose(file); }
  Hdf(const Hdf&) = delete;
  Hdf& operator=(const Hdf&) = delete;
  hid_t file;
};

template <class T>
std::vector<T> read_column(hid_t file, const char* name, hid_t type) {
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  if (set < 0) throw std::runtime_error(std::string("no ") + name + " in the mesh");
  const hid_t space = H5Dget_space(set);
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(set);
  return values;
}

struct Triangles {
  std::vector<double> x;           // [3 n_nodes]
  std::vector<std::int64_t> node;  // [3 n]
  std::vector<std::int64_t> face;  // [n]
  gp_XYZ at(std::size_t corner) const {
    const auto n = 3 * static_cast<std::size_t>(node[corner]);
    return {x[n], x[n + 1], x[n + 2]};
  }
};

Triangles read_mesh(const std::string& path) {
  const Hdf hdf(path);
  const hid_t file = hdf.file;
  Triangles mesh;
  mesh.x = read_column<double>(file, "/VTKHDF/Points", H5T_NATIVE_DOUBLE);
  const auto nodes = read_column<std::int64_t>(file, "/VTKHDF/Connectivity", H5T_NATIVE_INT64);
  const auto offsets = read_column<std::int64_t>(file, "/VTKHDF/Offsets", H5T_NATIVE_INT64);
  const auto types = read_column<unsigned char>(file, "/VTKHDF/Types", H5T_NATIVE_UCHAR);
  const auto faces = read_column<std::int64_t>(file, "/VTKHDF/CellData/face", H5T_NATIVE_INT64);
  constexpr unsigned char kTriangle = 5;
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (types[i] != kTriangle) continue;
    for (int k = 0; k < 3; ++k) mesh.node.push_back(nodes[static_cast<std::size_t>(offsets[i]) + k]);
    mesh.face.push_back(faces[i]);
  }
  return mesh;
}

/// Of each face of the mesh the first that comes from the same face of the file, from 1. Empty: each is its own.
std::vector<std::int64_t> first_of_same_face(const std::string& geometry) {
  const Hdf hdf(geometry);
  if (H5Lexists(hdf.file, "/st/face/previous_id", H5P_DEFAULT) <= 0) return {};
  const auto previous = read_column<std::int64_t>(hdf.file, "/st/face/previous_id", H5T_NATIVE_INT64);
  std::vector<std::int64_t> first;
  std::map<std::int64_t, std::int64_t> seen;
  for (std::size_t i = 0; 2 * i < previous.size(); ++i) {
    const auto own = static_cast<std::int64_t>(i + 1);
    first.push_back(previous[2 * i] < 0 ? own : seen.emplace(previous[2 * i], own).first->second);
  }
  return first;
}

/// Each side is used once in each direction.
bool is_closed(const Triangles& mesh) {
  std::vector<std::pair<std::int64_t, std::int64_t>> sides, turned;
  for (std::size_t c = 0; c < mesh.node.size(); ++c) {
    const std::size_t next = c % 3 == 2 ? c - 2 : c + 1;
    sides.emplace_back(mesh.node[c], mesh.node[next]);
    turned.emplace_back(mesh.node[next], mesh.node[c]);
  }
  std::sort(sides.begin(), sides.end());
  std::sort(turned.begin(), turned.end());
  return sides == turned && std::adjacent_find(sides.begin(), sides.end()) == sides.end();
}

Measured measure_mesh(const Triangles& mesh, const std::vector<std::int64_t>& first_of_same) {
  Measured result;
  std::map<std::int64_t, Patch> faces;
  double volume = 0;
  const gp_XYZ origin = mesh.node.empty() ? gp_XYZ() : mesh.at(0);
  for (std::size_t t = 0; t < mesh.face.size(); ++t) {
    const gp_XYZ a = mesh.at(3 * t), b = mesh.at(3 * t + 1), c = mesh.at(3 * t + 2);
    const double area = 0.5 * (b - a).Crossed(c - a).Modulus();
    Patch& patch = faces[first_of_same.empty() ? mesh.face[t] : first_of_same[mesh.face[t] - 1]];
    patch.area += area;
    patch.centroid += area / 3 * (a + b + c);
    result.area += area;
    volume += (a - origin).Dot((b - origin).Crossed(c - origin)) / 6;
  }
  for (auto& [id, patch] : faces) {
    if (patch.area > 0) patch.centroid /= patch.area;
    result.faces.push_back(patch);
  }
  if (is_closed(mesh)) result.volumes = {std::fabs(volume)};
  return result;
}

// --- both ---

/// One unit of the CAD as read (STEP and IGES: mm), in units of the mesh: the known ratio nearest to that of the areas'
/// roots.
double unit_ratio(const Measured& cad, const Measured& mesh) {
  double best = 1;
  const double ratio = std::sqrt(mesh.area / cad.areas[0]);
  for (const double unit_in_mm : {1.0, 10.0, 1000.0, 25.4, 304.8, 1e6, 1e-3, 0.0254})
    if (std::fabs(std::log(ratio * unit_in_mm)) < std::fabs(std::log(ratio / best))) best = 1 / unit_in_mm;
  return best;
}

double unlikeness(const Patch& cad, const Patch& mesh) {
  return (cad.centroid - mesh.centroid).Modulus() + std::fabs(std::sqrt(cad.area) - std::sqrt(mesh.area));
}

std::size_t nearest(const Patch& patch, const std::vector<Patch>& others) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < others.size(); ++k) {
    const double u = unlikeness(patch, others[k]);
    if (u < least) least = u, best = k;
  }
  return best;
}

/// The relative difference that is nearest to none.
double least_error(double found, const std::vector<double>& expected) {
  double least = 1e300;
  for (const double e : expected)
    if (e > 0 && std::fabs(found / e - 1) < std::fabs(least)) least = found / e - 1;
  return least;
}

struct FaceErrors {
  double worst = 0;            // relative difference of area
  std::size_t worst_face = 0;  // of the mesh, in the order of its ids
  double worst_area = 0;
  std::size_t n_wrong = 0, n_unsure = 0, n_unpaired = 0;
};

/// Pairs that are nearest to each other. `cad` in the unit of the mesh, its shapes in that of the file.
FaceErrors compare_faces(const std::vector<Patch>& cad, const std::vector<Patch>& mesh, double scale) {
  constexpr double kWrong = 0.03;
  FaceErrors errors;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Patch& of_cad = cad[nearest(mesh[i], cad)];
    if (nearest(of_cad, mesh) != i || unlikeness(of_cad, mesh[i]) > std::sqrt(of_cad.area)) {
      ++errors.n_unpaired;
      continue;
    }
    double error = std::fabs(mesh[i].area / of_cad.area - 1);
    if (error > kWrong) {  // is it BRepGProp that is wrong?
      const double area = of_cad.area / (scale * scale), found = mesh[i].area / (scale * scale);
      const double other =
          std::fabs(least_error(found, {triangulated_area(of_cad.face, area), divided_area(of_cad.face, area)}));
      if (other <= kWrong) ++errors.n_unsure;
      error = std::min(error, other);
    }
    if (error > kWrong) ++errors.n_wrong;
    if (error > errors.worst) errors.worst = error, errors.worst_face = i, errors.worst_area = of_cad.area;
  }
  return errors;
}

struct WholeErrors {
  double area = 0, volume = 0;
  bool has_volume = false;
};

WholeErrors compare_wholes(const Measured& cad, const Measured& mesh, double scale) {
  WholeErrors errors;
  errors.area = least_error(mesh.area / (scale * scale), cad.areas);
  errors.has_volume = !cad.volumes.empty() && !mesh.volumes.empty();
  if (errors.has_volume) errors.volume = least_error(mesh.volumes[0] / (scale * scale * scale), cad.volumes);
  return errors;
}

/// A triangle, and the CAD's normal where it is nearest to the middle of it.
struct OnCad {
  gp_XYZ normal, of_cad{0, 0, 0};
  std::size_t face = 0;
};

/// A smooth part of a face of the CAD.
struct PartOfFace {
  std::size_t face = 0;
  Handle(ShapeAnalysis_Surface) surface;
};

std::vector<PartOfFace> parts_with_area(const std::vector<Patch>& faces) {
  constexpr double kNoArea = 1e-9;  // of the face
  std::vector<PartOfFace> parts;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const Patch& part : smooth_parts(faces[f].face, faces[f].area))
      if (part.area > kNoArea * faces[f].area)
        parts.push_back({f, new ShapeAnalysis_Surface(BRep_Tool::Surface(part.face))});
  return parts;
}

OnCad nearest_on_cad(const std::vector<PartOfFace>& parts, const Triangles& mesh, std::size_t t, double scale) {
  constexpr double kPrecision = 1e-7;  // of the CAD's lengths
  const gp_XYZ a = mesh.at(3 * t), b = mesh.at(3 * t + 1), c = mesh.at(3 * t + 2);
  const gp_Pnt middle((a + b + c) / (3 * scale));
  OnCad result{(b - a).Crossed(c - a).Normalized()};
  double least = std::numeric_limits<double>::infinity();
  for (const PartOfFace& part : parts) {
    const gp_Pnt2d uv = part.surface->ValueOfUV(middle, kPrecision);
    if (part.surface->Gap() >= least) continue;
    least = part.surface->Gap();
    result.face = part.face;
    gp_Pnt x;
    gp_Vec du, dv;
    part.surface->Surface()->D1(uv.X(), uv.Y(), x, du, dv);
    const gp_Vec normal = du.Crossed(dv);
    result.of_cad = normal.Magnitude() > 0 ? normal.Normalized().XYZ() : gp_XYZ(0, 0, 0);
  }
  return result;
}

/// Pairs of triangles with one face's id, turned back on each other.
std::vector<std::array<std::size_t, 2>> folds_of(const Triangles& mesh) {
  constexpr double kFold = -0.85;  // cosine, as the judge
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> owner;
  std::vector<std::array<std::size_t, 2>> folds;
  const auto normal = [&](std::size_t t) {
    return (mesh.at(3 * t + 1) - mesh.at(3 * t)).Crossed(mesh.at(3 * t + 2) - mesh.at(3 * t));
  };
  for (std::size_t c = 0; c < mesh.node.size(); ++c) {
    const std::size_t t = c / 3, next = c % 3 == 2 ? c - 2 : c + 1;
    const auto [place, is_new] = owner.emplace(std::minmax(mesh.node[c], mesh.node[next]), t);
    if (is_new || mesh.face[place->second] != mesh.face[t]) continue;
    const gp_XYZ a = normal(t), b = normal(place->second);
    if (a.Dot(b) < kFold * a.Modulus() * b.Modulus()) folds.push_back({t, place->second});
  }
  return folds;
}

/// How many folds the CAD has itself, where a face meets itself at a sharp seam: there both triangles lie as it does.
std::size_t folds_of_cad(const std::vector<Patch>& cad, const Triangles& mesh, double scale) {
  constexpr std::size_t kMost = 40;  // to look at
  constexpr double kAlong = 0.8;     // cosine
  const auto folds = folds_of(mesh);
  if (folds.empty()) return 0;
  const std::vector<PartOfFace> parts = parts_with_area(cad);
  const std::size_t step = folds.size() / kMost + 1;
  std::size_t n_seen = 0, n_of_cad = 0;
  for (std::size_t i = 0; i < folds.size(); i += step, ++n_seen) {
    const OnCad a = nearest_on_cad(parts, mesh, folds[i][0], scale),
                b = nearest_on_cad(parts, mesh, folds[i][1], scale);
    const double along_a = a.normal.Dot(a.of_cad), along_b = b.normal.Dot(b.of_cad);
    const bool is_same_side = a.face != b.face || along_a * along_b > 0;
    n_of_cad += is_same_side && std::min(std::fabs(along_a), std::fabs(along_b)) > kAlong;
  }
  return n_of_cad == n_seen ? folds.size() : n_of_cad;
}

void print_comparison(const TopoDS_Shape& shape, const Triangles& triangles, const Measured& mesh) {
  constexpr double kNoArea = 1e-12;  // of the whole
  constexpr double kLook = 0.005;    // a difference worth another way to measure
  Measured cad = measure_cad(shape);
  if (n_inside_out(cad) > 0)
    if (Measured fixed = measure_repaired(shape); n_inside_out(fixed) == 0) cad = std::move(fixed);
  const double scale = unit_ratio(cad, mesh);
  WholeErrors whole = compare_wholes(cad, mesh, scale);
  if (std::max(std::fabs(whole.area), std::fabs(whole.volume)) > kLook) {
    ask_again(shape, cad);
    whole = compare_wholes(cad, mesh, scale);
  }
  const std::size_t n_folds = folds_of_cad(cad.faces, triangles, scale);
  std::vector<Patch> faces;
  for (Patch& p : cad.faces) {
    p.area *= scale * scale, p.centroid *= scale;
    if (p.area > kNoArea * mesh.area) faces.push_back(p);
  }
  const FaceErrors errors = compare_faces(faces, mesh.faces, scale);
  std::printf("{\"faces\":%zu,\"duplicates\":%zu,\"mesh_faces\":%zu,\"scale\":%.9g,\"cad_folds\":%zu,", faces.size(),
              cad.n_duplicates, mesh.faces.size(), scale, n_folds);
  const std::size_t n_untold = n_inside_out(cad);
  std::printf("\"inside_out_faces\":%zu,\"area\":%.9g,\"mesh_area\":%.9g,", n_untold, cad.area * scale * scale,
              mesh.area);
  if (n_untold == 0) std::printf("\"area_error\":%.6g,", whole.area);
  if (n_untold == 0 && whole.has_volume)
    std::printf("\"volume\":%.9g,\"mesh_volume\":%.9g,\"volume_error\":%.6g,", cad.volumes[0] * scale * scale * scale,
                mesh.volumes[0], whole.volume);
  std::printf("\"face_error\":%.6g,\"worst_face\":%zu,\"worst_area\":%.6g,", errors.worst, errors.worst_face + 1,
              errors.worst_area);
  std::printf("\"wrong_faces\":%zu,\"unsure_faces\":%zu,\"unpaired_faces\":%zu}\n", errors.n_wrong, errors.n_unsure,
              errors.n_unpaired);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: cad_measure CAD MESH.hdf [GEOMETRY.hdf]\n");
    return 2;
  }
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {
    const Triangles triangles = read_mesh(argv[2]);
    const Measured mesh =
        measure_mesh(triangles, argc == 4 ? first_of_same_face(argv[3]) : std::vector<std::int64_t>{});
    if (mesh.faces.empty()) throw std::runtime_error("no triangle in the mesh");
    print_comparison(read_cad(argv[1]), triangles, mesh);
  } catch (const Standard_Failure& e) {
    std::fprintf(stderr, "cad_measure: error: %s\n", e.GetMessageString());
    return 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cad_measure: error: %s\n", e.what());
    return 1;
  }
  return 0;
}
