// make_aircraft OUT.step: writes the bundled example, a generic transport aircraft in a half box of air, and checks it.
// Options make variants of it: sweep, dihedral, engines, tails, flaps.
// Exit codes as those of the tools: 0 ok, 2 usage, 4 the geometry is not valid or not written as intended.

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Solid.hxx>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gp_Ax2.hxx>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "parts.h"
#include "step_file.h"

namespace aircraft {
namespace {

/// What the program promises about its result.
struct Report {
  int n_solids = 0, n_shells = 0, n_faces = 0, n_edges = 0, n_open_edges = 0;
  double shortest_edge = std::numeric_limits<double>::max();  ///< m
  double largest_tolerance = 0;                               ///< m
  double volume = 0, wetted_area = 0;                         ///< m3, m2 without symmetry plane and far field
  bool is_valid = false;
  std::map<std::string, int> faces_per_group;
};

template <class Operation>
TopoDS_Shape solid_of(Operation& operation) {
  operation.Build();
  if (operation.HasErrors()) {
    std::ostringstream why;
    operation.DumpErrors(why);
    throw std::runtime_error("the boolean operation failed: " + why.str());
  }
  TopExp_Explorer solids(operation.Shape(), TopAbs_SOLID);
  return solids.More() ? solids.Current() : operation.Shape();
}

/// The air: far field minus all parts, in one operation.
TopoDS_Shape subtract(const TopoDS_Solid& far_field, const std::vector<Part>& parts) {
  TopTools_ListOfShape air, bodies;
  air.Append(far_field);
  for (const Part& part : parts) bodies.Append(part.solid);
  BRepAlgoAPI_Cut cut;
  cut.SetArguments(air);
  cut.SetTools(bodies);
  return solid_of(cut);
}

/// Both halves of the air as one solid; nothing stays of the symmetry plane between them.
TopoDS_Shape with_image(const TopoDS_Shape& half, NameTable& names) {
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2(gp::Origin(), gp::DY()));
  const TopoDS_Shape image = BRepBuilderAPI_Transform(half, mirror, true).Shape();
  TopTools_IndexedMapOfShape faces, images;
  TopExp::MapShapes(half, TopAbs_FACE, faces);
  TopExp::MapShapes(image, TopAbs_FACE, images);
  for (int i = 1; i <= faces.Extent(); ++i) names.set(TopoDS::Face(images(i)), names.of(TopoDS::Face(faces(i))));
  BRepAlgoAPI_Fuse both(half, image);
  return solid_of(both);
}

double length(const TopoDS_Edge& edge) {
  GProp_GProps properties;
  BRepGProp::LinearProperties(edge, properties);
  return properties.Mass();
}

void measure_edges(const TopoDS_Shape& shape, Report& report) {
  TopTools_IndexedDataMapOfShapeListOfShape edge_faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, edge_faces);
  report.n_edges = edge_faces.Extent();
  for (int i = 1; i <= edge_faces.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(edge_faces.FindKey(i));
    report.largest_tolerance = std::max(report.largest_tolerance, BRep_Tool::Tolerance(edge));
    if (BRep_Tool::Degenerated(edge)) continue;
    if (edge_faces(i).Extent() != 2) ++report.n_open_edges;
    report.shortest_edge = std::min(report.shortest_edge, length(edge));
  }
}

Report inspect(const TopoDS_Shape& shape, const NameTable& names) {
  Report report;
  for (TopExp_Explorer it(shape, TopAbs_SOLID); it.More(); it.Next()) ++report.n_solids;
  for (TopExp_Explorer it(shape, TopAbs_SHELL); it.More(); it.Next()) ++report.n_shells;
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  report.n_faces = faces.Extent();
  for (int i = 1; i <= faces.Extent(); ++i) {
    const std::string& name = names.of(TopoDS::Face(faces(i)));
    ++report.faces_per_group[name];
    if (name == "symmetry" || name == "farfield") continue;
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(faces(i), properties);
    report.wetted_area += properties.Mass();
  }
  measure_edges(shape, report);
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  report.volume = properties.Mass();
  report.is_valid = BRepCheck_Analyzer(shape).IsValid();
  return report;
}

void print(const Report& r) {
  for (const auto& [name, n] : r.faces_per_group) std::printf("%4d faces  %s\n", n, name.c_str());
  std::printf("solids %d, shells %d, faces %d, edges %d (open %d), shortest edge %.4g m, largest tolerance %.2g m\n",
              r.n_solids, r.n_shells, r.n_faces, r.n_edges, r.n_open_edges, r.shortest_edge, r.largest_tolerance);
  std::printf("volume %.6g m3, wetted area %.6g m2, %s\n", r.volume, r.wetted_area, r.is_valid ? "valid" : "NOT VALID");
}

