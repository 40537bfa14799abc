#include "stages/patches_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "base/share.h"
#include "base/text.h"
#include "base/threads.h"
#include "geometry/model/joined_tables.h"
#include "io/file/json_text.h"
#include "io/file/output_files.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/failure_artifact.h"
#include "io/hdf5/patches_writer.h"

namespace st {
namespace {

nlohmann::json failure_json(const ModelTables& t, const FaceFailure& f) {
  return {{"face", f.face + 1},
          {"name", t.labels.face_name[f.face]},
          {"cause", f.cause},
          {"remedy", f.remedy},
          {"is_closed", f.is_closed},
          {"deviation", f.deviation},
          {"xyz", {f.xyz.x, f.xyz.y, f.xyz.z}}};
}

/// Where the first of them is, for the one line on standard error.
std::string first_of(const ModelTables& t, const MergedFeatures& m) {
  const auto at = [](const std::string& label, Vec3 x) {
    return fmt::format("; first {} near ({:.6g}, {:.6g}, {:.6g})", label, x.x, x.y, x.z);
  };
  if (!m.strip_face.empty()) return at(t.face_label(m.strip_face[0]), t.face_box[m.strip_face[0]].center());
  return at(t.edge_label(m.edge[0]), t.vertex_xyz[t.edge_vertices[2 * m.edge[0]]]);
}

/// Ids 1-based, as in messages.
nlohmann::json merged_json(const ModelTables& t, const MergedFeatures& m, const std::vector<FaceId>& closed) {
  nlohmann::json edges = nlohmann::json::array(), strips = nlohmann::json::array();
  for (const EdgeId e : m.edge) {
    const Vec3 x = t.vertex_xyz[t.edge_vertices[2 * e]];
    edges.push_back(
        {{"edge", e + 1}, {"name", t.edge_name[e]}, {"length", t.edge_length[e]}, {"xyz", {x.x, x.y, x.z}}});
  }
  for (std::size_t s = 0; s < m.strip_face.size(); ++s) {
    const FaceId f = m.strip_face[s];
    const Vec3 x = t.face_box[f].center();
    strips.push_back({{"face", f + 1},
                      {"name", t.labels.face_name[f]},
                      {"mean_width", t.face_area[f] / t.edge_length[m.strip_kept[s]]},
                      {"kept_edge", m.strip_kept[s] + 1},
                      {"closed_edge", m.strip_closed[s] + 1},
                      {"whole_face", std::binary_search(closed.begin(), closed.end(), f)},
                      {"xyz", {x.x, x.y, x.z}}});
  }
  return {{"edges", edges}, {"strips", strips}};
}

/// Beside the patches: what the faces that could not be meshed look like; an earlier run's is removed when all were.
/// Returns its path, or "".
std::string write_failed_faces(const std::string& patches, const ArtifactHeader& header, const ModelTables& t,
                               const MeshResult& r) {
  const std::string path = failures_path(patches);
  if (r.failures.empty()) {
    remove_failures(path);
    return "";
  }
  write_failures(path, {header, r.failures, r.attempts, t.labels.face_name});
  return path;
}

ArtifactHeader complete(ArtifactHeader header, const ArtifactHeader& geometry) {
  header.schema = "patches";
  header.tool_version = ST_VERSION;
  header.unit = geometry.unit;
  header.unit_in_m = geometry.unit_in_m;
  header.geometry_hash = geometry.content_hash;
  return header;
}

/// The patches of all faces that have triangles.
std::vector<PatchCounts> counts_of(const MeshResult& r) {
  std::vector<PatchCounts> counts;
  if (r.places.empty())
    for (const FacePatch& p : r.patches)
      if (!p.triangles.empty()) counts.push_back(st::counts_of(p));
  for (std::size_t f = 0; f < r.places.size(); ++f) {
    if (r.places[f].empty()) continue;
    const PatchPlace& last = r.places[f].back();
    counts.push_back({static_cast<FaceId>(f), last.n_boundary, last.inner_begin + last.n_inner,
                      last.triangle_begin + last.n_triangles, last.own_uv_begin + last.n_own_uv});
  }
  return counts;
}

/// Local, on each rank: its patches into their places. What went wrong, or nothing.
std::string write_own_patches(const PatchTarget& target, const MeshResult& r) {
  try {
    PatchRowsFile rows(target);
    parallel_for(r.patches.size(), 1, [&](std::size_t i, std::size_t) {
      const auto patch = std::lower_bound(target.face.begin(), target.face.end(), r.patches[i].face);
      rows.write(static_cast<std::size_t>(patch - target.face.begin()), r.patches[i], r.own_places[i]);
    });
    rows.close();
  } catch (const Error& e) {
    if (e.code() != ExitCode::kOutput) throw;
    return e.what();
  }
  return "";
}

/// Collective. Returns the content hash on rank 0.
std::string write_everywhere(const std::string& path, const PatchesArtifact& rest,
                             const std::vector<PatchCounts>& counts, const MeshResult& result,
                             const Executor& executor) {
  std::optional<PatchesWriter> writer;
  PatchTarget target;
  if (executor.is_root()) {
    writer.emplace(path, rest, counts);
    target = writer->target();
  }
  share(executor, target);
  executor.begin_phase("rows");  // each rank its own
  const std::string own = write_own_patches(target, result);
  for (const Bytes& bytes : executor.gather(Bytes(packed(own)))) {
    std::string failure;
    unpack(bytes, failure);
    if (!failure.empty()) throw Error(ExitCode::kOutput, failure);
  }
  executor.begin_phase("write");
  return executor.is_root() ? writer->commit() : "";
}

/// Takes edges out of the result: all but the patches.
PatchesArtifact take_rest(const ModelTables& t, const ArtifactHeader& header, const MeshTopology& topology,
                          MeshResult& r) {
  PatchesArtifact out;
  out.header = header;
  out.edges = std::move(r.edges);
  out.vertex_xyz = t.vertex_xyz;
  out.edge_vertices = topology.tables().edge_vertices;
  out.merged = topology.merged();
  out.failures = r.failures;
  out.labels = t.labels;
  out.face_shell = t.face_shell;
  out.face_area = t.face_area;
  return out;
}

void warn(const ModelTables& t, const MeshResult& r, const std::string& failures_file) {
  for (const FaceFailure& f : r.failures) {
    const std::string cause = fmt::format("{}, near ({:.6g}, {:.6g}, {:.6g})", f.cause, f.xyz.x, f.xyz.y, f.xyz.z);
    log_warning(f.is_closed ? fmt::format("{} closed from its edges alone: {}; its triangles are up to {:.3g} off its "
                                          "surface{}",
                                          t.face_label(f.face), cause, f.deviation, f.is_near ? "" : "; " + f.remedy)
                            : fmt::format("{} not meshed: {}; {}", t.face_label(f.face), cause, f.remedy));
  }
  if (!failures_file.empty())
    log_warning(failures_file + ": boundaries and finished triangles of these faces; open it with ParaView");
  if (!r.folds.empty())
    log_warning(fmt::format("{} triangles point against their surface, the first near ({:.6g}, {:.6g}, {:.6g})",
                            r.folds.size(), r.folds[0].x.x, r.folds[0].x.y, r.folds[0].x.z));
  if (r.n_crossing_pairs)
    log_warning(fmt::format("{} pairs of triangles cross; st-check lists them", r.n_crossing_pairs));
}

void tell_merged(const ModelTables& t, const MergedFeatures& merged, std::size_t n_closed) {
  if (merged.empty()) return;
  log_info(fmt::format(
      "merged small features: {} edges much shorter than the sizes, {} strips much narrower, {} of them whole "
      "faces{} (--merge-below 0 merges nothing)",
      merged.edge.size(), merged.strip_face.size(), n_closed, first_of(t, merged)));
}

nlohmann::json result_json(const ModelTables& t, const MeshResult& r) {
  nlohmann::json failures = nlohmann::json::array(), folds = nlohmann::json::array();
  for (const FaceFailure& f : r.failures) failures.push_back(failure_json(t, f));
  for (const RefinementPoint& p : r.folds) folds.push_back({p.x.x, p.x.y, p.x.z});
  return {{"faces", count_left(t).faces},
          {"faces_failed", r.failures.size()},
          {"failures", failures},
          {"folds", folds},
          {"crossing_pairs", r.n_crossing_pairs},
          {"rounds", r.n_rounds},
          {"refinements", r.n_refinements},
          {"seconds_edges", r.times.edges},
          {"seconds_faces", r.times.faces},
          {"seconds_crossing", r.times.join + r.times.crossing}};
}

/// What came of it.
struct Written {
  std::size_t n_patches = 0;
  std::int64_t n_triangles = 0, n_nodes = 0;
  std::string hash, failures_file;
  double seconds = 0;
};

StageSummary summary_of(const std::string& path, const ModelTables& t, const ArtifactHeader& header,
                        const nlohmann::json& merged, const MeshResult& result, const Written& w,
                        const RunFacts& facts) {
  StageSummary s;
  const double seconds = facts.timer.seconds();
  const bool is_sound = std::all_of(result.failures.begin(), result.failures.end(),
                                    [](const FaceFailure& f) { return f.is_closed && f.is_near; });
  s.code = is_sound ? ExitCode::kOk : ExitCode::kIncomplete;
  s.line =
      fmt::format("{}: {} on {} of {}, {}, {:.2f} s ({}, {:.0f} triangles/s)", path, counted(w.n_triangles, "triangle"),
                  w.n_patches, counted(count_left(t).faces, "face"), counted(result.n_rounds, "round"), seconds,
                  counted(facts.n_ranks, "rank"), seconds > 0 ? static_cast<double>(w.n_triangles) / seconds : 0.0);
  nlohmann::json json = result_json(t, result);
  json.update({{"tool", header.tool},
               {"output", path},
               {"triangles", w.n_triangles},
               {"inner_nodes", w.n_nodes},
               {"faces_meshed", w.n_patches},
               {"failures_file", w.failures_file},
               {"merged", merged},
               {"ranks", facts.n_ranks},
               {"parts", facts.n_parts},
               {"parts_resumed", facts.n_resumed},
               {"seconds", seconds},
               {"seconds_load", facts.load_seconds},
               {"seconds_write", w.seconds},
               {"hash", w.hash}});
  json.update(facts.more);
  s.json = json_text(json);
  return s;
}

}  // namespace

void require_patches_outputs(const std::string& path) {
  require_writable(path);
  require_derived_outputs({failures_path(path)});
}

StageSummary write_patches_result(const std::string& path, const ModelTables& t, const ArtifactHeader& geometry,
                                  ArtifactHeader header, const MeshTopology& topology, MeshResult result,
                                  const RunFacts& facts, const Executor& executor) {
  const bool is_everywhere = !result.places.empty();
  header = complete(std::move(header), geometry);
  PatchesArtifact out = take_rest(t, header, topology, result);
  out.composites = facts.composites;
  const std::vector<PatchCounts> counts = counts_of(result);
  const std::vector<FaceId> closed = closed_faces(out.merged, out.edges, out.edge_vertices);
  out.is_complete = static_cast<std::int32_t>(counts.size() + closed.size()) == count_left(t).faces;
  Written written;
  written.n_patches = counts.size();
  for (const PatchCounts& c : counts) {
    written.n_triangles += c.n_triangles;
    written.n_nodes += c.n_inner;
  }
  const Timer write_timer;
  if (is_everywhere) {
    written.hash = write_everywhere(path, out, counts, result, executor);
  } else {
    out.patches = std::move(result.patches);
    std::erase_if(out.patches, [](const FacePatch& p) { return p.triangles.empty(); });
    written.hash = write_patches(path, out);
  }
  if (is_everywhere && !executor.is_root()) return {};
  written.failures_file = write_failed_faces(path, header, t, result);
  written.seconds = write_timer.seconds();
  warn(t, result, written.failures_file);
  tell_merged(t, out.merged, closed.size());
  return summary_of(path, t, header, merged_json(t, out.merged, closed), result, written, facts);
}

}  // namespace st
