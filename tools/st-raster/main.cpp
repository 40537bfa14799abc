// st-raster: sample lengths of curves and trimmed surfaces into a balanced octree.
#include "common/tool_main.h"
#include "stages/raster_stage.h"

int main(int argc, char** argv) {
  st::RasterStageOptions o;
  st::ToolMain tool("st-raster",
                    "Computes edge lengths from curvature, features and rules, and stores them in an octree.");
  tool.input("geometry", o.geometry, "geometry artifact");
  tool.output(o.output);
  tool.length("--lmin", o.lmin, "lmax/64", "smallest edge length that curvature and rules may set");
  tool.length("--lmax", o.lmax, "2.5%", "largest edge length on walls");
  tool.number("--alpha", o.alpha_deg, "(0, 90]",
              "curvature angle: largest angle in degrees by which normal or tangent turn along one edge length");
  tool.length("--chord", o.chord, "",
              "largest chord error: distance between a straight edge and the geometry; default: no limit");
  tool.optional_input("--sizes", o.sizes, "file with rules [[size]] for groups, faces and edges (TOML)");
  tool.number("--gap-cells", o.gap_cells, "[1, 100]",
              "proximity: edge lengths across gaps in the flow, down to --lmin; default: off");
  tool.number("--wall-cells", o.wall_cells, "[1, 100]",
              "edge lengths across thin walls, inside the material, down to --lmin; default: off");
  tool.number("--edge-cells", o.edge_cells, "[1, 100]",
              "smallest number of edge lengths along each CAD edge, down to --lmin; default: 1");
  tool.text("--trailing-edges", o.trailing_edges, "[LMIN:]LMAX",
            "find trailing edges by shape and give them these edge lengths; default: off");
  tool.text("--leading-edges", o.leading_edges, "[LMIN:]LMAX",
            "find leading edges by shape and give them these edge lengths; default: off");
  tool.text("--edge-size", o.edge_size, "LENGTH|none", "edge length at trailing edges and noses of lifting surfaces");
  tool.number("--base-cells", o.base_cells, "[1, 100]", "edge lengths across the base of a blunt trailing edge");
  tool.number("--chord-cells", o.chord_cells, "[1, 1000]",
              "smallest number of edge lengths along the local chord of a lifting surface");
  tool.number("--cell-per-length", o.cell_per_length, "[1, 8]",
              "octree cell size in edge lengths: larger means fewer cells");
  tool.number("--max-cells", o.max_cells, "[1, 2147483647]",
              "refuse an octree with more cells than this; default: what 80% of the memory can hold");
  tool.flag("--surface", o.surface,
            "store the surface of a closed model, so that st-prolong lets no length pass through solids");
  tool.flag("--allow-incomplete", o.allow_incomplete,
            "exit code 0 even when parts could not be sampled; the artifact is marked incomplete");
  tool.preset();
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) { return st::run_raster(o, comm); });
}
