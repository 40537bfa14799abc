#include "stages/prolong_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "base/length.h"
#include "base/limits.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "io/file/json_text.h"
#include "io/file/output_files.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/sizing_artifact.h"
#include "sizing/moved_field.h"
#include "sizing/size_field.h"
#include "sizing/stretched_cones.h"
#include "sizing/telling_triangles.h"
#include "stages/blank_input.h"
#include "stages/edit_provenance.h"
#include "stages/expected_triangles.h"
#include "stages/phase_times.h"
#include "stages/size_report.h"
#include "stages/size_tally.h"
#include "stages/slope_input.h"
#include "stages/source_input.h"
#include "stages/undercuts.h"

namespace st {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostExact = 9e15;  // triangles that are still written as a whole number

/// A member of a grid family beside the sizing itself.
struct FamilyMember {
  std::string level;  ///< "coarse"
  double factor;      ///< of all lengths
};

/// Of the workshops from level to level (L+2)/(L+1), level 3 being the medium one (guidelines of the seventh drag
/// prediction workshop). Throws Error(kUsage).
std::vector<FamilyMember> family_members(const std::string& family) {
  if (family.empty()) return {};
  if (family == "dpw") {
    std::vector<FamilyMember> members;
    for (int level = 1; level <= 6; ++level) members.push_back({fmt::format("L{}", level), 4.0 / (level + 1)});
    return members;
  }
  const std::optional<double> ratio = as_number(family);
  if (!ratio || !ProlongStageOptions::kFamily.refusal(*ratio).empty())
    throw Error(ExitCode::kUsage,
                fmt::format("--family {}: takes a ratio in {} or dpw", family, ProlongStageOptions::kFamily.interval));
  return {{"coarse", *ratio}, {"fine", 1 / *ratio}};
}

void warn_of_no_effect(const ProlongStageOptions& o) {
  if (!o.transform.empty() && o.sources.empty() && o.background.empty())
    log_warning("--transform has no effect without --sources or --background");
  if (o.blank_side != ProlongStageOptions().blank_side && o.blank.empty())
    log_warning("--blank-side has no effect without --blank");
}

constexpr const char* kOnly = "only_above";  // option in a sizing of --only: the smallest length, in the octree's frame

/// The options that the octree's lengths depend on; file names stand among the inputs.
Json octree_options(const ProlongStageOptions& o, const RasterArtifact& raster) {
  Json json = {{"slope", o.slope}};
  if (o.only) json[kOnly] = Json::parse(raster.header.options_json).value("lmin", 0.0);
  if (!o.slope_of.empty()) json["slope_of"] = o.slope_of;
  if (!o.blank.empty()) json["blank_side"] = o.blank_side;
  if (o.no_blank) json["no_blank"] = true;
  if (o.allow_incomplete) json["allow_incomplete"] = true;
  return json;
}

/// Replaces those of a finished field in the same way.
Json octree_options(const std::string& options_json) {
  Json json = Json::parse(options_json);
  for (const char* key : {"scale", "transform", "target_triangles"}) json.erase(key);
  return json;
}

std::string options_json(Json json, const ProlongStageOptions& o, double scale) {
  json["scale"] = scale;
  if (!o.transform.empty()) json["transform"] = o.transform;
  if (o.target_triangles) json["target_triangles"] = *o.target_triangles;
  return json_text(json);
}

/// The scale of all lengths that gives this many triangles: N(s) = a/s^2 + b/s + c, solved for 1/s. c is what steep
/// gradients cost at any scale; at least half of the triangles are left for the rest.
double scale_to(int target_triangles, const std::vector<FaceWeight>& weights) {
  FaceWeight all;
  for (const FaceWeight& w : weights) all.add(w, kTrianglesPerWeight);
  const double a = all.uniform, b = kTrianglesPerGradient * all.graded,
               rest = std::max(target_triangles - kTrianglesPerGradient2 * all.steep, 0.5 * target_triangles);
  return 2 * a / (std::sqrt(b * b + 4 * a * rest) - b);
}

void require_complete(const ProlongStageOptions& o, const RasterArtifact& raster) {
  if (raster.n_not_sampled == 0) return;
  const std::string what = fmt::format("{}: incomplete, {} of the model could not be sampled", o.raster,
                                       counted(raster.n_not_sampled, "part"));
  if (!o.allow_incomplete)
    throw Error(
        ExitCode::kIncomplete,
        what +
            "; repair them and run st-raster again, or take their sizes from their neighbours with --allow-incomplete");
  log_warning(what + ": their sizes come from their neighbours");
}

/// The geometry that the sizing is for, and its motion since the raster.
struct MovedGeometry {
  Similarity motion;
  std::string hash;
  std::vector<InputRef> file;  ///< none unless --geometry is given
};

MovedGeometry read_moved(const ProlongStageOptions& o, const ArtifactHeader& raster) {
  if (o.geometry.empty()) return {{}, raster.geometry_hash, {}};
  const ArtifactHeader geometry = read_header(o.geometry);
  if (geometry.schema != "geometry")
    throw Error(ExitCode::kInput, fmt::format("{}: is a {} artifact; give a geometry", o.geometry, geometry.schema));
  const InputRef file{"geometry", std::filesystem::path(o.geometry).filename().string(), geometry.content_hash};
  return {whole_motion(o.geometry, geometry, raster.geometry_hash), geometry.content_hash, {file}};
}

/// The surface that lengths do not pass, in the octree's own frame; without triangles: there is none.
struct Barrier {
  BlankSurface surface;
  double flow_along_normals = 0;  ///< see Blanking
  std::vector<InputRef> file;     ///< of --blank
};

double extent_of(const SurfaceMesh& mesh) {
  Box3 box;
  for (const Vec3 x : mesh.node_xyz) box.add(x);
  return box.diagonal();
}

/// Of a mesh in another unit, of another model, or of this one at another place, other cells would be blanked than
/// those inside, or none. `mesh` is in the octree's frame.
void warn_of_place(const std::string& path, const SurfaceMesh& mesh, const RasterArtifact& raster) {
  constexpr double kSmaller = 5;          // factor: mm and cm; one part of a model may be as small
  constexpr double kLarger = 100;         // factor: a far field may be as large
  constexpr double kOtherSize = 2.5;      // factor; the mesh may be of one part alone
  constexpr double kLeastShare = 0.25;    // of its nodes, near the faces
  constexpr double kLeastOfOther = 0.75;  // likewise where its size is another
  const double ratio = extent_of(mesh) / raster.numbers.diagonal;
  if (ratio < 1 / kSmaller || ratio > kLarger)
    return log_warning(fmt::format(
        "--blank {}: its extent is {:.3g} times that of the walls; is it in the model's unit?", path, ratio));
  const double share = share_near(mesh.node_xyz, raster.octree.shape.view(), raster.model.faces.leaf);
  if (share < (ratio < 1 / kOtherSize || ratio > kOtherSize ? kLeastOfOther : kLeastShare))
    log_warning(
        fmt::format("--blank {}: only {:.0f} % of its nodes are near the model's faces; is it a mesh of this "
                    "model, in its place and unit?",
                    path, 100 * share));
}

Barrier find_barrier(const ProlongStageOptions& o, RasterArtifact& raster, const Similarity& to_octree) {
  if (o.no_blank) return {};
  const double along = raster.surface.side == BlankSide::kInside ? 1 : -1;
  if (o.blank.empty()) return {std::move(raster.surface), along, {}};
  BlankInput blank = read_blank(o.blank, o.blank_side);
  if (to_octree != Similarity()) transform(to_octree, blank.mesh);
  warn_of_place(o.blank, blank.mesh, raster);
  const bool is_closed = !raster.surface.triangles.empty();  // then normals of faces tell sides, whatever blanks
  return {{std::move(blank.mesh.node_xyz), std::move(blank.mesh.triangles), blank.side},
          is_closed ? along : 0,
          {blank.file}};
}

/// Where lengths may pass.
Blanking blank(const Barrier& barrier, const Neighbours& neighbours) {
  if (barrier.surface.triangles.empty()) return {};
  const SurfaceView surface = barrier.surface.view();
  Blanking blanking = blank_cells(neighbours, surface, barrier.surface.side, find_open_edges(surface));
  blanking.flow_along_normals = barrier.flow_along_normals;
  return blanking;
}

/// [n_samples]
std::vector<float> sample_slopes(const ProlongStageOptions& o, const std::optional<SlopeSeeds>& seeds,
                                 std::span<const LengthSample> samples) {
  std::vector<float> slope(samples.size(), static_cast<float>(o.slope));
  for (std::size_t i = 0; seeds && i < samples.size(); ++i)
    if (const double own = seeds->of_cause(samples[i].cause); own > 0) slope[i] = static_cast<float>(own);
  return slope;
}

/// Rasters of older versions had lengths in cells alone where cells were small.
void require_samples(const ProlongStageOptions& o, const RasterArtifact& raster) {
  const std::vector<std::int32_t>& causes = raster.octree.stored_cause;
  if (raster.samples.empty() && std::ranges::count(causes, kNone) != std::ssize(causes))
    throw Error(ExitCode::kInput,
                o.raster + ": an older st-raster left out the places of its samples; run st-raster again");
}

/// Prolongs what the raster asks for; `sizing` gets shape, lengths, blanking and slope.
void make_lengths(const ProlongStageOptions& o, const Barrier& barrier, Progress& progress, RasterArtifact& raster,
                  SizingArtifact& sizing) {
  std::optional<SlopeSeeds> slope_seeds;
  sizing.slope = o.slope;
  if (const std::vector<NamedSlope> named = parse_slopes(o.slope_of); !named.empty()) {
    slope_seeds.emplace(named, raster);
    for (const NamedSlope& s : named) sizing.slope = std::max(sizing.slope, s.slope);
  }
  progress.step("neighbours", 0.1);
  const Neighbours neighbours(raster.octree.shape.view());
  progress.step(barrier.surface.triangles.empty() ? "samples" : "blanking", 0.2);
  sizing.blanking = blank(barrier, neighbours);
  const Blanking* blanking = sizing.blanking.colour.empty() ? nullptr : &sizing.blanking;
  progress.step("lengths", 0.4);
  if (!raster.samples.empty()) {
    const std::vector<float> slope = sample_slopes(o, slope_seeds, raster.samples);
    const bool is_stretched = sizing.numbers.max_aspect > 1;
    SampleSites sites;
    sizing.cones = spread_cones(neighbours, raster.samples, slope, raster.numbers.far_length, blanking,
                                is_stretched ? &sites : nullptr);
    if (is_stretched) add_stretch(neighbours.octree(), raster.samples, slope, sites, sizing.cones);
  } else {
    sizing.cones.at_center.assign(raster.octree.shape.leaf_keys.size() + sizing.blanking.split.size(), kNone);
  }
  sizing.shape = std::move(raster.octree.shape);
  sizing.lengths = lengths_at_centers(sizing.field_data(nullptr), sizing.cones.at_center);
}

/// A size field and what it requires of each group.
struct ProlongedSizes {
  SizingArtifact sizing;
  Json octree_options;
  std::vector<GroupSizes> groups;
  std::vector<FaceWeight> weights;

