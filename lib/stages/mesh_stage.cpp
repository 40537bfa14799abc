#include "stages/mesh_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/share.h"
#include "base/threads.h"
#include "geometry/model/sameness.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "meshing/engine/mesh_regions.h"
#include "meshing/engine/mirrored_mesh.h"
#include "sizing/mirrored_field.h"
#include "sizing/paired_field.h"
#include "stages/cell_budget.h"
#include "stages/expected_triangles.h"
#include "stages/fitting_files.h"
#include "stages/id_ranges.h"
#include "stages/joined_numbers.h"
#include "stages/pair_input.h"
#include "stages/patches_result.h"
#include "stages/resumption.h"
#include "stages/same_inputs.h"
#include "stages/stored_model.h"
#include "stages/task_trace.h"
#include "stages/wing_measure.h"

namespace st {
namespace {

constexpr double kLeastTile = 1000;  // triangles
constexpr int kMostPartings = 3;     // times that all is meshed again, each time with more composites apart

FaceId parse_face(std::string_view text, std::string_view all, FaceId n_faces) {
  FaceId id = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (status != std::errc() || end != text.data() + text.size() || id < 1 || id > n_faces)
    throw Error(ExitCode::kUsage,
                fmt::format("--faces '{}': '{}' is no face id from 1 to {}; write 12,17,30-40", all, text, n_faces));
  return id - 1;
}

/// "12,17,30-40" and a group's name as face ids, ascending; empty when neither is given.
std::vector<FaceId> select_faces(const MeshStageOptions& o, const ModelTables& t) {
  std::vector<char> chosen(t.n_faces(), 0);
  std::string_view rest = o.faces;
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view item = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    const std::size_t dash = item.find('-');
    const FaceId first = parse_face(item.substr(0, dash), o.faces, t.n_faces());
    const FaceId last =
        dash == std::string_view::npos ? first : parse_face(item.substr(dash + 1), o.faces, t.n_faces());
    if (last < first)
      throw Error(ExitCode::kUsage, fmt::format("--faces '{}': '{}' ends before it begins", o.faces, item));
    for (FaceId f = first; f <= last; ++f) chosen[f] = 1;
  }
  if (!o.group.empty()) {
    const std::vector<std::uint8_t> in_group = find_faces(o.group, t.labels);
    if (in_group.empty())
      throw Error(
          ExitCode::kUsage,
          fmt::format("--group '{}': the model has no such group of faces or part{}; st-info {} --groups lists them",
                      o.group, say_other_kind(o.group, t.labels), o.geometry));
    for (FaceId f = 0; f < t.n_faces(); ++f) chosen[f] |= in_group[f];
  }
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (chosen[f]) faces.push_back(f);
  return faces;
}

/// What an earlier part left, where there is one: its nodes on edges, and what it merged.
struct EarlierPart {
  EdgeMesh edges;
  MergedFeatures merged;
  std::string content_hash;
};

EarlierPart read_earlier_part(const MeshStageOptions& o, const ArtifactHeader& geometry) {
  if (o.edges.empty()) return {};
  PatchesArtifact earlier = read_patches(o.edges);
  require_same_geometry(o.geometry, geometry, o.edges, earlier.header);
  return {std::move(earlier.edges), std::move(earlier.merged), earlier.header.content_hash};
}

MeshPlan make_plan(const MeshStageOptions& o, const MeshTopology& topology, std::vector<FaceId> faces, EdgeMesh fixed,
                   std::vector<double> face_weight) {
  MeshPlan plan = plan_all(topology);
  if (!faces.empty() || !o.edges.empty())
    plan = plan_part(topology, faces.empty() ? std::move(plan.faces) : std::move(faces), std::move(fixed));
  plan.face_weight = std::move(face_weight);
  return plan;
}

/// Pairs are of faces that the CAD has.
GeometryArtifact read_geometry_for(const MeshStageOptions& o) {
  GeometryArtifact geometry = read_geometry(o.geometry);
  if (!o.pairs.empty() && part_joined_faces(geometry))
    log_report("  --pairs: composites are apart, as the CAD has them");
  return geometry;
}

void require_whole(const MeshStageOptions& o, const Mirror& mirror) {
  if (mirror.empty()) return;
  for (const auto& [name, value] : {std::pair{"--faces", &o.faces}, {"--group", &o.group}, {"--edges", &o.edges}})
    if (!value->empty())
      throw Error(ExitCode::kUsage,
                  fmt::format("{} meshes a part, and {} was imported with --mirror: leave one out", name, o.geometry));
  if (!o.pairs.empty())
    throw Error(ExitCode::kUsage, fmt::format("--pairs: {} was imported with --mirror: leave one out", o.geometry));
}

/// Collective. The topology with small features merged, in the same way on both sides of a mirror, and none on pairs,
/// whose vertices are images of one another.
MeshTopology make_topology(const Model& model, const SizeField& field, double below, const Mirror& mirror,
                           const PeriodicPairs& pairs, const Executor& executor) {
  MeshTopology topology = merge_small_features(model, field, below, executor);
  if (!pairs.empty()) {
    ModelTables placed = model.tables();
    placed.vertex_xyz = pairs.vertex_xyz();
    return MeshTopology(placed, without_paired(topology.merged(), pairs, placed));
  }
  return mirror.empty() ? topology : MeshTopology(model.tables(), mirrored(topology.merged(), mirror, model.tables()));
}

ArtifactHeader output_header(const MeshStageOptions& o, double tile_triangles, const ArtifactHeader& geometry,
                             const ArtifactHeader& sizing) {
  ArtifactHeader header;
  header.tool = "st-mesh";
  nlohmann::json options{{"faces", o.faces},
                         {"group", o.group},
                         {"enhance_rounds", o.enhance_rounds},
                         {"tile", tile_triangles},
                         {"merge_below", o.merge_below},
                         {"max_turning", o.max_turning_deg}};
  if (!o.pairs.empty()) options["pairs"] = o.pairs;
  header.options_json = json_text(options);
  header.inputs = {{"geometry", std::filesystem::path(o.geometry).filename().string(), geometry.content_hash},
                   {"sizing", std::filesystem::path(o.sizing).filename().string(), sizing.content_hash}};
  return header;
}

/// Collective. As write_patches_result(), with the other half of a mirrored model.
StageSummary write_result(const std::string& path, const Mirror& mirror, const ModelTables& tables,
                          const ArtifactHeader& geometry, const ArtifactHeader& header, const MeshTopology& topology,
                          MeshResult result, const RunFacts& facts, const Executor& executor) {
  if (mirror.empty())
    return write_patches_result(path, tables, geometry, header, topology, std::move(result), facts, executor);
  if (!executor.is_root()) return {};
  const ModelTables placed = add_image(mirror, tables, topology, result);
  return write_patches_result(path, placed, geometry, header, topology, std::move(result), facts, SerialExecutor());
}

/// Empty without pairs.
std::string hash_of(const std::vector<FacePair>& pairs) {
  if (pairs.empty()) return "";
  Hasher hasher;
  const Bytes bytes = packed(pairs);
  hasher.add(std::span(bytes));
  return hasher.hex();
}

/// Digest of what the results depend on.
std::string run_of(const ArtifactHeader& output, const EdgeMesh& earlier, const std::string& pairs) {
  Hasher hasher;
  hasher.add(std::string_view(pairs));
  hasher.add(std::string_view(output.options_json));
  for (const auto& input : output.inputs) hasher.add(std::string_view(input.hash));
  const Bytes edges = packed(earlier);
  hasher.add(std::span(edges));
  return hasher.hex();
}

/// The smaller of the lengths on both sides of a mirror or of pairs; null without either: the field as it is.
std::unique_ptr<SizeField> make_common_field(const SizeField& field, const Mirror& mirror, const PeriodicPairs& pairs,
                                             const ModelTables& t) {
  if (!mirror.empty()) return std::make_unique<MirroredField>(field, mirror);
  return make_paired_field(field, pairs, t);
}

/// Where noses and trailing edges of lifting surfaces are coarser than was asked for.
std::function<std::vector<RefinementPoint>(const SurfaceMesh&)> unheld_places(const std::string& sizing) {
  return [wings = read_asked_wings(sizing)](const SurfaceMesh& mesh) {
    std::vector<RefinementPoint> places;
    for (const UnheldPlace& p : find_unheld(mesh, wings)) places.push_back({.x = p.xyz, .radius = p.radius});
    return places;
  };
}

MeshOptions make_options(const MeshStageOptions& o, const SizeField& field, const Mirror& mirror,
                         double tile_triangles) {
  MeshOptions options{.enhance_rounds = o.enhance_rounds,
                      .max_turning_deg = o.max_turning_deg,
                      .merge_below = o.merge_below,
                      .tile_triangles = tile_triangles,
                      .time_limit = o.time_limit,
                      .when_late = WhenLate::kSignal,
                      .patches = mirror.empty() ? PatchesGo::kNowhere : PatchesGo::kToRoot};
  if (field.is_stretched()) options.find_unheld = unheld_places(o.sizing);
  return options;
}

/// A model as it was meshed.
struct Meshed {
  Composites composites;
  MeshTopology topology;
  MeshResult result;
};

/// Local, on rank 0. Faces without a mesh, triangles that fold, pairs that cross.
std::int64_t n_wrong(const MeshResult& r) {
  return static_cast<std::int64_t>(r.failures.size() + r.folds.size()) + r.n_crossing_pairs;
}

/// Local, on rank 0. Marks those of `all` that are faces of the mesh and something is wrong with.
void mark_wrong(const Meshed& m, const Composites& all, std::vector<std::uint8_t>& is_marked) {
  for (std::int32_t c = 0, own = 0; c < all.size() && own < m.composites.size(); ++c) {
    const FaceId face = all.members(c).front();
    if (m.composites.members(own).front() != face) continue;
    is_marked[c] |= std::ranges::binary_search(m.result.bad_faces, face) ? 1 : 0;
    ++own;
  }
}

/// One run of the stage on all ranks.
class MeshRun {
 public:
  /// Collective. Reads and compares all inputs. `o` and `comm` outlive the object.
  MeshRun(const MeshStageOptions& o, const Communicator& comm);
  /// Collective.
  StageSummary run();

