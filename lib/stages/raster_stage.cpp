#include "stages/raster_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "base/current_work.h"
#include "base/length.h"
#include "base/limits.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/required_unit.h"
#include "base/share.h"
#include "base/text.h"
#include "features/base_strips.h"
#include "features/passages.h"
#include "features/rotor_blades.h"
#include "features/round_tails.h"
#include "features/smooth_edges.h"
#include "features/strip.h"
#include "features/unlisted_wings.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "io/toml/size_rule_file.h"
#include "sizing/cell_limit.h"
#include "sizing/face_cells.h"
#include "sizing/gap_sizes.h"
#include "sizing/loop_tracer.h"
#include "sizing/model_limits.h"
#include "sizing/raster_curve.h"
#include "sizing/raster_face.h"
#include "sizing/raster_strip.h"
#include "stages/cell_budget.h"
#include "stages/coarse_surface.h"
#include "stages/common_octree.h"
#include "stages/joined_numbers.h"
#include "stages/phase_times.h"
#include "stages/same_inputs.h"
#include "stages/size_tally.h"
#include "stages/stored_model.h"
#include "stages/task_trace.h"
#include "stages/undercuts.h"
#include "stages/wing_report.h"

namespace st {
namespace {

constexpr std::int32_t kEdgesPerTask = 32;
constexpr std::size_t kPatchesPerTask = 256;
constexpr double kDefaultMaxLength = 0.025;     // of the reference diagonal
constexpr double kDefaultMinLength = 1.0 / 64;  // of the largest length

/// The rule of --trailing-edges or --leading-edges: "LMIN:LMAX" or "LMAX".
SizeRule detection_rule(const std::string& option, const std::string& word, const std::string& lengths) {
  SizeRule rule;
  rule.where = option;
  add_detected(word, rule);
  const std::size_t colon = lengths.find(':');
  if (colon != std::string::npos) rule.lmin = parse_length(lengths.substr(0, colon), option);
  rule.lmax = parse_length(colon == std::string::npos ? lengths : lengths.substr(colon + 1), option);
  if (rule.lmin && rule.lmin->kind == rule.lmax->kind && rule.lmin->value > rule.lmax->value)
    throw Error(ExitCode::kUsage,
                fmt::format("{} {}: the smallest length is larger than the largest; write LMIN:LMAX", option, lengths));
  return rule;
}

/// A length of --lmin, --lmax or --chord that refers to wings is a rule for all walls; the others resolve_limits()
/// takes.
std::optional<LengthSpec> wing_length(const std::string& text, const std::string& option) {
  if (text.empty()) return std::nullopt;
  const LengthSpec spec = parse_length(text, option);
  return spec.is_of_wing() ? std::optional(spec) : std::nullopt;
}

std::vector<SizeRule> option_rules(const RasterStageOptions& o) {
  std::vector<SizeRule> rules;
  SizeRule walls;
  walls.lmin = wing_length(o.lmin, "--lmin");
  walls.lmax = wing_length(o.lmax, "--lmax");
  walls.chord = wing_length(o.chord, "--chord");
  if (walls.lmin) walls.where += "--lmin ";
  if (walls.lmax) walls.where += "--lmax ";
  if (walls.chord) walls.where += "--chord ";
  if (!walls.where.empty()) {
    walls.where.pop_back();
    rules.push_back(walls);
  }
  if (!o.trailing_edges.empty()) rules.push_back(detection_rule("--trailing-edges", "trailing", o.trailing_edges));
  if (!o.leading_edges.empty()) rules.push_back(detection_rule("--leading-edges", "leading", o.leading_edges));
  return rules;
}

/// What hangs on --edge-size has no effect without it.
void require_edge_size(const RasterStageOptions& o, const std::vector<SizeRule>& rules) {
  if (o.edge_size != "none") return;
  const auto says_edges = [](const SizeRule& rule) {
    return rule.meaning && rule.meaning != EdgeMeaning::kNoTrailing && !rule.asks_sizes();
  };
  const auto rule = std::ranges::find_if(rules, says_edges);
  if (rule == rules.end() && o.end_size.empty()) return;
  throw Error(ExitCode::kUsage,
              fmt::format("{} has no effect with --edge-size none; give --edge-size a length",
                          rule == rules.end() ? "--end-size" : rule->where + ": trailing_edge or leading_edge"));
}

/// Rules of options, then those of the file, which win. What can be known before anything is sampled is refused now:
/// lengths with a unit in a model without one, names that nothing has, a smallest length above the largest.
std::vector<SizeRule> all_rules(const RasterStageOptions& o, const SizeRuleFile& sizes, const ModelTables& t) {
  std::vector<SizeRule> rules = option_rules(o);
  rules.insert(rules.end(), sizes.rules.begin(), sizes.rules.end());
  require_edge_size(o, rules);
  for (const SizeRule& rule : rules) {
    for (const auto& [length, key] : {std::pair(rule.lmin, "lmin"), {rule.lmax, "lmax"}, {rule.chord, "chord"}})
      if (length) require_unit(*length, t.unit_in_m, rule.where + ": " + key);
    if (rule.detected.empty()) find_targets(rule, t);
  }
  return rules;
}

/// nullopt: "none".
std::optional<LengthSpec> edge_size(const RasterStageOptions& o) {
  return o.edge_size == "none" ? std::nullopt : std::optional(parse_length(o.edge_size, "--edge-size"));
}

std::optional<LengthSpec> end_size(const RasterStageOptions& o) {
  return o.end_size.empty() ? std::nullopt : std::optional(parse_length(o.end_size, "--end-size"));
}

SamplingLimits resolve_limits(const RasterStageOptions& o, const ModelTables& t, double diagonal) {
  if (!(diagonal > 0))
    throw Error(ExitCode::kGeometry, fmt::format("{}: the model has no extent; check the CAD file", o.geometry));
  SamplingLimits limits;
  const auto resolved = [&](const std::string& text, const std::string& option, double otherwise) {
    if (text.empty() || wing_length(text, option)) return otherwise;
    return resolve_length(parse_length(text, option), {diagonal, t.unit_in_m}, option);
  };
  if (const std::optional<LengthSpec> size = edge_size(o)) require_unit(*size, t.unit_in_m, "--edge-size");
  if (const std::optional<LengthSpec> size = end_size(o)) require_unit(*size, t.unit_in_m, "--end-size");
  limits.max_length = resolved(o.lmax, "--lmax", kDefaultMaxLength * diagonal);
  limits.min_length = resolved(o.lmin, "--lmin", kDefaultMinLength * limits.max_length);
  limits.alpha = radians(o.alpha_deg);
  limits.chord = resolved(o.chord, "--chord", limits.chord);
  limits.chord_cells = o.chord_cells;
  limits.cell_per_length = o.cell_per_length;
  limits.gap_cells = o.gap_cells;
  limits.wall_cells = o.wall_cells;
  limits.edge_cells = o.edge_cells;
  limits.max_aspect = o.max_aspect;
  if (limits.min_length > limits.max_length)
    throw Error(ExitCode::kUsage, fmt::format("--lmin {} is larger than --lmax {}; give --lmin at most --lmax",
                                              limits.min_length, limits.max_length));
  return limits;
}

constexpr const char* kPassageLine =
    "  taken for the air in a passage, as holes have the profile of a wing; if it is a solid, say so in a file for "
    "--sizes: size = [{ edges = [...], trailing_edge = false }]";
constexpr std::size_t kMostUnused = 20;  // lines about trailing edges without a lifting surface

/// What detection found; on rank 0.
struct Wings {
  std::vector<WingEdge> edges;
  std::vector<UnusedTrailing> unused;
  Aircraft aircraft;
  std::vector<RasterBox> boxes;     ///< what they ask for, besides curvature
  std::vector<WingRecord> records;  ///< likewise, for the artifact
};

/// Where --lmin undoes --edge-size.
void warn_of_floor(const RasterStageOptions& o, const std::vector<LiftingSurface>& surfaces, const WingSizes& sizes,
                   const std::string& unit) {
  std::size_t n_raised = 0;
  std::optional<RaisedLength> most;
  for (const LiftingSurface& wing : surfaces) {
    const std::optional<RaisedLength> own = most_raised(wing, sizes);
    if (!own) continue;
    ++n_raised;
    note_raised(*own, most);
  }
  if (most)
    log_warning(fmt::format(
        "--lmin {} is larger than --edge-size {} on {} of {} lifting surfaces: {:.4g}{} instead of {:.4g}{} "
        "where it matters most; give a smaller --lmin, or leave it out",
        o.lmin, o.edge_size, n_raised, surfaces.size(), most->floor, unit, most->asked, unit));
}

/// The least lengths that rules give, and --lmin where it is given.
GivenFloors find_floors(const std::vector<SizeRule>& rules, bool everywhere, const ModelTables& t,
                        std::span<const WingEdge> wing_edges, const ModelLimits& limits) {
  GivenFloors floors{std::vector<double>(t.n_faces(), 0), std::vector<double>(t.n_edges(), 0)};
  const auto set_edge = [&](EdgeId e) {
    if (limits.edge[e]) floors.edge[e] = limits.edge[e]->min_length;
  };
  const auto set_face = [&](FaceId f) {
    if (limits.face[f]) floors.face[f] = limits.face[f]->min_length;
    for (const EdgeId e : t.edges_of(f)) set_edge(e);
  };
  if (everywhere)
    for (FaceId f = 0; f < t.n_faces(); ++f) set_face(f);
  for (const SizeRule& rule : rules) {
    if (!rule.lmin) continue;
    const RuleTargets targets = find_targets(rule, t, wing_edges);
    for (const EdgeId e : targets.edges) set_edge(e);
    for (FaceId f = 0; f < t.n_faces(); ++f)
      if (!rule.has_selection() || std::binary_search(targets.faces.begin(), targets.faces.end(), f)) set_face(f);
  }
  return floors;
}

/// Of a long face: its width. Model unit.
double face_width(const ModelTables& t, FaceId f) {
  double around = 0;
  for (const EdgeId e : t.edges_of(f)) around += t.edge_length[e];
  return around > 0 ? 2 * t.face_area[f] / around : 0;
}

/// Half of the least length at the noses of `wings`, of the default one at most, per face of theirs and narrow face
/// beside one; infinite for other faces.
std::vector<double> curvature_floors(const ModelTables& t, const std::vector<LiftingSurface>& wings,
                                     const WingSizes& sizes, std::span<const ChordLine> chords) {
  constexpr double kOfNose = 0.5;
  constexpr double kDefaultNose = 0.003;  // of the chord
  constexpr double kNarrow = 0.1;         // likewise
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> floors(static_cast<std::size_t>(t.n_faces()), kNone);
  std::vector<double> own(wings.size(), kNone), chord(wings.size(), kNone);
  for (const ChordLine& line : chords) {
    const LiftingSurface& wing = wings[line.wing];
    if (wing.trailing.empty()) continue;
    const double length = length_along(wing, sizes, wing.trailing.front(), line.chord);
    own[line.wing] = std::min(own[line.wing], kOfNose * std::min(length, kDefaultNose * line.chord));
    chord[line.wing] = std::min(chord[line.wing], line.chord);
  }
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> edge_faces;
  t.edge_faces(offsets, edge_faces);
  for (std::size_t w = 0; w < wings.size(); ++w) {
    const auto is_own = [&](FaceId f) { return std::ranges::binary_search(wings[w].faces, f); };
    for (const FaceId wing_face : wings[w].faces)
      for (const EdgeId e : t.edges_of(wing_face))
        for (std::int32_t k = offsets[e]; k < offsets[e + 1]; ++k)
          if (const FaceId f = edge_faces[k]; is_own(f) || face_width(t, f) < kNarrow * chord[w])
            floors[f] = std::min(floors[f], own[w]);
  }
  return floors;
}

/// Curvature on and beside a lifting surface asks for no less than a share of what its nose gets: fillets and rounded
/// tips need no finer mesh than the nose does. Slots of flaps ask for what the nose gets at least, however small they
/// are beside the model. An lmin of a rule stays.
void set_floors(const ModelTables& t, const std::vector<LiftingSurface>& wings, const WingSizes& sizes,
                ModelLimits& limits) {
  const std::vector<double> floors = curvature_floors(t, wings, sizes, limits.chords);
  for (std::size_t f = 0; f < floors.size(); ++f)
    if (std::optional<SamplingLimits>& own = limits.face[f]; own && std::isfinite(floors[f]) && !own->has_own_min) {
      own->gap_floor = std::max(2 * floors[f], limits.min_length);
      own->min_length = std::clamp(floors[f], own->min_length, own->max_length);
    }
}

/// Boxes of all lifting surfaces; lowers the smallest length of `limits` to theirs.
void sample_wings(const RasterStageOptions& o, const Model& model, const std::vector<SizeRule>& rules,
                  std::span<const Strip> strips, double diagonal, double max_length, ModelLimits& limits,
                  Wings& wings) {
  const std::optional<LengthSpec> size = edge_size(o);
  if (!size || wings.aircraft.wings.empty()) return;
  std::vector<std::uint8_t> is_left_out = limits.edge_is_ruled;
  for (std::size_t e = 0; e < is_left_out.size(); ++e) is_left_out[e] |= !limits.edge[e];
  WingSizes sizes{*size, o.base_cells, {diagonal, model.tables().unit_in_m}, std::nullopt, o.cell_per_length};
  sizes.stretch = {o.max_aspect, max_length, radians(o.alpha_deg)};
  if (!o.lmin.empty()) sizes.least = parse_length(o.lmin, "--lmin");
  sizes.end_size = end_size(o);
  sizes.given = find_floors(rules, false, model.tables(), wings.edges, limits);
  const std::string unit = in_unit(model.tables().unit);
  warn_of_floor(o, wings.aircraft.wings, sizes, unit);
  std::optional<RaisedLength> most;
  for (const LiftingSurface& wing : wings.aircraft.wings) {
    const std::optional<RaisedLength> own = raster_wing(model, wing, sizes, strips, is_left_out, wings.boxes);
    if (own) note_raised(*own, most);
    wings.records.push_back(record_wing(wing, sizes, is_left_out, strips));
  }
  if (most)
    log_warning(
        fmt::format("the lmin of a rule is larger than what --edge-size {} asks for: {:.4g}{} instead of {:.4g}{} "
                    "where it matters most; give a smaller lmin there, or leave it out",
                    o.edge_size, most->floor, unit, most->asked, unit));
  for (const RasterBox& box : wings.boxes) limits.min_length = std::min<double>(limits.min_length, box.length);
  if (!sizes.least) set_floors(model.tables(), wings.aircraft.wings, sizes, limits);
}

void report_undercuts(const RasterArtifact& a) {
  if (a.undercuts.empty()) return;
  log_report(fmt::format(
      "  {} of {} samples are below the lmin given for them, down to {:.4g}{}, on narrower strips or bases: {}",
      count(a.undercuts), a.samples.size(), least_of(a.undercuts), in_unit(a.header.unit),
      undercut_text(a.undercuts, a.cause_names(), 1)));
}

nlohmann::ordered_json below_lmin_json(const RasterArtifact& a) {
  if (a.undercuts.empty()) return nullptr;
  constexpr std::size_t kPlaces = 3;
  nlohmann::ordered_json places = nlohmann::ordered_json::array();
  for (const Undercut& u : a.undercuts)
    if (places.size() < kPlaces) places.push_back({u.place.x, u.place.y, u.place.z});
  return {{"samples", count(a.undercuts)},
          {"least", least_of(a.undercuts)},
          {"places", places},
          {"causes", undercuts_json(a.undercuts, a.cause_names(), "samples", 1)}};
}

/// Loops of the faces that this rank sampled: they are asked for twice.
using FaceLoops = std::vector<std::optional<LoopPolygons>>;

/// The work cut into tasks: first batches of edges, then one task per face.
class RasterTasks {
 public:
  /// Keeps the loops that it traces in `loops` ([n_faces]).
  /// `seconds`: for each face.
  RasterTasks(const Model& model, const ModelLimits& limits, std::span<const Strip> strips, double seconds,
              FaceLoops& loops)
      : model_(model),
        limits_(limits),
        strips_(strips),
        seconds_(seconds),
        loops_(loops),
        vertex_edge_(first_edges(model.tables())),
        n_batches_((model.tables().n_edges() + kEdgesPerTask - 1) / kEdgesPerTask) {}

