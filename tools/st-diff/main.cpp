// st-diff: compare two artifacts of the same kind.
#include "common/tool_main.h"
#include "stages/inspect_stage.h"

int main(int argc, char** argv) {
  st::DiffStageOptions o;
  st::ToolMain tool("st-diff", "Compares two artifacts of the same kind; exit 5 when they differ.",
                    st::ToolMain::Kind::kReport);
  tool.input("a", o.a, "artifact");
  tool.input("b", o.b, "artifact of the same kind");
  tool.number("--tolerance", o.tolerance, "[0, 1]",
              "for floating-point data, relative to the larger value; 0: bit for bit");
  return tool.run(argc, argv, [&] { return st::run_diff(o); });
}
