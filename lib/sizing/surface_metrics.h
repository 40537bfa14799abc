// Metrics in space as the faces of a model see them.
#pragma once

#include "sizing/background.h"
#include "sizing/face_cells.h"

namespace st {

/// Where the faces of a model lie.
struct ModelPlanes {
  const FaceCells& faces;  ///< their planes are the tangent planes
  OctreeView raster;       ///< whose cells they are
};

/// Sizes of the nodes by their metrics in the tangent plane of the nearest face: the short and the long length in it,
/// and the direction of the long one; across the plane the short one. So a metric with one short and two long lengths
/// is long in both directions of a face that its short axis is normal to. At sharp edges the metrics of both planes are
/// intersected, across each by its long length; of the result the longest and the smallest length stay, which is
/// no smaller than the metric's own. Tetrahedra that no face passes through go, unless all do. Takes node_metric away.
/// False: no metric has more than one long length, and sizes stay as they are. `planes`: in the frame of the mesh;
/// where there are none, nodes keep their sizes. The same on every number of threads. O(nodes * log cells).
bool project_metrics(const ModelPlanes& planes, BackgroundMesh& mesh);

}  // namespace st
