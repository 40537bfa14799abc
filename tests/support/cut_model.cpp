// Cuts the faces of a CAD model by random planes: cut_model IN OUT.brep SEED N [N_EDGES [SHARE]]
//
// The solids are left out, so that planes cut faces only; N = 0 writes the faces as they are. Every plane is an edge
// between smooth neighbours, somewhere: it says nothing about the shape. N_EDGES random edges are cut at two places
// which are 1e-5 of their length apart, so that between them is a short one. SHARE: planes pass the middle of the
// model, of this share of its extents, 1 by default.
#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <gp_Pln.hxx>
#include <stdexcept>
#include <string>

namespace {

/// A linear congruential generator: the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(2 * seed + 1) {}
  double operator()(double lo, double hi) {
    state_ = 6364136223846793005u * state_ + 1442695040888963407u;
    return lo + (hi - lo) * static_cast<double>(state_ >> 11) / 9007199254740992.0;
  }

 private:
  std::uint64_t state_;
};

TopoDS_Shape read_model(const std::string& path) {
  const auto ends_with = [&](const std::string& end) { return path.size() > end.size() && path.ends_with(end); };
  if (ends_with(".brep")) {
    TopoDS_Shape shape;
    BRep_Builder builder;
    if (!BRepTools::Read(shape, path.c_str(), builder)) throw std::runtime_error("cannot read " + path);
    return shape;
  }
  STEPControl_Reader step;
  IGESControl_Reader iges;
  XSControl_Reader& reader = ends_with(".igs") || ends_with(".iges") ? static_cast<XSControl_Reader&>(iges) : step;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) throw std::runtime_error("cannot read " + path);
  reader.TransferRoots();
  return reader.OneShape();
}

/// All shells, and faces of none.
TopoDS_Shape surfaces_of(const TopoDS_Shape& shape) {
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  for (TopExp_Explorer e(shape, TopAbs_SHELL); e.More(); e.Next()) builder.Add(compound, e.Current());
  for (TopExp_Explorer e(shape, TopAbs_FACE, TopAbs_SHELL); e.More(); e.Next()) builder.Add(compound, e.Current());
  return compound;
}

TopoDS_Shape split(const TopoDS_Shape& surfaces, const TopTools_ListOfShape& tools, const char* failure) {
  TopTools_ListOfShape arguments;
  arguments.Append(surfaces);
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(arguments);
  splitter.SetTools(tools);
  splitter.Build();
  if (splitter.HasErrors()) throw std::runtime_error(failure);
  return splitter.Shape();
}

TopoDS_Shape cut(const TopoDS_Shape& surfaces, int n_planes, double share, Random& random) {
  Bnd_Box box;
  BRepBndLib::Add(surfaces, box);
  double lo[3], hi[3];
  box.Get(lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
  const double size = 2 * std::sqrt(box.SquareExtent());
  TopTools_ListOfShape tools;
  for (int i = 0; i < n_planes; ++i) {
    const auto place = [&](int k) {
      const double inner = 0.5 * (1 - share) * (hi[k] - lo[k]);
      return random(lo[k] + inner, hi[k] - inner);
    };
    const double x = place(0), y = place(1), z = place(2);
    const gp_Pnt at(x, y, z);
    const gp_Dir normal(random(-1, 1), random(-1, 1), random(-1, 1));
    tools.Append(BRepBuilderAPI_MakeFace(gp_Pln(at, normal), -size, size, -size, size).Face());
  }
  return split(surfaces, tools, "the planes cannot cut the model");
}

TopoDS_Shape with_short_edges(const TopoDS_Shape& surfaces, int n_edges, Random& random) {
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(surfaces, TopAbs_EDGE, edges);
  TopTools_ListOfShape tools;
  for (int i = 0; i < n_edges; ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(1 + static_cast<int>(random(0, edges.Extent()))));
    if (BRep_Tool::Degenerated(edge)) continue;
    const BRepAdaptor_Curve curve(edge);
    const double t = random(0.1, 0.9), from = curve.FirstParameter(), way = curve.LastParameter() - from;
    for (const double share : {t, t + 1e-5})
      tools.Append(BRepBuilderAPI_MakeVertex(curve.Value(from + share * way)).Vertex());
  }
  return split(surfaces, tools, "the edges cannot be cut");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5 || argc > 7) {
    std::fputs("usage: cut_model IN OUT.brep SEED N [N_EDGES [SHARE]]\n", stderr);
    return 2;
  }
  try {
    TopoDS_Shape surfaces = surfaces_of(read_model(argv[1]));
    Random random(std::strtoull(argv[3], nullptr, 10));
    if (const int n = std::atoi(argv[4]); n > 0)
      surfaces = cut(surfaces, n, argc == 7 ? std::atof(argv[6]) : 1, random);
    if (argc > 5 && std::atoi(argv[5]) > 0) surfaces = with_short_edges(surfaces, std::atoi(argv[5]), random);
    if (!BRepTools::Write(surfaces, argv[2])) throw std::runtime_error(std::string("cannot write ") + argv[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cut_model: error: %s\n", e.what());
    return 1;
  }
  return 0;
}
