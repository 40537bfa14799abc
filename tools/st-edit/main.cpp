// st-edit: geometries put together, parts taken out, left out, moved.
#include "common/tool_main.h"
#include "stages/edit_stage.h"

int main(int argc, char** argv) {
  st::EditStageOptions o;
  st::ToolMain tool("st-edit", "Edits geometries: joins several into one, keeps or removes parts, moves parts.");
  tool.inputs("geometries", o.geometries, "geometry artifacts; several are joined into one");
  tool.output(o.output);
  tool.text("--as", o.as, "NAME,...", "names of the inputs, in order; default: the file names");
  tool.text(
      "--join", o.join, "NAMES",
      "groups of this name in several inputs become one group; others of later inputs get the input's name in front");
  tool.text("--extract", o.extract, "NAMES", "keep only these groups, parts or faces (17 or 3-7); default: everything");
  tool.text("--remove", o.remove, "NAMES", "remove these groups, parts or faces (17 or 3-7)");
  tool.texts("--transform", o.transforms, "STEPS",
             "moves parts: 'rotate X Y Z DEG at X Y Z; hinge X Y Z X Y Z DEG; mirror X Y Z; scale F; translate X Y Z'; "
             "repeatable");
  tool.texts("--of", o.of, "NAMES",
             "groups, parts or faces that the --transform in the same place of the order moves; repeatable; default: "
             "everything");
  tool.flag("--require-valid", o.require_valid, "end with exit code 4 when the result is open or its parts cross");
  tool.examples({"st-edit geometry.hdf -o there.hdf --transform 'rotate 0 1 0 3; translate 0 0 2'",
                 "st-edit geometry.hdf -o wing.hdf --extract WING"});
  return tool.run(argc, argv, [&] { return st::run_edit(o); });
}
