#include "stages/remesh_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/hash.h"
#include "base/length.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/required_unit.h"
#include "base/text.h"
#include "io/export/displacement_export.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/foreign/node_array.h"
#include "io/foreign/triangulation_reader.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/mesh_part.h"
#include "io/hdf5/node_values.h"
#include "io/hdf5/sizing_artifact.h"
#include "mesh/edge_segments.h"
#include "mesh/merge.h"
#include "mesh/pair_match.h"
#include "meshing/engine/mesh_regions.h"
#include "meshing/hole/hole_reprojector.h"
#include "meshing/hole/mesh_gaps.h"
#include "sizing/node_field.h"
#include "stages/carried_values.h"
#include "stages/expected_triangles.h"
#include "stages/fitting_files.h"
#include "stages/foreign_mesh.h"
#include "stages/joined_numbers.h"
#include "stages/merge_columns.h"
#include "stages/orientation_warnings.h"
#include "stages/pair_input.h"
#include "stages/patches_result.h"
#include "stages/remeshed_places.h"
#include "stages/resumption.h"
#include "stages/same_inputs.h"
#include "stages/stored_model.h"

namespace st {
namespace {

void require_valid(const RemeshStageOptions& o) {
  o.kTooLong.require(o.too_long);
  o.kTooShort.require(o.too_short);
  if (!o.interpolate.empty() && o.merged.empty())
    throw Error(ExitCode::kUsage, "--interpolate: patches have no room for values; give --merged as well");
  if (o.moved) return;
  for (const auto& [option, is_given] :
       {std::pair("--keep-connectivity", o.keep_connectivity), std::pair("--displacements", !o.displacements.empty())})
    if (is_given)
      throw Error(ExitCode::kUsage, fmt::format("{}: is for a geometry that moved; give --moved as well", option));
}

/// The sizing's field, or the one on the nodes that takes its place.
std::unique_ptr<SizeField> make_node_field(const RemeshStageOptions& o, const SurfaceMesh& mesh,
                                           const ForeignMesh* foreign, double slope) {
  if (o.sizes_on_nodes.empty()) return nullptr;
  const auto [file, array] = file_and_array("--sizes-on-nodes", o.sizes_on_nodes);
  std::vector<double> lengths = read_node_lengths(file, array, foreign ? foreign->n_file_nodes : mesh.node_xyz.size());
  if (foreign) lengths = in_mesh_order(lengths, foreign->file_node, 1);
  return std::make_unique<NodeField>(mesh, std::move(lengths), slope);
}

/// Sets which faces and edges stay: those of the group with their partners, and strips that were closed for meshing.
void set_kept(const RemeshStageOptions& o, const ModelTables& t, const MergedFeatures& merged, HoleMarkOptions& mark) {
  if (!merged.strip_face.empty()) mark.keep_face.resize(t.n_faces(), 0);
  for (const FaceId f : merged.strip_face) mark.keep_face[f] = 1;
  if (o.keep.empty()) return;
  const std::vector<std::uint8_t> in_group = find_faces(o.keep, t.labels);
  const std::vector<EdgeId> edges = find_members(o.keep, t.labels.edge_groups);
  if (in_group.empty() && edges.empty())
    throw Error(ExitCode::kUsage, fmt::format("--keep '{}': the model has no such group of faces or edges and no such "
                                              "part{}; st-info {} --groups lists them",
                                              o.keep, say_other_kind(o.keep, t.labels), o.geometry));
  mark.keep_face.resize(t.n_faces(), 0);
  for (std::size_t f = 0; f < in_group.size(); ++f) mark.keep_face[f] |= static_cast<char>(in_group[f]);
  for (const FacePair& p : merged.pairs)
    if (mark.keep_face[p.a] || mark.keep_face[p.b]) mark.keep_face[p.a] = mark.keep_face[p.b] = 1;
  mark.keep_edge.resize(t.n_edges(), 0);
  for (const EdgeId e : edges) mark.keep_edge[e] = 1;
}

nlohmann::json counts(const HoleMarker& holes, const MeshResult& r) {
  return {{"faces_redone", holes.dirty_faces().size()},
          {"triangles_redone", holes.n_marked_triangles},
          {"segments_redone", holes.n_marked_segments},
          {"marks_hash", holes.marks_hash},
          {"triangles_before", holes.mesh().mesh.n_triangles()},
          {"faces", holes.mesh().tables.n_faces()},
          {"holes_grown", r.n_grown},
          {"rounds", r.n_rounds},
          {"crossing_pairs", r.n_crossing_pairs},
          {"refinements", r.n_refinements},
          {"seconds_analysis", holes.seconds},
          {"seconds_edges", r.times.edges},
          {"seconds_faces", r.times.faces},
          {"seconds_insert", r.times.join},
          {"seconds_crossing", r.times.crossing}};
}

StageSummary dry_run_summary(const HoleMarker& holes, nlohmann::json json) {
  json.update(counts(holes, {}));
  json["tool"] = "st-remesh";
  return {
      fmt::format("{} of {} triangles on {} of {} faces would be remeshed, and {} segments of edges; nothing written",
                  holes.n_marked_triangles, holes.mesh().mesh.n_triangles(), holes.dirty_faces().size(),
                  holes.mesh().tables.n_faces(), holes.n_marked_segments),
      json_text(json)};
}

/// What is read once and used by all steps.
struct RemeshInput {
  MeshArtifact old;
  ArtifactHeader geometry;
  Model model;
  MappedSizing sizing;
  std::vector<Vec3> earlier_xyz = {};                 ///< of the nodes, before the geometry moved; else empty
  std::vector<TriangleId> spoilt = {};                ///< by the move
  std::optional<ForeignMesh> foreign = std::nullopt;  ///< what `old` was made of
  MeshShare share = {};                               ///< of this rank, in `old`
  Composites composites = {};                         ///< of the geometry
  PeriodicPairs pairs = {};                           ///< of the mesh
};

/// A move may turn, stretch or part what was the image of something.
void forget_parted(SurfaceMesh& mesh) {
  const double tolerance = pair_tolerance(mesh);
  const auto n = std::erase_if(mesh.merged.pairs, [&](const FacePair& p) {
    const PairMatch match = match_pair(mesh, p, tolerance);
    return !match.alone.empty() || !match.triangles_alone.empty();
  });
  if (n > 0)
    log_warning(
        fmt::format("{} pairs of periodic faces are no images of one another by the motion that they had, and "
                    "are none any more: mesh the moved geometry with st-mesh --pairs",
                    n));
}

/// Puts the mesh onto the moved geometry.
void move(RemeshInput& in, bool smooths) {
  MovedMesh moved = move_mesh(in.old.mesh, in.model, smooths ? in.sizing.field.get() : nullptr);
  in.earlier_xyz = std::move(in.old.mesh.node_xyz);
  in.old.mesh = std::move(moved.mesh);
  forget_parted(in.old.mesh);
  in.spoilt = std::move(moved.spoilt);
}

/// A mesh of another program, put onto the geometry.
RemeshInput read_foreign_input(const RemeshStageOptions& o) {
  if (o.moved)
    throw Error(ExitCode::kUsage,
                fmt::format("--moved: {} is not a mesh artifact: only these know the geometry that moved", o.mesh));
  GeometryArtifact geometry = read_geometry(o.geometry);
  if (!o.tolerance.empty())
    require_unit(parse_length(o.tolerance, "--tolerance"), geometry.header.unit_in_m, "--tolerance");
  MappedSizing sizing = map_sizing(o.sizing);
  require_same_geometry(o.geometry, geometry.header, o.sizing, sizing.header);
  std::optional<MappedSizing> made_for;
  if (!o.made_for.empty()) {
    made_for.emplace(map_sizing(o.made_for));
    require_same_geometry(o.geometry, geometry.header, o.made_for, made_for->header);
  }
  Composites composites = geometry.composites;
  Model model = stored_model(geometry, o.geometry);
  ForeignMesh foreign =
      read_foreign_mesh(o.mesh, model, {o.tolerance, sizing.field.get(), made_for ? made_for->field.get() : nullptr});
  MeshArtifact old = std::move(foreign.artifact);
  orient_outward(old.mesh);  // as st-merge does
  Model on_nodes = with_vertices_of(old.mesh, std::move(model), composites);
  RemeshInput in{std::move(old), std::move(geometry.header), std::move(on_nodes), std::move(sizing)};
  in.foreign = std::move(foreign);
  in.composites = std::move(composites);
  return in;
}

/// The whole mesh, and the share of it that this rank marks.
MeshShare share_of(const SurfaceMesh& whole, const Communicator& comm) {
  const auto n = static_cast<std::int64_t>(whole.triangles.size());
  const auto at = [&](int rank) { return static_cast<TriangleId>(n * rank / comm.size()); };
  return {at(comm.rank()), at(comm.rank() + 1), 0};
}

/// A node inside a face belongs to triangles of that face alone. Throws Error(kInput).
void require_own_nodes(const std::string& path, const SurfaceMesh& mesh) {
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t)
    for (const NodeId n : mesh.triangles[t].n)
      if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kFace) &&
          mesh.node_entity[n] != mesh.triangle_face[t])
        throw Error(ExitCode::kInput, fmt::format("{}: triangle {} of face {} has a node inside another face; the file "
                                                  "is damaged: make it again with st-merge",
                                                  path, t + 1, mesh.triangle_face[t] + 1));
}

