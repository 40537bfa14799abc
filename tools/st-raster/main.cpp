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
  tool.number(st::SizeOptions::kAlpha, o.alpha_deg);
  tool.length("--chord", o.chord, "",
              "largest chord error: distance between a straight edge and the geometry; default: no limit");
  tool.optional_input("--sizes", o.sizes, "file with rules [[size]] for groups, faces and edges (TOML)");
  tool.number(st::SizeOptions::kGapCells, o.gap_cells);
  tool.number(st::SizeOptions::kWallCells, o.wall_cells);
  tool.number(st::SizeOptions::kEdgeCells, o.edge_cells);
  tool.text("--trailing-edges", o.trailing_edges, "[LMIN:]LMAX",
            "find trailing edges by shape and give them these edge lengths; default: off");
  tool.text("--leading-edges", o.leading_edges, "[LMIN:]LMAX",
            "find leading edges by shape and give them these edge lengths; default: off");
  tool.text("--end-size", o.end_size, "LENGTH",
            "edge length around the tips and roots of lifting surfaces, such as 0.1%span; default: not set");
  tool.text("--edge-size", o.edge_size, "LENGTH",
            "edge length at trailing edges and noses of lifting surfaces; none: as all other edges");
  tool.number(o.kBaseCells, o.base_cells);
  tool.number(o.kChordCells, o.chord_cells);
  tool.number(o.kCellPerLength, o.cell_per_length);
  tool.number(st::SizeOptions::kMaxAspect, o.max_aspect);
  tool.number(o.kMaxCells, o.max_cells);
  tool.number(o.kTimeLimit, o.time_limit);
  tool.output_option("--trace", o.trace, "table of the time of each task, for bench/replay.py; default: none");
  tool.flag("--no-surface", o.no_surface,
            "leave out the coarse surface of a closed model: lengths then pass through solids");
  tool.flag("--allow-incomplete", o.allow_incomplete,
            "exit code 0 even when parts could not be sampled; the artifact is marked incomplete");
  tool.preset();
  tool.examples({"st-raster geometry.hdf --np 8", "st-raster geometry.hdf --lmax 2% --lmin 1mm --alpha 8"});
  return tool.run_parallel(argc, argv, [&](const st::Communicator& comm) {
    o.asks_for_wings = tool.is_set("--edge-size") && o.edge_size != "none";
    return st::run_raster(o, comm);
  });
}
