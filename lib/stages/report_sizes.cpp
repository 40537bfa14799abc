#include "stages/report_sizes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "base/morton.h"
#include "io/hdf5/sizing_artifact.h"
#include "sizing/refine.h"

namespace st {
namespace {

/// The cells that are shown, without those that are blanked.
struct Shown {
  ShownOctree octree;
  const std::vector<CellColour>& colour;

  bool is_blanked(std::size_t leaf) const {
    return !colour.empty() && colour[octree.leaf[leaf]] == CellColour::kBlanked;
  }
};

/// The cell of level `deepest` at most that a leaf is part of.
std::pair<std::uint64_t, int> united(const OctreeShape& shape, std::size_t leaf, int deepest) {
  const int level = std::min<int>(shape.leaf_levels[leaf], deepest), shift = 3 * (kMaxLevel - level);
  return {shape.leaf_keys[leaf] >> shift << shift, level};
}

/// Leaves in Morton order: those of one cell follow each other.
template <class Visit>
void for_each_cell(const Shown& shown, int deepest, const Visit& visit) {
  const OctreeShape& shape = shown.octree.shape;
  for (std::size_t leaf = 0; leaf < shape.leaf_keys.size();) {
    const auto cell = united(shape, leaf, deepest);
    double least = std::numeric_limits<double>::infinity();
    for (; leaf < shape.leaf_keys.size() && united(shape, leaf, deepest) == cell; ++leaf)
      if (!shown.is_blanked(leaf)) least = std::min(least, static_cast<double>(shown.octree.length[leaf]));
    if (least < std::numeric_limits<double>::infinity()) visit(cell.first, cell.second, least);
  }
}

/// The deepest level at which there are at most `most` cells.
int choose_level(const Shown& shown, std::size_t most) {
  for (int deepest = kMaxLevel; deepest > 2; --deepest) {
    std::size_t n = 0;
    for_each_cell(shown, deepest, [&](std::uint64_t, int, double) { ++n; });
    if (n <= most) return deepest;
  }
  return 2;
}

SizeReason reason_of(std::int32_t cause, FaceId face) {
  if (cause == kNone) return SizeReason::kNone;
  switch (cause_kind(cause)) {
    case CauseKind::kEdge:
      return SizeReason::kEdge;
    case CauseKind::kFace:
      return cause_id(cause) == face ? SizeReason::kOwnFace : SizeReason::kOtherFace;
    default:
      return SizeReason::kSource;
  }
}

}  // namespace

SliceCells slice_cells(const SizingArtifact& sizing, std::size_t most) {
  SliceCells cells;
  const double scale = sizing.scale * sizing.frame.scale;
  const Shown shown{show_octree(*sizing.field()), sizing.blanking.colour};
  for_each_cell(shown, choose_level(shown, most), [&](std::uint64_t key, int level, double length) {
    const GridPoint corner = morton::decode(key);
    cells.corner.insert(cells.corner.end(), {corner.x, corner.y, corner.z});
    cells.level.push_back(static_cast<std::uint8_t>(level));
    cells.length.push_back(static_cast<float>(scale * length));
  });
  return cells;
}

nlohmann::ordered_json slice_frame(const SizingArtifact& sizing) {
  const OctreeView octree = sizing.shape.view();
  const auto place = [&](Vec3 x) { return sizing.frame(octree.lo + octree.edge * x); };
  const Vec3 origin = place({0, 0, 0});
  nlohmann::ordered_json axes = nlohmann::ordered_json::array();
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 d = place(axis) - origin;
    axes.push_back({d.x, d.y, d.z});
  }
  return {{"origin", {origin.x, origin.y, origin.z}}, {"axes", axes}};
}

TriangleCauses triangle_causes(const SizingArtifact& sizing, const SurfaceMesh& mesh) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  TriangleCauses causes{nlohmann::ordered_json::array(), {}};
  const auto field = sizing.field(sizing.frame);
  const CauseNames names = sizing.cause_names();
  std::map<std::pair<std::int32_t, SizeReason>, std::uint16_t> known;
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    const auto& n = mesh.triangles[t].n;
    const Vec3 middle = (mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3;
    const std::int32_t cause = field->explain(middle).cause;
    const SizeReason reason = reason_of(cause, mesh.triangle_face[t]);
    const auto next = static_cast<std::uint16_t>(std::min(known.size(), kMost));
    const auto [at, is_new] = known.try_emplace({cause, reason}, next);
    if (is_new && next < kMost)
      causes.list.push_back({{"text", cause_text(names, cause)}, {"reason", static_cast<int>(reason)}});
    causes.index.push_back(std::min(at->second, static_cast<std::uint16_t>(causes.list.size() - 1)));
  }
  return causes;
}

}  // namespace st
