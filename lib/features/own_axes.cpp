#include "features/own_axes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/eigen.h"
#include "base/share.h"
#include "base/threads.h"
#include "features/certain_wing_edges.h"
#include "geometry/model/facets.h"

namespace st {
namespace {

constexpr int kSamples = 9;             // of an edge
constexpr std::size_t kPerPiece = 8;    // edges: their curves are made, too
constexpr double kFlat = 1e-3;          // thickness over width of a plane edge, width over length of a straight one
constexpr double kParallel = 2e-3;      // sine of the angle between directions that count as one
constexpr std::size_t kTried = 12;      // first axes: the directions of most edges
constexpr std::size_t kKept = 256;      // directions
constexpr double kDeflection = 1e-3;    // of the diagonal: of the facets whose boxes are measured
constexpr double kClearlyMore = 1.001;  // way along axes over that along the axes found before

using Axes = std::array<Vec3, 3>;

/// A direction that edges show, and how long they are together.
struct Direction {
  Vec3 d;  // unit, either sign
  double way = 0;
};

bool are_parallel(Vec3 a, Vec3 b) { return norm(cross(a, b)) < kParallel; }

Eigen::Matrix3d outer(Vec3 d) { return to_eigen(d) * to_eigen(d).transpose(); }

/// What the edges of a shape show.
class EdgeDirections {
 public:
  explicit EdgeDirections(const Model& model) {
    const ModelTables& t = model.tables();
    std::vector<EdgeShape> shapes(static_cast<std::size_t>(t.n_edges()));
    const auto counts = [&](std::size_t e) { return !t.edge_is_degenerate[e] && t.edge_length[e] > 0; };
    parallel_for(shapes.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e)
        if (counts(e)) shapes[e] = shape_of(*model.curve(static_cast<EdgeId>(e)));
    });
    std::vector<Direction> all;
    for (std::size_t e = 0; e < shapes.size(); ++e)
      if (counts(e)) add(shapes[e], t.edge_length[e], all);
    measure_spread();
    unite(std::move(all));
  }

  /// The axes along which most edges run, or to which their planes are square.
  Axes best() const {
    Axes best = from(directions_.empty() ? principal_axes(spread_).axis[2] : directions_.front().d);
    double most = way_along(best);
    const auto try_axes = [&](const Axes& axes) {
      const double way = way_along(axes);
      if (!(way > kClearlyMore * most)) return;
      most = way;
      best = axes;
    };
    for (std::size_t a = 0; a < std::min(kTried, directions_.size()); ++a) {
      const Vec3 first = directions_[a].d;
      for (const Direction& second : directions_)
        if (std::abs(dot(first, second.d)) < kParallel) try_axes(square(first, second.d));
      try_axes(from(first));
    }
    return best;
  }

 private:
  static Axes square(Vec3 first, Vec3 second) {
    const Vec3 third = normalized(cross(first, second));
    return {first, cross(third, first), third};
  }

  /// With the second axis where the model spreads most across the first.
  Axes from(Vec3 first) const {
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - outer(first);
    return square(first, principal_axes(across * spread_ * across).axis[2]);
  }

  /// The way of the directions that are parallel to one of the axes.
  double way_along(const Axes& axes) const {
    double way = 0;
    for (const Direction& own : directions_)
      if (std::any_of(axes.begin(), axes.end(), [&](Vec3 axis) { return are_parallel(axis, own.d); })) way += own.way;
    return way;
  }

  struct EdgeShape {
    Vec3 middle;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  // of its samples
    std::optional<Vec3> direction;                     // of a straight or a plane one
  };

  static EdgeShape shape_of(const Curve& curve) {
    std::array<Vec3, kSamples> x;
    EdgeShape own;
    Vec3& middle = own.middle;
    for (int k = 0; k < kSamples; ++k) {
      x[k] = curve.point(curve.t_min() + (curve.t_max() - curve.t_min()) * k / (kSamples - 1));
      middle += x[k] / kSamples;
    }
    for (const Vec3& p : x) own.spread += outer(p - middle);
    const PrincipalAxes shape = principal_axes(own.spread);
    const double thick = std::sqrt(std::max(0.0, shape.value[0])), wide = std::sqrt(std::max(0.0, shape.value[1])),
                 long_ = std::sqrt(std::max(0.0, shape.value[2]));
    if (wide <= kFlat * long_)
      own.direction = shape.axis[2];
    else if (thick <= kFlat * wide)
      own.direction = shape.axis[0];
    return own;
  }

  void add(const EdgeShape& shape, double length, std::vector<Direction>& all) {
    middle_.push_back({shape.middle, length});
    own_spread_ += length / kSamples * shape.spread;
    if (shape.direction) all.push_back({*shape.direction, length});
  }

