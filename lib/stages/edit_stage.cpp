#include "stages/edit_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/length.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/similarity.h"
#include "base/text.h"
#include "geometry/import/import.h"
#include "geometry/model/bodies.h"
#include "geometry/model/edit_model.h"
#include "geometry/model/joined_tables.h"
#include "geometry/model/model_state.h"
#include "geometry/model/unused_labels.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/artifact.h"
#include "judge/part_crossings.h"
#include "judge/same_place.h"
#include "stages/carried_composites.h"
#include "stages/edit_names.h"
#include "stages/edit_provenance.h"
#include "stages/edit_trace.h"
#include "stages/stored_model.h"

namespace st {
namespace {

/// What is remembered of the inputs once their models are put together.
struct EditInputs {
  std::vector<std::string> names;
  std::vector<InputRef> files;
  std::vector<std::vector<ImportFinding>> findings;
  std::vector<JoinedInput> joined;
  bool are_closed = true;
};

/// A model on its way through the edits.
struct Edited {
  Model model;
  EditTrace trace;
  std::vector<Similarity> motion;           ///< [n_faces] so far
  std::vector<std::vector<int>> placement;  ///< [n_faces] input, then the transforms that moved it

  const ModelTables& tables() const { return model.tables(); }
};

/// One --transform and the faces that it moves.
struct Move {
  Similarity motion;
  std::vector<FaceId> faces;
};

/// The result's tables, and what is to be said of it.
struct EditResult {
  ModelTables tables;
  EdgeUses uses;
  bool is_closed = false;
  PartCrossings crossings;
  SamePlaces same;
  std::vector<std::string> faults;    ///< in words; errors with --require-valid
  std::vector<std::string> warnings;  ///< likewise, but no errors
};

std::vector<FaceId> all_faces(std::int32_t n) {
  std::vector<FaceId> faces(n);
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

std::vector<Similarity> parse_transforms(const EditStageOptions& o) {
  if (!o.of.empty() && o.of.size() != o.transforms.size())
    throw Error(ExitCode::kUsage, fmt::format("--of is given {} times, --transform {} times; give one --of for each "
                                              "--transform, or none to move everything",
                                              o.of.size(), o.transforms.size()));
  std::vector<Similarity> motions;
  for (const std::string& steps : o.transforms) motions.push_back(parse_similarity(steps, "--transform"));
  return motions;
}

void require_same_unit(const std::string& path_a, const ModelTables& a, const std::string& path_b,
                       const ModelTables& b) {
  if (a.unit == b.unit && a.unit_in_m == b.unit_in_m) return;
  const auto unit = [](const ModelTables& t) {
    return t.unit.empty() ? std::string("has no unit") : "is in " + t.unit;
  };
  throw Error(ExitCode::kMismatch,
              fmt::format("{} {}, {} {}; import both with the same --unit", path_a, unit(a), path_b, unit(b)));
}

/// All inputs side by side.
Edited put_together(const EditStageOptions& o, EditInputs& inputs) {
  std::vector<GeometryArtifact> artifacts;
  for (const std::string& path : o.geometries) {
    GeometryArtifact& a = artifacts.emplace_back(read_geometry(path));
    inputs.joined.push_back({a.cad, a.composites});
    part_joined_faces(a);
  }
  inputs.names = input_names(o.as, o.geometries, artifacts);
  const std::vector<std::string> join = split_names(o.join);
  require_join_names(join, artifacts);
  EditTrace trace;
  std::optional<Model> all;
  std::vector<std::vector<int>> placement;
  for (std::size_t i = 0; i < artifacts.size(); ++i) {
    GeometryArtifact& a = artifacts[i];
    inputs.files.push_back(
        {"geometry", std::filesystem::path(o.geometries[i]).filename().string(), a.header.content_hash});
    inputs.findings.push_back(std::move(a.findings));
    inputs.are_closed = inputs.are_closed && a.is_closed;
    if (artifacts.size() > 1) label_input(inputs.names[i], a.tables);
    if (all) require_same_unit(o.geometries[0], all->tables(), o.geometries[i], a.tables);
    if (all) keep_names_apart(all->tables(), inputs.names[i], join, a.tables);
    trace.append(a.tables, static_cast<std::int32_t>(i));
    placement.resize(trace.faces.size(), {static_cast<int>(i)});
    Model model = stored_cad(a, o.geometries[i]);
    all = all ? append(*all, model) : std::move(model);
  }
  return {std::move(*all), std::move(trace), std::vector<Similarity>(placement.size()), std::move(placement)};
}

/// What --extract and --remove leave.
std::vector<FaceId> faces_to_keep(const EditStageOptions& o, const ModelTables& t) {
  std::vector<FaceId> faces = o.extract.empty() ? all_faces(t.n_faces()) : select_faces(o.extract, t, "--extract");
  if (o.remove.empty()) return faces;
  const std::vector<FaceId> gone = select_faces(o.remove, t, "--remove");
  std::erase_if(faces, [&](FaceId f) { return std::binary_search(gone.begin(), gone.end(), f); });
  if (faces.empty()) throw Error(ExitCode::kUsage, fmt::format("--remove '{}': nothing would be left", o.remove));
  return faces;
}

/// Faces by their numbers among those that are kept. Transforms that move everything become one.
std::vector<Move> resolve_moves(const EditStageOptions& o, const ModelTables& t, const std::vector<FaceId>& kept) {
  std::vector<Move> moves;
  const std::vector<Similarity> motions = parse_transforms(o);
  if (o.of.empty()) {
    Similarity all;
    for (const Similarity& motion : motions) all = all.then(motion);
    moves.push_back({all, all_faces(static_cast<std::int32_t>(kept.size()))});
  }
  for (std::size_t k = 0; k < o.of.size(); ++k) {
    const std::vector<FaceId> wanted = select_faces(o.of[k], t, "--of");
    std::vector<FaceId> faces;
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (std::binary_search(wanted.begin(), wanted.end(), kept[i])) faces.push_back(static_cast<FaceId>(i));
    if (faces.empty())
      throw Error(
          ExitCode::kUsage,
          fmt::format("--of '{}': --extract or --remove took all of it away; nothing is left to move", o.of[k]));
    moves.push_back({motions[k], std::move(faces)});
  }
  std::erase_if(moves, [](const Move& m) { return m.motion == Similarity(); });
  return moves;
}

void take_out(const std::vector<FaceId>& kept, Edited& e) {
  if (kept.size() == static_cast<std::size_t>(e.tables().n_faces())) return;
  SubModel part = extract(e.model, kept);
  e.model = std::move(part.model);
  e.trace.select(part.faces, part.edges, part.vertices);
  std::vector<std::vector<int>> placement;
  for (const FaceId f : kept) placement.push_back(std::move(e.placement[f]));
  e.placement = std::move(placement);
  e.motion.resize(kept.size());
}

/// What st-import would refuse is not made here either.
void require_in_range(const Move& move, const ModelTables& t) {
  constexpr double kLeastDiagonal = 1e-9;  // model unit
  Box3 box;
  for (const FaceId f : move.faces) {
    const Vec3 lo = t.face_box[f].lo, hi = t.face_box[f].hi;
    for (int corner = 0; corner < 8; ++corner)
      box.add(move.motion({corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z}));
  }
  const auto is_far = [](Vec3 x) {
    return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) > kLargestCoordinate;
  };
  if (is_far(box.lo) || is_far(box.hi) || box.diagonal() < kLeastDiagonal)
    throw Error(ExitCode::kUsage,
                fmt::format("--transform: the model would reach from ({:.4g} {:.4g} {:.4g}) to ({:.4g} {:.4g} {:.4g}); "
                            "coordinates are at most 1e12, and models no smaller than 1e-9",
                            box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z));
}

void apply(const Move& move, int number, Edited& e) {
  require_in_range(move, e.tables());
  if (move.faces.size() == static_cast<std::size_t>(e.tables().n_faces())) {
    e.model = transform(e.model, move.motion);
  } else {
    SubModel moved = transform_faces(e.model, move.faces, move.motion);
    e.model = std::move(moved.model);
    e.trace.select(moved.faces, moved.edges, moved.vertices);
  }
  for (const FaceId f : move.faces) {
    e.motion[f] = e.motion[f].then(move.motion);
    e.placement[f].push_back(number);
  }
}

/// [n_faces] equal for faces that came and moved together.
std::vector<std::int32_t> placement_numbers(const std::vector<std::vector<int>>& placement) {
  std::map<std::vector<int>, std::int32_t> number;
  for (const std::vector<int>& p : placement) number.emplace(p, static_cast<std::int32_t>(number.size()));
  std::vector<std::int32_t> numbers;
  for (const std::vector<int>& p : placement) numbers.push_back(number.at(p));
  return numbers;
}

/// [n_faces] equal for faces of one body that came and moved together.
std::vector<std::int32_t> parts_of(const Edited& e) {
  std::map<std::pair<std::vector<int>, std::int32_t>, std::int32_t> number;
  const std::vector<std::int32_t> body = bodies_of(e.tables());
  std::vector<std::int32_t> parts;
  for (std::size_t f = 0; f < body.size(); ++f)
    parts.push_back(
        number.emplace(std::pair(e.placement[f], body[f]), static_cast<std::int32_t>(number.size())).first->second);
  return parts;
}

/// A face with the input that it is of: "face 17 of engine".
std::string label_of(const Edited& e, const EditInputs& inputs, FaceId f) {
  const std::string label = e.tables().face_label(f);
  return inputs.names.size() > 1 ? fmt::format("{} of {}", label, inputs.names[e.placement[f].front()]) : label;
}

/// Pairs in words, the first kPairsNamed.
std::string list_of(const std::vector<std::string>& pairs) {
  constexpr std::size_t kPairsNamed = 20;
  const std::size_t n = std::min(pairs.size(), kPairsNamed);
  return fmt::format("{}{}", fmt::join(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(n), "; "),
                     pairs.size() > n ? fmt::format("; and {} more pairs", pairs.size() - n) : "");
}

/// All pairs of parts that cross, with a place each.
std::string describe_crossings(const Edited& e, const EditInputs& inputs, const PartCrossings& crossings) {
  std::vector<std::string> pairs;
  std::set<std::pair<std::int32_t, std::int32_t>> known;
  const std::vector<std::int32_t> part = parts_of(e);
  for (const PartCrossing& c : crossings.found)
    if (known.insert(std::minmax(part[c.first], part[c.second])).second)
      pairs.push_back(fmt::format("{} passes through {} at ({:.6g}, {:.6g}, {:.6g})", label_of(e, inputs, c.first),
                                  label_of(e, inputs, c.second), c.xyz.x, c.xyz.y, c.xyz.z));
  const std::size_t n_more = crossings.found.size() - pairs.size();
  return fmt::format("parts cross: {}{}", list_of(pairs),
                     n_more > 0 ? fmt::format("; and {} more pairs of faces", n_more) : "");
}

/// Bodies that are there twice; of faces that are only those of no such body.
void describe_same_places(const Edited& e, const EditInputs& inputs, EditResult& r) {
  std::vector<std::string> bodies, faces;
  std::set<std::pair<std::int32_t, std::int32_t>> known;
  const std::vector<std::int32_t> part = parts_of(e);
  for (const auto& [a, b] : r.same.bodies) {
    known.insert(std::minmax(part[a], part[b]));
    bodies.push_back(
        fmt::format("that of {} is at the place of that of {}", label_of(e, inputs, b), label_of(e, inputs, a)));
  }
  for (const auto& [a, b] : r.same.faces)
    if (!known.contains(std::minmax(part[a], part[b])))
      faces.push_back(fmt::format("{} and {}", label_of(e, inputs, a), label_of(e, inputs, b)));
  if (!bodies.empty())
    r.faults.push_back(
        fmt::format("bodies that are there twice: {}; their meshes would lie on each other: leave one out "
                    "(--remove), or move it (--transform)",
                    list_of(bodies)));
  if (!faces.empty())
    r.warnings.push_back(
        fmt::format("faces lie on each other and would be meshed twice: {}; leave one of each out "
                    "(--remove) where the parts are to be one",
                    list_of(faces)));
}

EditResult judge(const Edited& e, const EditInputs& inputs) {
  EditResult r;
  r.tables = e.tables();
  drop_unused(r.tables);
  const double scale = e.motion.front().scale;
  const bool scaled_as_one =
      std::all_of(e.motion.begin(), e.motion.end(), [&](const Similarity& m) { return m.scale == scale; });
  if (scaled_as_one && scale != 1) scale_tolerances(scale, r.tables.labels);
  r.uses = report_edge_uses(r.tables);
  r.is_closed = is_closed(r.tables, r.uses);
  if (!r.is_closed)
    r.tables.volume.reset();
  else if (!r.tables.volume && r.uses.n_nonmanifold == 0)
    r.tables.volume = enclosed_volume(e.model);
  if (!r.is_closed && inputs.are_closed)
    r.faults.push_back(fmt::format("open where it was closed: {} free edges", r.uses.n_free));
  FaceParts parts{placement_numbers(e.placement), parts_of(e)};
  r.same = find_same_places(e.model, parts.placement);
  for (const auto& [a, b] : r.same.bodies) parts.left_out.insert(std::minmax(parts.part[a], parts.part[b]));
  describe_same_places(e, inputs, r);
  r.crossings = find_part_crossings(e.model, parts);
  if (!r.crossings.found.empty()) r.faults.push_back(describe_crossings(e, inputs, r.crossings));
  return r;
}

/// Warnings; with --require-valid an error.
void say(const EditStageOptions& o, const EditResult& r) {
  if (o.require_valid && !r.is_closed && r.faults.empty())
    throw Error(ExitCode::kGeometry, fmt::format("{}: open: {} free edges; close it, or leave out --require-valid",
                                                 o.output, r.uses.n_free));
  if (o.require_valid && !r.faults.empty())
    throw Error(ExitCode::kGeometry, fmt::format("{}: {}; nothing written", o.output, fmt::join(r.faults, "; ")));
  for (const std::vector<std::string>* all : {&r.faults, &r.warnings})
    for (const std::string& text : *all) log_warning(fmt::format("{}: {}", o.output, text));
  const PartCrossings& c = r.crossings;
  if (c.n_left > 0)
    log_warning(
        fmt::format("{}: {} pairs of close faces were not examined for crossings; st-check finds crossings in the mesh",
                    o.output, c.n_left));
}

std::vector<ImportFinding> findings_of(const Edited& e, const EditInputs& inputs, const EditResult& r) {
  std::vector<ImportFinding> findings = carry_findings(inputs.findings, e.trace, r.tables, e.motion);
  findings.insert(findings.end(), r.uses.findings.begin(), r.uses.findings.end());
  for (const PartCrossing& c : r.crossings.found)
    for (const FaceId f : {c.first, c.second})
      findings.push_back({FindingKind::kCrossingPart, r.tables.face_label(f), c.xyz, c.size, false});
  for (const auto& [a, b] : r.same.faces) {
    const Box3& box = r.tables.face_box[b];
    findings.push_back({FindingKind::kOther, r.tables.face_label(b), box.center(), box.diagonal(), false,
                        fmt::format("face at the place of one of another part: {}", r.tables.face_label(a))});
  }
  return findings;
}

std::string write(const EditStageOptions& o, const EditInputs& inputs, const Edited& e, const EditResult& r) {
  GeometryArtifact g;
  g.header.tool = "st-edit";
  g.header.tool_version = ST_VERSION;
  g.header.options_json = edit_options_json(o);
  g.header.inputs = inputs.files;
  g.tables = r.tables;
  g.brep = e.model.brep();
  g.findings = findings_of(e, inputs, r);
  g.is_closed = r.is_closed;
  g.previous_faces = previous_ids(e.trace.faces);
  g.previous_edges = previous_ids(e.trace.edges);
  g.previous_vertices = previous_ids(e.trace.vertices);
  int n_left = 0;
  g.composites = carry_composites(inputs.joined, e.trace, e.model, e.motion, n_left);
  if (n_left > 0)
    log_report(
        fmt::format("  {} composites are apart: some of their faces are gone, were mirrored, or "
                    "moved on their own",
                    n_left));
  if (!g.composites.empty()) g.cad = std::exchange(g.tables, join_tables(g.tables, g.composites).tables);
  return write_geometry(o.output, g);
}

nlohmann::ordered_json inputs_json(const EditInputs& inputs, const EditTrace& trace) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < inputs.files.size(); ++i) {
    const auto is_of = [&](const Origin& o) { return o.input == static_cast<std::int32_t>(i); };
    list.push_back({{"name", inputs.names[i]},
                    {"file", inputs.files[i].name},
                    {"hash", inputs.files[i].hash},
                    {"faces", std::count_if(trace.faces.begin(), trace.faces.end(), is_of)}});
  }
  return list;
}

