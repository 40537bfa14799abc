// Symmetric tensors as matrices.
#pragma once

#include "base/eigen.h"
#include "sizing/background.h"

namespace st {

inline Eigen::Matrix3d matrix_of(const SymmetricTensor& t) {
  Eigen::Matrix3d m;
  m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return m;
}

/// By the upper triangle.
inline SymmetricTensor tensor_of(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)};
}

}  // namespace st
