// st-remesh: redo only what no longer respects the sizes.
#include "common/crash_handler.h"
#include "common/tool_main.h"
#include "stages/remesh_stage.h"

int main(int argc, char** argv) {
  st::RemeshStageOptions o;
  st::ToolMain tool("st-remesh", "Remeshes only the places of a mesh that no longer fit the sizes.");
  tool.input("mesh", o.mesh, "mesh artifact, or a surface mesh of another program (STL, MSH, VTU, FRO)");
  tool.input("geometry", o.geometry, "geometry artifact of the mesh");
  tool.input("sizing", o.sizing, "sizing artifact with the new sizes");
  tool.output(o.output);
  tool.output_instead("--merged", o.merged, "write a merged mesh to this artifact instead of patches");
  tool.number(o.kTooLong, o.too_long);
  tool.number(o.kTooShort, o.too_short);
  tool.text("--keep", o.keep, "GROUP", "do not change the faces, edges or vertices of this group");
  tool.optional_array(
      "--sizes-on-nodes", o.sizes_on_nodes,
      "requested lengths at the nodes of the mesh (point data of a .vtu or HDF5 file) instead of the sizing");
  tool.optional_array("--interpolate", o.interpolate,
                      "values at the nodes of the mesh (FILE:ARRAY,ARRAY...) that --merged has at its nodes");
  tool.length(
      "--tolerance", o.tolerance, "",
      "largest distance from the CAD of the nodes of another program's mesh; default: 5% of the local edge length");
  tool.optional_input("--made-for", o.made_for,
                      "sizing artifact that the mesh of another program was made for; default: sizes are measured");
  tool.flag("--moved", o.moved, "move the mesh onto a changed geometry of the same topology");
  tool.flag("--keep-connectivity", o.keep_connectivity,
            "with --moved: keep all triangles but those that the move turned or distorted");
  tool.output_option("--displacements", o.displacements,
                     "with --moved: write how far each node of the mesh moved (.vtu, .csv)");
  tool.flag("--dry-run", o.dry_run, "print how much would change and write nothing");
  tool.number(o.kJournalAfter, o.journal_after);
  tool.flag("--no-resume", o.begins_new, "begin anew, without what an earlier run has kept in OUTPUT.journal");
  tool.restart_after_crash();
  tool.main_options({"--merged", "--too-long", "--too-short", "--keep", "--sizes-on-nodes", "--made-for", "--tolerance",
                     "--moved", "--dry-run", "--np"});
  tool.examples({"st-remesh mesh.hdf geometry.hdf new_sizing.hdf --merged remeshed.hdf --np 8"});
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) {
    o.begins_new = o.begins_new && st::n_tries() == 0;  // a new try of this run goes on
    return st::run_remesh(o, comm);
  });
}
