// The axes of a model, wherever it lies in space: those that its straight edges and its plane edges show.
#pragma once

#include <array>
#include <vector>

#include "base/executor.h"
#include "geometry/model/facets.h"
#include "geometry/model/model.h"

namespace st {

/// Axes along which the extent of a model is measured.
struct OwnAxes {
  std::array<Vec3, 3> axis = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< unit, at right angles, right-handed
  std::vector<Box3> face_box;                                                ///< [n_faces] along these, model unit
  Facets facets;          ///< of all faces, where they were measured by them; of rank 0
  double deflection = 0;  ///< of these, model unit
};

/// Of the axes at right angles that the edges show, those along which most of them run, or to which most of their
/// planes are square, each edge with its length. A model without such edges has those along which its edges spread
/// most. Collective. Cost: a few points on each edge; a coarse triangulation of the faces, as tasks, where other axes
/// than those of space show.
OwnAxes find_own_axes(const Model& model, const Executor& executor = SerialExecutor());

}  // namespace st
