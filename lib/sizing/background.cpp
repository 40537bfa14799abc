#include "sizing/background.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/box_tree.h"
#include "base/eigen.h"

namespace st {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Barycentric coordinates 1 to 3 of x are row . (x - corner); coordinate 0 is the rest to 1.
struct TetFrame {
  Vec3 corner;
  Vec3 row[3];

  /// False: it is flat.
  bool make(const std::array<Vec3, 4>& p) {
    constexpr double kFlat = 1e-12;  // six volumes over the cubed edge
    const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
    const double volume6 = dot(cross(a, b), c), longest = std::max({norm(a), norm(b), norm(c)});
    if (!(std::abs(volume6) > kFlat * longest * longest * longest)) return false;
    corner = p[0];
    row[0] = cross(b, c) / volume6;
    row[1] = cross(c, a) / volume6;
    row[2] = cross(a, b) / volume6;
    return true;
  }
  std::array<double, 4> coordinates(Vec3 x) const {
    const Vec3 r = x - corner;
    const double b = dot(row[0], r), c = dot(row[1], r), d = dot(row[2], r);
    return {1 - b - c - d, b, c, d};
  }
  Vec3 gradient(const std::array<double, 4>& value) const {
    return (value[1] - value[0]) * row[0] + (value[2] - value[0]) * row[1] + (value[3] - value[0]) * row[2];
  }
};

std::array<Vec3, 4> corners_of(const BackgroundMesh& mesh, const std::array<std::int32_t, 4>& tet) {
  return {mesh.node_xyz[tet[0]], mesh.node_xyz[tet[1]], mesh.node_xyz[tet[2]], mesh.node_xyz[tet[3]]};
}

std::array<double, 4> lengths_of(const BackgroundMesh& mesh, const std::array<std::int32_t, 4>& tet) {
  const auto& s = mesh.node_size;
  return {s[tet[0]].length, s[tet[1]].length, s[tet[2]].length, s[tet[3]].length};
}

/// Faces that one tetrahedron alone has, by their nodes.
std::vector<std::array<std::int32_t, 3>> border_of(const BackgroundMesh& mesh) {
  std::vector<std::array<std::int32_t, 3>> faces, border;
  for (const auto& t : mesh.tets)
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<std::int32_t, 3> face{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
      std::sort(face.begin(), face.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    for (end = i + 1; end < faces.size() && faces[end] == faces[i];) ++end;
    if (end == i + 1) border.push_back(faces[i]);
  }
  return border;
}

/// A tree of boxes, and the smallest length in each of its nodes.
class LengthTree {
 public:
  LengthTree() = default;
  LengthTree(std::span<const Box3> boxes, std::span<const double> least) : tree_(boxes) {
    for (const BoxTree::Node& node : tree_.nodes()) {
      double smallest = kInfinity;
      for (std::int32_t i = node.begin; i < node.end; ++i) smallest = std::min(smallest, least[tree_.items()[i]]);
      least_.push_back(smallest);
    }
  }
  /// Those whose box holds x, while one may be below `best`.
  template <class Visit>
  void visit_at(Vec3 x, const double& best, const Visit& visit) const {
    tree_.visit_near(
        x, [&](std::int32_t node, double d2) { return d2 == 0 && least_[node] < best; }, visit);
  }
  /// Those from which lengths that grow by `slope` may reach x below `best`.
  template <class Visit>
  void visit_from(Vec3 x, double slope, const double& best, const Visit& visit) const {
    const auto matters = [&](std::int32_t node, double d2) {
      const double room = best - least_[node];
      return room > 0 && slope * slope * d2 < room * room;
    };
    tree_.visit_near(x, matters, visit);
  }

 private:
  BoxTree tree_;
  std::vector<double> least_;  // [nodes of the tree]
};

class BackgroundSource final : public SizeSource {
 public:
  BackgroundSource(BackgroundMesh mesh, double slope) : SizeSource(slope), mesh_(std::move(mesh)) {
    border_ = border_of(mesh_);
    leave_out_flat();
    for (const LocalSize& s : mesh_.node_size) {
      min_size_ = std::min(min_size_, s.length);
      max_aspect_ = std::max(max_aspect_, s.along / s.length);
    }
    for (const Vec3 x : mesh_.node_xyz) box_.add(x);
    tet_tree_ = tree_over(std::span<const std::array<std::int32_t, 4>>(mesh_.tets));
    border_tree_ = tree_over(std::span<const std::array<std::int32_t, 3>>(border_));
  }

  double size(Vec3 x, int&) const override { return size_below(x, kInfinity); }
  double size_below(Vec3 x, double upper) const override {
    std::size_t tet = 0;
    return least_outside(x, least_inside(x, upper, tet));
  }
  LocalSize local(Vec3 x, int&) const override {
    std::size_t tet = mesh_.tets.size();
    const double inside = least_inside(x, kInfinity, tet), length = least_outside(x, inside);
    if (length < inside || max_aspect_ <= 1) return {length, length, {}};
    return stretched_in(tet, x, length);
  }
  double min_size() const override { return min_size_; }
  double max_aspect() const override { return max_aspect_; }
  SourceGrowth growth() const override { return {box_, {min_size_, 0, 0}}; }

 private:
  void leave_out_flat() {
    std::vector<std::array<std::int32_t, 4>> tets;
    for (const auto& tet : mesh_.tets)
      if (TetFrame frame; frame.make(corners_of(mesh_, tet))) {
        frames_.push_back(frame);
        tets.push_back(tet);
      }
    mesh_.tets = std::move(tets);
  }
  template <std::size_t N>
  LengthTree tree_over(std::span<const std::array<std::int32_t, N>> cells) const {
    std::vector<Box3> boxes;
    std::vector<double> least;
    for (const auto& cell : cells) {
      boxes.emplace_back();
      least.push_back(kInfinity);
      for (const std::int32_t node : cell) {
        boxes.back().add(mesh_.node_xyz[node]);
        least.back() = std::min(least.back(), mesh_.node_size[node].length);
      }
    }
    return {boxes, least};
  }

  static double interpolated(const std::array<double, 4>& at, const std::array<double, 4>& value) {
    return at[0] * value[0] + at[1] * value[1] + at[2] * value[2] + at[3] * value[3];
  }
  /// Of the tetrahedra that hold x, or best; `winner`: the first of those with the smallest.
  double least_inside(Vec3 x, double best, std::size_t& winner) const {
    constexpr double kOnSide = -1e-9;  // of the height: sides are shared
    tet_tree_.visit_at(x, best, [&](std::int32_t t) {
      const std::array<double, 4> at = frames_[t].coordinates(x);
      if (*std::min_element(at.begin(), at.end()) < kOnSide) return;
      const double length = interpolated(at, lengths_of(mesh_, mesh_.tets[t]));
      if (length < best) {
        best = length;
        winner = static_cast<std::size_t>(t);
      }
    });
    return best;
  }
  double least_outside(Vec3 x, double best) const {
    border_tree_.visit_from(x, slope(), best, [&](std::int32_t b) {
      const auto& n = border_[b];
      const auto& s = mesh_.node_size;
      best = std::min(best, least_over_triangle(x, {mesh_.node_xyz[n[0]], mesh_.node_xyz[n[1]], mesh_.node_xyz[n[2]]},
                                                {s[n[0]].length, s[n[1]].length, s[n[2]].length}, slope()));
    });
    return best;
  }
  /// With the direction that the squeezes of the tetrahedron's nodes share most, and the lengths along it.
  LocalSize stretched_in(std::size_t tet, Vec3 x, double length) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const std::int32_t node : mesh_.tets[tet]) {
      const Eigen::Vector3d squeeze = to_eigen(mesh_.node_size[node].squeeze());
      sum += squeeze * squeeze.transpose();
    }
    if (!(sum.trace() > 0)) return {length, length, {}};
    const Vec3 direction = principal_axes(sum).axis[2];
    std::array<double, 4> along{};
    for (std::size_t k = 0; k < 4; ++k) along[k] = mesh_.node_size[mesh_.tets[tet][k]].in(direction);
    return {length, std::max(length, interpolated(frames_[tet].coordinates(x), along)), direction};
  }

