#include "stages/raster_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/share.h"
#include "base/text.h"
#include "features/base_strips.h"
#include "features/passages.h"
#include "features/rotor_blades.h"
#include "features/round_tails.h"
#include "features/smooth_edges.h"
#include "features/unlisted_wings.h"
#include "geometry/model/edge_faces.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "io/toml/size_rule_file.h"
#include "sizing/model_limits.h"
#include "stages/cell_budget.h"
#include "stages/coarse_surface.h"
#include "stages/common_octree.h"
#include "stages/joined_numbers.h"
#include "stages/phase_times.h"
#include "stages/raster_options.h"
#include "stages/raster_tasks.h"
#include "stages/raster_wings.h"
#include "stages/same_inputs.h"
#include "stages/size_tally.h"
#include "stages/stored_model.h"
#include "stages/task_trace.h"
#include "stages/undercuts.h"
#include "stages/wing_report.h"

namespace st {
namespace {

constexpr const char* kPassageLine =
    "  taken for the air in a passage, as holes have the profile of a wing; if it is a solid, say so in a file for "
    "--sizes: size = [{ edges = [...], trailing_edge = false }]";

void report_undercuts(const RasterArtifact& a) {
  if (a.model.undercuts.empty()) return;
  log_report(fmt::format(
      "  {} of {} samples are below the lmin given for them, down to {:.4g}{}, on narrower strips or bases: {}",
      count(a.model.undercuts), a.samples.size(), least_of(a.model.undercuts), in_unit(a.header.unit),
      undercut_text(a.model.undercuts, a.model.cause_names(), 1)));
}

nlohmann::ordered_json below_lmin_json(const RasterArtifact& a) {
  if (a.model.undercuts.empty()) return nullptr;
  constexpr std::size_t kPlaces = 3;
  nlohmann::ordered_json places = nlohmann::ordered_json::array();
  for (const Undercut& u : a.model.undercuts)
    if (places.size() < kPlaces) places.push_back({u.place.x, u.place.y, u.place.z});
  return {{"samples", count(a.model.undercuts)},
          {"least", least_of(a.model.undercuts)},
          {"places", places},
          {"causes", undercuts_json(a.model.undercuts, a.model.cause_names(), "samples", 1)}};
}

void fill_header(const RasterStageOptions& o, const ArtifactHeader& geometry, const SamplingLimits& limits,
                 const std::string& sizes_hash, ArtifactHeader& header) {
  header.schema = "raster";
  header.tool = "st-raster";
  header.tool_version = ST_VERSION;
  nlohmann::json options{{"lmin", limits.min_length},
                         {"lmax", limits.max_length},
                         {"alpha", o.alpha_deg},
                         {"cell_per_length", o.cell_per_length}};
  if (o.gap_cells) options["gap_cells"] = *o.gap_cells;
  if (o.wall_cells) options["wall_cells"] = *o.wall_cells;
  if (o.edge_cells) options["edge_cells"] = *o.edge_cells;
  if (!o.trailing_edges.empty()) options["trailing_edges"] = o.trailing_edges;
  if (!o.leading_edges.empty()) options["leading_edges"] = o.leading_edges;
  if (wing_length(o.chord, "--chord"))
    options["chord"] = o.chord;
  else if (!o.chord.empty())
    options["chord"] = limits.chord;
  options["edge_size"] = o.edge_size;
  options["base_cells"] = o.base_cells;
  if (!o.end_size.empty()) options["end_size"] = o.end_size;
  options["chord_cells"] = o.chord_cells;
  if (o.no_surface) options["no_surface"] = true;
  if (o.max_aspect > 1) options["max_aspect"] = o.max_aspect;
  if (!o.preset.empty()) options["preset"] = o.preset;
  header.options_json = json_text(options);
  header.unit = geometry.unit;
  header.unit_in_m = geometry.unit_in_m;
  header.geometry_hash = geometry.content_hash;
  header.inputs = {{"geometry", std::filesystem::path(o.geometry).filename().string(), geometry.content_hash}};
  if (!o.sizes.empty())
    header.inputs.push_back({"sizes", std::filesystem::path(o.sizes).filename().string(), sizes_hash});
}

void warn_of_depth(const DepthLimit& depth, const std::string& unit) {
  if (depth.n_samples == 0) return;
  log_warning(fmt::format(
      "{} samples with lengths down to {:.4g}{} need smaller cells than those of the octree's deepest level {}, "
      "{:.4g}{}; "
      "their lengths apply in cells of that size; mesh in a smaller domain, or use larger lengths",
      depth.n_samples, depth.smallest_length, in_unit(unit), kMaxLevel, depth.smallest_cell, in_unit(unit)));
}

nlohmann::json depth_json(const DepthLimit& depth) {
  nlohmann::json json{
      {"deepest_level", kMaxLevel}, {"smallest_cell", depth.smallest_cell}, {"samples", depth.n_samples}};
  if (depth.n_samples > 0) json["smallest_length"] = depth.smallest_length;
  return json;
}

/// Incomplete: the artifact is written, and says so.
ExitCode code_of(const RasterStageOptions& o, const SampleCounts& counts) {
  return counts.n_failures == 0 || o.allow_incomplete ? ExitCode::kOk : ExitCode::kIncomplete;
}

StageSummary summarize(const RasterStageOptions& o, const RasterArtifact& a, const SampleCounts& counts,
                       std::size_t n_rules, const RasterWings& wings, const std::vector<GroupSizes>& groups,
                       const PhaseTimes& times) {
  const double seconds = times.total();
  const std::size_t n_cells = a.octree.shape.leaf_keys.size();
  StageSummary summary;
  summary.code = code_of(o, counts);
  summary.line = fmt::format(
      "{}: {}, {}{}, {}{}, {:.2f} s", o.output, counted(counts.n_boxes, "sample"), counted(n_cells, "cell"),
      range_text(groups, a.header.unit), counted(wings.aircraft.wings.size(), "lifting surface"),
      counts.n_failures ? fmt::format(", INCOMPLETE: {} not sampled", counted(counts.n_failures, "part")) : "",
      seconds);
  summary.json = json_text(nlohmann::ordered_json{{"tool", "st-raster"},
                                                  {"output", o.output},
                                                  {"samples", counts.n_boxes},
                                                  {"cells", n_cells},
                                                  {"lmin", a.numbers.min_length},
                                                  {"lmax", a.numbers.max_length},
                                                  {"far_length", a.numbers.far_length},
                                                  {"alpha", a.numbers.alpha_deg},
                                                  {"cell_per_length", a.numbers.cell_per_length},
                                                  {"rules", n_rules},
                                                  {"wing_edges", wings.edges.size()},
                                                  {"lifting_surfaces", wings_json(wings.aircraft.wings)},
                                                  {"unused_trailing", unused_json(wings.unused)},
                                                  {"gap_samples", counts.n_gap_boxes},
                                                  {"not_sampled", counts.n_failures},
                                                  {"beyond_depth", depth_json(counts.depth)},
                                                  {"below_lmin", below_lmin_json(a)},
                                                  {"groups", sampled_json(groups, a.model.cause_names())},
                                                  {"hash", a.header.content_hash},
                                                  {"seconds", seconds},
                                                  {"seconds_of", times.wall()},
                                                  {"processor_seconds_of", times.processor()}});
  return summary;
}

/// Gives every rank what rank 0 decided.
void share_limits(const Executor& comm, ModelLimits& l) {
  share(comm, l.face, l.edge, l.vertex, l.edge_is_ruled, l.edge_is_smooth, l.face_wing, l.chords, l.far, l.min_length,
        l.wants_gaps, l.is_material_ahead, l.far_length, l.max_aspect);
}

/// Rules of sizes are for faces and edges of the CAD.
GeometryArtifact read_geometry_for(const std::string& path, const std::vector<SizeRule>& rules) {
  GeometryArtifact geometry = read_geometry(path);
  if (select_parts(rules, geometry) && part_joined_faces(geometry))
    log_report("  rules select parts of composites: all faces are apart, as the CAD has them");
  return geometry;
}

/// What is read, the same on all ranks.
struct RasterInput {
  RasterInput(const RasterStageOptions& o, const Communicator& comm)
      : sizes(o.sizes.empty() ? SizeRuleFile() : read_size_rules(o.sizes)),
        geometry(read_geometry_for(o.geometry, sizes.rules)),
        rules(all_rules(o, {rules_on_joined(sizes.rules, geometry), sizes.hash}, geometry.tables)),
        model(same_model(o, comm)) {}

