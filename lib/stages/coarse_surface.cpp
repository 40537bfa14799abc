#include "stages/coarse_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/boxes.h"
#include "base/log.h"
#include "base/share.h"
#include "base/text.h"
#include "geometry/model/model_state.h"
#include "mesh/merge.h"
#include "meshing/engine/mesh_regions.h"
#include "sizing/octree_field.h"
#include "sizing/prolong.h"

namespace st {
namespace {

constexpr double kSlope = 0.2;
constexpr double kCoarser = 3;  // than the raster's lengths: a ninth of the triangles

void warn_of_holes(std::vector<FaceFailure> failures) {
  std::erase_if(failures, [](const FaceFailure& f) { return f.is_closed; });
  if (failures.empty()) return;
  log_warning(fmt::format("{} no coarse mesh, first face {}: sizes may pass through the solid there",
                          counted(failures.size(), "face has", "faces have"), failures.front().face + 1));
}

/// The lengths of an octree, which grow beyond its box at the same slope: far fields may lie outside.
class GrowingField : public SizeField {
 public:
  /// The reference outlives it. `largest`: length where nothing asks for less, before scale.
  GrowingField(const OctreeField& octree, double largest)
      : octree_(octree), largest_(largest * octree.data().scale), box_(box_of(octree.data().octree)) {}
  using SizeField::size;
  double size(Vec3 xyz, int& hint) const override {
    const double length = octree_.size(xyz, hint), away2 = distance2(xyz, box_);
    return away2 > 0 ? std::min(length + slope() * std::sqrt(away2), std::max(length, largest_)) : length;
  }
  double min_size() const override { return octree_.min_size(); }
  double slope() const override { return octree_.slope(); }

 private:
  static Box3 box_of(const OctreeView& octree) {
    return {octree.lo, octree.lo + Vec3{octree.edge, octree.edge, octree.edge}};
  }

  const OctreeField& octree_;
  const double largest_;
  const Box3 box_;
};

/// Places and triangles alone, turned outward.
SurfaceMesh joined(const ModelTables& t, const MeshResult& result) {
  std::vector<const FacePatch*> patches;
  for (const FacePatch& p : result.patches) patches.push_back(&p);
  SurfaceMesh mesh = weld_patches(result.edges, t.vertex_xyz, patches).mesh;
  orient_outward(mesh);
  return mesh;
}

}  // namespace

bool has_coarse_surface(const ModelTables& tables) { return is_closed(tables, report_edge_uses(tables)); }

std::vector<float> prolong_openly(const RasterArtifact& raster) {
  return prolong(Neighbours(raster.octree.shape.view()), raster.octree.stored_length,
                 {kSlope, raster.numbers.far_length});
}

BlankSurface make_coarse_surface(const Model& model, const FaceRoles& roles, const RasterArtifact& raster,
                                 std::vector<float> lengths, const std::vector<Strip>& strips, double seconds,
                                 const Executor& executor) {
  if (executor.has_listeners()) share(executor, lengths);
  std::vector<CellLength> cells;
  for (const float length : lengths) cells.push_back({length, {0, 0, 0}, length});
  OctreeFieldData data;
  data.octree = raster.octree.shape.view();
  data.cells = cells;
  data.slope = kSlope;
  data.scale = kCoarser;
  const OctreeField octree(data, nullptr);
  const GrowingField field(octree, raster.numbers.far_length);
  MeshOptions options;
  options.enhance_rounds = 0;  // it only tells where the solid is
  options.time_limit = seconds;
  options.when_late = WhenLate::kThrow;
  options.parts_bodies = false;
  options.mends_faces = false;      // some triangles turned over hide nothing
  options.stores_requests = false;  // nobody meshes it again
  const MeshTopology topology = merge_small_features(model, field, options.merge_below, executor, &strips);
  MeshResult result = mesh_regions(model, topology, field, plan_all(topology), options, executor);
  if (!executor.is_root()) return {};
  warn_of_holes(result.failures);
  std::erase_if(result.patches, [&](const FacePatch& p) {  // sizes pass where there is air on both sides
    return p.triangles.empty() || roles.role[p.face] == FaceRole::kInterface;
  });
  SurfaceMesh mesh = joined(topology.tables(), result);
  BlankSurface surface{std::move(mesh.node_xyz), std::move(mesh.triangles), BlankSide::kInside};
  if (roles.is_passage || std::ranges::count(roles.role, FaceRole::kFarfield) > 0) surface.side = BlankSide::kOutside;
  return surface;
}

}  // namespace st
