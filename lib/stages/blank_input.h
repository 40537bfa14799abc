// The closed mesh that st-prolong is given for blanking. Internal to stages.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/similarity.h"
#include "io/hdf5/artifact.h"
#include "sizing/blanking.h"

namespace st {

/// A mesh whose triangles agree in orientation, normals out of its inside.
struct BlankInput {
  SurfaceMesh mesh;
  BlankSide side = BlankSide::kInside;
  InputRef file;  ///< for the header

  SurfaceView view() const { return {mesh.node_xyz, mesh.triangles}; }
};

/// Throws Error(kUsage) unless `side` is "inside", "outside" or "auto".
void require_blank_side(const std::string& side);

/// Reads, orients and checks. `side`: as above; "auto": outside when the name of a group says far field. Throws
/// Error(kUsage), Error(kInput), Error(kGeometry) naming places when the mesh is open or cannot be oriented.
BlankInput read_blank(const std::string& path, const std::string& side);

/// The share of the points, 0 to 1, that lie in one of these leaves or next to one: no farther than a tenth of an edge
/// of the leaf in which they are. 0 without points.
double share_near(std::span<const Vec3> points, const OctreeView& octree, std::span<const std::int32_t> leaves);

/// The nodes moved; a mirrored mesh keeps its normals out of its inside.
void transform(const Similarity& motion, SurfaceMesh& mesh);

}  // namespace st
