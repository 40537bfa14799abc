#include "sizing/face_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/assert.h"
#include "base/threads.h"
#include "sizing/patch_walk.h"

namespace st {
namespace {

struct PositionProbe {
  Vec3 x;
};

/// A patch of the face, small enough for its cell.
struct FacePart {
  std::int32_t leaf = 0;
  double area = 0;
  Vec3 center, normal;  // any length
};

/// Halves a face down to the cells and notes the area in each.
class CellLocator {
 public:
  CellLocator(const Surface& surface, const OctreeView& octree) : surface_(surface), octree_(octree) {}

  PositionProbe probe(Vec2 uv) { return {surface_.point(uv)}; }

  bool must_split(const PatchSize& size) {
    int level = 0;
    leaf_ = octree_.find_leaf(morton::encode(octree_.grid_point(size.center)), level);
    return size.extent > std::max(octree_.cell_edge(level), outside(size.center));
  }

  bool visit(const Patch<PositionProbe>& patch, const PatchSize& size, int&) {
    // A patch that the loops only graze counts a little, so that a sliver between the probes is somewhere.
    const PatchSpans spans = patch.n_inside > 0 ? PatchSpans() : measure_spans(patch);
    const double area = patch.n_inside > 0 ? inside_area(patch) : 1e-3 * spans.along_u * spans.along_v;
    parts_.push_back(
        {leaf_, area, size.center, cross(patch.probe[8].x - patch.probe[0].x, patch.probe[6].x - patch.probe[2].x)});
    return false;
  }

  std::vector<FacePart> take() { return std::move(parts_); }

 private:
  /// How far a point lies from the root cube: lengths change no faster there.
  double outside(Vec3 x) const {
    const Vec3 d = x - octree_.lo;
    return std::max({-d.x, -d.y, -d.z, d.x - octree_.edge, d.y - octree_.edge, d.z - octree_.edge});
  }

  const Surface& surface_;
  const OctreeView& octree_;
  std::int32_t leaf_ = 0;  // at the centre of the last patch
  std::vector<FacePart> parts_;
};

CellArea make_cell(std::int32_t leaf, double area, Vec3 center, Vec3 normal) {
  const Vec3 n = normalized(normal);
  const auto f = [](double x) { return static_cast<float>(x); };
  return {leaf, f(area), {f(center.x), f(center.y), f(center.z)}, {f(n.x), f(n.y), f(n.z)}};
}

/// Sums parts of the same leaf, in the order in which they came, and scales the total to `face_area`.
std::vector<CellArea> unite(const std::vector<FacePart>& unsorted, double face_area, Vec3 origin) {
  std::vector<std::pair<std::int32_t, std::size_t>> order;  // leaf, and which came when
  for (const FacePart& p : unsorted) order.emplace_back(p.leaf, order.size());
  std::sort(order.begin(), order.end());
  double total = 0;
  for (const auto& [leaf, i] : order) total += unsorted[i].area;
  const double scale = face_area > 0 && total > 0 ? face_area / total : 1;
  std::vector<CellArea> cells;
  for (std::size_t i = 0; i < order.size();) {
    const std::int32_t leaf = order[i].first;
    double area = 0;
    Vec3 moment, normal;
    for (; i < order.size() && order[i].first == leaf; ++i) {
      const FacePart& p = unsorted[order[i].second];
      area += p.area;
      moment += p.area * p.center;
      normal += (dot(normal, p.normal) < 0 ? -1.0 : 1.0) * p.normal;
    }
    if (area > 0) cells.push_back(make_cell(leaf, scale * area, moment / area - origin, normal));
  }
  return cells;
}

/// A point that stands for so large a part of the area of a face in a cell, as others do.
struct AreaPoint {
  Vec3 x;
  double weight = 0;
};

/// Points that share out the area of a face in a cell: squares of its plane whose middles lie in the cell, smaller ones
/// where sources ask for less somewhere in a square than at its middle.
class PlanePoints {
 public:
  static constexpr int kLargest = 48;  // squares per axis before sources are looked at
  /// `octree`: without the sources.
  PlanePoints(const OctreeField& octree, const SourceTree* sources) : octree_(octree), sources_(sources) {}

