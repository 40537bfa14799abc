// st-diff: compare two artifacts of the same kind.
#include "common/tool_main.h"
#include "stages/inspect_stage.h"

int main(int argc, char** argv) {
  st::DiffStageOptions o;
  st::ToolMain tool("st-diff", "Compares two artifacts of the same kind. Exit code 0: equal; 5: they differ.",
                    st::ToolMain::Kind::kReport);
  tool.input("a", o.a, "first artifact");
  tool.input("b", o.b, "second artifact, of the same kind");
  tool.number(o.kTolerance, o.tolerance);
  tool.examples({"st-diff mesh.hdf other_mesh.hdf"});
  return tool.run(argc, argv, [&] { return st::run_diff(o); });
}
