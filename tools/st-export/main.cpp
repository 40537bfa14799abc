// st-export: artifacts in other programs' formats.
#include <string>

#include "common/tool_main.h"
#include "stages/inspect_stage.h"

int main(int argc, char** argv) {
  std::string artifact, output;
  st::ToolMain tool("st-export", "Writes a mesh (.stl .ascii.stl .vtu .obj .ply .msh .fro) or an octree (.vtu) for other programs.");
  tool.input("artifact", artifact, "mesh, raster, sizing or failures artifact");
  tool.output(output, "file to write; its suffix decides the format");
  return tool.run(argc, argv, [&] { return st::run_export(artifact, output); });
}
