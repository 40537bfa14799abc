// st-mesh: curve discretisation, then one advancing-front patch per face.
#include "common/crash_handler.h"
#include "common/stage_options.h"
#include "common/tool_main.h"
#include "stages/mesh_stage.h"

int main(int argc, char** argv) {
  st::MeshStageOptions o;
  st::ToolMain tool("st-mesh", "Meshes every CAD edge once and every CAD face as one patch of triangles.");
  tool.input("geometry", o.geometry, "geometry artifact");
  tool.input("sizing", o.sizing, "sizing artifact");
  tool.output(o.output);
  tool.text("--faces", o.faces, "LIST",
            "mesh these faces only: ids from 1 and ranges, such as 12,17,30-40; default: all");
  tool.text("--group", o.group, "NAME", "mesh the faces of this group or part only; default: all");
  tool.optional_input("--edges", o.edges,
                      "patches meshed earlier: their nodes on CAD edges are reused, so that both fit together");
  st::declare(tool, o);
  tool.output_option("--trace", o.trace, "table of the time of each task, for bench/replay.py; default: none");
  tool.number(o.kJournalAfter, o.journal_after);
  tool.flag("--no-resume", o.begins_new, "begin anew, without what an earlier run has kept in OUTPUT.journal");
  tool.restart_after_crash();
  tool.main_options({"--np", "--threads", "--group", "--faces", "--edges", "--time-limit", "--no-resume",
                     "--max-turning", "--enhance-rounds"});
  tool.examples({"st-mesh geometry.hdf sizing.hdf --np 8", "st-mesh geometry.hdf sizing.hdf --group WING -o wing.hdf"});
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) {
    o.begins_new = o.begins_new && st::n_tries() == 0;  // a new try of this run goes on
    return st::run_mesh(o, comm);
  });
}
