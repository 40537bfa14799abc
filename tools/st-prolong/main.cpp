// st-prolong: the complete mesh size specification from a raster, sources and a background mesh.
#include "common/tool_main.h"
#include "stages/prolong_stage.h"

int main(int argc, char** argv) {
  st::ProlongStageOptions o;
  st::ToolMain tool(
      "st-prolong",
      "Makes the size field from a raster, sources and a background mesh; limits the growth of edge lengths.");
  tool.input("raster", o.raster, "raster artifact, or a sizing to change its sources and scale");
  tool.output(o.output);
  tool.number(o.kSlope, o.slope);
  tool.text("--slope-of", o.slope_of, "NAME=S,...",
            "slope of lengths that come from faces of this name, group or part, such as WING=0.1");
  tool.number(o.kScale, o.scale);
  tool.number(o.kTargetTriangles, o.target_triangles);
  tool.number(o.kMaxTriangles, o.max_triangles);
  tool.text(o.kFamily.flag, o.family, o.kFamily.unit, o.kFamily.help);
  tool.optional_inputs("--sources", o.sources, "file with sources: TOML, .bac or .ba3; repeatable");
  tool.optional_input("--background", o.background,
                      "background mesh with edge lengths: .bac, .ba3 or .msh (version 2.2)");
  tool.text("--transform", o.transform, "STEPS",
            "move sources and background: 'rotate X Y Z DEG; mirror X Y Z; scale F; translate X Y Z'");
  tool.optional_input("--geometry", o.geometry,
                      "geometry of the raster after st-edit --transform; the octree moves with it");
  tool.optional_input("--blank", o.blank, "closed mesh that lengths do not pass, instead of the raster's own surface");
  tool.flag("--no-blank", o.no_blank, "let lengths pass through solids");
  tool.text("--blank-side", o.blank_side, "SIDE",
            "side that is blanked: inside, outside (of a meshed fluid domain) or auto");
  tool.optional_input("--sample", o.sample, "CSV file of points at which lengths are written to --sample-output");
  tool.output_option("--sample-output", o.sample_output, "CSV file that --sample writes");
  tool.flag("--allow-incomplete", o.allow_incomplete, "accept a raster with parts that could not be sampled");
  tool.preset();
  tool.threads();
  tool.examples(
      {"st-prolong raster.hdf", "st-prolong raster.hdf --slope 0.15 --sources wake.toml --target-triangles 500000"});
  return tool.run(argc, argv, [&] { return st::run_prolong(o); });
}