  std::int32_t count() const { return n_batches_ + model_.tables().n_faces(); }

  /// Heaviest first, by the number of largest lengths that fit on the face; ties by task.
  std::vector<std::int32_t> order() const {
    std::vector<double> work(static_cast<std::size_t>(count()), 0.0);
    for (std::int32_t f = 0; f < model_.tables().n_faces(); ++f)
      work[n_batches_ + f] = face_work(static_cast<std::size_t>(f));
    return heaviest_first(work);
  }

  /// Local. The boxes of one task; returns, packed, their number, what went wrong (empty: nothing) and the patches.
  Bytes compute(std::int32_t task, std::vector<RasterBox>& boxes) const {
    std::vector<GapPatch> patches;
    std::string failure;
    try {
      if (task < n_batches_)
        raster_edges(task, boxes);
      else
        raster_one_face(task - n_batches_, boxes, patches);
    } catch (const TooManyCells&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      boxes.clear();
      patches.clear();
      failure = task < n_batches_ ? fmt::format("edges from {} on", task * kEdgesPerTask + 1)
                                  : model_.tables().face_label(task - n_batches_);
      failure += std::string(": not sampled, ") + e.what();
    }
    Packer packer;
    packer.add(static_cast<std::uint64_t>(boxes.size()));
    packer.add(failure);
    packer.add(patches);
    return packer.take();
  }