  BackgroundMesh mesh_;
  std::vector<TetFrame> frames_;                     // [tets]
  std::vector<std::array<std::int32_t, 3>> border_;  // nodes
  LengthTree tet_tree_, border_tree_;
  Box3 box_;
  double min_size_ = kInfinity, max_aspect_ = 1;
};

/// Lowers the lengths of one tetrahedron until its gradient is no more than the slope: the largest alone where that is
/// enough, else all towards the smallest. False: nothing to do.
bool limit_tet(const std::array<Vec3, 4>& p, double slope, std::array<double, 4>& h) {
  constexpr double kSlack = 1 + 1e-9;
  TetFrame frame;
  if (!frame.make(p)) return false;
  const double steepness = norm(frame.gradient(h));
  if (!(steepness > kSlack * slope)) return false;
  const auto [least, top] = std::minmax_element(h.begin(), h.end());
  // the gradient is g0 + h_top * row: of the values of h_top that hold it to the slope, the largest
  const double smallest = *least, was = *top;
  std::array<double, 4> without = h;
  without[static_cast<std::size_t>(top - h.begin())] = smallest;
  std::array<double, 4> unit{};
  unit[static_cast<std::size_t>(top - h.begin())] = 1;
  const Vec3 g = frame.gradient(without), row = frame.gradient(unit);
  const double a = norm2(row), b = dot(g, row), c = norm2(g) - slope * slope, root = b * b - a * c;
  if (root >= 0) {
    const double rise = (-b + std::sqrt(root)) / a;
    if (rise >= 0 && smallest + rise < was) {
      *top = smallest + rise;
      return true;
    }
  }
  for (double& value : h) value = smallest + (value - smallest) * (slope / steepness);
  return true;
}

