// st-merge: patches to one consistent, oriented, checked mesh in canonical order.
#include "common/tool_main.h"
#include "stages/merge_stage.h"

int main(int argc, char** argv) {
  st::MergeStageOptions o;
  st::ToolMain tool("st-merge", "Merges patches into one oriented, checked mesh.");
  tool.inputs("patches", o.patches, "patches artifacts, one or several of the same geometry");
  tool.output(o.output);
  tool.outputs("--export", o.exports,
               "further file to write, by suffix: .stl .ascii.stl .vtu .obj .ply .msh .fro; repeatable");
  tool.flag("--allow-incomplete", o.allow_incomplete, "merge although faces are missing");
  return tool.run(argc, argv, [&] { return st::run_merge(o); });
}
