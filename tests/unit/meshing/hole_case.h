// Holes in the mesh of a shape, and what fills them.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "meshing/hole/hole_curves.h"
#include "meshing/hole/hole_filler.h"
#include "meshing/hole/hole_merger.h"
#include "unit/meshing/mark_holes.h"
#include "unit/meshing/shape_mesh.h"

namespace st::test {

/// A mesh whose sizes change: marks, new nodes on edges, rims and fills of all faces. `solid` and `field` outlive it.
struct Refilled {
  const ShapeMesh& solid;
  const SizeField& field;
  HoleMesh holes;
  HoleMarks marks;
  EdgeUpdate update;
  HoleNumbering numbering;
  std::vector<std::vector<HoleRim>> rims;         ///< [n_faces]
  std::vector<std::vector<FaceBoundary>> bounds;  ///< [n_faces] of the rims
  std::vector<std::vector<Piece>> fills;          ///< [n_faces]

  /// Lengths are the field's where they are below the solid's.
  Refilled(const ShapeMesh& s, const SizeField& f, const HoleMarkOptions& options = {})
      : solid(s),
        field(f),
        holes(s.mesh, s.model.tables()),
        marks(mark_holes(holes, smaller(), options)),
        update(redone_edges()),
        numbering(holes, update) {
    for (FaceId face = 0; face < s.model.tables().n_faces(); ++face) fill(face);
  }
  Refilled(const Refilled&) = delete;
  Refilled& operator=(const Refilled&) = delete;

  std::vector<FacePatch> patches(std::span<const FaceId> left_out = {}) const {
    std::vector<FacePatch> all = insert_fills(numbering, marks, fills);
    add_old_patches(numbering, left_out, all);
    return all;
  }
  SurfaceMesh welded(std::span<const FaceId> left_out = {}) const { return weld_filled(numbering, patches(left_out)); }
  /// Without patches of faces that are as they were.
  SurfaceMesh inserted() const { return weld_filled(numbering, insert_fills(numbering, marks, fills)); }
  SurfaceMesh merged() const {
    const ModelTables& t = solid.model.tables();
    OrientationReport report;
    return merge_patches({update.edges, t.vertex_xyz, t.edge_vertices, patches(), t.labels.face_group}, report);
  }

 private:
  std::vector<double> smaller() const {
    std::vector<double> wanted = solid.wanted(field);
    for (double& w : wanted) w = std::min(w, solid.field.min_size());
    return wanted;
  }
  EdgeUpdate redone_edges() const {
    const std::vector<SegmentRun> runs = marked_runs(holes, marks);
    EdgeMesh fresh = EdgeMesh::of_edges(0);
    for (const SegmentRun& r : runs) fresh.append(discretise_run(holes, r, *solid.model.curve(r.edge), field, {30, 1}));
    return update_edges(holes, runs, fresh);
  }
  void fill(FaceId f) {
    rims.push_back(find_hole_rims(holes, marks, f));
    bounds.emplace_back();
    fills.emplace_back();
    const auto surface = solid.model.surface(f);
    for (const HoleRim& rim : rims.back()) {
      bounds.back().push_back(make_hole_boundary(solid.model, *surface, rim, marks, numbering, field));
      const FaceMesh mesh = mesh_face(*surface, bounds.back().back(), field, {});
      EXPECT_EQ(mesh.cause, FailureCause::kNone);
      fills.back().push_back(make_hole_fill(rim, bounds.back().back(), mesh));
    }
  }
};

/// Sizes that fall towards the first vertex (at a seam, a pole or an apex where the solid has one).
inline LinearField finer_at_a_corner(const ShapeMesh& solid) {
  return LinearField(solid.model.tables().vertex_xyz[0], 0.3 * solid.field.min_size(), 0.3);
}

/// No edge is too long or too short for what it was made for, whatever its curve's turning asked for.
inline HoleMarkOptions nothing_changes() {
  HoleMarkOptions options;
  options.change = 100;
  return options;
}

}  // namespace st::test
