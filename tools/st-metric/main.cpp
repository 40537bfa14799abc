// st-metric: edge lengths that make the interpolation error of fields smallest.
#include "common/tool_main.h"
#include "stages/metric_stage.h"

int main(int argc, char** argv) {
  st::MetricStageOptions o;
  st::ToolMain tool("st-metric", "Makes edge lengths for the next mesh from the fields of a solution.");
  tool.input_arrays("fields", o.fields,
                    "scalar fields on one mesh: .vtu or .vtkhdf with an ARRAY, .sol or .solb with its mesh");
  tool.output(o.output, "lengths or metrics to write, .solb or .sol; the mesh is written beside it");
  tool.number(o.kNodes, o.nodes);
  tool.number(o.kNorm, o.norm);
  tool.number(o.kMaxAspect, o.max_aspect);
  tool.number(o.kLeast, o.least);
  tool.number(o.kGreatest, o.greatest);
  tool.text("--group", o.group, "NAME", "name or number of a group of cells: sizes for these alone");
  tool.text("--box", o.box, "CORNERS", "two corners, 'X Y Z X Y Z': sizes for the cells that have a node in this box");
  tool.threads();
  tool.examples(
      {"st-metric flow.vtu:mach -o sizes.solb", "st-metric flow.vtu:mach flow.vtu:p -o sizes.solb --nodes 50000"});
  return tool.run(argc, argv, [&] { return st::run_metric(o); });
}