  /// `n` squares per axis. `near`: the sources that may count in the cell.
  const std::vector<AreaPoint>& make(const CellPlane& plane, Vec3 origin, Vec3 middle, double edge, int n,
                                     FewSources near) {
    points_.clear();
    center_ = origin + Vec3{plane.center[0], plane.center[1], plane.center[2]};
    normal_ = {plane.normal[0], plane.normal[1], plane.normal[2]};
    middle_ = middle;
    edge_ = edge;
    near_ = near;
    steepest_ = std::max({std::abs(normal_.x), std::abs(normal_.y), std::abs(normal_.z)});
    if (steepest_ > 0 && !is_beyond(center_))
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) add((a + 0.5) / n - 0.5, (b + 0.5) / n - 0.5, 1.0 / n);
    if (points_.empty()) points_.push_back({center_, 1});
    total_ = 0;
    for (const AreaPoint& p : points_) total_ += p.weight;
    return points_;
  }
  /// Of the weights of the points.
  double total() const { return total_; }

 private:
  /// A square by its middle and side, as shares of the cell's edge.
  void add(double a, double b, double side) {
    double height = 0;
    const Vec3 x = on_plane(a, b, height);
    if (!near_.are_none() && is_coarse(x, a, b, side)) {
      for (const double v : {-0.25, 0.25})
        for (const double u : {-0.25, 0.25}) add(a + u * side, b + v * side, 0.5 * side);
      return;
    }
    if (std::abs(height) <= 0.5 * edge_) points_.push_back({x, side * side});
  }
  /// Beyond the root cube the nearest cells hold the area: lengths inside them say nothing of it.
  bool is_beyond(Vec3 x) const {
    const Vec3 d = x - middle_;
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > edge_;
  }
  /// The point of the plane over (a, b), and how far it lies from the middle of the cell the third way.
  Vec3 on_plane(double a, double b, double& height) const {
    const Vec3 c = center_, m = normal_;
    Vec3 x;
    if (std::abs(m.z) == steepest_) {
      x = {middle_.x + a * edge_, middle_.y + b * edge_, 0};
      height = x.z = c.z - (m.x * (x.x - c.x) + m.y * (x.y - c.y)) / m.z;
      height -= middle_.z;
    } else if (std::abs(m.y) == steepest_) {
      x = {middle_.x + a * edge_, 0, middle_.z + b * edge_};
      height = x.y = c.y - (m.x * (x.x - c.x) + m.z * (x.z - c.z)) / m.y;
      height -= middle_.y;
    } else {
      x = {0, middle_.y + a * edge_, middle_.z + b * edge_};
      height = x.x = c.x - (m.y * (x.y - c.y) + m.z * (x.z - c.z)) / m.x;
      height -= middle_.x;
    }
    return x;
  }
  /// Whether lengths of sources vary much in a square that is larger than they are; x is its middle.
  bool is_coarse(Vec3 x, double a, double b, double side) {
    constexpr double kLeastShare = 0.8;  // of the least in the largest: 1.5 % of the triangles around a point source
    constexpr double kSmallest = 1e-4;   // of the cell's edge
    if (side < kSmallest) return false;
    std::int32_t winner = kNone;
    const double radius = std::sqrt(0.5) * side * edge_ / steepest_, length = length_at(x, winner),
                 at_least = length - sources_->slope() * radius;  // within the radius
    if (2 * radius <= at_least) return false;
    if (2 * radius <= length || at_least < kLeastShare * length) {
      const double least = sources_->least_near(x, radius, length);
      if (2 * radius <= least) return false;
      if (least < kLeastShare * length) return true;
    }
    if (winner == kNone) return false;
    double height = 0;
    for (const double v : {-0.5, 0.5})
      for (const double u : {-0.5, 0.5})
        if (kLeastShare * length_at(on_plane(a + u * side, b + v * side, height), winner) > length) return true;
    return false;
  }
  double length_at(Vec3 x, std::int32_t& winner) {
    return sources_->size_below(x, octree_.OctreeField::size(x, hint_) / octree_.data().scale, near_, winner);
  }

