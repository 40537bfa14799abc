#include "base/sparse.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace st {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix to_matrix(std::span<const SparseEntry> entries, std::size_t n) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const SparseEntry& e : entries) triplets.emplace_back(e.row, e.column, e.value);
  Matrix matrix(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace

std::optional<std::vector<Vec2>> solve_sparse(std::span<const SparseEntry> entries, std::span<const Vec2> b) {
  Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>> solver;
  solver.compute(to_matrix(entries, b.size()));
  if (solver.info() != Eigen::Success) return std::nullopt;
  Eigen::MatrixX2d right(b.size(), 2);
  for (std::size_t i = 0; i < b.size(); ++i) right.row(static_cast<Eigen::Index>(i)) << b[i].x, b[i].y;
  const Eigen::MatrixX2d x = solver.solve(right);
  std::vector<Vec2> result;
  for (Eigen::Index i = 0; i < x.rows(); ++i) result.push_back({x(i, 0), x(i, 1)});
  return result;
}

struct SymmetricSolver::Impl {
  Eigen::SimplicialLDLT<Matrix> decomposition;
  bool is_analysed = false;
};

SymmetricSolver::SymmetricSolver() : impl_(std::make_unique<Impl>()) {}
SymmetricSolver::~SymmetricSolver() = default;

std::optional<std::vector<double>> SymmetricSolver::solve(std::span<const SparseEntry> entries,
                                                          std::span<const double> b) {
  const Matrix matrix = to_matrix(entries, b.size());
  if (!impl_->is_analysed) impl_->decomposition.analyzePattern(matrix);
  impl_->is_analysed = true;
  impl_->decomposition.factorize(matrix);
  if (impl_->decomposition.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::VectorXd x = impl_->decomposition.solve(right);
  return std::vector<double>(x.data(), x.data() + x.size());
}

}  // namespace st