  /// Of all edges, as if they were of one stuff.
  void measure_spread() {
    Vec3 center;
    double whole = 0;
    for (const Direction& m : middle_) whole += m.way;
    for (const Direction& m : middle_) center += m.way / whole * m.d;
    spread_ = own_spread_;
    for (const Direction& m : middle_) spread_ += m.way * outer(m.d - center);
  }

  /// Parallel ones together, those of the longest way first.
  void unite(std::vector<Direction> all) {
    const auto is_longer = [](const Direction& a, const Direction& b) { return a.way > b.way; };
    std::stable_sort(all.begin(), all.end(), is_longer);
    for (const Direction& own : all) {
      const auto same = std::find_if(directions_.begin(), directions_.end(),
                                     [&](const Direction& known) { return are_parallel(known.d, own.d); });
      if (same != directions_.end())
        same->way += own.way;
      else if (directions_.size() < kKept)
        directions_.push_back(own);
    }
    std::stable_sort(directions_.begin(), directions_.end(), is_longer);
  }

  std::vector<Direction> directions_;
  std::vector<Direction> middle_;  // of the edges: a place, not a direction
  Eigen::Matrix3d own_spread_ = Eigen::Matrix3d::Zero(), spread_ = own_spread_;
};

bool are_of_space(const Axes& axes) {
  return std::all_of(axes.begin(), axes.end(), [](Vec3 a) {
    return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}) > 1 - 0.5 * kParallel * kParallel;
  });
}

/// Boxes of the faces along the axes: of facets; of what has none, the corners of the box in space.
std::vector<Box3> boxes_along(const Axes& axes, const ModelTables& t, const Facets& facets) {
  const auto along = [&](Vec3 x) { return Vec3{dot(axes[0], x), dot(axes[1], x), dot(axes[2], x)}; };
  std::vector<Box3> boxes(static_cast<std::size_t>(t.n_faces()));
  for (std::size_t i = 0; i < facets.triangle.size(); ++i)
    for (const std::int32_t n : facets.triangle[i]) boxes[facets.face[i]].add(along(facets.xyz[n]));
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    if (!boxes[f].is_empty() || t.is_joined(static_cast<FaceId>(f))) continue;
    const Box3& b = t.face_box[f];
    for (const double x : {b.lo.x, b.hi.x})
      for (const double y : {b.lo.y, b.hi.y})
        for (const double z : {b.lo.z, b.hi.z}) boxes[f].add(along({x, y, z}));
  }
  return boxes;
}

}  // namespace

LengthBounds bound_reference_diagonal(const Model& model, const FaceRoles& roles) {
  constexpr double kBeside = 0.01;  // of the diagonal: boxes of faces are as exact as facets are, about
  const ModelTables& t = model.tables();
  const double in_space = roles.reference_diagonal;
  const Axes axes = EdgeDirections(model).best();
  if (are_of_space(axes)) return {in_space, in_space};
  Box3 largest, least;  // along the axes: of boxes, which no facet leaves, and of vertices, which facets have
  const auto along = [&](Vec3 x) { return Vec3{dot(axes[0], x), dot(axes[1], x), dot(axes[2], x)}; };
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    if (roles.role[f] != FaceRole::kWall || t.face_box[f].is_empty()) continue;
    const Box3& b = t.face_box[f];
    for (const double x : {b.lo.x, b.hi.x})
      for (const double y : {b.lo.y, b.hi.y})
        for (const double z : {b.lo.z, b.hi.z}) largest.add(along({x, y, z}));
    for (const EdgeId e : t.edges_of(f))
      for (const std::size_t end : {0, 1})
        if (const VertexId v = t.edge_vertices[2 * static_cast<std::size_t>(e) + end]; v != kNone)
          least.add(along(t.vertex_xyz[v]));
  }
  // The diagonal of a box is no shorter than the longest way inside, which is at least 1 / sqrt(3) of any box's.
  const double longest_inside = std::max(in_space / std::sqrt(3.0), least.is_empty() ? 0 : least.diagonal());
  return {std::min(in_space, (1 - kBeside) * longest_inside), std::max(in_space, (1 + kBeside) * largest.diagonal())};
}

OwnAxes find_own_axes(const Model& model, const Executor& executor) {
  const ModelTables& t = model.tables();
  OwnAxes own;
  own.face_box = t.face_box;
  Axes axes = own.axis;
  if (executor.is_root()) axes = EdgeDirections(model).best();
  share(executor, axes);
  if (are_of_space(axes)) return own;
  own.axis = axes;
  own.deflection = kDeflection * t.box().diagonal();
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(t.n_faces()), 1);
  own.facets = make_facets(model, all, {.deflection = own.deflection}, executor);
  if (executor.is_root()) own.face_box = boxes_along(axes, t, own.facets);
  share(executor, own.face_box);
  return own;
}

}  // namespace st
