// Angles between the CAD edges of a face at its vertices.
#pragma once

#include <map>
#include <utility>

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Looks up the CAD's corners as they are asked for. Vertices that a merged edge joins count as one.
class CadCorners {
 public:
  CadCorners(const Model& model, const MergedFeatures& merged);
  /// Smallest angle inside the face between two of its edges that meet at the vertex, degrees in (0, 360]; 360 when
  /// none does.
  double smallest_deg(FaceId face, VertexId vertex);
  /// The vertex that stands for all that merged edges join.
  VertexId representative(VertexId v) const { return representative_[v]; }

 private:
  void measure_face(FaceId face);
  struct Side;  // a coedge's end with its direction
  double angle_deg(FaceId face, const Side& arriving, const Side& leaving) const;
  Side side_of(FaceId face, CoedgeId coedge, bool at_its_end) const;

  const Model& model_;
  std::vector<VertexId> representative_;
  std::vector<std::uint8_t> is_merged_;  // by edge
  std::vector<std::uint8_t> is_known_;   // by face
  std::map<std::pair<FaceId, VertexId>, double> smallest_;
};

}  // namespace st