nlohmann::ordered_json pairs_json(const std::vector<std::pair<FaceId, FaceId>>& pairs) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [a, b] : pairs) list.push_back({a + 1, b + 1});
  return list;
}

nlohmann::ordered_json crossings_json(const EditResult& r) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const PartCrossing& c : r.crossings.found)
    list.push_back({{"faces", {c.first + 1, c.second + 1}}, {"xyz", {c.xyz.x, c.xyz.y, c.xyz.z}}, {"size", c.size}});
  return list;
}

StageSummary summarize(const EditStageOptions& o, const EditInputs& inputs, const Edited& e, const EditResult& r,
                       const std::string& hash, double seconds) {
  const ModelTables& t = r.tables;
  const double area = std::accumulate(t.face_area.begin(), t.face_area.end(), 0.0);
  const auto n_moved =
      std::count_if(e.motion.begin(), e.motion.end(), [](const Similarity& m) { return m != Similarity(); });
  StageSummary s;
  s.line = fmt::format(
      "{}: {} of {}, {} moved, {}, {}, area {:.6g}{}{}, {:.2f} s", o.output, counted(t.n_faces(), "face"),
      counted(inputs.files.size(), "geometry", "geometries"), n_moved, counted(t.n_edges(), "edge"),
      r.is_closed ? "closed" : fmt::format("open ({})", counted(r.uses.n_free, "free edge")), area, in_unit(t.unit, 2),
      t.volume ? fmt::format(", volume {:.6g}{}", *t.volume, in_unit(t.unit, 3)) : "", seconds);
  const nlohmann::ordered_json json = {
      {"tool", "st-edit"},
      {"output", o.output},
      {"inputs", inputs_json(inputs, e.trace)},
      {"faces", t.n_faces()},
      {"edges", t.n_edges()},
      {"vertices", t.n_vertices()},
      {"groups", t.labels.group_name.size()},
      {"parts", t.labels.part_path.size()},
      {"solids", t.n_solids},
      {"moved_faces", n_moved},
      {"closed", r.is_closed},
      {"free_edges", r.uses.n_free},
      {"nonmanifold_edges", r.uses.n_nonmanifold},
      {"crossings", crossings_json(r)},
      {"same_bodies", pairs_json(r.same.bodies)},
      {"same_faces", pairs_json(r.same.faces)},
      {"pairs_not_compared", r.crossings.n_left},
      {"area", area},
      {"volume", t.volume ? nlohmann::ordered_json(*t.volume) : nlohmann::ordered_json(nullptr)},
      {"hash", hash},
      {"seconds", seconds}};
  s.json = json_text(json);
  return s;
}

}  // namespace

StageSummary run_edit(const EditStageOptions& o) {
  const Timer timer;
  parse_transforms(o);  // before hours of reading
  require_writable(o.output);
  Progress progress("st-edit", 1);
  progress.step("reading", 0);
  EditInputs inputs;
  Edited edited = put_together(o, inputs);
  const std::vector<FaceId> kept = faces_to_keep(o, edited.tables());
  const std::vector<Move> moves = resolve_moves(o, edited.tables(), kept);
  progress.step("moving", 0.4);
  take_out(kept, edited);
  for (std::size_t k = 0; k < moves.size(); ++k) apply(moves[k], static_cast<int>(k), edited);
  progress.step("comparing parts", 0.6);
  const EditResult result = judge(edited, inputs);
  say(o, result);
  progress.step("writing", 0.9);
  const std::string hash = write(o, inputs, edited, result);
  return summarize(o, inputs, edited, result, hash, timer.seconds());
}

}  // namespace st
