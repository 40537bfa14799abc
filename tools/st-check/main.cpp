// st-check: is this mesh fit for use?
#include "common/tool_main.h"
#include "stages/check_stage.h"

int main(int argc, char** argv) {
  st::CheckStageOptions o;
  st::CheckThresholds& t = o.thresholds;
  st::ToolMain tool(
      "st-check",
      "Checks a surface mesh, alone or against CAD and sizes. Exit code 0: the mesh passes; 5: it does not.",
      st::ToolMain::Kind::kReport);
  tool.input("mesh", o.mesh, "mesh artifact, or a surface mesh of another program (STL, MSH, VTU, FRO)");
  tool.optional_input("--geometry", o.geometry,
                      "geometry artifact: also compare area of each face, free edges and distance to the surfaces");
  tool.optional_input("--sizing", o.sizing, "sizing artifact: also compare edge lengths with the requested lengths");
  tool.number("--area-tolerance", o.area_tolerance, "(0, 1]",
              "largest relative difference between mesh and CAD area of a face, after the chord error");
  tool.number("--list-below", o.list_below_deg, "(0, 60]",
              "triangles with an angle below this, in degrees, are listed by cause; needs --geometry");
  tool.outputs("--report", o.reports,
               "JSON file to write, with results per model, group and face, and histograms; repeatable");
  tool.number("--max-folds", t.max_folds, "[0, 1000000000]",
              "number of folded edges accepted (neighbouring triangles turned over)");
  tool.number("--max-crossings", t.max_crossings, "[0, 1000000000]",
              "number of crossing or overlapping pairs of triangles accepted");
  tool.number("--min-quality", t.min_quality, "[0, 1]",
              "smallest quality accepted of any triangle (1: equilateral); default: not checked");
  tool.number("--min-mean-quality", t.min_mean_quality, "[0, 1]",
              "smallest mean quality of all triangles accepted; default: not checked");
  tool.number("--min-p1-quality", t.min_p1_quality, "[0, 1]",
              "smallest first percentile of quality accepted; default: not checked");
  tool.number("--min-angle", t.min_angle_deg, "(0, 60]",
              "smallest angle accepted of any triangle, in degrees; default: not checked");
  tool.number("--max-free-sharp", t.max_free_sharp, "[0, 1000000000]",
              "number of triangles below --list-below accepted that the CAD does not force; needs --geometry; "
              "default: not checked");
  tool.number("--max-jump", t.max_jump, "[1, 1000000]",
              "largest size ratio of neighbouring triangles accepted, 99.9th percentile; default: not checked");
  tool.number(
      "--min-size-share", t.min_size_share, "[0, 1]",
      "smallest share accepted of edges within 0.7 to 1.4 times the requested length, without those that the CAD "
      "forces; needs --sizing; default: not checked");
  tool.length(
      "--max-deviation", t.max_deviation, "",
      "largest distance accepted of a triangle's centroid from its surface; needs --geometry; default: not checked");
  tool.number("--max-normal-deviation", t.max_normal_deviation_deg, "(0, 180]",
              "largest angle accepted between a triangle and its surface, in degrees; needs --geometry; default: not "
              "checked");
  return tool.run(argc, argv, [&] { return st::run_check(o); });
}
