// "Did you mean", where names of faces are taken beside those of groups and parts.
#pragma once

#include <string>

#include "base/face_labels.h"
#include "base/nearest_name.h"

namespace st {

/// As say_other_kind(); where that knows nothing, the name of a face that was meant.
inline std::string say_other_name(const std::string& pattern, const FaceLabels& labels) {
  const std::string meant = say_other_kind(pattern, labels);
  return meant.empty() ? did_you_mean(pattern, labels.face_name) : meant;
}

}  // namespace st
