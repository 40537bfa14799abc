// st-merge: patches to one consistent, oriented, checked mesh in canonical order.
#include "common/stage_options.h"
#include "common/tool_main.h"
#include "stages/merge_stage.h"

int main(int argc, char** argv) {
  st::MergeStageOptions o;
  st::ToolMain tool("st-merge", "Merges the patches of all faces into one oriented, checked surface mesh.");
  tool.inputs("patches", o.patches, "patches artifacts, one or several of the same geometry");
  tool.output(o.output);
  tool.outputs("--export", o.exports, "also write the mesh to this file: a suffix that st-export knows; repeatable");
  st::declare(tool, o);
  tool.threads();
  tool.examples({"st-merge patches.hdf", "st-merge wing.hdf body.hdf -o mesh.hdf --export mesh.stl"});
  return tool.run(argc, argv, [&] { return st::run_merge(o); });
}