  void set_scale(const ProlongStageOptions& o, double scale) {
    sizing.scale = scale;
    sizing.header.options_json = options_json(octree_options, o, scale);
    sizing.face_weight.clear();
    for (const FaceWeight& w : weights) sizing.face_weight.push_back(w.at(scale));
  }
};

/// To the smallest length that the raster allows.
void raise_background(double least, const SizingArtifact& sizing, BackgroundMesh& mesh) {
  if (const std::int64_t n = raise_lengths(least, mesh))
    log_warning(
        fmt::format("{} of {} nodes of the background mesh ask for less than the raster's lmin, {:.4g}{}, and "
                    "get it; give st-raster a smaller --lmin",
                    n, mesh.node_xyz.size(), sizing.frame.scale * least, in_unit(sizing.header.unit)));
}

/// Adds the sources of `o`, and all that depends on them and on the scale, to the octree's lengths.
ProlongedSizes add_sources(const ProlongStageOptions& o, Json octree_options, Progress& progress,
                           SizingArtifact&& sizing) {
  SourceInput input = read_sources(
      o.sources, o.background, parse_similarity(o.transform, "--transform").then(sizing.frame.inverse()),
      octree_options["slope"].get<double>(), {sizing.numbers.diagonal * sizing.frame.scale, sizing.header.unit_in_m},
      sizing.model.faces, sizing.shape.view());
  if (octree_options.contains(kOnly))
    raise_background(octree_options[kOnly].get<double>(), sizing, input.set.background);
  input.set.background.triangles = telling_triangles(input.set.background, input.set.slope);
  warn_of_places(input, sizing.shape.view(), sizing.numbers.far_length, sizing.header.unit);
  warn_of_outside(input.set.background, sizing.model.faces, sizing.header.unit);
  sizing.sources = std::move(input.set);
  sizing.source_name = std::move(input.names);
  progress.step("expected triangles", 0.8);
  SizeTally tally = tally_by_group(sizing.model.labels, sizing.model.faces.n_faces());
  UndercutTally undercuts;
  std::vector<FaceWeight> weights =
      face_weights(sizing.model.faces, sizing.shape.view(), *sizing.field(), [&](const SizedPart& part) {
        tally.add(part);
        if (!sizing.model.face_lmin.empty())
          undercuts.add(part.cause, part.least, sizing.model.face_lmin[part.face], sizing.frame(part.place));
      });
  sizing.model.undercuts = undercuts.take();
  const double scale = o.target_triangles ? scale_to(*o.target_triangles, weights) : o.scale;
  std::vector<InputRef>& inputs = sizing.header.inputs;
  std::erase_if(inputs, [](const InputRef& i) { return i.role == "sources" || i.role == "background"; });
  inputs.insert(inputs.end(), input.files.begin(), input.files.end());
  ProlongedSizes result{std::move(sizing), std::move(octree_options), {}, std::move(weights)};
  result.groups = tally.groups(scale, result.sizing.frame.scale);
  result.set_scale(o, scale);
  return result;
}

ProlongedSizes prolong_raster(const ProlongStageOptions& o, Progress& progress, RasterArtifact&& raster) {
  require_complete(o, raster);
  MovedGeometry moved = read_moved(o, raster.header);
  SizingArtifact sizing;
  sizing.frame = moved.motion;
  sizing.numbers = raster.numbers;
  Json options = octree_options(o, raster);
  const Barrier barrier = o.only ? Barrier{} : find_barrier(o, raster, moved.motion.inverse());
  if (o.only)
    raster.samples.clear();
  else
    require_samples(o, raster);
  make_lengths(o, barrier, progress, raster, sizing);
  sizing.model = std::move(raster.model);
  sizing.header = raster.header;
  sizing.header.schema = "sizing";
  sizing.header.tool = "st-prolong";
  sizing.header.tool_version = ST_VERSION;
  sizing.header.geometry_hash = moved.hash;
  sizing.header.inputs = {{"raster", std::filesystem::path(o.raster).filename().string(), raster.header.content_hash}};
  for (const std::vector<InputRef>& files : {moved.file, barrier.file})
    sizing.header.inputs.insert(sizing.header.inputs.end(), files.begin(), files.end());
  return add_sources(o, std::move(options), progress, std::move(sizing));
}

/// Other sources for a finished field; what the octree tells stays.
ProlongedSizes change_sources(ProlongStageOptions o, Progress& progress) {
  SizingArtifact sizing = read_sizing(o.raster);
  const Json made_with = Json::parse(sizing.header.options_json);
  const ProlongStageOptions defaults;
  if (!o.slope_of.empty() || !o.blank.empty() || o.no_blank || !o.geometry.empty() || o.only ||
      (o.slope != defaults.slope && o.slope != made_with["slope"].get<double>()))
    throw Error(ExitCode::kUsage, fmt::format("{}: is a finished field, of which the sources and the scale can be "
                                              "changed; give the raster for other slopes, blanking or geometry",
                                              o.raster));
  if (!o.target_triangles && o.scale == defaults.scale) {  // as it was
    if (made_with.contains("target_triangles")) o.target_triangles = made_with["target_triangles"].get<int>();
    o.scale = made_with["scale"].get<double>();
  }
  sizing.scale = 1;
  return add_sources(o, octree_options(sizing.header.options_json), progress, std::move(sizing));
}

/// Where the smallest lengths that were given do not hold on faces.
void report_undercuts(const SizingArtifact& sizing) {
  if (sizing.model.undercuts.empty()) return;
  const double scale = sizing.scale * sizing.frame.scale;
  log_report(fmt::format("  {} places on faces are below the lmin given for them, down to {:.4g}{}, because of {}",
                         count(sizing.model.undercuts), scale * least_of(sizing.model.undercuts),
                         in_unit(sizing.header.unit),
                         undercut_text(sizing.model.undercuts, sizing.cause_names(), scale)));
}

StageSummary summarize(const ProlongStageOptions& o, const SizingArtifact& sizing,
                       const std::vector<GroupSizes>& groups, double seconds) {
  const auto [smallest, largest] =
      std::minmax_element(sizing.lengths.cells.begin(), sizing.lengths.cells.end(),
                          [](const CellLength& a, const CellLength& b) { return a.at_centre() < b.at_centre(); });
  const double scale = sizing.scale * sizing.frame.scale;
  const double lo = scale * std::min<double>(smallest->at_centre(), sizing.sources.min_size()),
               hi = scale * largest->at_centre(), n = expected_triangles(sizing.face_weight);
  const std::string scaled = o.target_triangles ? fmt::format(" scaled by {:.4g}", sizing.scale) : "";
  const std::string sources = sizing.source_name.empty() ? "" : ", " + counted(sizing.source_name.size(), "source");
  const std::vector<CellColour>& colour = sizing.blanking.colour;
  const auto n_blanked = std::count(colour.begin(), colour.end(), CellColour::kBlanked);
  const auto n_cut = std::count(colour.begin(), colour.end(), CellColour::kCut);
  const std::string blanked = colour.empty() ? ""
                                             : fmt::format(" ({} blanked, {} cut, {} of these split)", n_blanked, n_cut,
                                                           sizing.blanking.split.size());
  StageSummary summary;
  summary.line = fmt::format("{}: {} cells{}{}{}{}, slope {:g}, about {:.0f} triangles, {:.2f} s", o.output,
                             sizing.lengths.cells.size(), blanked, sources, range_text(groups, sizing.header.unit),
                             scaled, o.slope, n, seconds);
  summary.json =
      json_text(Json{{"tool", "st-prolong"},
                     {"output", o.output},
                     {"cells", sizing.lengths.cells.size()},
                     {"blanked_cells", n_blanked},
                     {"cut_cells", n_cut},
                     {"split_cells", sizing.blanking.split.size()},
                     {"sources", sizing.source_name.size()},
                     {"lmin", lo},
                     {"lmax", hi},
                     {"slope", o.slope},
                     {"scale", sizing.scale},
                     {"expected_triangles", n < kMostExact ? Json(std::llround(n)) : Json(n)},
                     {"below_lmin", undercuts_json(sizing.model.undercuts, sizing.cause_names(), "places", scale)},
                     {"groups", groups_json(groups, sizing.cause_names())},
                     {"hash", sizing.header.content_hash},
                     {"seconds", seconds},
                     {"processor_seconds", processor_json()}});
  return summary;
}

/// "out/sizing.hdf" and "coarse" -> "out/sizing-coarse.hdf".
std::string member_path(const std::string& path, const std::string& level) {
  std::filesystem::path p(path);
  p.replace_filename(p.stem().string() + "-" + level + p.extension().string());
  return p.string();
}

/// The size field of the same options with all lengths times `scale`.
void write_member(ProlongStageOptions o, const std::string& path, double scale, ProlongedSizes& sizes) {
  o.target_triangles.reset();
  sizes.set_scale(o, scale);
  write_sizing(path, sizes.sizing);
  log_info(fmt::format("  {}: scale {:.4g}", path, scale));
}

ProlongedSizes read_and_prolong(const ProlongStageOptions& o) {
  Progress progress("prolonging", 1);
  progress.step("reading", 0);
  if (read_header(o.raster).schema == "sizing") return change_sources(o, progress);
  return prolong_raster(o, progress, read_raster(o.raster));
}

}  // namespace

