// st-raster: sample lengths of curves and trimmed surfaces into a balanced octree.
#include "common/tool_main.h"
#include "stages/raster_stage.h"

int main(int argc, char** argv) {
  st::RasterStageOptions o;
  st::ToolMain tool("st-raster", "Samples the lengths that curvature and features ask for into an octree.");
  tool.input("geometry", o.geometry, "geometry artifact");
  tool.output(o.output);
  tool.length("--lmin", o.lmin, "lmax/64", "smallest length");
  tool.length("--lmax", o.lmax, "2.5%", "largest length");
  tool.number("--alpha", o.alpha_deg, "(0, 90]", "largest turning of the normal or tangent along one length, degrees");
  tool.length("--chord", o.chord, "", "largest distance of a length's chord from the geometry");
  tool.optional_input("--sizes", o.sizes, "rules [[size]] for groups, faces and edges (TOML)");
  tool.number("--gap-cells", o.gap_cells, "[1, 100]", "lengths across gaps and thin walls, down to lmin");
  tool.number("--edge-cells", o.edge_cells, "[1, 100]", "lengths along each CAD edge at least, down to lmin");
  tool.text("--trailing-edges", o.trailing_edges, "[LMIN:]LMAX", "find trailing edges and give them these lengths");
  tool.text("--leading-edges", o.leading_edges, "[LMIN:]LMAX", "find leading edges and give them these lengths");
  tool.number("--cell-per-length", o.cell_per_length, "[1, 8]", "raster boxes reach this many sample lengths");
  tool.number("--max-cells", o.max_cells, "[1, 2147483647]",
              "refuse an octree with more cells; default: what fits 80% of the memory");
  tool.flag("--surface", o.surface,
            "store the surface of a closed model: st-prolong lets no length pass through solids");
  tool.flag("--allow-incomplete", o.allow_incomplete,
            "exit code 0 although parts could not be sampled; the artifact is flagged");
  tool.preset();
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) { return st::run_raster(o, comm); });
}
