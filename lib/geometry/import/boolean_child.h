// Boolean operations in a process of their own: they may crash, hang or eat the memory.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

namespace st::occt {

/// What a boolean operation gave.
struct BooleanResult {
  TopoDS_Shape shape;                ///< null: nothing
  std::vector<TopoDS_Shape> images;  ///< compounds of what became of the shapes that were tracked, in their order
};

/// One attempt: a result, or the cause of its failure in words.
struct BooleanAttempt {
  BooleanResult result;
  std::string failure;  ///< empty: it did not fail
};

/// Runs `work` in a child process, which ends after `cpu_seconds` (> 0) of processor time. Shapes of the result that
/// are equal stay so. Cost: a fork, and writing and reading the result. Precondition: the process has no other threads.
BooleanAttempt run_boolean(const std::function<BooleanResult()>& work, double cpu_seconds);

}  // namespace st::occt
