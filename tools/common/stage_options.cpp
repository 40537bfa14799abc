#include "common/stage_options.h"

namespace st {

void declare(OptionSet& set, ImportStageOptions& o) {
  ImportOptions& i = o.import;
  set.unit("--unit", i.unit,
           "length unit of the artifact: mm, cm, m, in or ft, needed for facets; default: the unit of the file");
  set.length("--small", i.small, "0.01%", "list edges shorter and faces narrower than this");
  set.length("--sew", i.sew, "0.01%", "join free edges that are at most this far apart");
  set.text("--symmetry", i.air.symmetry, "AXIS=VALUE",
           "cut or close the model at this plane: y=0 keeps the positive side, y=0- the negative side");
  set.text("--mirror", i.air.mirror, "AXIS=VALUE",
           "mesh one half of a symmetric model, the other is its image: y=0 the positive side, y=0- the negative");
  set.text("--farfield", i.air.farfield, "KIND:SIZE",
           "add a far field: box:20 (half width) or sphere:50 (radius), in diagonals of the model");
  set.text("--replace-farfield", i.air.replace_farfield, "KIND:SIZE",
           "likewise, in place of the far field that the file has; its symmetry plane stays one");
  set.text("--flow-domain", i.air.flow_domain, "WORD",
           "whether the file is the air around a body: auto (by shape where no name says so), yes or no");
  set.optional_input("--groups", o.groups, "file that defines groups of faces, edges and vertices (TOML)");
  set.number(o.kTimeLimit, o.time_limit);
  set.number(o.kFeatureAngle, o.feature_angle);
  set.length("--smooth", i.smooth, "", "of facets: take noise of a scan away, moving nodes by at most this");
  set.text(
      "--composite", o.composite, "WORD",
      "make one face of CAD faces that meet smoothly: none, harm (where the edge between them spoils triangles) or "
      "smooth (wherever they do); default: harm");
  set.flag("--unite", i.unite, "make solids that overlap or touch one body, without what is inside");
  set.flag("--join", i.join_touching, "give solids that touch common faces and edges, in groups of their own");
  set.flag("--cap", i.cap,
           "close openings whose rim lies in a plane, or in two or three, by faces named cap_1, cap_2 ...");
  set.flag("--require-closed", i.require_closed, "end with exit code 4 when the model is not closed");
}

void declare(OptionSet& set, RasterStageOptions& o) {
  set.length("--lmin", o.lmin, "lmax/64", "smallest edge length that curvature and rules may set");
  set.length("--lmax", o.lmax, "2.5%", "largest edge length on walls");
  set.number(SizeOptions::kAlpha, o.alpha_deg);
  set.length("--chord", o.chord, "",
             "largest chord error: distance between a straight edge and the geometry; default: no limit");
  set.optional_input("--sizes", o.sizes, "file with rules [[size]] for groups, faces and edges (TOML)");
  set.number(SizeOptions::kGapCells, o.gap_cells);
  set.number(SizeOptions::kWallCells, o.wall_cells);
  set.number(SizeOptions::kEdgeCells, o.edge_cells);
  set.text("--trailing-edges", o.trailing_edges, "[LMIN:]LMAX",
           "find trailing edges by shape and give them these edge lengths; default: off");
  set.text("--leading-edges", o.leading_edges, "[LMIN:]LMAX",
           "find leading edges by shape and give them these edge lengths; default: off");
  set.text("--end-size", o.end_size, "LENGTH",
           "edge length around the tips and roots of lifting surfaces, such as 0.1%span; default: not set");
  set.text("--edge-size", o.edge_size, "LENGTH",
           "edge length at trailing edges and noses of lifting surfaces; none: as all other edges");
  set.number(o.kBaseCells, o.base_cells);
  set.number(o.kChordCells, o.chord_cells);
  set.number(o.kCellPerLength, o.cell_per_length);
  set.number(SizeOptions::kMaxAspect, o.max_aspect);
  set.number(o.kMaxCells, o.max_cells);
  set.number(o.kTimeLimit, o.time_limit);
  set.flag("--no-surface", o.no_surface,
           "leave out the coarse surface of a closed model: lengths then pass through solids");
  set.flag("--allow-incomplete", o.allow_incomplete,
           "exit code 0 even when parts could not be sampled; the artifact is marked incomplete");
  set.preset();
}

void note_what_is_set(const OptionSet& set, RasterStageOptions& o) {
  o.preset = set.preset_name();
  o.asks_for_wings = set.is_set("--edge-size") && o.edge_size != "none";
}

void declare(OptionSet& set, ProlongStageOptions& o) {
  set.number(o.kSlope, o.slope);
  set.text("--slope-of", o.slope_of, "NAME=S,...",
           "slope of lengths that come from faces of this name, group or part, such as WING=0.1");
  set.number(o.kScale, o.scale);
  set.number(o.kTargetTriangles, o.target_triangles);
  set.number(o.kMaxTriangles, o.max_triangles);
  set.optional_inputs("--sources", o.sources, "file with sources: TOML, .bac or .ba3; repeatable");
  set.optional_array("--background", o.background,
                     "mesh with edge lengths or metrics at its nodes: .bac, .ba3, .pos, .msh, .sol or .solb with its "
                     "mesh, .vtu or .vtkhdf with an ARRAY");
  set.flag("--only", o.only, "take the lengths of the background alone, between the raster's lmin and lmax");
  set.text("--transform", o.transform, "STEPS",
           "move sources and background: 'rotate X Y Z DEG; mirror X Y Z; scale F; translate X Y Z'");
  set.optional_input("--blank", o.blank, "closed mesh that lengths do not pass, instead of the raster's own surface");
  set.flag("--no-blank", o.no_blank, "let lengths pass through solids");
  set.text("--blank-side", o.blank_side, "SIDE",
           "side that is blanked: inside, outside (of a meshed fluid domain) or auto");
  set.flag("--allow-incomplete", o.allow_incomplete, "accept a raster with parts that could not be sampled");
  set.preset();
}

void declare(OptionSet& set, MeshStageOptions& o) {
  set.number(o.kEnhanceRounds, o.enhance_rounds);
  set.number(o.kMergeBelow, o.merge_below);
  set.number(o.kMaxTurning, o.max_turning_deg);
  set.number(o.kTile, o.tile_triangles);
  set.number(o.kTimeLimit, o.time_limit);
  set.optional_input("--pairs", o.pairs, "periodic faces get the same mesh: file with tables [[pair]] (TOML), or auto");
}

void declare(OptionSet& set, MergeStageOptions& o) {
  set.flag("--allow-incomplete", o.allow_incomplete,
           "merge even when faces are missing; the mesh is marked incomplete");
}

void declare(OptionSet& set, CheckStageOptions& o) {
  CheckThresholds& t = o.thresholds;
  set.number(o.kAreaTolerance, o.area_tolerance);
  set.number(o.kListBelow, o.list_below_deg);
  set.number(t.kMaxFolds, t.max_folds);
  set.number(t.kMaxCrossings, t.max_crossings);
  set.number(t.kMinQuality, t.min_quality);
  set.number(t.kMinMeanQuality, t.min_mean_quality);
  set.number(t.kMinP1Quality, t.min_p1_quality);
  set.number(t.kMinAngle, t.min_angle_deg);
  set.number(t.kMaxFreeSharp, t.max_free_sharp);
  set.number(t.kMaxJump, t.max_jump);
  set.number(t.kMinSizeShare, t.min_size_share);
  set.length(
      "--max-deviation", t.max_deviation, "",
      "largest distance accepted of a triangle's centroid from its surface; needs --geometry; default: not checked");
  set.number(t.kMaxNormalDeviation, t.max_normal_deviation_deg);
  set.text("--layers", o.layers, "HEIGHT",
           "say whether layers of prisms can grow from the walls, of this height in all: 5mm, 1%, or the boundary "
           "layer of a plate: Re=6e6@2.5m; 5mm,1.2 with their growth");
}

}  // namespace st