  const OctreeField& octree_;
  const SourceTree* sources_;
  int hint_ = 0;
  FewSources near_;
  Vec3 center_, normal_, middle_;
  double edge_ = 0, steepest_ = 0, total_ = 0;
  std::vector<AreaPoint> points_;
};

/// Points per axis for a cell of the raster: 2, times the cells that the field has along it.
int points_per_axis(const OctreeView& raster, std::int32_t leaf, const OctreeView& fine) {
  const int level = raster.leaf_levels[leaf];
  const std::uint64_t key = raster.leaf_keys[leaf], last = key + ((1ull << (3 * (kMaxLevel - level))) - 1);
  int deepest = level;
  for (std::int32_t i = fine.find_leaf(key), end = fine.find_leaf(last); i <= end; ++i)
    deepest = std::max<int>(deepest, fine.leaf_levels[i]);
  return std::min(PlanePoints::kLargest, 2 << std::min(deepest - level, 5));
}

/// Area of a plane, measured in stretched lengths, over that measured in the smallest.
double area_share(const LocalSize& local, Vec3 normal) {
  const double out = dot(local.direction, normal), ratio = local.length / local.along;
  return std::sqrt(1 - (1 - out * out) * (1 - ratio * ratio) * norm2(local.direction));
}

/// Unites points of one cell that follow each other and have one cause.
class PartCollector {
 public:
  PartCollector(FaceId face, std::vector<SizedPart>& parts) : parts_(parts), face_(face) {}

  /// A point of length `h` that stands for `area`; its weight is that of a unit area.
  void add(std::int32_t cause, double h, double area, const FaceWeight& weight, Vec3 place) {
    if (part_.area > 0 && cause != part_.cause) finish();
    if (!(part_.area > 0)) part_ = {face_, cause, 0, h, {}, place};
    part_.area += area;
    if (h < part_.least) {
      part_.least = h;
      part_.place = place;
    }
    part_.weight.add(weight, area);
  }

  void finish() {
    if (part_.area > 0) parts_.push_back(part_);
    part_ = {};
  }

 private:
  std::vector<SizedPart>& parts_;
  FaceId face_;
  SizedPart part_;
};

/// What some cells of faces weigh. One for each thread.
class CellWeigher {
 public:
  /// `octree`: `field` without its sources.
  CellWeigher(const FaceCells& faces, const OctreeView& raster, const OctreeField& field, const OctreeField& octree)
      : faces_(faces), raster_(raster), field_(field), octree_(octree), points_(octree, field.data().sources) {}

  /// Row `i` of the cells of `face`; its parts are appended.
  FaceWeight weigh(FaceId face, std::size_t i, std::vector<SizedPart>& parts) {
    const std::int32_t leaf = faces_.leaf[i];
    const float* n = faces_.plane[i].normal;
    const Vec3 normal{n[0], n[1], n[2]};
    const FewSources near = field_.sources_in(leaf);
    const OctreeField& asked = near.are_none() ? octree_ : field_;
    const int n_points = points_per_axis(raster_, leaf, field_.data().octree);
    const auto& on_plane = points_.make(faces_.plane[i], faces_.origin, raster_.leaf_center(leaf),
                                        raster_.cell_edge(raster_.leaf_levels[leaf]), n_points, near);
    FaceWeight sum;
    PartCollector collector(face, parts);
    const double unit = static_cast<double>(faces_.area[i]) / points_.total();
    for (const auto& [x, weight] : on_plane) {
      Vec3 gradient;
      std::int32_t cause = kNone;
      double h = asked.size_and_gradient(x, hint_, gradient, cause);
      double share = 1, g = norm(gradient - dot(gradient, normal) * normal);
      if (asked.is_stretched()) {
        const LocalSize local = asked.OctreeField::local_on(x, normal, hint_);
        h = local.length;
        share = area_share(local, normal);
        g *= local.length / local.along;  // rows need no more triangles where their heights change
      }
      const double uniform = share / (h * h);
      const FaceWeight at_point{uniform, g * uniform, g * g * uniform};
      sum.add(at_point, weight);
      collector.add(cause, h, unit * weight, at_point, x);
    }
    collector.finish();
    FaceWeight of_cell;
    of_cell.add(sum, unit);
    return of_cell;
  }

