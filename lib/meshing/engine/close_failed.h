// Faces that failed, closed by the triangles of least area between their loops.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "base/current_work.h"
#include "geometry/model/model.h"
#include "meshing/engine/meshed_faces.h"
#include "meshing/face/refinements.h"

namespace st {

/// What the triangles are made from.
struct FaceClosing {
  const Model& model;
  const SizeField& field;
  const Refinements& refinements;
  const std::map<FaceId, std::string>& left_out;  ///< faces that stay holes
  std::function<WorkLimit(FaceId)> limit;
};

/// Local, on rank 0, the faces on its threads. What cannot be closed either stays a hole.
void close_failed(const FaceClosing& by, MeshedFaces& faces);

}  // namespace st
