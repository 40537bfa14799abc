// st-remesh: redo only what no longer respects the sizes.
#include "common/tool_main.h"
#include "stages/remesh_stage.h"

int main(int argc, char** argv) {
  st::RemeshStageOptions o;
  st::ToolMain tool("st-remesh", "Redoes the triangles of a mesh that no longer respect the sizes.");
  tool.input("mesh", o.mesh, "mesh artifact, or a triangulation of another program (STL, MSH, VTU, FRO)");
  tool.input("geometry", o.geometry, "geometry artifact the mesh was made on");
  tool.input("sizing", o.sizing, "new sizing artifact");
  tool.output(o.output);
  tool.output_instead("--merged", o.merged, "write the merged mesh to this artifact instead of patches");
  tool.number("--too-long", o.too_long, "(1, 100]",
              "an edge longer than this times the requested length is redone where the sizes changed");
  tool.number("--too-short", o.too_short, "(0, 1)", "likewise an edge shorter than this");
  tool.text("--keep", o.keep, "GROUP", "group of faces of which nothing changes");
  tool.optional_array("--sizes-on-nodes", o.sizes_on_nodes,
                      "lengths on the nodes of the mesh instead of the sizing's: point data of a .vtu or HDF5 file");
  tool.length("--tolerance", o.tolerance, "", "how far nodes of another program's mesh may lie from the CAD");
  tool.optional_input("--made-for", o.made_for, "sizing artifact that another program's mesh was made for");
  tool.flag("--moved", o.moved, "the geometry is another one of the same topology: put the mesh onto it");
  tool.flag("--dry-run", o.dry_run, "say how much would change, write nothing");
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) { return st::run_remesh(o, comm); });
}
