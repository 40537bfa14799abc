// The surface of the face at hand.
#pragma once

#include <memory>

#include "geometry/model/model.h"

namespace st {

/// Makes a surface when the face changes: triangles come face by face. One per thread.
class FaceSurface {
 public:
  /// The model outlives the object.
  explicit FaceSurface(const Model& model) : model_(model) {}
  const Surface& of(FaceId face) {
    if (face != face_) surface_ = model_.surface(face);
    face_ = face;
    return *surface_;
  }

 private:
  const Model& model_;
  FaceId face_ = kNone;
  std::unique_ptr<Surface> surface_;
};

}  // namespace st