 private:
  const FaceCells& faces_;
  const OctreeView& raster_;
  const OctreeField &field_, &octree_;
  PlanePoints points_;
  int hint_ = 0;
};

/// The face of each row from `begin` on: rows are asked for in ascending order.
class FaceOfRow {
 public:
  FaceOfRow(const FaceCells& faces, std::size_t begin)
      : offsets_(faces.offsets),
        face_(std::upper_bound(offsets_.begin(), offsets_.end(), static_cast<std::int64_t>(begin)) - offsets_.begin() -
              1) {}
  FaceId operator()(std::size_t row) {
    while (offsets_[static_cast<std::size_t>(face_) + 1] <= static_cast<std::int64_t>(row)) ++face_;
    return static_cast<FaceId>(face_);
  }

 private:
  const std::vector<std::int64_t>& offsets_;
  std::ptrdiff_t face_;
};

}  // namespace

void FaceCells::append_face(std::span<const CellArea> cells) {
  ST_ASSERT(
      std::is_sorted(cells.begin(), cells.end(), [](const CellArea& a, const CellArea& b) { return a.leaf < b.leaf; }));
  for (const CellArea& c : cells) {
    leaf.push_back(c.leaf);
    area.push_back(c.area);
    plane.push_back({{c.center[0], c.center[1], c.center[2]}, {c.normal[0], c.normal[1], c.normal[2]}});
  }
  offsets.push_back(static_cast<std::int64_t>(leaf.size()));
}

std::vector<CellArea> locate_face(const Surface& surface, const LoopPolygons& loops, const OctreeView& octree,
                                  double face_area, Vec3 origin) {
  CellLocator locator(surface, octree);
  PatchWalk<PositionProbe, CellLocator> walk(surface, loops, locator);
  walk.walk(surface.u_min(), surface.u_max(), surface.v_min(), surface.v_max(), surface.is_planar() ? 1 : 2);
  return unite(locator.take(), face_area, origin);
}

double SizedPart::length() const { return std::max(least, std::sqrt(area / weight.uniform)); }

std::vector<FaceWeight> face_weights(const FaceCells& faces, const OctreeView& raster, const OctreeField& field,
                                     const std::function<void(const SizedPart&)>& visit) {
  constexpr std::size_t kBlock = 1 << 18, kPiece = 512;  // rows whose parts are held at once; of a task
  std::vector<FaceWeight> weights(static_cast<std::size_t>(faces.n_faces()));
  OctreeFieldData without = field.data();
  without.sources = nullptr;
  const OctreeField octree(without, nullptr, field.OctreeField::min_size() / without.scale);
  for (std::size_t first = 0; first < faces.leaf.size(); first += kBlock) {
    const std::size_t n = std::min(kBlock, faces.leaf.size() - first);
    std::vector<FaceWeight> of_row(n);
    std::vector<std::vector<SizedPart>> parts((n + kPiece - 1) / kPiece);
    parallel_for(n, kPiece, [&](std::size_t begin, std::size_t end) {
      CellWeigher weigher(faces, raster, field, octree);
      FaceOfRow face_of(faces, first + begin);
      for (std::size_t i = begin; i < end; ++i)
        of_row[i] = weigher.weigh(face_of(first + i), first + i, parts[begin / kPiece]);
    });
    FaceOfRow face_of(faces, first);
    for (std::size_t i = 0; i < n; ++i) weights[static_cast<std::size_t>(face_of(first + i))].add(of_row[i]);
    if (!visit) continue;
    for (const std::vector<SizedPart>& piece : parts)
      for (const SizedPart& part : piece) visit(part);
  }
  return weights;
}

}  // namespace st
