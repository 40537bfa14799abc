// A coedge with its face.
#pragma once

#include "base/ids.h"

namespace st {

struct FaceCoedge {
  FaceId face = kNone;  ///< that the coedge bounds
  CoedgeId coedge = kNone;
};

}  // namespace st
