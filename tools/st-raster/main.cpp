// st-raster: sample lengths of curves and trimmed surfaces into a balanced octree.
#include "common/stage_options.h"
#include "common/tool_main.h"
#include "stages/raster_stage.h"

int main(int argc, char** argv) {
  st::RasterStageOptions o;
  st::ToolMain tool("st-raster",
                    "Computes edge lengths from curvature, features and rules, and stores them in an octree.");
  tool.input("geometry", o.geometry, "geometry artifact");
  tool.output(o.output);
  st::declare(tool, o);
  tool.output_option("--trace", o.trace, "table of the time of each task, for bench/replay.py; default: none");
  tool.main_options({"--preset", "--lmax", "--lmin", "--alpha", "--sizes", "--gap-cells", "--edge-size", "--base-cells",
                     "--max-aspect", "--np"});
  tool.examples({"st-raster geometry.hdf --np 8", "st-raster geometry.hdf --lmax 2% --lmin 1mm --alpha 8"});
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) {
    st::note_what_is_set(tool, o);
    return st::run_raster(o, comm);
  });
}
