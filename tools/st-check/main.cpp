// st-check: is this mesh fit for use?
#include "common/tool_main.h"
#include "stages/check_stage.h"

int main(int argc, char** argv) {
  st::CheckStageOptions o;
  st::ToolMain tool("st-check", "Checks a mesh; exit 0 only when it passes.", st::ToolMain::Kind::kReport);
  tool.input("mesh", o.mesh, "mesh artifact");
  tool.optional_input("--geometry", o.geometry, "geometry artifact: areas per face, edges open in the CAD");
  tool.optional_input("--sizing", o.sizing, "sizing artifact: conformity of edge lengths to the sizes");
  tool.number("--area-tolerance", o.area_tolerance, "(0, 1]",
              "largest relative difference between mesh and CAD area of a face, beyond what chords explain");
  return tool.run(argc, argv, [&] { return st::run_check(o); });
}
