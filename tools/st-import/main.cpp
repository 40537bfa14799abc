// st-import: CAD file to geometry artifact.
#include "common/tool_main.h"
#include "stages/import_stage.h"

int main(int argc, char** argv) {
  st::ImportStageOptions o;
  st::ToolMain tool("st-import", "Reads a CAD model (STEP, IGES, BREP, FLITE) and writes its geometry artifact.");
  tool.input("model", o.model, "CAD file");
  tool.output(o.output);
  tool.unit("--unit", o.unit, "unit of the artifact (mm, cm, m, in, ft); the file's own when not given");
  tool.length("--small", o.small, "0.01%", "edges shorter and faces narrower than this are listed");
  tool.length("--sew", o.sew, "0.01%", "free edges up to this far apart are joined");
  tool.text("--symmetry", o.symmetry, "AXIS=VALUE",
            "cut or close the model at this plane (y=0; y=0- keeps the negative side)");
  tool.text("--farfield", o.farfield, "KIND:SIZE",
            "the fluid around the model: box:20, sphere:50 (half width, radius in diagonals)");
  tool.optional_input("--groups", o.groups,
                      "groups of faces by name, part, colour, layer, place, surface, of edges and vertices (TOML)");
  tool.number("--time-limit", o.time_limit, "(0, 1e9]",
              "seconds of processor time (30 and 5 per megabyte when not given)");
  tool.flag("--check", o.check, "report defects only, write nothing");
  tool.flag("--require-closed", o.require_closed, "an open model is an error (exit 4)");
  return tool.run(argc, argv, [&] { return st::run_import(o); });
}