/// Rank 0 needs the whole mesh; others their share, unless the move or lengths on nodes ask for all of it.
MeshArtifact read_share(const RemeshStageOptions& o, const Communicator& comm, MeshShare& share) {
  if (comm.is_root() || o.moved || !o.sizes_on_nodes.empty()) {
    MeshArtifact whole = read_mesh(o.mesh);
    require_own_nodes(o.mesh, whole.mesh);
    share = share_of(whole.mesh, comm);
    return whole;
  }
  MeshPart part = read_mesh_part(o.mesh, comm.rank(), comm.size());
  share = {0, static_cast<TriangleId>(part.artifact.mesh.n_triangles()), part.first_triangle,
           std::move(part.node_number)};
  return std::move(part.artifact);
}

RemeshInput read_input(const RemeshStageOptions& o, const Communicator& comm) {
  if (is_foreign_mesh(o.mesh)) {
    RemeshInput in = read_foreign_input(o);
    in.share = share_of(in.old.mesh, comm);
    return in;
  }
  for (const auto& [option, value] : {std::pair("--tolerance", o.tolerance), std::pair("--made-for", o.made_for)})
    if (!value.empty())
      throw Error(ExitCode::kUsage,
                  fmt::format("{}: is for meshes of other programs, but {} is a mesh artifact; leave the option out",
                              option, o.mesh));
  MeshShare share;
  MeshArtifact old = read_share(o, comm, share);
  if (!old.is_complete)
    throw Error(ExitCode::kInput,
                fmt::format("{}: incomplete, faces are missing; mesh all of them with st-mesh first", o.mesh));
  GeometryArtifact geometry = read_geometry(o.geometry);
  MappedSizing sizing = map_sizing(o.sizing);
  if (!o.moved) require_same_geometry(o.mesh, old.header, o.geometry, geometry.header);
  require_same_geometry(o.geometry, geometry.header, o.sizing, sizing.header);
  part_as_meshed(old, geometry);
  if (o.moved) require_same_composites(o.mesh, old, o.geometry, geometry);
  ArtifactHeader header = geometry.header;
  Composites composites = geometry.composites;
  RemeshInput in{std::move(old), std::move(header), stored_model(geometry, o.geometry), std::move(sizing)};
  in.share = share;
  in.composites = std::move(composites);
  if (o.moved) move(in, o.keep_connectivity);
  if (!in.old.mesh.merged.pairs.empty()) {  // their vertices are images of one another
    in.model = with_vertices_of(in.old.mesh, std::move(in.model), in.composites);
    in.pairs = PeriodicPairs(in.model, in.old.mesh.merged.pairs);
  }
  return in;
}

