// make_model KIND OUT: writes the models of the pages in examples/jobs, and checks them.
// Exit codes as those of the tools: 0 ok, 2 usage, 4 the geometry is not valid or cannot be written.

#include <BRepCheck_Analyzer.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>
#include <StlAPI_Writer.hxx>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "../aircraft/step_file.h"
#include "job_models.h"

namespace aircraft {
namespace {

struct Kind {
  const char* name;
  TopoDS_Shape (*make)(NameTable&);
  const char* unit;
  bool is_facets;
};

constexpr Kind kKinds[] = {
    {"propeller", make_propeller, "M", false}, {"hull", make_hull, "M", false}, {"cascade", make_cascade, "M", false},
    {"bracket", make_bracket, "MM", false},    {"tee", make_tee, "MM", true},
};

constexpr const char* kUsage =
    "usage: make_model KIND OUT\n"
    "Writes a model of the pages in examples/jobs:\n"
    "  propeller  four blades on a hub, metres, STEP\n"
    "  hull       half a ship's hull, open at deck and symmetry plane, metres, STEP\n"
    "  cascade    the air around a turbine's vane, metres, STEP\n"
    "  bracket    a bearing bracket, millimetres, STEP\n"
    "  tee        a T of pipes, millimetres, as facets: STL\n";

void write_facets(const std::string& path, const TopoDS_Shape& shape) {
  constexpr double kChordError = 0.05, kAngle = 0.2;  // mm, rad: as CAD systems export by default
  BRepMesh_IncrementalMesh(shape, kChordError, /*isRelative=*/false, kAngle);
  StlAPI_Writer writer;
  writer.ASCIIMode() = false;
  if (!writer.Write(shape, path.c_str())) throw std::runtime_error("cannot write '" + path + "'");
}

void make(const Kind& kind, const std::string& path) {
  NameTable names;
  const TopoDS_Shape shape = kind.make(names);
  if (!BRepCheck_Analyzer(shape).IsValid()) throw std::runtime_error("the model is not valid");
  if (kind.is_facets)
    write_facets(path, shape);
  else
    write_step(path, kind.name, shape, names, kind.unit);
  std::printf("%s\n", path.c_str());
}

}  // namespace
}  // namespace aircraft

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 1 && arguments[0] == "--help") {
    std::fputs(aircraft::kUsage, stdout);
    return 0;
  }
  const aircraft::Kind* chosen = nullptr;
  for (const aircraft::Kind& kind : aircraft::kKinds)
    if (arguments.size() == 2 && arguments[0] == kind.name) chosen = &kind;
  if (!chosen) {
    std::fputs(aircraft::kUsage, stderr);
    return 2;
  }
  Message::DefaultMessenger()->ChangePrinters().Clear();  // no chatter of the STEP translator
  try {
    aircraft::make(*chosen, arguments[1]);
    return 0;
  } catch (const Standard_Failure& failure) {
    std::fprintf(stderr, "make_model: OpenCASCADE: %s\n", failure.GetMessageString());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_model: %s\n", error.what());
  }
  return 4;
}
