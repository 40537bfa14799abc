// st-check: is this mesh fit for use?
#include "common/tool_main.h"
#include "stages/check_stage.h"

int main(int argc, char** argv) {
  st::CheckStageOptions o;
  st::CheckThresholds& t = o.thresholds;
  st::ToolMain tool("st-check", "Checks a mesh; exit 0 only when it passes.", st::ToolMain::Kind::kReport);
  tool.input("mesh", o.mesh, "mesh artifact, or a triangulation of another program (STL, MSH, VTU, FRO)");
  tool.optional_input("--geometry", o.geometry,
                      "geometry artifact: areas per face, edges open in the CAD, deviation from the surfaces");
  tool.optional_input("--sizing", o.sizing, "sizing artifact: conformity of edge lengths to the sizes");
  tool.number("--area-tolerance", o.area_tolerance, "(0, 1]",
              "largest relative difference between mesh and CAD area of a face, beyond what chords explain");
  tool.number("--list-below", o.list_below_deg, "(0, 60]",
              "degrees: triangles with a smaller angle are listed by their cause; with --geometry");
  tool.outputs("--report", o.reports, "JSON file to write: everything per model, group and face, with histograms");
  tool.number("--max-folds", t.max_folds, "[0, 1000000000]", "folds accepted");
  tool.number("--max-crossings", t.max_crossings, "[0, 1000000000]",
              "crossing or overlapping pairs of triangles accepted");
  tool.number("--min-quality", t.min_quality, "[0, 1]", "least quality of every triangle");
  tool.number("--min-mean-quality", t.min_mean_quality, "[0, 1]", "least mean quality");
  tool.number("--min-p1-quality", t.min_p1_quality, "[0, 1]", "least first percentile of quality");
  tool.number("--min-angle", t.min_angle_deg, "(0, 60]", "least angle of every triangle, degrees");
  tool.number("--max-free-sharp", t.max_free_sharp, "[0, 1000000000]",
              "triangles below --list-below accepted that nothing in the CAD forces; needs --geometry");
  tool.number("--max-jump", t.max_jump, "[1, 1000000]", "largest growth between neighbours (99.9 %)");
  tool.number(
      "--min-size-share", t.min_size_share, "[0, 1]",
      "least share of edges within 0.7 to 1.4 of the requested length, those the CAD forces apart; needs --sizing");
  tool.length("--max-deviation", t.max_deviation, "",
              "largest distance of a triangle's middle from its surface; needs --geometry");
  tool.number("--max-normal-deviation", t.max_normal_deviation_deg, "(0, 180]",
              "largest angle between a triangle and its surface, degrees; needs --geometry");
  return tool.run(argc, argv, [&] { return st::run_check(o); });
}
