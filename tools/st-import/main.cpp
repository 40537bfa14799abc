// st-import: CAD file to geometry artifact.
#include "common/stage_options.h"
#include "common/tool_main.h"
#include "stages/import_stage.h"

int main(int argc, char** argv) {
  st::ImportStageOptions o;
  st::ToolMain tool(
      "st-import",
      "Reads a CAD model (STEP, IGES, BREP, FLITE) or facets (STL), repairs them where needed and writes a geometry "
      "artifact.");
  tool.input("model", o.model,
             "CAD file: .step .stp .iges .igs .brep .dat .fli; or facets: .stl .obj .ply .msh .vtu .fro");
  tool.output(o.output);
  st::declare(tool, o);
  tool.output_option("--suggest-groups", o.suggest_groups,
                     "write a groups file that the shape suggests: wing, tail, fuselage, nacelle ...; to be edited");
  tool.flag("--check", o.import.check_only, "print a report of the defects and write nothing");
  tool.threads();
  tool.main_options(
      {"--symmetry", "--farfield", "--groups", "--unit", "--sew", "--unite", "--join", "--check", "--require-closed"});
  tool.examples({"st-import wing.step", "st-import aircraft.step --symmetry y=0 --farfield sphere:50 -o geometry.hdf",
                 "st-import wing.step --check"});
  return tool.run(argc, argv, [&] { return st::run_import(o); });
}