/// A hole that is none of the CAD model's would stay.
void require_no_gaps(const RemeshStageOptions& o, const HoleMesh& m) {
  const std::vector<OpenSide> open = find_open_sides(m);
  if (open.empty()) return;
  const Vec3 x = 0.5 * (m.mesh.node_xyz[open[0].low] + m.mesh.node_xyz[open[0].high]);
  throw Error(ExitCode::kInput, fmt::format("{}: has a hole that is not in the model: {} sides of triangles have no "
                                            "neighbour, the first at ({:.6g} {:.6g} {:.6g}), "
                                            "{}; make the mesh again with st-mesh and st-merge",
                                            o.mesh, open.size(), x.x, x.y, x.z, m.tables.face_label(open[0].face)));
}

ArtifactHeader output_header(const RemeshStageOptions& o, const RemeshInput& in, const HoleMarker& holes) {
  ArtifactHeader header;
  header.tool = "st-remesh";
  header.tool_version = ST_VERSION;
  header.options_json =
      json_text(nlohmann::json{{"too_long", o.too_long},
                               {"too_short", o.too_short},
                               {"keep", o.keep},
                               {"sizes_on_nodes", std::filesystem::path(o.sizes_on_nodes).filename().string()},
                               {"faces_redone", holes.dirty_faces().size()}});
  header.inputs = {{"mesh", std::filesystem::path(o.mesh).filename().string(), in.old.header.content_hash},
                   {"geometry", std::filesystem::path(o.geometry).filename().string(), in.geometry.content_hash},
                   {"sizing", std::filesystem::path(o.sizing).filename().string(), in.sizing.header.content_hash}};
  return header;
}