  Model same_model(const RasterStageOptions& o, const Communicator& comm) {
    require_same_inputs(comm, {{o.geometry, geometry.header.content_hash}, {o.sizes, sizes.hash}});
    return stored_model(geometry, o.geometry);
  }

  SizeRuleFile sizes;
  GeometryArtifact geometry;  // without the model
  std::vector<SizeRule> rules;
  Model model;
};

/// A far field is as large as all of its faces that go on into each other: it may be cut anywhere.
void join_far_boxes(const ModelTables& t, const std::vector<std::uint8_t>& is_smooth, FaceRoles& roles) {
  const EdgeFaces faces_at(t);
  DisjointSets sets(t.n_faces());
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (is_smooth[e] &&
        std::ranges::all_of(faces_at[e], [&](FaceId f) { return roles.role[f] == FaceRole::kFarfield; }))
      sets.join(faces_at[e].front(), faces_at[e].back());
  std::vector<Box3> box(static_cast<std::size_t>(t.n_faces()));
  for (FaceId f = 0; f < t.n_faces(); ++f) box[sets.find(f)].add(roles.own.face_box[f]);
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (roles.role[f] == FaceRole::kFarfield) roles.own.face_box[f] = box[sets.find(f)];
}

/// The stage, step by step.
class RasterRun {
 public:
  RasterRun(const RasterStageOptions& o, const Communicator& comm)
      : o_(o),
        comm_(comm),
        trace_(comm, o.trace),
        in_(o, comm),
        roles_(face_roles(in_.model, trace_)),
        wall_(resolve_limits(o, in_.model.tables(), roles_.reference_diagonal)),
        strips_(find_strips(in_.model, trace_)),
        bases_(comm.is_root() ? find_base_strips(in_.model, strips_) : std::vector<Strip>()) {}

