#include "stages/mesh_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <numeric>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/log.h"
#include "base/memory.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "meshing/engine/model_mesher.h"
#include "stages/expected_triangles.h"
#include "stages/patches_result.h"

namespace st {
namespace {

void require_valid(const MeshStageOptions& o) {
  if (o.enhance_rounds < 0 || o.enhance_rounds > 10)
    throw Error(ExitCode::kUsage, fmt::format("--enhance-rounds {}: not in [0, 10]", o.enhance_rounds));
  if (!(o.merge_below >= 0 && o.merge_below <= 0.2))
    throw Error(ExitCode::kUsage, fmt::format("--merge-below {}: not in [0, 0.2]", o.merge_below));
  if (!(o.max_turning_deg > 0 && o.max_turning_deg <= 60))
    throw Error(ExitCode::kUsage, fmt::format("--max-turning {}: not in (0, 60] degrees", o.max_turning_deg));
}

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
    for (FaceId f = first; f <= last; ++f) chosen[f] = 1;
  }
  if (!o.group.empty()) {
    const std::vector<std::uint8_t> in_group = find_faces(o.group, t.group_names());
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

}  // namespace

StageSummary run_mesh(const MeshStageOptions& o, const Communicator& comm) {
  const Timer timer;
  keep_freed_memory();
  require_valid(o);
  if (comm.is_root()) require_writable(o.output);
  GeometryArtifact geometry = read_geometry(o.geometry);
  const MappedSizing sizing = map_sizing(o.sizing);
  require_same_geometry(o.geometry, geometry.header, o.sizing, sizing.header);
  const ArtifactHeader geometry_header = geometry.header;
  const Model model(std::move(geometry.tables), std::move(geometry.brep));
  ModelMesherOptions options;
  options.enhance_rounds = o.enhance_rounds;
  options.max_turning_deg = o.max_turning_deg;
  options.merge_below = o.merge_below;
  const std::vector<FaceId> faces = select_faces(o, model.tables());
  require_countable_mesh(model.tables(), sizing.face_weight, faces, o.sizing);
  EdgeMesh fixed;
  MergedFeatures merged;
  if (!o.edges.empty()) {
    PatchesArtifact earlier = read_patches(o.edges);
    require_same_geometry(o.geometry, geometry_header, o.edges, earlier.header);
    fixed = std::move(earlier.edges);
    merged = std::move(earlier.merged);
    options.merged = &merged;
  }
  ModelMesher mesher(model, *sizing.field, sizing.face_weight, options, comm);
  const double load_seconds = timer.seconds();
  if (faces.empty() && o.edges.empty()) {
    mesher.run();
  } else {
    std::vector<FaceId> all(model.tables().n_faces());
    std::iota(all.begin(), all.end(), 0);
    mesher.run_part(faces.empty() ? all : faces, std::move(fixed));
  }
  if (!comm.is_root()) return {};
  store_requests(*sizing.field, mesher);

  ArtifactHeader header;
  header.tool = "st-mesh";
  header.options_json = nlohmann::json{
      {"faces", o.faces},
      {"group", o.group},
      {"enhance_rounds", o.enhance_rounds},
      {"merge_below", o.merge_below},
      {"max_turning",
       o.max_turning_deg}}.dump();
  header.inputs = {{"geometry", std::filesystem::path(o.geometry).filename().string(), geometry_header.content_hash},
                   {"sizing", std::filesystem::path(o.sizing).filename().string(), sizing.header.content_hash}};
  return write_patches_result(o.output, model.tables(), geometry_header, header, mesher,
                              {timer, load_seconds, comm.size()});
}

}  // namespace st
