#include "sizing/background.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/eigen.h"
#include "sizing/length_tree.h"
#include "sizing/mean_stretch.h"
#include "sizing/multiscale_metric.h"
#include "sizing/space_metric.h"
#include "sizing/symmetric_tensor.h"
#include "sizing/tet_frame.h"

namespace st {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <std::size_t N, std::size_t M>
bool have_common_node(const std::array<std::int32_t, N>& a, const std::array<std::int32_t, M>& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

/// Barycentric coordinates of the place on a triangle that is closest to x.
std::array<double, 3> closest_on_triangle(const std::array<Vec3, 3>& p, Vec3 x) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], n = cross(a, b), r = x - p[0];
  const double n2 = norm2(n), wb = n2 > 0 ? dot(cross(r, b), n) / n2 : -1, wc = n2 > 0 ? dot(cross(a, r), n) / n2 : -1;
  if (wb >= 0 && wc >= 0 && wb + wc <= 1) return {1 - wb - wc, wb, wc};
  std::array<double, 3> closest{1, 0, 0};
  double least = kInfinity;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t to = (k + 1) % 3;
    const Vec3 side = p[to] - p[k];
    const double side2 = norm2(side), t = side2 > 0 ? std::clamp(dot(x - p[k], side) / side2, 0.0, 1.0) : 0,
                 d2 = norm2(p[k] + t * side - x);
    if (!(d2 < least)) continue;
    least = d2;
    closest = {};
    closest[k] = 1 - t;
    closest[to] = t;
  }
  return closest;
}

/// Faces that one tetrahedron alone has, by their nodes: those with the lowest node in one range after the other, so
/// that an eighth of them is in memory at once.
std::vector<std::array<std::int32_t, 3>> border_of(const BackgroundMesh& mesh) {
  const std::size_t n_at_once = mesh.node_xyz.size() / 8 + 1;
  std::vector<std::array<std::int32_t, 3>> faces, border;
  for (std::size_t first = 0; first < mesh.node_xyz.size(); first += n_at_once) {
    faces.clear();
    for (const auto& t : mesh.tets)
      for (std::size_t k = 0; k < 4; ++k) {
        std::array<std::int32_t, 3> face{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
        const auto lowest = static_cast<std::size_t>(std::min({face[0], face[1], face[2]}));
        if (lowest < first || lowest - first >= n_at_once) continue;
        std::sort(face.begin(), face.end());
        faces.push_back(face);
      }
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
      for (end = i + 1; end < faces.size() && faces[end] == faces[i];) ++end;
      if (end == i + 1) border.push_back(faces[i]);
    }
  }
  return border;
}

class BackgroundSource final : public SizeSource {
 public:
  BackgroundSource(BackgroundMesh mesh, double slope) : SizeSource(slope), mesh_(std::move(mesh)) {
    for (const LocalSize& s : mesh_.node_size) {
      min_size_ = std::min(min_size_, s.length);
      max_aspect_ = std::max(max_aspect_, s.along / s.length);
    }
    if (has_metrics())
      take_logs(mesh_.node_metric);
    else if (max_aspect_ > 1)
      for (const LocalSize& s : mesh_.node_size) log_stretch_.push_back(log_stretch(s));
    border_ = border_of(mesh_);
    border_.insert(border_.end(), mesh_.triangles.begin(), mesh_.triangles.end());
    leave_out_flat();
    for (const Vec3 x : mesh_.node_xyz) box_.add(x);
    tet_tree_ = tree_over(std::span<const std::array<std::int32_t, 4>>(mesh_.tets));
    border_tree_ = tree_over(std::span<const std::array<std::int32_t, 3>>(border_));
  }