 private:
  void read_sizes_and_model();
  Meshed mesh(const Model& model, Composites composites, Resumption& resumption);
  Meshed mesh_apart(const std::vector<std::uint8_t>& is_apart, Resumption& resumption);
  void part_wrong(Meshed& best, Resumption& resumption);

  const MeshStageOptions& o_;
  const Communicator& comm_;
  const Timer timer_;
  TaskTrace trace_;
  Progress progress_{"st-mesh", 1};
  GeometryArtifact geometry_;  // but for what model_ has
  std::vector<FaceId> faces_;  // chosen; empty: all
  std::optional<MappedSizing> sizing_;
  std::optional<Model> model_;
  EarlierPart earlier_;
  PeriodicPairs pairs_;
  double load_seconds_ = 0, tile_triangles_ = 0;
};

MeshRun::MeshRun(const MeshStageOptions& o, const Communicator& comm) : o_(o), comm_(comm), trace_(comm, o.trace) {
  o.validate();
  if (comm.is_root()) {
    require_patches_outputs(o.output);
    if (!o.trace.empty()) require_writable(o.trace);
  }
  progress_.step("reading", 0);
  require_fitting({{o.geometry, "geometry"}, {o.sizing, "sizing"}, {o.edges, "patches"}});
  geometry_ = read_geometry_for(o);
  require_whole(o, geometry_.mirror);
  read_sizes_and_model();
  faces_ = geometry_.mirror.empty()
               ? whole_faces(select_faces(o, model_->tables()), geometry_.composites, "--faces " + o.faces)
               : faces_to_mesh(geometry_.mirror);
  require_countable_mesh(model_->tables(), sizing_->face_weight, faces_, o.sizing,
                         most_triangles_in(memory_of_all_hosts(comm)));
  earlier_ = read_earlier_part(o, geometry_.header);
  pairs_ = read_pairs(o.pairs, *model_);
  require_same_inputs(comm, {{o.edges, earlier_.content_hash}, {o.pairs, hash_of(pairs_.pairs())}});
  tile_triangles_ = o.tile_triangles.value_or(usual_tile(expected_triangles(sizing_->face_weight)));
}

void MeshRun::read_sizes_and_model() {
  const Composites composites = geometry_.composites;
  run_jobs(
      {[&] { model_.emplace(stored_model(geometry_, o_.geometry)); }, [&] { sizing_.emplace(map_sizing(o_.sizing)); }});
  geometry_.composites = composites;
  if (are_of_cad_faces(sizing_->face_weight, composites)) {
    geometry_ = read_geometry(o_.geometry);
    model_.emplace(stored_cad(geometry_, o_.geometry));
  }
  require_same_inputs(comm_, {{o_.geometry, geometry_.header.content_hash}, {o_.sizing, sizing_->header.content_hash}});
  require_same_geometry(o_.geometry, geometry_.header, o_.sizing, sizing_->header);
}

Meshed MeshRun::mesh(const Model& model, Composites composites, Resumption& resumption) {
  const auto common_field = make_common_field(*sizing_->field, geometry_.mirror, pairs_, model.tables());
  const SizeField& field = common_field ? *common_field : *sizing_->field;
  progress_.step("small features", 0.05);
  MeshTopology topology = o_.edges.empty()
                              ? make_topology(model, field, o_.merge_below, geometry_.mirror, pairs_, trace_)
                              : MeshTopology(model.tables(), earlier_.merged);
  if (load_seconds_ == 0) load_seconds_ = timer_.seconds();
  progress_.step("meshing", 0.1);
  MeshOptions options = make_options(o_, field, geometry_.mirror, tile_triangles_);
  options.left_out = resumption.left_out();
  options.pairs = &pairs_;
  MeshPlan plan = make_plan(o_, topology, faces_, earlier_.edges, sizing_->face_weight);
  MeshResult result = mesh_regions(model, topology, field, std::move(plan), options, resumption);
  return {std::move(composites), std::move(topology), std::move(result)};
}

/// Collective. With the faces of composites that are marked apart.
Meshed MeshRun::mesh_apart(const std::vector<std::uint8_t>& is_apart, Resumption& resumption) {
  GeometryArtifact geometry = read_geometry(o_.geometry);
  part_joined_faces(geometry, is_apart);
  Composites composites = geometry.composites;
  const Model model = stored_model(geometry, o_.geometry);
  return mesh(model, std::move(composites), resumption);
}

/// Collective. Where composites cannot be meshed: the faces of the CAD instead, unless more is wrong with them. What
/// else is joined stays so. A part has to fit other parts, so its faces stay joined.
void MeshRun::part_wrong(Meshed& best, Resumption& resumption) {
  if (!faces_.empty() || !o_.edges.empty()) return;
  const Composites& all = geometry_.composites;
  std::vector<std::uint8_t> is_apart(static_cast<std::size_t>(all.size()), 0), marked = is_apart, of_best = is_apart;
  if (comm_.is_root()) mark_wrong(best, all, marked);
  for (int i = 0; i < kMostPartings; ++i) {
    share(trace_, marked);
    if (marked == is_apart) break;
    is_apart = marked;
    log_info(fmt::format("{} of {} composites fail, fold or cross: the faces of the CAD are meshed there",
                         std::ranges::count(is_apart, 1), all.size()));
    Meshed apart = mesh_apart(is_apart, resumption);
    if (comm_.is_root()) mark_wrong(apart, all, marked);
    char is_better = comm_.is_root() && n_wrong(apart.result) < n_wrong(best.result);
    share(trace_, is_better);
    if (!is_better) continue;
    best = std::move(apart);
    of_best = is_apart;
  }
  for (std::int32_t c = 0; comm_.is_root() && c < all.size(); ++c) {
    std::vector<std::int32_t> numbers(all.members(c).begin(), all.members(c).end());
    for (std::int32_t& n : numbers) ++n;
    if (of_best[c])
      log_report(fmt::format("  faces {} could not be meshed as one: they are apart", id_ranges(numbers)));
  }
}

StageSummary MeshRun::run() {
  const ArtifactHeader header = output_header(o_, tile_triangles_, geometry_.header, sizing_->header);
  Resumption resumption(trace_, o_.output, run_of(header, earlier_.edges, hash_of(pairs_.pairs())),
                        {o_.journal_after, o_.begins_new});
  Meshed meshed = mesh(*model_, geometry_.composites, resumption);
  part_wrong(meshed, resumption);
  resumption.end();
  trace_.begin_phase("write");
  progress_.step("writing", 0.9);
  StageSummary summary = write_result(o_.output, geometry_.mirror, meshed.topology.tables(), geometry_.header, header,
                                      meshed.topology, std::move(meshed.result),
                                      {timer_, load_seconds_, comm_.size(), resumption.n_tasks(),
                                       resumption.n_resumed(), nlohmann::json::object(), meshed.composites},
                                      trace_);
  if (comm_.is_root()) resumption.remove();
  trace_.write();
  return summary;
}

}  // namespace

void MeshStageOptions::validate() const {
  if (!pairs.empty() && !(faces.empty() && group.empty() && edges.empty()))
    throw Error(ExitCode::kUsage, "--pairs: meshes both sides at once; leave out --faces, --group and --edges");
  kEnhanceRounds.require(enhance_rounds);
  kMergeBelow.require(merge_below);
  kMaxTurning.require(max_turning_deg);
  if (!tile_triangles) return;
  kTile.require(*tile_triangles);
  if (*tile_triangles > 0 && *tile_triangles < kLeastTile)
    throw Error(ExitCode::kUsage, fmt::format("--tile {}: tiles below {} triangles are mostly seams; give more, or 0",
                                              *tile_triangles, kLeastTile));
}

StageSummary run_mesh(const MeshStageOptions& o, const Communicator& comm) { return MeshRun(o, comm).run(); }

}  // namespace st