/// @throws std::runtime_error naming the first promise that is not kept.
void check(const Report& r, bool is_variant) {
  constexpr double kShortestEdge = 2e-3;  // m: the thinnest trailing edge is longer; anything shorter is a sliver of
                                          // the boolean operation
  const auto require = [](bool kept, const char* promise) {
    if (!kept) throw std::runtime_error(std::string("promise not kept: ") + promise);
  };
  require(r.is_valid, "the shape is valid");
  require(r.n_solids == 1, "the air is one solid");
  require(r.n_open_edges == 0, "every edge has two faces");
  require(r.volume > 0, "the volume is positive");
  if (is_variant) return;  // where parts of other variants meet there may be slivers, as in real models
  require(r.shortest_edge >= kShortestEdge, "no edge is shorter than 2 mm");
  require(r.n_faces >= 150, "the model has some hundred faces");
}

void make(const std::string& path, const Shape& shape, bool is_variant, bool is_whole) {
  NameTable names;
  const std::vector<Part> parts = make_parts(shape, names);
  TopoDS_Shape air = subtract(make_far_field(names), parts);
  if (is_whole) air = with_image(air, names);
  const Report report = inspect(air, names);
  print(report);
  write_step(path, "transport_aircraft", air, names);
  // OpenCASCADE reads no names of faces in the void that a flap apart from its fairings makes; the file has them
  if (report.n_shells == 1 && read_face_names(path) != report.faces_per_group)
    throw std::runtime_error("the names of the faces in '" + path + "' are not those of the model");
  check(report, is_variant);
  std::printf("%s\n", path.c_str());
}

constexpr const char* kUsage =
    "usage: make_aircraft OUT.step [--sweep DEG] [--dihedral DEG] [--engines N] [--tail KIND] [--flaps DEG] [--whole]\n"
    "Writes a generic transport aircraft (half configuration, metres) in a half box of air. Variants of it:\n"
    "  --sweep DEG     of the wing's leading edge, 10 to 45\n"
    "  --dihedral DEG  of the wing, -4 to 10; default 5.5\n"
    "  --engines N     under each wing, 0 to 2; default 1\n"
    "  --tail KIND     conventional, t, cross, v or none\n"
    "  --flaps DEG     deflection of a slotted flap, 0 to 40; default 0: none\n"
    "  --whole         both halves, in a whole box of air\n";

struct BadUsage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

double number(const std::string& option, const std::string& text, double least, double most) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !(value >= least && value <= most))
    throw BadUsage(option + " takes a number from " + std::to_string(static_cast<int>(least)) + " to " +
                   std::to_string(static_cast<int>(most)) + ", not '" + text + "'");
  return value;
}

int whole_number(const std::string& option, const std::string& text, int least, int most) {
  const double value = number(option, text, least, most);
  if (value != std::floor(value)) throw BadUsage(option + " takes a whole number, not '" + text + "'");
  return static_cast<int>(value);
}

Tail tail_of(const std::string& name) {
  const char* const names[] = {"conventional", "t", "cross", "v", "none"};
  for (int i = 0; i < 5; ++i)
    if (name == names[i]) return static_cast<Tail>(i);
  throw BadUsage("--tail takes conventional, t, cross, v or none, not '" + name + "'");
}

void set(Shape& shape, const std::string& option, const std::string& value) {
  if (option == "--sweep")
    shape.aft_per_span = std::tan(number(option, value, 10, 45) * M_PI / 180);
  else if (option == "--dihedral")
    shape.dihedral_deg = number(option, value, -4, 10);
  else if (option == "--engines")
    shape.n_engines = whole_number(option, value, 0, 2);
  else if (option == "--tail")
    shape.tail = tail_of(value);
  else if (option == "--flaps")
    shape.flaps_deg = number(option, value, 0, 40);
  else
    throw BadUsage("unknown option '" + option + "'");
}

}  // namespace
}  // namespace aircraft

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 1 && arguments[0] == "--help") {
    std::fputs(aircraft::kUsage, stdout);
    return 0;
  }
  Message::DefaultMessenger()->ChangePrinters().Clear();  // no chatter of the STEP translator
  const bool is_whole = std::erase(arguments, "--whole") > 0;
  try {
    if (arguments.size() % 2 == 0 || arguments[0].starts_with("-")) throw aircraft::BadUsage("one file is needed");
    aircraft::Shape shape;
    for (std::size_t i = 1; i < arguments.size(); i += 2) aircraft::set(shape, arguments[i], arguments[i + 1]);
    aircraft::make(arguments[0], shape, arguments.size() > 1 || is_whole, is_whole);
    return 0;
  } catch (const aircraft::BadUsage& error) {
    std::fprintf(stderr, "make_aircraft: %s\n%s", error.what(), aircraft::kUsage);
    return 2;
  } catch (const Standard_Failure& failure) {
    std::fprintf(stderr, "make_aircraft: OpenCASCADE: %s\n", failure.GetMessageString());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_aircraft: %s\n", error.what());
  }
  return 4;
}
