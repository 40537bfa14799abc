// Boolean operations in a process of their own: they may crash, hang or eat the memory.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

#include "geometry/brep/compound.h"

namespace st::occt {

/// What a boolean operation gave.
struct BooleanResult {
  TopoDS_Shape shape;                ///< null: nothing
  std::vector<TopoDS_Shape> images;  ///< compounds of what became of the shapes that were tracked, in their order
};

/// What became of a shape in an operation of OpenCASCADE, as a compound: itself where it did not change, nothing where
/// it is gone.
template <class Operation>
TopoDS_Shape image_of(Operation& operation, const TopoDS_Shape& shape) {
  const auto& images = operation.Modified(shape);
  if (operation.IsDeleted(shape)) return compound_of(std::vector<TopoDS_Shape>{});
  return images.IsEmpty() ? TopoDS_Shape(compound_of(std::vector<TopoDS_Shape>{shape}))
                          : TopoDS_Shape(compound_of(images));
}

/// One attempt: a result, or the cause of its failure in words.
struct BooleanAttempt {
  BooleanResult result;
  std::string failure;  ///< empty: it did not fail
};

/// Runs `work` in a child process, which ends after `cpu_seconds` (> 0) of processor time. Shapes of the result that
/// are equal stay so. Cost: a fork, and writing and reading the result. Precondition: the process has no other threads.
BooleanAttempt run_boolean(const std::function<BooleanResult()>& work, double cpu_seconds);

}  // namespace st::occt
