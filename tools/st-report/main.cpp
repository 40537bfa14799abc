// st-report: one HTML file that shows a mesh and what the checks found.
#include "common/tool_main.h"
#include "stages/report_stage.h"

int main(int argc, char** argv) {
  st::ReportStageOptions o;
  st::ToolMain tool("st-report",
                    "Writes one HTML file for any browser: the mesh in 3-D, its verdict, findings and tables.");
  tool.inputs("artifacts", o.artifacts,
              "artifacts of one run, in any order: a mesh, patches or a geometry, and others");
  tool.optional_input("--geometry", o.geometry, "geometry artifact: findings by cause, distance from the CAD");
  tool.optional_input("--sizing", o.sizing, "sizing artifact: lengths compared, slice, causes of sizes");
  tool.optional_input("--before", o.before, "the mesh before a remeshing: both are compared");
  tool.text("--times", o.times, "FOLDER", "folder with <stage>.seconds of the stages, as make writes it: OUT/log");
  tool.output(o.output, "HTML file to write");
  tool.examples({"st-report geometry.hdf sizing.hdf mesh.hdf -o report.html",
                 "st-report geometry.hdf sizing.hdf patches.hdf", "st-report geometry.hdf -o cad.html"});
  return tool.run(argc, argv, [&] { return st::run_report(o); });
}
