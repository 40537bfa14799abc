// The surface of the face at hand.
#pragma once

#include <cstddef>
#include <memory>

#include "geometry/model/model.h"

namespace st {

/// Triangles that one thread takes at a time. What is found for them depends on no other piece, so the number of
/// threads does not show.
inline constexpr std::size_t kTrianglesPerPiece = 16'384;

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