void ProlongStageOptions::validate() const {
  kSlope.require(slope);
  kScale.require(scale);
  kTargetTriangles.require(target_triangles);
  kMaxTriangles.require(max_triangles);
  family_members(family);
  parse_similarity(transform, "--transform");
  require_blank_side(blank_side);
  if (no_blank && !blank.empty())
    throw Error(ExitCode::kUsage, "--no-blank and --blank exclude each other: leave out one");
  parse_slopes(slope_of);
  if (only && background.empty())
    throw Error(ExitCode::kUsage, "--only takes the lengths of --background alone: give one");
  if (only && (!blank.empty() || !slope_of.empty()))
    throw Error(ExitCode::kUsage, "--only leaves out the lengths of walls: leave out --blank and --slope-of");
  if (target_triangles && scale != 1)
    throw Error(ExitCode::kUsage, "--target-triangles sets the scale: leave out --scale");
}

StageSummary run_prolong(const ProlongStageOptions& o) {
  const Timer timer;
  o.validate();
  warn_of_no_effect(o);
  require_writable(o.output);
  const std::vector<FamilyMember> members = family_members(o.family);
  std::vector<std::string> paths;
  for (const FamilyMember& m : members) paths.push_back(member_path(o.output, m.level));
  require_derived_outputs(paths);
  if (!o.sample.empty()) require_writable(o.sample_output);
  ProlongedSizes sizes = read_and_prolong(o);
  SizingArtifact& sizing = sizes.sizing;
  report_expected_triangles(sizing.face_weight, sizing.model.labels.face_name, o.max_triangles, o.output);
  if (!o.sample.empty()) {
    sample_sizes(*sizing.field(sizing.frame), sizing.cause_names(), o.sample, o.sample_output);
  }
  sizing.header.content_hash = write_sizing(o.output, sizing);
  for (const std::string& line : group_lines(sizes.groups, sizing.cause_names(), kMostGroups, sizing.header.unit))
    log_report(line);
  report_undercuts(sizing);
  const StageSummary summary = summarize(o, sizing, sizes.groups, timer.seconds());
  const double scale = sizing.scale;
  for (std::size_t i = 0; i < members.size(); ++i) write_member(o, paths[i], scale * members[i].factor, sizes);
  return summary;
}

}  // namespace st