  double size(Vec3 x, int&) const override { return size_below(x, kInfinity); }
  double size_below(Vec3 x, double upper) const override {
    std::size_t tet = kNowhere, border = kNowhere;
    return least_outside(x, least_inside(x, upper, tet), border);
  }
  LocalSize local(Vec3 x, int&) const override {
    std::size_t tet = kNowhere, border = kNowhere;
    const double length = least_outside(x, least_inside(x, kInfinity, tet), border);
    if (has_metrics()) {
      const LocalSize s = size_of_metric(metric_at(x));
      return longer_along(s.direction, length, s.along);
    }
    if (log_stretch_.empty() || (border == kNowhere && tet == kNowhere)) return {length, length, {}};
    return border == kNowhere ? stretched_in(tet, length, x) : stretched_from(border, length, x);
  }
  LocalSize local_on(Vec3 x, Vec3 normal, int& hint) const override {
    return has_metrics() ? cut_by_plane(metric_at(x), normal) : local(x, hint);
  }
  bool has_metrics() const override { return !mesh_.node_metric.empty(); }
  /// In a tetrahedron by its own gradient, which may be far below the slope.
  double least_within(Vec3 x, double radius, double upper) const override {
    const double drop = slope() * radius;
    std::size_t border = kNowhere;
    double best = std::min(upper, std::max(min_size_, least_outside(x, upper + drop, border) - drop));
    tet_tree_.visit_within(x, radius, best, [&](std::int32_t t) {
      const TetFrame frame = frame_of(static_cast<std::size_t>(t));
      const std::array<double, 4> lengths = lengths_of(mesh_, mesh_.tets[t]);
      const double at_x = interpolated(frame.coordinates(x), lengths);
      best = std::min(best, std::max(*std::min_element(lengths.begin(), lengths.end()),
                                     at_x - norm(frame.gradient(lengths)) * radius));
    });
    return best;
  }
  /// Of the cell that tells the length at x.
  Vec3 gradient(Vec3 x) const override {
    std::size_t tet = kNowhere, border = kNowhere;
    least_outside(x, least_inside(x, kInfinity, tet), border);
    if (border != kNowhere) return gradient_of([&](Vec3 at) { return border_length(border, at); }, x);
    return tet == kNowhere ? Vec3{} : frame_of(tet).gradient(lengths_of(mesh_, mesh_.tets[tet]));
  }
  double min_size() const override { return min_size_; }
  double max_aspect() const override { return max_aspect_; }
  SourceGrowth growth() const override { return {box_, {min_size_, 0, 0}}; }

 private:
  void leave_out_flat() {
    std::erase_if(mesh_.tets, [&](const auto& tet) { return is_flat(st::corners_of(mesh_, tet)); });
  }
  /// Made anew each time: all of them are six times the mesh.
  TetFrame frame_of(std::size_t tet) const { return TetFrame(st::corners_of(mesh_, mesh_.tets[tet])); }
  template <std::size_t N>
  LengthTree tree_over(std::span<const std::array<std::int32_t, N>> cells) const {
    const auto box_of = [&](std::int32_t c) {
      Box3 box;
      for (const std::int32_t node : cells[static_cast<std::size_t>(c)]) box.add(mesh_.node_xyz[node]);
      return box;
    };
    return {BoxTree(static_cast<std::int32_t>(cells.size()), box_of), [&](std::int32_t c) {
              double least = kInfinity;
              for (const std::int32_t node : cells[static_cast<std::size_t>(c)])
                least = std::min(least, mesh_.node_size[node].length);
              return least;
            }};
  }

