// st-check: is this mesh fit for use?
#include "common/stage_options.h"
#include "common/tool_main.h"
#include "stages/check_stage.h"

int main(int argc, char** argv) {
  st::CheckStageOptions o;
  st::ToolMain tool(
      "st-check",
      "Checks a surface mesh, alone or against CAD and sizes. Exit code 0: the mesh passes; 5: it does not.",
      st::ToolMain::Kind::kReport);
  tool.input("mesh", o.mesh, "mesh artifact, or a surface mesh of another program (STL, MSH, VTU, FRO)");
  tool.optional_input("--geometry", o.geometry,
                      "geometry artifact: also compare area of each face, free edges and distance to the surfaces");
  tool.optional_input("--sizing", o.sizing, "sizing artifact: also compare edge lengths with the requested lengths");
  tool.outputs("--report", o.reports,
               "JSON file to write, with results per model, group and face, and histograms; repeatable");
  st::declare(tool, o);
  tool.main_options({"--geometry", "--sizing", "--report", "--layers", "--min-angle", "--min-quality",
                     "--min-size-share", "--max-deviation", "--verbose", "--np"});
  tool.examples(
      {"st-check mesh.hdf", "st-check mesh.hdf --geometry geometry.hdf --sizing sizing.hdf --report report.json"});
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) {
    o.text = tool.is_set("--verbose") ? st::CheckText::kWhole : st::CheckText::kBrief;
    return st::run_check(o, comm);
  });
}
