// Do triangles of two bodies cross although the CAD keeps the bodies apart?
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "geometry/model/bodies.h"
#include "geometry/model/model.h"
#include "mesh/crossing.h"
#include "mesh/surface_mesh.h"

namespace st {

/// Answers by the distance of the CAD's surfaces where the triangles cross. One object serves one mesh, one thread.
class WallsApart {
 public:
  WallsApart(const Model& model, const SurfaceMesh& mesh)
      : model_(model), mesh_(mesh), face_body_(bodies_of(model.tables())) {}

  /// Whether both triangles are of one body, whose shells never meet.
  bool are_of_one_body(const TrianglePair& pair) const;
  /// Whether one triangle is of a body, and the other is not: of a sheet that ends on it.
  bool are_of_body_and_sheet(const TrianglePair& pair) const;
  /// No, where the surfaces meet within the triangles, both are planes, or the first kTried pairs of these faces meet.
  bool are_apart(const TrianglePair& pair);

 private:
  static constexpr int kTried = 32;
  struct Tries {  // to find two faces apart
    int n_tried = 0;
    bool is_apart = false;  // at one place at least
  };
  std::map<std::pair<FaceId, FaceId>, Tries> known_;

  const Model& model_;
  const SurfaceMesh& mesh_;
  std::vector<std::int32_t> face_body_;
};

}  // namespace st