/// previous_id of a foreign mesh is the number in its file.
void number_as_in_file(const RemeshInput& in, std::vector<NodeId>& nodes, std::vector<TriangleId>& triangles) {
  if (!in.foreign) return;
  for (NodeId& n : nodes)
    if (n != kNone) n = in.foreign->file_node[n];
  for (TriangleId& t : triangles)
    if (t != kNone) t = in.foreign->file_triangle[t];
}

MeshArtifact merged_artifact(const RemeshStageOptions& o, const RemeshInput& in, const HoleMarker& holes,
                             MeshResult& r) {
  MeshArtifact artifact;
  artifact.header = output_header(o, in, holes);
  artifact.header.unit = in.geometry.unit;
  artifact.header.unit_in_m = in.geometry.unit_in_m;
  artifact.header.geometry_hash = in.geometry.content_hash;
  SurfaceMesh& mesh = artifact.mesh = std::move(r.mesh);
  number_as_in_file(in, mesh.node_previous, mesh.triangle_previous);
  mesh.labels = in.old.mesh.labels;
  mesh.merged = in.old.mesh.merged;
  if (o.moved) warn_of_changes(orient_outward(mesh));  // as st-merge does: a mirrored mesh is inside out
  if (!mesh.labels.edge_groups.empty()) add_segments(mesh, r.edges, holes.mesh().tables.edge_vertices);
  if (!in.composites.empty()) add_cad_places({in.composites, in.model.tables().n_faces()}, artifact);
  return artifact;
}

/// Local, on rank 0. Writes the merged mesh.
StageSummary write_merged(const RemeshStageOptions& o, const RemeshInput& in, const HoleMarker& holes, MeshResult& r,
                          std::vector<NodeValues> values, const RunFacts& facts) {
  if (!r.failures.empty())
    throw Error(ExitCode::kIncomplete,
                fmt::format("{}: {}; nothing written; remesh to patches (-o) to see all faces that failed",
                            in.model.tables().face_label(r.failures[0].face), r.failures[0].cause));
  carry_values(holes.mesh(), r.mesh, values);
  const MeshArtifact artifact = merged_artifact(o, in, holes, r);
  if (r.n_crossing_pairs)
    log_warning(fmt::format("{} pairs of triangles cross; st-check lists them", r.n_crossing_pairs));
  const Timer timer;
  const std::string hash = write_mesh_with(o.merged, artifact, values);
  const double write_seconds = timer.seconds(), seconds = facts.timer.seconds();
  StageSummary s;
  s.line = fmt::format("{}: {}, {}, {:.2f} s ({})", o.merged, counted(artifact.mesh.n_triangles(), "triangle"),
                       counted(artifact.mesh.n_nodes(), "node"), seconds, counted(facts.n_ranks, "rank"));
  nlohmann::json json = {{"tool", "st-remesh"},
                         {"output", o.merged},
                         {"hash", hash},
                         {"triangles", artifact.mesh.n_triangles()},
                         {"nodes", artifact.mesh.n_nodes()},
                         {"ranks", facts.n_ranks},
                         {"parts", facts.n_parts},
                         {"parts_resumed", facts.n_resumed},
                         {"seconds", seconds},
                         {"seconds_load", facts.load_seconds},
                         {"seconds_write", write_seconds}};
  json.update(facts.more);
  s.json = json_text(json);
  return s;
}

/// Local, on rank 0. Writes patches for st-merge.
StageSummary write_patches_of(const RemeshStageOptions& o, const RemeshInput& in, const HoleMarker& holes, MeshResult r,
                              RunFacts facts) {
  facts.composites = in.composites;
  std::vector<TriangleId> none;
  number_as_in_file(in, r.edges.node_previous, none);
  for (FacePatch& p : r.patches) number_as_in_file(in, p.inner_previous, p.triangle_previous);
  return write_patches_result(o.output, in.model.tables(), in.geometry, output_header(o, in, holes),
                              holes.mesh().topology, std::move(r), facts, SerialExecutor());
}

