// st-prolong: slope-limited mesh size specification from a raster.
#include "common/tool_main.h"
#include "stages/prolong_stage.h"

int main(int argc, char** argv) {
  st::ProlongStageOptions o;
  st::ToolMain tool("st-prolong", "Makes the complete mesh size specification from a raster.");
  tool.input("raster", o.raster, "raster artifact");
  tool.output(o.output);
  tool.number("--slope", o.slope, "(0, 2]", "largest change of length per distance");
  tool.number("--scale", o.scale, "(0, 1e6]", "multiplies every length");
  return tool.run(argc, argv, [&] { return st::run_prolong(o); });
}
