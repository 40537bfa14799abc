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
  tool.number(o.kAreaTolerance, o.area_tolerance);
  tool.number(o.kListBelow, o.list_below_deg);
  tool.outputs("--report", o.reports,
               "JSON file to write, with results per model, group and face, and histograms; repeatable");
  tool.number(t.kMaxFolds, t.max_folds);
  tool.number(t.kMaxCrossings, t.max_crossings);
  tool.number(t.kMinQuality, t.min_quality);
  tool.number(t.kMinMeanQuality, t.min_mean_quality);
  tool.number(t.kMinP1Quality, t.min_p1_quality);
  tool.number(t.kMinAngle, t.min_angle_deg);
  tool.number(t.kMaxFreeSharp, t.max_free_sharp);
  tool.number(t.kMaxJump, t.max_jump);
  tool.number(t.kMinSizeShare, t.min_size_share);
  tool.length(
      "--max-deviation", t.max_deviation, "",
      "largest distance accepted of a triangle's centroid from its surface; needs --geometry; default: not checked");
  tool.number(t.kMaxNormalDeviation, t.max_normal_deviation_deg);
  tool.text("--layers", o.layers, "HEIGHT",
            "say whether layers of prisms can grow from the walls, of this height in all: 5mm, 1%, or the boundary "
            "layer of a plate: Re=6e6@2.5m; 5mm,1.2 with their growth");
  tool.threads();
  tool.examples(
      {"st-check mesh.hdf", "st-check mesh.hdf --geometry geometry.hdf --sizing sizing.hdf --report report.json"});
  return tool.run(argc, argv, [&] { return st::run_check(o); });
}
