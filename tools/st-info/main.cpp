// st-info: what an artifact is, from what it was made, counts, content hash.
#include <string>

#include "common/tool_main.h"
#include "stages/inspect_stage.h"

int main(int argc, char** argv) {
  std::string artifact;
  bool hash = false;
  st::ToolMain tool("st-info", "Says what an artifact is and from what it was made.", st::ToolMain::Kind::kReport);
  tool.input("artifact", artifact, "any artifact");
  tool.flag("--hash", hash, "print the content hash alone");
  return tool.run(argc, argv, [&] { return hash ? st::run_hash(artifact) : st::run_info(artifact); });
}
