#include "sizing/field_hessian.h"

#include <algorithm>
#include <optional>

#include "base/eigen.h"
#include "base/threads.h"
#include "sizing/symmetric_tensor.h"

namespace st {
namespace {

const double kSharp = std::cos(radians(30));  // of the angle between a triangle and the mean of those at a node
constexpr double kRounding = 1e-12;           // of the largest value: how far a linear field seems to curve

/// Numbers of each node, as CSR.
struct NodeLists {
  std::vector<std::int64_t> first;
  std::vector<std::int32_t> item;

  std::span<const std::int32_t> operator[](std::int32_t node) const {
    return std::span(item).subspan(first[node], first[node + 1] - first[node]);
  }
};

/// The cells of each node.
template <std::size_t N>
NodeLists cells_of_nodes(const std::vector<std::array<std::int32_t, N>>& cells, std::size_t n_nodes) {
  NodeLists lists;
  lists.first.assign(n_nodes + 1, 0);
  lists.item.resize(N * cells.size());
  for (const auto& cell : cells)
    for (const std::int32_t n : cell) ++lists.first[n + 1];
  for (std::size_t n = 0; n < n_nodes; ++n) lists.first[n + 1] += lists.first[n];
  std::vector<std::int64_t> next(lists.first.begin(), lists.first.end() - 1);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const std::int32_t n : cells[c]) lists.item[next[n]++] = static_cast<std::int32_t>(c);
  return lists;
}

/// D: of space or of the tangent plane. Unknowns: D slopes, then the second derivatives 11 12 13 22 23 33 or 11 12 22.
template <int D>
struct Quadric {
  static constexpr int kUnknowns = D + D * (D + 1) / 2;
  using Point = Eigen::Matrix<double, D, 1>;
  using Row = Eigen::Matrix<double, kUnknowns, 1>;
  using Square = Eigen::Matrix<double, D, D>;

  static Row row_of(const Point& x) {
    Row row;
    row.template head<D>() = x;
    int at = D;
    for (int i = 0; i < D; ++i)
      for (int k = i; k < D; ++k) row[at++] = (i == k ? 0.5 : 1.0) * x[i] * x[k];
    return row;
  }

  /// Second derivatives of the quadric that is 0 at the origin and fits `value` at the points, zero where it curves by
  /// no more than `rounding` among them; nullopt: they lie so that they do not tell it.
  static std::optional<Square> fit(const std::vector<Point>& points, const std::vector<double>& value,
                                   double rounding) {
    constexpr double kSingular = 1e-10;  // of pivots of the scaled normal equations, which are about one
    if (points.size() < kUnknowns) return std::nullopt;
    Square scatter = Square::Zero();
    for (const Point& x : points) scatter += x * x.transpose();
    scatter /= static_cast<double>(points.size());
    const Eigen::SelfAdjointEigenSolver<Square> axes(scatter);
    if (!(axes.eigenvalues()[0] > 0)) return std::nullopt;
    const Square to_unit = axes.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal() * axes.eigenvectors().transpose();
    Eigen::Matrix<double, kUnknowns, kUnknowns> normal = decltype(normal)::Zero();
    Row right = Row::Zero();
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point x = to_unit * points[i];
      const double weight = 1 / x.squaredNorm();
      const Row row = row_of(x);
      normal += weight * row * row.transpose();
      right += weight * value[i] * row;
      sum += weight;
    }
    const Eigen::LDLT<decltype(normal)> solver(normal / sum);
    if (!(solver.vectorD().minCoeff() > kSingular)) return std::nullopt;
    const Row unknown = solver.solve(right / sum);
    Square second;
    int at = D;
    for (int i = 0; i < D; ++i)
      for (int k = i; k < D; ++k) second(i, k) = second(k, i) = unknown[at++];
    if (!(second.cwiseAbs().maxCoeff() > rounding)) return Square::Zero();
    return to_unit.transpose() * second * to_unit;
  }
};

double largest_of(std::span<const double> value) {
  double largest = 0;
  for (const double v : value) largest = std::max(largest, std::abs(v));
  return largest;
}