  static bool is_inside(const std::array<double, 4>& at) {
    constexpr double kOnSide = -1e-9;  // of the height: sides are shared
    return *std::min_element(at.begin(), at.end()) >= kOnSide;
  }
  static double interpolated(const std::array<double, 4>& at, const std::array<double, 4>& value) {
    return at[0] * value[0] + at[1] * value[1] + at[2] * value[2] + at[3] * value[3];
  }
  /// Of the tetrahedra that hold x, or best; `winner`: the first of those with the smallest.
  double least_inside(Vec3 x, double best, std::size_t& winner) const {
    tet_tree_.visit_at(x, best, [&](std::int32_t t) {
      const std::array<double, 4> at = frame_of(static_cast<std::size_t>(t)).coordinates(x);
      if (!is_inside(at)) return;
      const double length = interpolated(at, lengths_of(mesh_, mesh_.tets[t]));
      if (length < best) {
        best = length;
        winner = static_cast<std::size_t>(t);
      }
    });
    return best;
  }
  std::array<double, 3> border_lengths(std::size_t triangle) const {
    return values_at(border_[triangle], [](const LocalSize& s) { return s.length; });
  }
  double border_length(std::size_t triangle, Vec3 x) const {
    return least_over_triangle(x, corners_of(triangle), border_lengths(triangle), slope());
  }
  /// Whether lengths that grow from a triangle can be below `best` at x.
  bool may_be_below(double best, Vec3 x, std::size_t triangle, const std::array<double, 3>& lengths) const {
    constexpr double kRounding = 1e-12;  // of a length: a bound is as exact as that
    return bound_over_triangle(x, corners_of(triangle), lengths, slope()) < (1 + kRounding) * best;
  }
  /// Of the growth from the border, or best; `winner`: the triangle that asks for less than best, else unchanged.
  double least_outside(Vec3 x, double best, std::size_t& winner) const {
    border_tree_.visit_from(x, slope(), best, [&](std::int32_t b) {
      const auto triangle = static_cast<std::size_t>(b);
      if (!may_be_below(best, x, triangle, border_lengths(triangle))) return;
      const double length = border_length(triangle, x);
      if (!(length < best)) return;
      best = length;
      winner = triangle;
    });
    return best;
  }
  /// With the mean of the metrics of a tetrahedron's nodes, by their weights at x.
  LocalSize stretched_in(std::size_t t, double length, Vec3 x) const {
    const auto& nodes = mesh_.tets[t];
    const std::array<double, 4> at = frame_of(static_cast<std::size_t>(t)).coordinates(x);
    const MeanStretch mean = mean_stretch(stretches_of(nodes), at);
    const double along = mean.kept * interpolated(at, values_at(nodes, [](const LocalSize& s) { return s.along; }));
    return longer_along(mean.direction, length, std::min(along, least_of_other_tets(nodes, mean.direction, x)));
  }
  /// Likewise where a triangle of the border asks for least at x. The length along grows by the slope, too.
  LocalSize stretched_from(std::size_t b, double length, Vec3 x) const {
    const auto& nodes = border_[b];
    const MeanStretch mean = mean_stretch(stretches_of(nodes), closest_on_triangle(corners_of(b), x));
    const double inside = least_of_other_tets(nodes, mean.direction, x);
    return longer_along(mean.direction, length, inside < kInfinity ? inside : least_of_border(nodes, mean, x));
  }
  /// In space, of the cell that tells the length at x; from the border all lengths grow alike.
  SymmetricTensor metric_at(Vec3 x) const {
    std::size_t tet = kNowhere, border = kNowhere;
    const double length = least_outside(x, least_inside(x, kInfinity, tet), border);
    if (border == kNowhere)
      return least_of_other_metrics(mesh_.tets[tet], x,
                                    mean_metric_in(mesh_.tets[tet], frame_of(tet).coordinates(x), length));
    const std::array<double, 3> at = closest_on_triangle(corners_of(border), x), of_nodes = border_lengths(border);
    const double there = std::min(length, at[0] * of_nodes[0] + at[1] * of_nodes[1] + at[2] * of_nodes[2]);
    const SymmetricTensor mean = mean_metric_in(border_[border], at, there);
    return least_of_other_metrics(border_[border], x,
                                  length > there ? GrowingMetric(mean).after(length - there) : mean);
  }
  template <std::size_t N>
  SymmetricTensor mean_metric_in(const std::array<std::int32_t, N>& nodes, const std::array<double, N>& at,
                                 double shortest) const {
    std::array<SymmetricTensor, N> logs;
    for (std::size_t k = 0; k < N; ++k) logs[k] = mesh_.node_metric[nodes[k]];
    return mean_metric(logs, at, shortest);
  }
  /// The intersection of `own` with what tetrahedra at x ask for that have none of `nodes`: meshes may overlap.
  template <std::size_t N>
  SymmetricTensor least_of_other_metrics(const std::array<std::int32_t, N>& nodes, Vec3 x, SymmetricTensor own) const {
    tet_tree_.visit_at(x, kInfinity, [&](std::int32_t t) {
      const auto& tet = mesh_.tets[t];
      const std::array<double, 4> at = frame_of(static_cast<std::size_t>(t)).coordinates(x);
      if (!is_inside(at) || have_common_node(tet, nodes)) return;
      own = intersection(own, mean_metric_in(tet, at, interpolated(at, lengths_of(mesh_, tet))));
    });
    return own;
  }
  static LocalSize longer_along(Vec3 direction, double length, double along) {
    return along > length && !(direction == Vec3{}) ? LocalSize{length, along, direction}
                                                    : LocalSize{length, length, {}};
  }
  /// The smallest along `direction` of what tetrahedra at x ask for that have none of `nodes`: meshes may overlap.
  template <std::size_t N>
  double least_of_other_tets(const std::array<std::int32_t, N>& nodes, Vec3 direction, Vec3 x) const {
    double best = kInfinity;
    tet_tree_.visit_at(x, best, [&](std::int32_t t) {
      const auto& tet = mesh_.tets[t];
      const std::array<double, 4> at = frame_of(static_cast<std::size_t>(t)).coordinates(x);
      if (!is_inside(at) || have_common_node(tet, nodes)) return;
      best = std::min(best, interpolated(at, values_at(tet, [&](const LocalSize& s) { return s.in(direction); })));
    });
    return best;
  }
  /// Likewise of the growth from the border. Triangles beside `nodes` are stretched as these.
  double least_of_border(const std::array<std::int32_t, 3>& nodes, const MeanStretch& mean, Vec3 x) const {
    double best = kInfinity;
    border_tree_.visit_from(x, slope(), best, [&](std::int32_t b) {
      const auto& triangle = border_[static_cast<std::size_t>(b)];
      if (!may_be_below(best, x, static_cast<std::size_t>(b), border_lengths(static_cast<std::size_t>(b)))) return;
      const bool is_beside = have_common_node(triangle, nodes);
      const std::array<double, 3> lengths = values_at(triangle, [&](const LocalSize& s) {
        return is_beside ? std::max(s.length, mean.kept * s.along) : s.in(mean.direction);
      });
      if (!may_be_below(best, x, static_cast<std::size_t>(b), lengths)) return;
      best = std::min(best, least_over_triangle(x, corners_of(static_cast<std::size_t>(b)), lengths, slope()));
    });
    return best;
  }
  std::array<Vec3, 3> corners_of(std::size_t border) const {
    const auto& n = border_[border];
    return {mesh_.node_xyz[n[0]], mesh_.node_xyz[n[1]], mesh_.node_xyz[n[2]]};
  }
  template <std::size_t N, class Value>
  std::array<double, N> values_at(const std::array<std::int32_t, N>& nodes, const Value& value) const {
    std::array<double, N> values{};
    for (std::size_t k = 0; k < N; ++k) values[k] = value(mesh_.node_size[nodes[k]]);
    return values;
  }

