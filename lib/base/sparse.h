// Large sparse systems of equations, solved directly: on one thread, in an order that depends on the matrix alone, so
// that the same input gives the same bits.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"

namespace st {

/// Entries of one place are added.
struct SparseEntry {
  std::int32_t row = 0, column = 0;
  double value = 0;
};

/// x of A x = b by sparse LU with column ordering, for both columns of b; nullopt where A is singular. Some
/// milliseconds per thousand unknowns of a triangulation.
std::optional<std::vector<Vec2>> solve_sparse(std::span<const SparseEntry> matrix, std::span<const Vec2> b);

/// Sparse LDL^T of symmetric matrices that have entries in the same places.
class SymmetricSolver {
 public:
  SymmetricSolver();
  ~SymmetricSolver();
  SymmetricSolver(const SymmetricSolver&) = delete;
  SymmetricSolver& operator=(const SymmetricSolver&) = delete;
  /// x of A x = b; nullopt where A cannot be decomposed. `matrix`: both triangles, in the same order each time.
  std::optional<std::vector<double>> solve(std::span<const SparseEntry> matrix, std::span<const double> b);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace st
