#include "stages/blank_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "base/boxes.h"
#include "base/error.h"
#include "base/hash.h"
#include "io/foreign/triangulation_reader.h"
#include "mesh/adjacency.h"
#include "mesh/checks.h"
#include "mesh/merge.h"

namespace st {
namespace {

BlankSide parse_side(const std::string& side, const SurfaceMesh& mesh) {
  if (side == "inside") return BlankSide::kInside;
  if (side == "outside") return BlankSide::kOutside;
  for (std::size_t g = 0; g < mesh.labels.group_name.size(); ++g)
    if ((g < mesh.labels.group_role.size() ? mesh.labels.group_role[g] : role_of_name(mesh.labels.group_name[g])) ==
        "farfield")
      return BlankSide::kOutside;
  return BlankSide::kInside;
}

std::string places(const Defects& defects) {
  std::string text;
  for (const DefectPlace& place : defects.first)
    text += fmt::format("{}({:.6g}, {:.6g}, {:.6g})", text.empty() ? "" : ", ", place.xyz.x, place.xyz.y, place.xyz.z);
  return text + (defects.count > static_cast<std::int64_t>(defects.first.size()) ? ", ..." : "");
}

/// Edges along which not as many triangles run one way as the other: one triangle alone (open), an inner wall of three,
/// two that disagree.
void find_unbalanced_edges(const SurfaceMesh& mesh, Defects& open, Defects& unbalanced) {
  EdgeTable(mesh.triangles, mesh.n_nodes()).for_each_edge([&](NodeId low, NodeId high, std::span<const SideId> sides) {
    std::ptrdiff_t balance = 0;
    for (const SideId side : sides) balance += side_start(mesh.triangles, side) == low ? 1 : -1;
    if (balance == 0) return;
    (sides.size() == 1 ? open : unbalanced).add({0.5 * (mesh.node_xyz[low] + mesh.node_xyz[high])});
  });
}

void require_closed(const std::string& path, const SurfaceMesh& mesh) {
  if (mesh.triangles.empty())
    throw Error(ExitCode::kGeometry, path + ": the mesh has no triangles; --blank needs a closed mesh");
  Defects open, unbalanced;
  find_unbalanced_edges(mesh, open, unbalanced);
  if (open.count > 0)
    throw Error(
        ExitCode::kGeometry,
        fmt::format("{}: the mesh is open and has no inside to blank: {} edges have only one triangle, at {}; close it "
                    "there (st-check names the faces)",
                    path, open.count, places(open)));
  if (unbalanced.count > 0)
    throw Error(
        ExitCode::kGeometry,
        fmt::format(
            "{}: the mesh has no clear inside to blank: at {} edges triangles are not oriented consistently, or "
            "form inner walls, at {}; mesh the parts as one body",
            path, unbalanced.count, places(unbalanced)));
}

}  // namespace

void require_blank_side(const std::string& side) {
  if (side != "auto" && side != "inside" && side != "outside")
    throw Error(ExitCode::kUsage, fmt::format("--blank-side '{}': unknown; write auto, inside or outside", side));
}

BlankInput read_blank(const std::string& path, const std::string& side) {
  require_blank_side(side);
  BlankInput input;
  input.file = {"blank", std::filesystem::path(path).filename().string(), ""};
  if (is_foreign_mesh(path)) {
    input.mesh = read_triangulation(path);
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

double share_near(std::span<const Vec3> points, const OctreeView& octree, std::span<const std::int32_t> leaves) {
  std::vector<std::uint8_t> is_wanted(static_cast<std::size_t>(octree.n_leaves()), 0);
  for (const std::int32_t leaf : leaves) is_wanted[leaf] = 1;
  const Box3 root = [&] {
    Box3 box;
    box.add(octree.lo);
    box.add(octree.lo + octree.edge * Vec3{1, 1, 1});
    return box;
  }();
  const auto leaf_at = [&](Vec3 x) { return octree.find_leaf(morton::encode(octree.grid_point(x))); };
  const auto is_near = [&](Vec3 x) {
    if (!contains(root, x)) return false;
    const double step = 0.1 * octree.cell_edge(octree.leaf_levels[leaf_at(x)]);
    for (const double dx : {0.0, -step, step})
      for (const double dy : {0.0, -step, step})
        for (const double dz : {0.0, -step, step})
          if (is_wanted[leaf_at(x + Vec3{dx, dy, dz})]) return true;
    return false;
  };
  const auto n_near = std::count_if(points.begin(), points.end(), is_near);
  return points.empty() ? 0 : static_cast<double>(n_near) / static_cast<double>(points.size());
}

void transform(const Similarity& motion, SurfaceMesh& mesh) {
  for (Vec3& x : mesh.node_xyz) x = motion(x);
  if (motion.is_mirrored())
    for (Triangle& t : mesh.triangles) std::swap(t.n[1], t.n[2]);
}

}  // namespace st