 private:
  double face_work(std::size_t f) const {
    const ModelTables& t = model_.tables();
    if (!limits_.face[f]) return 0;
    const double flat = t.face_type[f] == SurfaceType::kPlane ? 1 : 10;
    return flat * t.face_area[f] / (limits_.face[f]->max_length * limits_.face[f]->max_length);
  }

  void raster_edges(std::int32_t batch, std::vector<RasterBox>& boxes) const {
    const EdgeId end = std::min((batch + 1) * kEdgesPerTask, model_.tables().n_edges());
    for (EdgeId e = batch * kEdgesPerTask; e < end; ++e) {
      const std::optional<SamplingLimits>& limits = limits_.edge[e];
      if (limits && !limits_.is_mere_split(e))
        raster_curve(*model_.curve(e), *limits, pack_cause(CauseKind::kEdge, e), boxes);
      raster_ends(e, boxes);
    }
  }

  /// Vertices that rules name, with the first edge that ends there as their cause.
  void raster_ends(EdgeId e, std::vector<RasterBox>& boxes) const {
    const ModelTables& t = model_.tables();
    const VertexId ends[2] = {t.edge_vertices[2 * e], t.edge_vertices[2 * e + 1]};
    for (int k = 0; k < (ends[0] == ends[1] ? 1 : 2); ++k) {
      const std::optional<SamplingLimits>& limits = limits_.vertex[ends[k]];
      if (!limits || vertex_edge_[ends[k]] != e) continue;
      const auto length = static_cast<float>(limits->max_length);
      const auto half = static_cast<float>(0.5 * limits->cell_per_length * limits->max_length);
      boxes.push_back({t.vertex_xyz[ends[k]], half, length, pack_cause(CauseKind::kEdge, e)});
    }
  }

