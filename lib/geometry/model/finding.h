// What the import found in a model, and what it did about it.
#pragma once

#include <string>

#include "base/vec.h"

namespace st {

/// One finding of the import: what, where, what was done.
struct ImportFinding {
  std::string what;    ///< "free edge", "short edge", "sliver face", "sewn", "scaled" ...
  std::string entity;  ///< "edge 12 "TE"" or empty
  Vec3 xyz;            ///< model unit
  double size = 0;     ///< length, width, tolerance: model unit
  bool is_repair = false;
};

}  // namespace st
