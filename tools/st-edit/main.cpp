// st-edit: geometries put together, parts taken out, left out, moved.
#include "common/tool_main.h"
#include "stages/edit_stage.h"

int main(int argc, char** argv) {
  st::EditStageOptions o;
  st::ToolMain tool("st-edit", "Puts geometries together, takes parts out of them, leaves parts out, moves them.");
  tool.inputs("geometries", o.geometries, "geometry artifacts; several are put together");
  tool.output(o.output);
  tool.text("--as", o.as, "NAME,...", "names of the inputs in their order; those of their files when not given");
  tool.text(
      "--join", o.join, "NAMES",
      "groups of the same name in several inputs become one; else the later ones get their input's name in front");
  tool.text("--extract", o.extract, "NAMES", "keep only these: groups, parts, faces such as 17 or 3-7");
  tool.text("--remove", o.remove, "NAMES", "leave these out");
  tool.texts(
      "--transform", o.transforms, "STEPS",
      "move: 'rotate X Y Z DEG at X Y Z; hinge X Y Z X Y Z DEG; mirror X Y Z; scale F; translate X Y Z'; repeatable");
  tool.texts("--of", o.of, "NAMES",
             "what the --transform at the same place moves; everything when not given; repeatable");
  tool.flag("--require-valid", o.require_valid, "a result that is open, or whose parts cross, is an error (exit 4)");
  return tool.run(argc, argv, [&] { return st::run_edit(o); });
}