  static std::vector<EdgeId> first_edges(const ModelTables& t) {
    std::vector<EdgeId> first(t.n_vertices(), kNone);
    for (EdgeId e = t.n_edges() - 1; e >= 0; --e) first[t.edge_vertices[2 * e]] = first[t.edge_vertices[2 * e + 1]] = e;
    return first;
  }

  void raster_one_face(FaceId f, std::vector<RasterBox>& boxes, std::vector<GapPatch>& patches) const {
    const CurrentWork at_face("face", f + 1, {seconds_, WhenLate::kThrow});
    const std::optional<SamplingLimits>& limits = limits_.face[f];
    if (!limits) return;
    const bool is_reversed = model_.tables().face_is_reversed[f] != 0;
    const std::size_t n_before = boxes.size();
    std::optional<ChordLimit> chord;
    if (limits_.face_wing[f] != kNone) chord.emplace(limits_.chords, limits_.face_wing[f], *limits->chord_cells);
    const Strip* strip = strip_of(f);
    SamplingLimits own = *limits;
    if (strip && strip->is_one_edge()) own.min_length = own.max_length;  // how it bends across tells nothing either
    raster_face(*model_.surface(f), loops_[f].emplace(loop_polygons(model_, f, limits_)), own,
                pack_cause(CauseKind::kFace, f), boxes, limits_.wants_gaps ? &patches : nullptr,
                chord ? &*chord : nullptr);
    if (is_reversed)
      for (std::size_t i = n_before; i < boxes.size(); ++i) boxes[i].normal = boxes[i].normal.reversed();
    for (GapPatch& patch : patches) {
      patch.solid = model_.tables().face_solid[f];
      patch.keeps_floor = limits->has_own_min;
      if (is_reversed != limits_.is_material_ahead) patch.flip();
    }
    if (strip && !limits_.edge_is_ruled[strip->edges[0]] && !limits_.edge_is_ruled[strip->edges[1]] &&
        !(limits_.is_mere_split(strip->edges[0]) && limits_.is_mere_split(strip->edges[1])))
      raster_strip(*strip, *limits, pack_cause(CauseKind::kFace, f), boxes);
  }

