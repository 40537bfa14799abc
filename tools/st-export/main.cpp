// st-export: artifacts in other programs' formats.
#include "common/tool_main.h"
#include "stages/inspect_stage.h"

int main(int argc, char** argv) {
  st::ExportStageOptions o;
  st::ToolMain tool(
      "st-export",
      "Writes a mesh (.stl .ascii.stl .vtu .obj .ply .msh .fro), an octree (.vtu) or a geometry (FLITE .dat).");
  tool.input("artifact", o.artifact, "mesh, raster, sizing, failures or geometry artifact");
  tool.output(o.output, "file to write; its suffix decides the format");
  tool.length("--tolerance", o.tolerance, "0.001%", "distance of FLITE curves and surfaces from the model");
  return tool.run(argc, argv, [&] { return st::run_export(o); });
}
