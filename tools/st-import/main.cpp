// st-import: CAD file to geometry artifact.
#include "common/tool_main.h"
#include "stages/import_stage.h"

int main(int argc, char** argv) {
  st::ImportStageOptions o;
  st::ToolMain tool(
      "st-import",
      "Reads a CAD model (STEP, IGES, BREP, FLITE), repairs it where needed and writes a geometry artifact.");
  tool.input("model", o.model, "CAD file: .step .stp .iges .igs .brep .dat .fli");
  tool.output(o.output);
  tool.unit("--unit", o.unit, "length unit of the artifact: mm, cm, m, in or ft; default: the unit of the file");
  tool.length("--small", o.small, "0.01%", "list edges shorter and faces narrower than this");
  tool.length("--sew", o.sew, "0.01%", "join free edges that are at most this far apart");
  tool.text("--symmetry", o.symmetry, "AXIS=VALUE",
            "cut or close the model at this plane: y=0 keeps the positive side, y=0- the negative side");
  tool.text("--farfield", o.farfield, "KIND:SIZE",
            "add a far field: box:20 (half width) or sphere:50 (radius), in diagonals of the model");
  tool.text("--replace-farfield", o.replace_farfield, "KIND:SIZE",
            "likewise, in place of the far field that the file has; its symmetry plane stays one");
  tool.text("--flow-domain", o.flow_domain, "WORD",
            "whether the file is the air around a body: auto (by shape where no name says so), yes or no");
  tool.optional_input("--groups", o.groups, "file that defines groups of faces, edges and vertices (TOML)");
  tool.number(o.kTimeLimit, o.time_limit);
  tool.flag("--unite", o.unite, "make solids that overlap or touch one body, without what is inside");
  tool.flag("--join", o.join, "give solids that touch common faces and edges, in groups of their own");
  tool.flag("--cap", o.cap,
            "close openings whose rim lies in a plane, or in two or three, by faces named cap_1, cap_2 ...");
  tool.flag("--check", o.check, "print a report of the defects and write nothing");
  tool.flag("--require-closed", o.require_closed, "end with exit code 4 when the model is not closed");
  tool.examples({"st-import wing.step", "st-import aircraft.step --symmetry y=0 --farfield sphere:50 -o geometry.hdf",
                 "st-import wing.step --check"});
  return tool.run(argc, argv, [&] { return st::run_import(o); });
}
