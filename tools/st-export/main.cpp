// st-export: artifacts in other programs' formats.
#include "common/tool_main.h"
#include "stages/inspect_stage.h"

int main(int argc, char** argv) {
  st::ExportStageOptions o;
  st::ToolMain tool(
      "st-export",
      "Converts a mesh (.stl .vtu .obj .ply .msh .ugrid .su2 .bdf .mesh .off .smesh .poly .fro .sol), sizes "
      "(.vtu .pos .bac) or a geometry (FLITE .dat).");
  tool.input("artifact", o.artifact, "mesh, raster, sizing, failures or geometry artifact");
  tool.output(o.output, "file to write; its suffix selects the format");
  tool.flag("--quads", o.quads, "write rows of stretched triangles as quadrilaterals (.vtu .msh .ugrid .su2 .mesh)");
  tool.optional_input("--sizing", o.sizing, "sizing artifact, for .sol: the size asked for at each node of a mesh");
  tool.length("--tolerance", o.tolerance, "0.001%", "largest distance of FLITE curves and surfaces from the CAD model");
  return tool.run(argc, argv, [&] { return st::run_export(o); });
}
