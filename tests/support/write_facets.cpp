// Facets of a CAD model, for scripts/facets_table.py: write_facets IN SHARE OUT.stl OUT.brep
//
// Facets are OpenCASCADE's, off by at most SHARE of the diagonal of the model's box, and turned by half a radian from
// one to the next, as it does by default. OUT.brep is the model as read, in the same numbers.
#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <IGESControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <StlAPI_Writer.hxx>
#include <TopoDS_Shape.hxx>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

TopoDS_Shape read_model(const std::string& path) {
  TopoDS_Shape shape;
  BRep_Builder builder;
  if (path.ends_with(".brep")) {
    if (!BRepTools::Read(shape, path.c_str(), builder)) throw std::runtime_error("cannot read " + path);
    return shape;
  }
  STEPControl_Reader step;
  IGESControl_Reader iges;
  const bool is_iges = path.ends_with(".igs") || path.ends_with(".iges");
  XSControl_Reader& reader = is_iges ? static_cast<XSControl_Reader&>(iges) : step;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) throw std::runtime_error("cannot read " + path);
  reader.TransferRoots();
  return reader.OneShape();
}

void write_facets(const TopoDS_Shape& shape, double share, const std::string& stl, const std::string& brep) {
  BRepTools::Clean(shape);
  if (!BRepTools::Write(shape, brep.c_str())) throw std::runtime_error("cannot write " + brep);
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, false, false);
  BRepMesh_IncrementalMesh(shape, share * std::sqrt(box.SquareExtent()));
  StlAPI_Writer writer;
  writer.ASCIIMode() = false;
  if (!writer.Write(shape, stl.c_str())) throw std::runtime_error("cannot write " + stl);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: write_facets IN SHARE OUT.stl OUT.brep\n", stderr);
    return 2;
  }
  try {
    write_facets(read_model(argv[1]), std::atof(argv[2]), argv[3], argv[4]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "write_facets: error: %s\n", e.what());
    return 1;
  }
  return 0;
}
