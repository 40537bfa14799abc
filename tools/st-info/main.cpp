// st-info: what an artifact is, from what it was made, counts, content hash.
#include <string>

#include "common/tool_main.h"
#include "stages/group_report.h"
#include "stages/inspect_stage.h"
#include "stages/size_report.h"

int main(int argc, char** argv) {
  std::string artifact, at, why, raster;
  bool hash = false, groups = false;
  st::ToolMain tool("st-info", "Prints what an artifact contains and what it was made from.",
                    st::ToolMain::Kind::kReport);
  tool.input("artifact", artifact, "any artifact");
  tool.flag("--hash", hash, "print the content hash only (32 hexadecimal digits)");
  tool.flag("--groups", groups, "list the groups, parts and face names of a geometry, patches or mesh artifact");
  tool.text("--at", at, "X,Y,Z",
            "print the requested length at this point of a sizing artifact (model unit), and its cause");
  tool.text("--why", why, "GROUP",
            "print what causes most triangles on the faces of this group, part or face name, for a sizing artifact");
  tool.optional_input("--raster", raster,
                      "raster of the sizing, for --why; default: the one in the folder of the sizing");
  tool.examples({"st-info mesh.hdf", "st-info sizing.hdf --why WING"});
  return tool.run(argc, argv, [&] {
    if (!why.empty()) return st::run_size_why(artifact, why, raster);
    if (!raster.empty()) throw st::Error(st::ExitCode::kUsage, "--raster is for --why: add --why GROUP");
    if (!at.empty()) return st::run_size_at(artifact, at);
    if (groups) return st::run_groups(artifact);
    return hash ? st::run_hash(artifact) : st::run_info(artifact);
  });
}
