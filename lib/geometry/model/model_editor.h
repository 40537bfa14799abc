// The B-Rep of a Model.
#pragma once

#include "geometry/model/model_impl.h"

namespace st {

class ModelEditor {
 public:
  static const Model::Impl& brep(const Model& m) { return *m.impl_; }
};

}  // namespace st