  StageSummary run(Progress& progress) {
    if (comm_.is_root()) say_interfaces();
    progress.step("lifting surfaces and limits", 0.1);
    set_limits();
    times_.end("opening");
    trace_.begin_phase("samples");
    progress.step("samples", 0.2);
    std::vector<std::vector<LengthSample>> samples = sample();  // by rank, on rank 0
    artifact_.numbers = {limits_.min_length, wall_.max_length,          limits_.far_length, o_.alpha_deg,
                         o_.cell_per_length, roles_.reference_diagonal, limits_.max_aspect};
    const bool has_surface = !o_.no_surface && has_coarse_surface(in_.model.tables());
    std::vector<float> open_lengths;  // on rank 0
    const auto meanwhile = [&] {
      artifact_.samples = merged_samples(std::move(samples));
      if (has_surface) open_lengths = prolong_openly(artifact_);
    };
    artifact_.model.faces = locate_faces(sampled(), artifact_.octree.shape, meanwhile, trace_, counts_.n_failures);
    times_.end("faces");
    trace_.begin_phase("surface");
    progress.step("surface", 0.7);
    if (has_surface)
      artifact_.surface =
          make_coarse_surface(in_.model, roles_, artifact_, std::move(open_lengths), strips_, o_.time_limit, trace_);
    times_.end("surface");
    trace_.begin_phase("write");
    times_.gather(comm_);
    if (comm_.is_root()) {
      progress.step("writing", 0.9);
      warn_of_depth(counts_.depth, in_.model.tables().unit);
      write();
    }
    trace_.write();
    if (!comm_.is_root()) return {};
    times_.end("writing");
    return report();
  }

 private:
  void say_interfaces() const {
    const auto n = std::ranges::count(roles_.role, FaceRole::kInterface);
    if (n > 0)
      log_report(
          fmt::format("  {} the role interface: no lengths are asked for there", counted(n, "face has", "faces have")));
  }

  /// Returns whether holes may be vanes: worth a look where no wing is found, or holes lead through.
  bool find_wings() {
    std::vector<WingEdge> small;
    bool has_hollow = false;
    wings_.edges = find_wing_edges(in_.model, roles_, bases_, trace_, &small, &has_hollow);
    std::vector<DeclaredEdge> declared;
    if (comm_.is_root()) {
      declared = declared_edges(in_.rules, in_.model.tables(), bases_, wings_.edges);
      declare_edges(in_.model, roles_, bases_, declared, wings_.edges);
      std::vector<DeclaredEdge> named = declared;  // what the user says of an edge counts, however short it is
      for (DeclaredEdge& d : named) d.meaning = EdgeMeaning::kNoTrailing;
      declare_edges(in_.model, roles_, bases_, named, small);
    }
    std::vector<LiftingSurface>& wings = wings_.aircraft.wings;
    wings =
        find_lifting_surfaces(in_.model, roles_, wings_.edges, trace_, &wings_.unused, Noseless::kOfAircraft, small);
    const std::vector<std::uint8_t> is_excluded = edges_without_wing(in_.model.tables(), declared);
    add_round_tails(in_.model, roles_, wings_.edges, is_excluded, wings, trace_);
    if (comm_.is_root()) liken_blades(in_.model, is_excluded, wings, wings_.unused);
    bool may_be_vanes = has_hollow && (wings.empty() || has_through_holes(in_.model.tables()));
    share(trace_, may_be_vanes);
    return may_be_vanes;
  }