  template <std::size_t N>
  std::array<Vec3, N> stretches_of(const std::array<std::int32_t, N>& nodes) const {
    std::array<Vec3, N> stretches;
    for (std::size_t k = 0; k < N; ++k) stretches[k] = log_stretch_[nodes[k]];
    return stretches;
  }

  static constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
  BackgroundMesh mesh_;
  std::vector<Vec3> log_stretch_;                    // [nodes]; empty where none is stretched
  std::vector<std::array<std::int32_t, 3>> border_;  // nodes
  LengthTree tet_tree_, border_tree_;
  Box3 box_;
  double min_size_ = kInfinity, max_aspect_ = 1;
};

/// Of the sizes behind those that have one.
void add_plain_metrics(const std::vector<LocalSize>& sizes, std::vector<SymmetricTensor>& metrics) {
  for (const LocalSize& s : sizes) metrics.push_back(metric_of(s));
}

}  // namespace

LocalSize uniaxial(const LocalSize& s) {
  constexpr double kEqual = 1 + 1e-6;
  const bool is_stretched = s.along > kEqual * s.length && norm(s.direction) > 0;
  return is_stretched ? LocalSize{s.length, s.along, normalized(s.direction)} : LocalSize{s.length, s.length, {}};
}

LocalSize size_of_metric(const SymmetricTensor& metric) {
  const auto [xx, yy, zz, xy, yz, xz] = metric;
  if (!std::isfinite(xx + yy + zz + xy + yz + xz)) return {};
  const PrincipalAxes axes = principal_axes(matrix_of(metric));
  if (!(axes.value[0] > 0)) return {};
  return uniaxial({1 / std::sqrt(axes.value[2]), 1 / std::sqrt(axes.value[0]), axes.axis[0]});
}