/// Fits quadrics at nodes of one piece of the mesh.
class HessianFit {
 public:
  HessianFit(const BackgroundMesh& mesh, std::span<const double> value, const NodeLists& cells_of,
             std::span<const Vec3> triangle_normal)
      : mesh_(mesh),
        value_(value),
        rounding_(kRounding * largest_of(value)),
        cells_of_(cells_of),
        triangle_normal_(triangle_normal),
        seen_by_(mesh.node_xyz.size(), -1) {}

  std::optional<SymmetricTensor> in_volume(std::int32_t node) {
    for (std::size_t n_wanted = 2 * Quadric<3>::kUnknowns; gather(node, n_wanted, mesh_.tets, kAll); n_wanted *= 2) {
      points3_.clear();
      for (const std::int32_t n : near_) points3_.push_back(to_eigen(mesh_.node_xyz[n] - mesh_.node_xyz[node]));
      if (const auto second = Quadric<3>::fit(points3_, differences(node), rounding_)) return tensor_of(*second);
      if (near_.size() >= kMostNodes) break;
    }
    return std::nullopt;
  }

  std::optional<SymmetricTensor> on_surface(std::int32_t node) {
    Vec3 normal;
    for (const std::int32_t t : cells_of_[node]) normal += triangle_normal_[t];
    if (!(norm(normal) > 0)) return std::nullopt;
    normal = normalized(normal);
    const auto is_flat = [&](std::int32_t t) {
      return dot(triangle_normal_[t], normal) >= kSharp * norm(triangle_normal_[t]);
    };
    for (const std::int32_t t : cells_of_[node])
      if (!is_flat(t)) return std::nullopt;
    const Vec3 a = normalized(cross(normal, std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})),
               b = cross(normal, a);
    Eigen::Matrix<double, 3, 2> frame;
    frame << to_eigen(a), to_eigen(b);
    for (std::size_t n_wanted = 2 * Quadric<2>::kUnknowns; gather(node, n_wanted, mesh_.triangles, is_flat);
         n_wanted *= 2) {
      points2_.clear();
      for (const std::int32_t n : near_) {
        const Vec3 d = mesh_.node_xyz[n] - mesh_.node_xyz[node];
        points2_.emplace_back(dot(d, a), dot(d, b));
      }
      if (const auto second = Quadric<2>::fit(points2_, differences(node), rounding_)) {
        const double across =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(*second).eigenvalues().cwiseAbs().maxCoeff();
        return tensor_of(frame * *second * frame.transpose() +
                         across * to_eigen(normal) * to_eigen(normal).transpose());
      }
      if (near_.size() >= kMostNodes) break;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kMostNodes = 400;  // more rings tell of other places
  static constexpr auto kAll = [](std::int32_t) { return true; };

  /// Fills near_ with rings around the node until it has `n_wanted`; false: no more than before. Cells that `counts`
  /// refuses are not crossed.
  template <class Cells, class Counts>
  bool gather(std::int32_t node, std::size_t n_wanted, const Cells& cells, const Counts& counts) {
    const std::size_t n_before = near_of_ == node ? near_.size() : 0;
    if (near_of_ != node) {
      near_.clear();
      near_of_ = seen_by_[node] = node;
      grown_ = 0;
      grow(node, cells, counts);
    }
    while (near_.size() < n_wanted && grown_ < near_.size())
      for (const std::size_t end = near_.size(); grown_ < end; ++grown_) grow(near_[grown_], cells, counts);
    return near_.size() > n_before;
  }
  template <class Cells, class Counts>
  void grow(std::int32_t from, const Cells& cells, const Counts& counts) {
    for (const std::int32_t c : cells_of_[from]) {
      if (!counts(c)) continue;
      for (const std::int32_t n : cells[c]) {
        if (seen_by_[n] == near_of_) continue;
        seen_by_[n] = near_of_;
        near_.push_back(n);
      }
    }
  }
  const std::vector<double>& differences(std::int32_t node) {
    differences_.clear();
    for (const std::int32_t n : near_) differences_.push_back(value_[n] - value_[node]);
    return differences_;
  }

  const BackgroundMesh& mesh_;
  const std::span<const double> value_;
  const double rounding_;
  const NodeLists& cells_of_;
  const std::span<const Vec3> triangle_normal_;  // [triangles] not of unit length
  std::vector<std::int32_t> seen_by_;            // [nodes] for which one
  std::vector<std::int32_t> near_;
  std::int32_t near_of_ = -1;
  std::size_t grown_ = 0;  // of near_, whose neighbours are in it
  std::vector<double> differences_;
  std::vector<Quadric<3>::Point> points3_;
  std::vector<Quadric<2>::Point> points2_;
};

/// Nodes without derivatives take the mean of their neighbours that have them, from ring to ring.
template <class Cells>
std::int64_t fill_unknown(const Cells& cells, const NodeLists& cells_of, std::vector<std::uint8_t>& is_known,
                          std::vector<SymmetricTensor>& hessian) {
  std::vector<std::int32_t> unknown, left, filled;
  for (std::size_t n = 0; n < hessian.size(); ++n)
    if (!is_known[n]) unknown.push_back(static_cast<std::int32_t>(n));
  for (; !unknown.empty(); unknown.swap(left), left.clear(), filled.clear()) {
    for (const std::int32_t node : unknown) {
      SymmetricTensor sum{};
      int n_known = 0;
      for (const std::int32_t c : cells_of[node])
        for (const std::int32_t n : cells[c]) {
          if (!is_known[n]) continue;
          ++n_known;
          for (std::size_t k = 0; k < 6; ++k) sum[k] += hessian[n][k];
        }
      if (n_known == 0) {
        left.push_back(node);
        continue;
      }
      for (std::size_t k = 0; k < 6; ++k) hessian[node][k] = sum[k] / n_known;
      filled.push_back(node);
    }
    if (filled.empty()) break;
    for (const std::int32_t n : filled) is_known[n] = 1;
  }
  return static_cast<std::int64_t>(std::max(unknown.size(), left.size()));
}

template <class Cells, class Fit>
NodeHessians fit_all(const Cells& cells, std::size_t n_nodes, const Fit& fit) {
  constexpr std::size_t kMostPieces = 64, kLeastNodes = 4096;  // each has a mark per node of the mesh
  const NodeLists cells_of = cells_of_nodes(cells, n_nodes);
  NodeHessians result;
  result.of_node.resize(n_nodes);
  std::vector<std::uint8_t> is_known(n_nodes, 0);
  parallel_for(n_nodes, std::max(kLeastNodes, n_nodes / kMostPieces + 1), [&](std::size_t begin, std::size_t end) {
    fit(cells_of, [&](const auto& at_node) {
      for (std::size_t n = begin; n < end; ++n)
        if (const std::optional<SymmetricTensor> second = at_node(static_cast<std::int32_t>(n))) {
          result.of_node[n] = *second;
          is_known[n] = 1;
        }
    });
  });
  result.n_unknown = fill_unknown(cells, cells_of, is_known, result.of_node);
  return result;
}

}  // namespace

NodeHessians fit_hessians(const BackgroundMesh& mesh, std::span<const double> value) {
  const std::size_t n_nodes = mesh.node_xyz.size();
  if (!mesh.tets.empty())
    return fit_all(mesh.tets, n_nodes, [&](const NodeLists& cells_of, const auto& run) {
      HessianFit fit(mesh, value, cells_of, {});
      run([&](std::int32_t node) { return fit.in_volume(node); });
    });
  std::vector<Vec3> normal;
  for (const auto& t : mesh.triangles)
    normal.push_back(cross(mesh.node_xyz[t[1]] - mesh.node_xyz[t[0]], mesh.node_xyz[t[2]] - mesh.node_xyz[t[0]]));
  return fit_all(mesh.triangles, n_nodes, [&](const NodeLists& cells_of, const auto& run) {
    HessianFit fit(mesh, value, cells_of, normal);
    run([&](std::int32_t node) { return fit.on_surface(node); });
  });
}

}  // namespace st
