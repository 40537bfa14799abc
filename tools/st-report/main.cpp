// st-report: one HTML file that shows a mesh and what the checks found.
#include "common/tool_main.h"
#include "stages/report_stage.h"

int main(int argc, char** argv) {
  st::ReportStageOptions o;
  st::ToolMain tool("st-report",
                    "Writes one HTML file for any browser: the mesh in 3-D, its verdict, findings and tables.");
  tool.input("mesh", o.mesh, "mesh artifact");
  tool.optional_input("--geometry", o.geometry, "geometry artifact: findings by cause, distance from the CAD");
  tool.optional_input("--sizing", o.sizing, "sizing artifact: lengths compared with the requested ones");
  tool.output(o.output, "HTML file to write");
  tool.examples({"st-report mesh.hdf --geometry geometry.hdf --sizing sizing.hdf -o report.html"});
  return tool.run(argc, argv, [&] { return st::run_report(o); });
}
