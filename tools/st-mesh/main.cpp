// st-mesh: curve discretisation, then one advancing-front patch per face.
#include "common/tool_main.h"
#include "stages/mesh_stage.h"

int main(int argc, char** argv) {
  st::MeshStageOptions o;
  st::ToolMain tool("st-mesh", "Meshes every CAD edge once and every CAD face into a patch.");
  tool.input("geometry", o.geometry, "geometry artifact");
  tool.input("sizing", o.sizing, "sizing artifact");
  tool.output(o.output);
  tool.text("--faces", o.faces, "LIST", "mesh these faces only: 1-based ids and ranges, 12,17,30-40");
  tool.text("--group", o.group, "NAME", "mesh the faces of this group only");
  tool.optional_input("--edges", o.edges,
                      "patches of an earlier part: its nodes on CAD edges are taken over, so that the parts fit");
  tool.number("--enhance-rounds", o.enhance_rounds, "[0, 10]", "rounds of the enhancer");
  tool.number("--merge-below", o.merge_below, "[0, 0.2]",
              "of the requested length: shorter CAD edges and narrower strips are merged for meshing; 0: none");
  tool.number("--max-turning", o.max_turning_deg, "(0, 60]",
              "largest turning of a CAD edge along one segment, degrees");
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) { return st::run_mesh(o, comm); });
}