  void set_limits() {
    if (find_wings() && has_vanes(in_.model, roles_, bases_, trace_)) {
      roles_.is_passage = true;
      if (comm_.is_root()) log_report(kPassageLine);
      find_wings();
    }
    std::vector<std::uint8_t> is_smooth = find_smooth_edges(in_.model, trace_);
    if (comm_.is_root()) join_far_boxes(in_.model.tables(), is_smooth, roles_);
    if (comm_.is_root()) limits_ = find_limits(o_, in_.model, roles_, bases_, {wall_, in_.rules}, wings_);
    limits_.edge_is_smooth = std::move(is_smooth);
    share_limits(trace_, limits_);
    budget_ = make_cell_budget(o_.max_cells, limits_, comm_);
    require_cells(least_cells(in_.model.tables(), limits_), budget_.max_cells);
    limit_samples(in_.model.tables(), budget_.max_samples, limits_);
  }

  SampledModel sampled() { return {in_.model, limits_, strips_, o_.time_limit, loops_}; }

  std::vector<std::vector<LengthSample>> sample() {
    loops_.resize(static_cast<std::size_t>(in_.model.tables().n_faces()));
    Samples samples = sample_model(sampled(), budget_.max_samples, trace_);
    times_.end("sampling");
    if (comm_.is_root()) counts_ = report_samples(samples);
    counts_.n_boxes += wings_.boxes.size();
    std::vector<RasterBox>& boxes = samples.own_boxes;
    boxes.insert(boxes.end(), wings_.boxes.begin(), wings_.boxes.end());
    if (limits_.wants_gaps)
      counts_.n_gap_boxes = sample_gaps(in_.model, samples, o_.cell_per_length, budget_.max_samples, trace_);
    times_.end("gaps");
    trace_.begin_phase("octree");
    const Box3 box = in_.model.tables().box();
    const Box3 root = choose_octree_box(box, in_.model.tables().wall_box(), boxes, limits_.far_length, comm_);
    artifact_.octree = build_common_octree(root, boxes, budget_.max_cells, comm_);
    counts_.depth = gather_depth_limit(find_depth_limit(root, boxes), comm_);
    std::vector<std::vector<LengthSample>> lengths = gather_samples(boxes, origin_of_places(box), comm_);
    times_.end("octree");
    return lengths;
  }

  void write() {
    artifact_.n_not_sampled = static_cast<std::int64_t>(counts_.n_failures);
    artifact_.model.edge_name = in_.model.tables().edge_name;
    artifact_.model.labels = in_.model.tables().labels;
    artifact_.model.wings = std::move(wings_.records);
    const GivenFloors floors = find_floors(in_.rules, !o_.lmin.empty(), in_.model.tables(), wings_.edges, limits_);
    if (std::ranges::any_of(floors.face, [](double lmin) { return lmin > 0; })) artifact_.model.face_lmin = floors.face;
    artifact_.model.undercuts = sample_undercuts(artifact_.samples, floors);
    fill_header(o_, in_.geometry.header, wall_, in_.sizes.hash, artifact_.header);
    artifact_.header.content_hash = write_raster(o_.output, artifact_);
  }

  StageSummary report() const {
    report_wings(o_, wings_, artifact_.header.unit);
    report_unused(o_, in_.model, roles_, wings_);
    const std::vector<GroupSizes> groups = sampled_groups(artifact_);
    for (const std::string& line :
         sampled_lines(groups, artifact_.model.cause_names(), kMostGroups, artifact_.header.unit))
      log_report(line);
    report_undercuts(artifact_);
    return summarize(o_, artifact_, counts_, in_.rules.size(), wings_, groups, times_);
  }

  const RasterStageOptions& o_;
  const Communicator& comm_;
  TaskTrace trace_;
  PhaseTimes times_;
  const RasterInput in_;
  FaceRoles roles_;
  const SamplingLimits wall_;
  const std::vector<Strip> strips_, bases_;  // the latter on rank 0 only
  RasterWings wings_;                        // rank 0 only
  ModelLimits limits_;
  CellBudget budget_;
  FaceLoops loops_;
  SampleCounts counts_;
  RasterArtifact artifact_;
};

}  // namespace

void RasterStageOptions::validate() const {
  option_rules(*this);
  st::edge_size(*this);
  st::end_size(*this);
  SizeOptions::kAlpha.require(alpha_deg);
  SizeOptions::kGapCells.require(gap_cells);
  SizeOptions::kWallCells.require(wall_cells);
  SizeOptions::kEdgeCells.require(edge_cells);
  kBaseCells.require(base_cells);
  kChordCells.require(chord_cells);
  kCellPerLength.require(cell_per_length);
  kMaxCells.require(max_cells);
  kTimeLimit.require(time_limit);
  SizeOptions::kMaxAspect.require(max_aspect);
}

StageSummary run_raster(const RasterStageOptions& o, const Communicator& comm) {
  o.validate();
  if (comm.is_root()) require_writable(o.output);
  if (comm.is_root() && !o.trace.empty()) require_writable(o.trace);
  Progress progress("st-raster", 1);
  progress.step("reading", 0);
  return RasterRun(o, comm).run(progress);
}

}  // namespace st
