#include "sizing/face_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/assert.h"
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
    return size.extent > octree_.cell_edge(level);
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
std::vector<CellArea> unite(std::vector<FacePart> parts, double face_area, Vec3 origin) {
  std::stable_sort(parts.begin(), parts.end(), [](const FacePart& a, const FacePart& b) { return a.leaf < b.leaf; });
  double total = 0;
  for (const FacePart& p : parts) total += p.area;
  const double scale = face_area > 0 && total > 0 ? face_area / total : 1;
  std::vector<CellArea> cells;
  for (std::size_t i = 0; i < parts.size();) {
    const std::int32_t leaf = parts[i].leaf;
    double area = 0;
    Vec3 moment, normal;
    for (; i < parts.size() && parts[i].leaf == leaf; ++i) {
      area += parts[i].area;
      moment += parts[i].area * parts[i].center;
      normal += (dot(normal, parts[i].normal) < 0 ? -1.0 : 1.0) * parts[i].normal;
    }
    if (area > 0) cells.push_back(make_cell(leaf, scale * area, moment / area - origin, normal));
  }
  return cells;
}

/// Points that share out the area of a face in a cell: a grid on its plane, cut off at the cell's sides.
class PlanePoints {
 public:
  static constexpr int kLargest = 48;  // points per axis
  /// `n` points per axis.
  const std::vector<Vec3>& make(const CellPlane& plane, Vec3 origin, Vec3 middle, double edge, int n) {
    points_.clear();
    const Vec3 c = origin + Vec3{plane.center[0], plane.center[1], plane.center[2]},
               m{plane.normal[0], plane.normal[1], plane.normal[2]};
    const double steepest = std::max({std::abs(m.x), std::abs(m.y), std::abs(m.z)});
    if (steepest > 0)
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) add(c, m, middle, edge, (a + 0.5) / n - 0.5, (b + 0.5) / n - 0.5, steepest);
    if (points_.empty()) points_.push_back(c);
    return points_;
  }

 private:
  void add(Vec3 c, Vec3 m, Vec3 middle, double edge, double a, double b, double steepest) {
    Vec3 x;
    double height;
    if (std::abs(m.z) == steepest) {
      x = {middle.x + a * edge, middle.y + b * edge, 0};
      height = x.z = c.z - (m.x * (x.x - c.x) + m.y * (x.y - c.y)) / m.z;
      height -= middle.z;
    } else if (std::abs(m.y) == steepest) {
      x = {middle.x + a * edge, 0, middle.z + b * edge};
      height = x.y = c.y - (m.x * (x.x - c.x) + m.z * (x.z - c.z)) / m.y;
      height -= middle.y;
    } else {
      x = {0, middle.y + a * edge, middle.z + b * edge};
      height = x.x = c.x - (m.y * (x.y - c.y) + m.z * (x.z - c.z)) / m.x;
      height -= middle.x;
    }
    if (std::abs(height) <= 0.5 * edge) points_.push_back(x);
  }

  std::vector<Vec3> points_;
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
  /// `area` that each point stands for.
  PartCollector(FaceId face, double area, const std::function<void(const SizedPart&)>& visit)
      : visit_(visit), face_(face), area_(area) {}

  /// A point of length `h`; its weight is that of a unit area, without kTrianglesPerGradient.
  void add(std::int32_t cause, double h, const FaceWeight& weight) {
    if (!visit_) return;
    if (part_.area > 0 && cause != part_.cause) finish();
    if (!(part_.area > 0)) part_ = {face_, cause, 0, h, {}};
    part_.area += area_;
    part_.least = std::min(part_.least, h);
    part_.weight.uniform += area_ * weight.uniform;
    part_.weight.graded += kTrianglesPerGradient * area_ * weight.graded;
  }

  void finish() {
    if (part_.area > 0) visit_(part_);
    part_ = {};
  }

 private:
  const std::function<void(const SizedPart&)>& visit_;
  FaceId face_;
  double area_;
  SizedPart part_;
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
  PatchWalk<PositionProbe, CellLocator> walk(loops, locator);
  walk.walk(surface.u_min(), surface.u_max(), surface.v_min(), surface.v_max(), surface.is_planar() ? 1 : 2);
  return unite(locator.take(), face_area, origin);
}

double SizedPart::length() const { return std::max(least, std::sqrt(area / weight.uniform)); }

std::vector<FaceWeight> face_weights(const FaceCells& faces, const OctreeView& raster, const OctreeField& field,
                                     const std::function<void(const SizedPart&)>& visit) {
  std::vector<FaceWeight> weights(static_cast<std::size_t>(faces.n_faces()));
  PlanePoints points;
  int hint = 0;
  for (std::size_t f = 0; f < weights.size(); ++f)
    for (std::int64_t k = faces.offsets[f]; k < faces.offsets[f + 1]; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      const std::int32_t leaf = faces.leaf[i];
      const float* n = faces.plane[i].normal;
      const Vec3 normal{n[0], n[1], n[2]};
      const int n_points = points_per_axis(raster, leaf, field.data().octree);
      const auto& on_plane = points.make(faces.plane[i], faces.origin, raster.leaf_center(leaf),
                                         raster.cell_edge(raster.leaf_levels[leaf]), n_points);
      const double area = static_cast<double>(faces.area[i]) / static_cast<double>(on_plane.size());
      double uniform = 0, graded = 0;
      PartCollector parts(static_cast<FaceId>(f), area, visit);
      for (const Vec3& x : on_plane) {
        Vec3 gradient;
        std::int32_t cause = kNone;
        const double h = field.size_and_gradient(x, hint, gradient, cause);
        const double share = field.is_stretched() ? area_share(field.local(x, hint), normal) : 1;
        const FaceWeight at_point{share / (h * h), share * norm(gradient - dot(gradient, normal) * normal) / (h * h)};
        uniform += at_point.uniform;
        graded += at_point.graded;
        parts.add(cause, h, at_point);
      }
      parts.finish();
      weights[f].uniform += area * uniform;
      weights[f].graded += kTrianglesPerGradient * area * graded;
    }
  return weights;
}

}  // namespace st