  /// Null where the face is none.
  const Strip* strip_of(FaceId f) const {
    const auto strip =
        std::lower_bound(strips_.begin(), strips_.end(), f, [](const Strip& s, FaceId id) { return s.face < id; });
    return strip != strips_.end() && strip->face == f ? &*strip : nullptr;
  }

  const Model& model_;
  const ModelLimits& limits_;
  std::span<const Strip> strips_;
  double seconds_;
  FaceLoops& loops_;
  std::vector<EdgeId> vertex_edge_;  // first edge at each vertex
  std::int32_t n_batches_;
};

/// The samples: boxes stay on the rank that made them, the rest is gathered on rank 0, by task.
struct Samples {
  std::vector<RasterBox> own_boxes;  // in any order
  std::vector<std::uint64_t> n_boxes;
  std::vector<std::string> failures;  // empty where there is none
  std::vector<std::vector<GapPatch>> patches;
};

/// Tasks of one rank run on several threads.
void append_locked(const std::vector<RasterBox>& boxes, std::mutex& mutex, std::vector<RasterBox>& all) {
  const std::lock_guard lock(mutex);
  all.insert(all.end(), boxes.begin(), boxes.end());
}

/// Collective. Throws TooManyCells beyond `max_samples`.
Samples sample_model(const RasterTasks& tasks, std::uint64_t max_samples, const Executor& comm) {
  Samples samples;
  const auto n = static_cast<std::size_t>(tasks.count());
  samples.n_boxes.resize(n);
  samples.failures.resize(n);
  samples.patches.resize(n);
  Progress progress("sampling", tasks.count());
  std::int32_t n_done = 0;
  std::uint64_t n_samples = 0;
  std::mutex mutex;
  comm.run_tasks(
      tasks.count(), tasks.order(),
      [&](std::int32_t task) {
        std::vector<RasterBox> boxes;
        Bytes result = tasks.compute(task, boxes);
        append_locked(boxes, mutex, samples.own_boxes);
        return result;
      },
      [&](std::int32_t task, Bytes&& result) {
        Unpacker unpacker(result);
        unpacker.get(samples.n_boxes[task]);
        require_samples(n_samples += samples.n_boxes[task], max_samples);
        unpacker.get(samples.failures[task]);
        unpacker.get(samples.patches[task]);
        progress.update(++n_done);
      });
  return samples;
}

/// No curve and no face may make more.
void limit_samples(std::uint64_t max_samples, ModelLimits& limits) {
  limits.far.max_samples = max_samples;
  for (auto* all : {&limits.face, &limits.edge})
    for (std::optional<SamplingLimits>& own : *all)
      if (own) own->max_samples = max_samples;
}

/// Collective. The patches of all faces on every rank, by task.
std::vector<GapPatch> share_patches(const Samples& samples, const Executor& comm) {
  std::vector<GapPatch> all;
  for (const std::vector<GapPatch>& p : samples.patches) all.insert(all.end(), p.begin(), p.end());
  share(comm, all);
  return all;
}

/// Collective. Boxes of gaps stay on the rank that made them, as the others do; returns their number on rank 0. Throws
/// TooManyCells beyond `max_samples`.
std::size_t sample_gaps(Samples& samples, double cell_per_length, std::uint64_t max_samples, const Executor& comm) {
  const std::vector<GapPatch> patches = share_patches(samples, comm);
  const GapFinder finder(patches, cell_per_length);
  require_countable(patches.size(), "samples that look for gaps");
  const auto n_tasks = static_cast<std::int32_t>((patches.size() + kPatchesPerTask - 1) / kPatchesPerTask);
  std::size_t n_boxes = 0;
  std::mutex mutex;
  Progress progress("looking for gaps", n_tasks);
  std::int32_t n_done = 0;
  comm.run_tasks(
      n_tasks, heaviest_first(std::vector<double>(static_cast<std::size_t>(n_tasks), 1.0)),
      [&](std::int32_t task) {
        std::vector<RasterBox> boxes;
        const std::size_t first = static_cast<std::size_t>(task) * kPatchesPerTask;
        for (std::size_t i = first; i < std::min(first + kPatchesPerTask, patches.size()); ++i)
          finder.add_boxes(i, boxes);
        append_locked(boxes, mutex, samples.own_boxes);
        Packer packer;
        packer.add(static_cast<std::uint64_t>(boxes.size()));
        return packer.take();
      },
      [&](std::int32_t, Bytes&& result) {
        std::uint64_t n = 0;
        Unpacker(result).get(n);
        require_samples(n_boxes += n, max_samples);
        progress.update(++n_done);
      });
  return n_boxes;
}

struct SampleCounts {
  std::size_t n_boxes = 0, n_failures = 0, n_gap_boxes = 0;
  DepthLimit depth;
};

/// Counts, and warns of what could not be sampled.
SampleCounts report_samples(const Samples& samples) {
  SampleCounts counts;
  counts.n_boxes = std::accumulate(samples.n_boxes.begin(), samples.n_boxes.end(), std::uint64_t{0});
  for (const std::string& failure : samples.failures) {
    if (failure.empty()) continue;
    log_warning(failure);
    ++counts.n_failures;
  }
  return counts;
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

/// Packed: the cells of a face, and why there are none.
Bytes locate(const Model& model, const OctreeShape& shape, const ModelLimits& limits, const FaceLoops& loops,
             double seconds, Vec3 origin, FaceId f) {
  const ModelTables& t = model.tables();
  if (t.is_joined(f)) return packed(std::vector<CellArea>(), std::string());
  const CurrentWork at_face("face", f + 1, {seconds, WhenLate::kThrow});
  std::vector<CellArea> cells;
  std::string failure;
  try {
    cells = locate_face(*model.surface(f), loops[f] ? *loops[f] : loop_polygons(model, f, limits), shape.view(),
                        t.face_area[f], origin);
  } catch (const LateWork& e) {
    failure = fmt::format("{}: its cells were not found, {}", t.face_label(f), e.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // reported when it was sampled
    cells.clear();
  }
  return packed(cells, failure);
}

/// Collective. Where in the octree each face lies, symmetry planes included; complete on rank 0.
/// `seconds`: for each face; one that takes longer is in no cell, warned of and counted in `n_failures`.
/// `meanwhile`: what rank 0 alone can do; it does that first, while the others take faces.
FaceCells locate_faces(const Model& model, const OctreeShape& shape, const ModelLimits& limits, const FaceLoops& loops,
                       double seconds, const std::function<void()>& meanwhile, const Executor& comm,
                       std::size_t& n_failures) {
  const ModelTables& t = model.tables();
  FaceCells faces;
  faces.origin = origin_of_places(t.box());
  std::vector<std::vector<CellArea>> by_face(static_cast<std::size_t>(t.n_faces()));
  Progress progress("locating faces", t.n_faces());
  std::int32_t n_done = 0;
  const std::int32_t other = t.n_faces();  // task
  std::vector<double> work = t.face_area;
  work.push_back(std::numeric_limits<double>::infinity());
  NamedTasks tasks{.order = heaviest_first(work), .label = {}, .made_from = "", .home = {}};
  tasks.label = [](std::int32_t task) { return TaskLabel{"task", task}; };
  tasks.home.assign(work.size(), kNone);
  tasks.home[other] = 0;
  comm.run_named_tasks(
      tasks,
      [&](std::int32_t task) {
        if (task < other) return locate(model, shape, limits, loops, seconds, faces.origin, task);
        meanwhile();
        return Bytes();
      },
      [&](std::int32_t f, Bytes&& result) {
        if (f == other) return;
        Unpacker unpacker(result);
        unpacker.get(by_face[f]);
        std::string failure;
        unpacker.get(failure);
        if (!failure.empty()) log_warning(failure);
        n_failures += !failure.empty();
        progress.update(++n_done);
      });
  for (const std::vector<CellArea>& cells : by_face) faces.append_face(cells);
  return faces;
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

/// Options of lifting surfaces that were set, by a preset perhaps: "--edge-size, --base-cells"; empty: none.
std::string wing_options(const RasterStageOptions& o) {
  const RasterStageOptions defaults;
  std::string set;
  const auto add = [&](bool is_set, const std::string& flag) {
    if (is_set) set += (set.empty() ? "" : ", ") + flag;
  };
  add(o.edge_size != defaults.edge_size && o.edge_size != "none", "--edge-size");
  add(o.base_cells != defaults.base_cells, "--base-cells");
  add(o.end_size != defaults.end_size, "--end-size");
  add(o.chord_cells != defaults.chord_cells, "--chord-cells");
  return set;
}

bool asks_for_wings(const RasterStageOptions& o) { return o.asks_for_wings || !wing_options(o).empty(); }

/// Who asks for lengths at trailing edges is told of those without; with -v they are all listed.
void report_unused(const RasterStageOptions& o, const Model& model, const FaceRoles& roles, const Wings& wings) {
  const std::string& unit = model.tables().unit;
  for (const UnusedTrailing& u : wings.unused)
    if (u.is_declared) log_warning(declared_warning(u));
  const bool is_asked = asks_for_wings(o);
  for (const std::string& line : unused_lines(wings.unused, kMostUnused, unit))
    is_asked ? log_report(line) : log_info(line);
  if (!is_asked) return;
  for (const std::string& warning :
       {unused_warning(wings.unused, roles.reference_diagonal, unit), noseless_warning(wings.aircraft.wings),
        sheet_warning(find_sheet_edges(model, roles)),
        seam_warning(find_seams_of_blades(model, roles, wings.aircraft.wings))})
    if (!warning.empty()) log_warning(warning);
}

/// One line for each lifting surface, or one that there is none.
void report_wings(const RasterStageOptions& o, const Wings& wings, const std::string& unit) {
  const std::size_t n = wings.aircraft.wings.size();
  if (const std::string set = wing_options(o); n == 0 && !set.empty())
    log_report("  no lifting surface found: without effect are " + set);
  else if (n == 0)
    log_info("no lifting surface found: --edge-size has no effect");
  for (std::size_t i = 0; i < std::min(n, kMostGroups); ++i)
    log_report(wing_line(wings.aircraft.wings[i], o.edge_size, unit));
  if (n > kMostGroups) log_report(fmt::format("  and {} more lifting surfaces", n - kMostGroups));
  if (const std::string used = used_line(n, wings.unused); n > 0 && !used.empty())
    log_report(used + (asks_for_wings(o) ? "" : "; -v names them"));
}

/// [n_edges] 1: a rule says that it is no trailing edge.
std::vector<std::uint8_t> edges_without_wing(const ModelTables& t, std::span<const DeclaredEdge> declared) {
  std::vector<std::uint8_t> is_excluded(static_cast<std::size_t>(t.n_edges()), 0);
  for (const DeclaredEdge& d : declared) is_excluded[d.edge] = d.meaning == EdgeMeaning::kNoTrailing;
  return is_excluded;
}

/// What the user asks for.
struct AskedLimits {
  const SamplingLimits& wall;
  const std::vector<SizeRule>& rules;
};

/// On rank 0, which knows lifting surfaces: samples them, and sets the limits of all else.
ModelLimits find_limits(const RasterStageOptions& o, const Model& model, const FaceRoles& roles,
                        std::span<const Strip> strips, const AskedLimits& asked, Wings& wings) {
  wings.aircraft.bodies = find_bodies(model, roles, wings.aircraft.wings);
  ModelLimits limits = model_limits(model.tables(), roles, asked.wall, asked.rules, wings.edges, wings.aircraft);
  sample_wings(o, model, asked.rules, strips, roles.reference_diagonal, asked.wall.max_length, limits, wings);
  return limits;
}

void require_places(const RasterStageOptions& o, const ModelLimits& limits) {
  if (limits.max_aspect > 1 && o.cell_per_length <= kStoredByCellUpTo)
    throw Error(ExitCode::kUsage,
                fmt::format("--max-aspect {:g} needs --cell-per-length above {:g}: smaller cells keep no directions",
                            limits.max_aspect, kStoredByCellUpTo));
}

/// Incomplete: the artifact is written, and says so.
ExitCode code_of(const RasterStageOptions& o, const SampleCounts& counts) {
  return counts.n_failures == 0 || o.allow_incomplete ? ExitCode::kOk : ExitCode::kIncomplete;
}

StageSummary summarize(const RasterStageOptions& o, const RasterArtifact& a, const SampleCounts& counts,
                       std::size_t n_rules, const Wings& wings, const std::vector<GroupSizes>& groups,
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
                                                  {"groups", sampled_json(groups, a.cause_names())},
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
    log_report("  rules select parts of joined faces: all faces are apart, as the CAD has them");
  return geometry;
}

/// The stage, step by step.
class RasterRun {
 public:
  RasterRun(const RasterStageOptions& o, const Communicator& comm, Progress& progress)
      : o_(o),
        comm_(comm),
        trace_(comm, o.trace),
        progress_(progress),
        sizes_(o.sizes.empty() ? SizeRuleFile() : read_size_rules(o.sizes)),
        geometry_(read_geometry_for(o.geometry, sizes_.rules)),
        rules_(all_rules(o, {rules_on_joined(sizes_.rules, geometry_), sizes_.hash}, geometry_.tables)),
        model_(same_model(comm)),
        roles_(face_roles(model_, trace_)),
        wall_(resolve_limits(o, model_.tables(), roles_.reference_diagonal)),
        strips_(find_strips(model_, trace_)),
        bases_(comm.is_root() ? find_base_strips(model_, strips_) : std::vector<Strip>()) {}

  StageSummary run() {
    if (comm_.is_root()) say_interfaces();
    progress_.step("lifting surfaces and limits", 0.1);
    set_limits();
    times_.end("opening");
    trace_.begin_phase("samples");
    progress_.step("samples", 0.2);
    sample();
    artifact_.numbers = {limits_.min_length, wall_.max_length,          limits_.far_length, o_.alpha_deg,
                         o_.cell_per_length, roles_.reference_diagonal, limits_.max_aspect};
    const bool has_surface = !o_.no_surface && has_coarse_surface(model_.tables());
    std::vector<CellLength> cells;  // on rank 0
    const auto meanwhile = [&] {
      artifact_.samples = merged_samples(std::move(samples_));
      if (has_surface) cells = prolong_openly(artifact_);
    };
    artifact_.faces = locate_faces(model_, artifact_.octree.shape, limits_, loops_, o_.time_limit, meanwhile, trace_,
                                   counts_.n_failures);
    times_.end("faces");
    trace_.begin_phase("surface");
    progress_.step("surface", 0.7);
    if (has_surface)
      artifact_.surface =
          make_coarse_surface(model_, roles_, artifact_, std::move(cells), strips_, o_.time_limit, trace_);
    times_.end("surface");
    trace_.begin_phase("write");
    times_.gather(comm_);
    if (comm_.is_root()) {
      progress_.step("writing", 0.9);
      warn_of_depth(counts_.depth, model_.tables().unit);
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

  Model same_model(const Communicator& comm) {
    require_same_inputs(comm, {{o_.geometry, geometry_.header.content_hash}, {o_.sizes, sizes_.hash}});
    return stored_model(geometry_, o_.geometry);
  }

  /// Returns whether holes may be vanes: worth a look where no wing is found, or holes lead through.
  bool find_wings() {
    std::vector<WingEdge> small;
    bool has_hollow = false;
    wings_.edges = find_wing_edges(model_, roles_, bases_, trace_, &small, &has_hollow);
    std::vector<DeclaredEdge> declared;
    if (comm_.is_root()) {
      declared = declared_edges(rules_, model_.tables(), bases_, wings_.edges);
      declare_edges(model_, roles_, bases_, declared, wings_.edges);
      std::vector<DeclaredEdge> named = declared;  // what the user says of an edge counts, however short it is
      for (DeclaredEdge& d : named) d.meaning = EdgeMeaning::kNoTrailing;
      declare_edges(model_, roles_, bases_, named, small);
    }
    std::vector<LiftingSurface>& wings = wings_.aircraft.wings;
    wings = find_lifting_surfaces(model_, roles_, wings_.edges, trace_, &wings_.unused, Noseless::kOfAircraft, small);
    const std::vector<std::uint8_t> is_excluded = edges_without_wing(model_.tables(), declared);
    add_round_tails(model_, roles_, wings_.edges, is_excluded, wings, trace_);
    if (comm_.is_root()) liken_blades(model_, is_excluded, wings, wings_.unused);
    bool may_be_vanes = has_hollow && (wings.empty() || has_through_holes(model_.tables()));
    share(trace_, may_be_vanes);
    return may_be_vanes;
  }

  void set_limits() {
    if (find_wings() && has_vanes(model_, roles_, bases_, trace_)) {
      roles_.is_passage = true;
      if (comm_.is_root()) log_report(kPassageLine);
      find_wings();
    }
    std::vector<std::uint8_t> is_smooth = find_smooth_edges(model_, trace_);
    if (comm_.is_root()) limits_ = find_limits(o_, model_, roles_, bases_, {wall_, rules_}, wings_);
    limits_.edge_is_smooth = std::move(is_smooth);
    share_limits(trace_, limits_);
    require_places(o_, limits_);
    budget_ = make_cell_budget(o_.max_cells, limits_, comm_);
    require_cells(least_cells(model_.tables(), limits_), budget_.max_cells);
    limit_samples(budget_.max_samples, limits_);
  }

  void sample() {
    loops_.resize(static_cast<std::size_t>(model_.tables().n_faces()));
    Samples samples =
        sample_model(RasterTasks(model_, limits_, strips_, o_.time_limit, loops_), budget_.max_samples, trace_);
    times_.end("sampling");
    if (comm_.is_root()) counts_ = report_samples(samples);
    counts_.n_boxes += wings_.boxes.size();
    std::vector<RasterBox>& boxes = samples.own_boxes;
    boxes.insert(boxes.end(), wings_.boxes.begin(), wings_.boxes.end());
    if (limits_.wants_gaps) counts_.n_gap_boxes = sample_gaps(samples, o_.cell_per_length, budget_.max_samples, trace_);
    times_.end("gaps");
    trace_.begin_phase("octree");
    const Box3 box = model_.tables().box();
    const Box3 root = choose_octree_box(box, model_.tables().wall_box(), boxes, limits_.far_length, comm_);
    artifact_.octree = build_common_octree(root, boxes, budget_.max_cells, comm_);
    counts_.depth = gather_depth_limit(find_depth_limit(root, boxes), comm_);
    if (o_.cell_per_length > kStoredByCellUpTo) samples_ = gather_samples(boxes, origin_of_places(box), comm_);
    times_.end("octree");
  }

  void write() {
    artifact_.n_not_sampled = static_cast<std::int64_t>(counts_.n_failures);
    artifact_.edge_name = model_.tables().edge_name;
    artifact_.labels = model_.tables().labels;
    artifact_.wings = std::move(wings_.records);
    const GivenFloors floors = find_floors(rules_, !o_.lmin.empty(), model_.tables(), wings_.edges, limits_);
    if (std::ranges::any_of(floors.face, [](double lmin) { return lmin > 0; })) artifact_.face_lmin = floors.face;
    artifact_.undercuts = sample_undercuts(artifact_.samples, floors);
    fill_header(o_, geometry_.header, wall_, sizes_.hash, artifact_.header);
    artifact_.header.content_hash = write_raster(o_.output, artifact_);
  }

  StageSummary report() const {
    report_wings(o_, wings_, artifact_.header.unit);
    report_unused(o_, model_, roles_, wings_);
    const std::vector<GroupSizes> groups = sampled_groups(artifact_);
    for (const std::string& line : sampled_lines(groups, artifact_.cause_names(), kMostGroups, artifact_.header.unit))
      log_report(line);
    report_undercuts(artifact_);
    return summarize(o_, artifact_, counts_, rules_.size(), wings_, groups, times_);
  }

  const RasterStageOptions& o_;
  const Communicator& comm_;
  TaskTrace trace_;
  Progress& progress_;
  PhaseTimes times_;
  const SizeRuleFile sizes_;
  GeometryArtifact geometry_;  // without the model
  const std::vector<SizeRule> rules_;
  const Model model_;
  FaceRoles roles_;
  const SamplingLimits wall_;
  const std::vector<Strip> strips_, bases_;  // the latter on rank 0 only
  Wings wings_;                              // rank 0 only
  ModelLimits limits_;
  CellBudget budget_;
  FaceLoops loops_;
  SampleCounts counts_;
  std::vector<std::vector<LengthSample>> samples_;  // by rank, on rank 0
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
  keep_freed_memory();
  o.validate();
  if (comm.is_root()) require_writable(o.output);
  if (comm.is_root() && !o.trace.empty()) require_writable(o.trace);
  Progress progress("st-raster", 1);
  progress.step("reading", 0);
  return RasterRun(o, comm, progress).run();
}

}  // namespace st