/// Names what does not keep its connectivity, for the summary as well. Local, on rank 0.
nlohmann::json tell_places(const RemeshStageOptions& o, const HoleMarker& holes) {
  if (!o.keep_connectivity) return nlohmann::json::object();
  const SurfaceMesh& m = holes.mesh().mesh;
  const std::int64_t n = holes.marks().n_triangles();
  const std::vector<RemeshedPlace> places = find_remeshed_places(m, holes.marks().triangle);
  if (n > 0 && n == m.n_triangles())
    throw Error(ExitCode::kMismatch,
                fmt::format("--keep-connectivity: no triangle of {} keeps its shape on {}; mesh it "
                            "with st-mesh, or move the geometry in smaller steps",
                            o.mesh, o.geometry));
  if (n > 0)
    log_warning(
        fmt::format("--keep-connectivity: {} of {} triangles have other ones in their place, because the move "
                    "turned or distorted some there; {}",
                    n, m.n_triangles(), places_text(m, places)));
  return {{"triangles_kept", m.n_triangles() - n}, {"places", places_json(m, places)}};
}

/// Local, on rank 0.
StageSummary write_result(const RemeshStageOptions& o, const RemeshInput& in, const HoleMarker& holes, MeshResult r,
                          std::vector<NodeValues> values, RunFacts facts) {
  facts.more.update(counts(holes, r));
  facts.more.update(tell_places(o, holes));
  if (!o.displacements.empty()) export_displacements(o.displacements, in.earlier_xyz, in.old.mesh);
  StageSummary summary = o.merged.empty() ? write_patches_of(o, in, holes, std::move(r), std::move(facts))
                                          : write_merged(o, in, holes, r, std::move(values), facts);
  summary.line += fmt::format("; {} of {} triangles remeshed", holes.n_marked_triangles, in.old.mesh.n_triangles());
  return summary;
}

/// Before anything is remeshed; faces that are kept count for nothing. Local, on rank 0, which has the whole mesh: what
/// the sizing says of its faces is not asked, because lengths on nodes may take its place, and a file may lie.
void require_countable_sizes(const RemeshStageOptions& o, const RemeshInput& in, const HoleMarkOptions& mark,
                             const SizeField& field) {
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < in.model.tables().n_faces(); ++f)
    if (mark.keep_face.empty() || !mark.keep_face[f]) faces.push_back(f);
  if (faces.empty()) return;
  const ModelTables& tables = in.model.tables();
  require_countable_mesh(tables, face_weights_on(in.old.mesh, field, tables.n_faces()), faces,
                         o.sizes_on_nodes.empty() ? o.sizing : o.sizes_on_nodes, most_triangles_in(memory_limit()));
}

HoleMarkOptions mark_options(const RemeshStageOptions& o, const RemeshInput& in) {
  HoleMarkOptions mark;
  mark.too_long = o.too_long;
  mark.too_short = o.too_short;
  set_kept(o, in.model.tables(), in.old.mesh.merged, mark);
  mark.earlier_xyz = in.earlier_xyz;
  mark.redo = in.spoilt;
  mark.only_redo = o.keep_connectivity;
  mark.pairs = &in.pairs;
  return mark;
}

/// The lengths of --sizes-on-nodes.
std::string nodes_file(const RemeshStageOptions& o) { return o.sizes_on_nodes.substr(0, o.sizes_on_nodes.rfind(':')); }

/// --made-for and the sizes on nodes: files without a hash of their own.
std::vector<OpenedFile> digested_files(const RemeshStageOptions& o) {
  std::vector<OpenedFile> files;
  for (const std::string& path : {o.made_for, nodes_file(o)}) {
    if (path.empty()) continue;
    Hasher hasher;
    hasher.add(std::string_view(read_text_file(path)));
    files.push_back({path, hasher.hex()});
  }
  return files;
}