SymmetricTensor metric_of(const LocalSize& size) {
  const Eigen::Vector3d squeeze = to_eigen(size.squeeze());
  const Eigen::Matrix3d shape = Eigen::Matrix3d::Identity() - squeeze * squeeze.transpose();
  return tensor_of(Eigen::Matrix3d(shape / (size.length * size.length)));
}

void forget_plain_metrics(BackgroundMesh& mesh) {
  constexpr double kEqual = 0.999;  // of 1/length^2: less is rounding of a file
  const auto is_plain = [](const SymmetricTensor& m) {
    const PrincipalAxes axes = principal_axes(matrix_of(m));
    return !(axes.value[1] < kEqual * axes.value[2]);
  };
  if (std::all_of(mesh.node_metric.begin(), mesh.node_metric.end(), is_plain)) mesh.node_metric = {};
}

std::int64_t raise_lengths(double least, BackgroundMesh& mesh) {
  std::int64_t n_raised = 0;
  for (LocalSize& s : mesh.node_size) {
    n_raised += s.length < least;
    s = uniaxial({std::max(s.length, least), std::max(s.along, least), s.direction});
  }
  for (SymmetricTensor& m : mesh.node_metric) m = raised_metric(m, least);
  return n_raised;
}

std::vector<std::int32_t> number_used_nodes(BackgroundMesh& mesh) {
  std::vector<std::int32_t> number(mesh.node_xyz.size(), -1), kept;
  const auto number_nodes_of = [&](auto& cells) {
    for (auto& cell : cells)
      for (std::int32_t& n : cell) {
        if (number[n] < 0) {
          number[n] = static_cast<std::int32_t>(kept.size());
          kept.push_back(n);
        }
        n = number[n];
      }
  };
  number_nodes_of(mesh.tets);
  number_nodes_of(mesh.triangles);
  return kept;
}

void transform(const Similarity& motion, BackgroundMesh& mesh) {
  for (Vec3& p : mesh.node_xyz) p = motion(p);
  for (LocalSize& s : mesh.node_size)
    s = {motion.scale * s.length, motion.scale * s.along, motion.rotated(s.direction)};
  Eigen::Matrix3d turn;
  for (int row = 0; row < 3; ++row) turn.row(row) = to_eigen(motion.rotation[row]).transpose() / motion.scale;
  for (SymmetricTensor& m : mesh.node_metric) m = tensor_of(Eigen::Matrix3d(turn * matrix_of(m) * turn.transpose()));
}

void append(const BackgroundMesh& other, BackgroundMesh& mesh) {
  if (!mesh.node_metric.empty() || !other.node_metric.empty()) {
    if (mesh.node_metric.empty()) add_plain_metrics(mesh.node_size, mesh.node_metric);
    mesh.node_metric.insert(mesh.node_metric.end(), other.node_metric.begin(), other.node_metric.end());
    if (other.node_metric.empty()) add_plain_metrics(other.node_size, mesh.node_metric);
  }
  const auto first = static_cast<std::int32_t>(mesh.node_xyz.size());
  mesh.tets.reserve(mesh.tets.size() + other.tets.size());
  mesh.triangles.reserve(mesh.triangles.size() + other.triangles.size());
  mesh.node_xyz.insert(mesh.node_xyz.end(), other.node_xyz.begin(), other.node_xyz.end());
  mesh.node_size.insert(mesh.node_size.end(), other.node_size.begin(), other.node_size.end());
  for (std::array<std::int32_t, 4> tet : other.tets) {
    for (std::int32_t& node : tet) node += first;
    mesh.tets.push_back(tet);
  }
  for (std::array<std::int32_t, 3> triangle : other.triangles) {
    for (std::int32_t& node : triangle) node += first;
    mesh.triangles.push_back(triangle);
  }
}

std::unique_ptr<SizeSource> make_background(BackgroundMesh mesh, double slope) {
  return std::make_unique<BackgroundSource>(std::move(mesh), slope);
}

}  // namespace st
