#include "stages/blank_input.h"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>

#include "base/error.h"
#include "base/hash.h"
#include "io/stl_file.h"
#include "mesh/checks.h"
#include "mesh/merge.h"

namespace st {
namespace {

BlankSide parse_side(const std::string& side, const SurfaceMesh& mesh) {
  if (side == "inside") return BlankSide::kInside;
  if (side == "outside") return BlankSide::kOutside;
  for (const std::string& name : mesh.group_name) {
    std::string letters;
    for (const char c : name)
      if (std::isalpha(static_cast<unsigned char>(c))) letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (letters.find("farfield") != std::string::npos) return BlankSide::kOutside;
  }
  return BlankSide::kInside;
}

std::string places(const Defects& defects) {
  std::string text;
  for (const DefectPlace& place : defects.first)
    text += fmt::format("{}({:.6g}, {:.6g}, {:.6g})", text.empty() ? "" : ", ", place.xyz.x, place.xyz.y, place.xyz.z);
  return text + (defects.count > static_cast<std::int64_t>(defects.first.size()) ? ", ..." : "");
}

void require_closed(const std::string& path, const SurfaceMesh& mesh) {
  if (mesh.triangles.empty()) throw Error(ExitCode::kGeometry, path + ": no triangles to blank with");
  const TopologyReport topology = check_topology(mesh);
  if (topology.boundary_edges.count > 0)
    throw Error(ExitCode::kGeometry, fmt::format("{}: open, so it has no inside to blank: {} edges have one triangle only, at {}; close it "
                                                 "there (st-check names the faces)",
                                                 path, topology.boundary_edges.count, places(topology.boundary_edges)));
  if (topology.misoriented_edges.count > 0)
    throw Error(ExitCode::kGeometry, fmt::format("{}: its triangles cannot be oriented alike, at {}; repair it there", path,
                                                 places(topology.misoriented_edges)));
}

}  // namespace

void require_blank_side(const std::string& side) {
  if (side != "auto" && side != "inside" && side != "outside")
    throw Error(ExitCode::kUsage, fmt::format("--blank-side '{}': auto, inside or outside expected", side));
}

BlankInput read_blank(const std::string& path, const std::string& side) {
  require_blank_side(side);
  BlankInput input;
  input.file = {"blank", std::filesystem::path(path).filename().string(), ""};
  if (std::string suffix = std::filesystem::path(path).extension().string(); suffix == ".stl" || suffix == ".STL") {
    input.mesh = read_stl(path);
    input.file.hash = hash_hex(input.mesh.node_xyz.data(), input.mesh.node_xyz.size() * sizeof(Vec3));
  } else {
    MeshArtifact artifact = read_mesh(path);
    input.mesh = std::move(artifact.mesh);
    input.file.hash = artifact.header.content_hash;
  }
  orient_outward(input.mesh);
  require_closed(path, input.mesh);
  input.side = parse_side(side, input.mesh);
  return input;
}

}  // namespace st
