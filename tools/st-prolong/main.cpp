// st-prolong: the complete mesh size specification from a raster, sources and a background mesh.
#include "common/stage_options.h"
#include "common/tool_main.h"
#include "stages/prolong_stage.h"

int main(int argc, char** argv) {
  st::ProlongStageOptions o;
  st::ToolMain tool(
      "st-prolong",
      "Makes the size field from a raster, sources and a background mesh; limits the growth of edge lengths.");
  tool.input("raster", o.raster, "raster artifact, or a sizing to change its sources and scale");
  tool.output(o.output);
  st::declare(tool, o);
  tool.text(o.kFamily.flag, o.family, o.kFamily.unit, o.kFamily.help);
  tool.optional_input("--geometry", o.geometry,
                      "geometry of the raster after st-edit --transform; the octree moves with it");
  tool.optional_input("--sample", o.sample, "CSV file of points at which lengths are written to --sample-output");
  tool.output_option("--sample-output", o.sample_output, "CSV file that --sample writes");
  tool.threads();
  tool.main_options({"--preset", "--slope", "--target-triangles", "--sources", "--background", "--scale",
                     "--max-triangles", "--family", "--blank", "--no-blank"});
  tool.examples(
      {"st-prolong raster.hdf", "st-prolong raster.hdf --slope 0.15 --sources wake.toml --target-triangles 500000"});
  return tool.run(argc, argv, [&] { return st::run_prolong(o); });
}