/// Tetrahedra of each node, as CSR.
struct NodeTets {
  std::vector<std::int32_t> first, tet;

  explicit NodeTets(const BackgroundMesh& mesh) : first(mesh.node_xyz.size() + 1, 0), tet(4 * mesh.tets.size()) {
    for (const auto& t : mesh.tets)
      for (const std::int32_t n : t) ++first[static_cast<std::size_t>(n) + 1];
    for (std::size_t n = 1; n < first.size(); ++n) first[n] += first[n - 1];
    std::vector<std::int32_t> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      for (const std::int32_t n : mesh.tets[t]) tet[next[n]++] = static_cast<std::int32_t>(t);
  }
};

}  // namespace

std::int64_t remove_stretch(BackgroundMesh& mesh) {
  std::int64_t n_stretched = 0;
  for (LocalSize& s : mesh.node_size) {
    n_stretched += s.along > s.length;
    s = {s.length, s.length, {}};
  }
  return n_stretched;
}

void transform(const Similarity& motion, BackgroundMesh& mesh) {
  for (Vec3& p : mesh.node_xyz) p = motion(p);
  for (LocalSize& s : mesh.node_size)
    s = {motion.scale * s.length, motion.scale * s.along, motion.rotated(s.direction)};
}

void append(const BackgroundMesh& other, BackgroundMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.node_xyz.size());
  mesh.node_xyz.insert(mesh.node_xyz.end(), other.node_xyz.begin(), other.node_xyz.end());
  mesh.node_size.insert(mesh.node_size.end(), other.node_size.begin(), other.node_size.end());
  for (std::array<std::int32_t, 4> tet : other.tets) {
    for (std::int32_t& node : tet) node += first;
    mesh.tets.push_back(tet);
  }
}

std::int64_t limit_growth(double slope, BackgroundMesh& mesh) {
  const NodeTets tets_of(mesh);
  std::vector<std::uint8_t> is_lowered(mesh.node_xyz.size(), 0), is_waiting(mesh.tets.size(), 1);
  std::vector<std::int32_t> waiting(mesh.tets.size()), next;
  for (std::size_t t = 0; t < waiting.size(); ++t) waiting[t] = static_cast<std::int32_t>(t);
  for (; !waiting.empty(); waiting.swap(next), next.clear())
    for (const std::int32_t t : waiting) {
      is_waiting[t] = 0;
      const auto& tet = mesh.tets[t];
      const std::array<double, 4> before = lengths_of(mesh, tet);
      std::array<double, 4> after = before;
      if (!limit_tet(corners_of(mesh, tet), slope, after)) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        if (!(after[k] < before[k])) continue;
        mesh.node_size[tet[k]].length = after[k];
        is_lowered[tet[k]] = 1;
        for (std::int32_t i = tets_of.first[tet[k]]; i < tets_of.first[tet[k] + 1]; ++i)
          if (const std::int32_t other = tets_of.tet[i]; !is_waiting[other]) {
            is_waiting[other] = 1;
            next.push_back(other);
          }
      }
    }
  return std::count(is_lowered.begin(), is_lowered.end(), 1);
}

std::unique_ptr<SizeSource> make_background(BackgroundMesh mesh, double slope) {
  return std::make_unique<BackgroundSource>(std::move(mesh), slope);
}

}  // namespace st
