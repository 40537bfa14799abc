// st-prolong: the complete mesh size specification from a raster, sources and a background mesh.
#include "common/tool_main.h"
#include "stages/prolong_stage.h"

int main(int argc, char** argv) {
  st::ProlongStageOptions o;
  st::ToolMain tool("st-prolong", "Makes the complete mesh size specification from a raster.");
  tool.input("raster", o.raster, "raster artifact");
  tool.output(o.output);
  tool.number("--slope", o.slope, "(0, 2]", "largest change of length per distance");
  tool.text("--slope-of", o.slope_of, "NAME=S,...",
            "slope where lengths come from faces of this name, such as WING=0.1");
  tool.number("--scale", o.scale, "(0, 1e6]", "multiplies every length");
  tool.number("--target-triangles", o.target_triangles, "[4, 2e9]", "scale all lengths to about this many triangles");
  tool.optional_inputs("--sources", o.sources, "sources: TOML, .bac or .ba3; repeatable");
  tool.optional_input("--background", o.background, "background mesh: .bac, .ba3 or .msh (2.2)");
  tool.text("--transform", o.transform, "STEPS",
            "moves sources and background: 'rotate X Y Z DEG; mirror X Y Z; scale F; translate X Y Z'");
  tool.optional_input("--geometry", o.geometry,
                      "the raster's geometry as st-edit --transform moved it: the octree moves with it");
  tool.optional_input("--blank", o.blank, "closed mesh that lengths do not pass, instead of the raster's own surface");
  tool.flag("--no-blank", o.no_blank, "let lengths pass through solids");
  tool.text("--blank-side", o.blank_side, "SIDE",
            "what is blanked: inside, outside (of a meshed fluid domain) or auto");
  tool.optional_input("--sample", o.sample, "CSV of points at which to write the lengths");
  tool.output_option("--sample-output", o.sample_output, "CSV that --sample writes");
  tool.flag("--allow-incomplete", o.allow_incomplete, "take a raster of which parts could not be sampled");
  tool.preset();
  return tool.run(argc, argv, [&] { return st::run_prolong(o); });
}