/// Digest of what the results depend on.
std::string run_of(const RemeshStageOptions& o, const RemeshInput& in, const std::vector<OpenedFile>& files) {
  Hasher hasher;
  for (const std::string& text :
       {in.old.header.content_hash, in.geometry.content_hash, in.sizing.header.content_hash, o.keep, o.tolerance,
        o.sizes_on_nodes,
        fmt::format("{} {} {} {} {}", o.too_long, o.too_short, o.moved, o.keep_connectivity, o.merged.empty())}) {
    hasher.add(std::string_view(text));
    hasher.add(std::string_view("\n"));
  }
  for (const OpenedFile& file : files) hasher.add(std::string_view(file.content_hash));
  return hasher.hex();
}

/// How well the nodes of a foreign mesh lie on the CAD: says so, and returns it for the summary.
nlohmann::json tell_association(const RemeshStageOptions& o, const RemeshInput& in, const Communicator& comm) {
  if (!in.foreign) return nlohmann::json::object();
  if (comm.is_root()) log_info(association_text(o.mesh, in.old.mesh, in.foreign->report));
  return {{"association", association_json(in.old.mesh, in.foreign->report)}};
}

StageSummary with_distance(StageSummary summary, const RemeshInput& in) {
  if (in.foreign)
    summary.line +=
        fmt::format("; nodes within {:.3g}{} of the CAD", in.foreign->report.max_distance, in_unit(in.geometry.unit));
  return summary;
}

}  // namespace

StageSummary run_remesh(const RemeshStageOptions& o, const Communicator& comm) {
  const Timer timer;
  require_valid(o);
  if (!o.displacements.empty()) require_displacement_format(o.displacements);
  if (comm.is_root() && !o.dry_run) o.merged.empty() ? require_patches_outputs(o.output) : require_writable(o.merged);
  Progress progress("st-remesh", 1);
  progress.step("reading", 0);
  require_fitting(
      {{o.geometry, "geometry"}, {o.sizing, "sizing"}, {o.moved ? "" : o.mesh, "mesh"}, {o.made_for, "sizing"}});
  const RemeshInput in = read_input(o, comm);
  require_same_inputs(comm, {{o.mesh, in.old.header.content_hash},
                             {o.geometry, in.geometry.content_hash},
                             {o.sizing, in.sizing.header.content_hash}});
  const HoleMesh mesh(in.old.mesh, in.model.tables(), &in.model);
  if (comm.is_root()) require_no_gaps(o, mesh);
  const HoleMarkOptions mark = mark_options(o, in);
  const std::unique_ptr<SizeField> on_nodes =
      make_node_field(o, in.old.mesh, in.foreign ? &*in.foreign : nullptr, in.sizing.field->slope());
  const SizeField& own_field = on_nodes ? *on_nodes : *in.sizing.field;
  const std::unique_ptr<SizeField> paired = make_paired_field(own_field, in.pairs, in.model.tables());
  const SizeField& field = paired ? *paired : own_field;
  std::vector<NodeValues> values;
  if (comm.is_root())
    values = in.foreign ? read_carried_values(o.interpolate, in.foreign->n_file_nodes, in.foreign->file_node)
                        : read_carried_values(o.interpolate, in.old.mesh.node_xyz.size(), {});
  const std::vector<OpenedFile> files = digested_files(o);
  require_same_inputs(comm, files);
  if (comm.is_root()) require_countable_sizes(o, in, mark, field);
  const nlohmann::json association = tell_association(o, in, comm);
  const double load_seconds = timer.seconds();
  progress.step("looking for what no longer fits", 0.1);
  HoleMarker holes(in.model, mesh, in.share, field, mark, comm);
  if (o.dry_run) {
    nlohmann::json more = association;
    if (comm.is_root()) more.update(tell_places(o, holes));
    return with_distance(dry_run_summary(holes, more), in);
  }
  const HoleOutput output = o.merged.empty() ? HoleOutput::kPatches : HoleOutput::kMesh;
  Resumption resumption(comm, o.merged.empty() ? o.output : o.merged, run_of(o, in, files),
                        {o.journal_after, o.begins_new});
  progress.step("meshing", 0.2);
  MeshOptions options;
  options.left_out = resumption.left_out();
  options.pairs = &in.pairs;
  MeshResult result = mesh_regions(holes, field, output, options, resumption);
  resumption.end();
  if (!comm.is_root()) return {};
  progress.step("writing", 0.9);
  StageSummary summary =
      write_result(o, in, holes, std::move(result), std::move(values),
                   {timer, load_seconds, comm.size(), resumption.n_tasks(), resumption.n_resumed(), association});
  resumption.remove();
  return with_distance(std::move(summary), in);
}

}  // namespace st
