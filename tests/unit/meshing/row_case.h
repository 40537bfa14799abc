// Plane faces on which rows are laid, and the sizes for them.
#pragma once

#include <cmath>
#include <vector>

#include "meshing/face/front.h"
#include "meshing/face/row_line.h"
#include "meshing/face/stretch.h"
#include "unit/meshing/faces.h"

namespace st::test {

/// Lengths that grow from the x axis on; along x they are longer.
class WallField : public SizeField {
 public:
  WallField(double at, double slope, double along) : at_(at), slope_(slope), along_(along) {}
  using SizeField::size;
  double size(Vec3 x, int&) const override { return at_ + slope_ * std::abs(x.y); }
  double min_size() const override { return at_; }
  double slope() const override { return slope_; }
  bool is_stretched() const override { return true; }
  LocalSize local(Vec3 x, int& hint) const override {
    const double length = size(x, hint);
    return along_ > length ? LocalSize{length, along_, {1, 0, 0}} : LocalSize{length, length, {}};
  }

 private:
  double at_, slope_, along_;
};

/// A face with these loops in (u,v) before rows are laid.
struct RowCase {
  FaceBoundary boundary;
  FaceWork work;

  RowCase(const std::vector<std::vector<Vec2>>& loops, const SizeField& field, const Surface& surface = kPlane)
      : boundary(polygons(loops, 1)) {
    work.set_surface(surface);
    work.plane.u = PlaneAxis(1);
    work.plane.v = PlaneAxis(1);
    work.field = &field;
    work.max_nodes = 100'000;
    for (FaceNode& b : boundary.nodes) {
      b.h = field.size(b.x);
      MeshNode n{b};
      n.p = b.uv;
      work.evaluate(n);
      work.ask_sizes(n);
      work.mesh.nodes.push_back(n);
    }
    work.segments = boundary.segments;
    EXPECT_TRUE(work.mesh.build(work.segments).empty());
  }

  int n_laid() const {
    int n = 0;
    for (const PlaneTriangle& t : work.mesh.triangles) n += t.state == kLaid;
    return n;
  }
  double laid_area() const {
    double sum = 0;
    for (const PlaneTriangle& t : work.mesh.triangles) {
      if (t.state != kLaid) continue;
      const Vec2 a = work.mesh.nodes[t.v[0]].p;
      sum += 0.5 * cross(work.mesh.nodes[t.v[1]].p - a, work.mesh.nodes[t.v[2]].p - a);
    }
    return sum;
  }
};

/// The first nodes of a loop.
inline RowLine line_of(std::int32_t n) {
  RowLine line;
  for (std::int32_t i = 0; i < n; ++i) line.nodes.push_back(i);
  line.joined.assign(n - 1, 1);
  line.lowest.assign(n, 0);
  line.highest.assign(n, 0);
  return line;
}

/// Counter-clockwise from (0,0): bottom and top in `n` parts, the sides at `left` and `right` heights between 0 and the
/// last of them.
inline std::vector<Vec2> band(int n, double width, const std::vector<double>& left, const std::vector<double>& right) {
  std::vector<Vec2> loop;
  for (int i = 0; i <= n; ++i) loop.push_back({width * i / n, 0});
  for (const double y : right) loop.push_back({width, y});
  for (int i = n - 1; i >= 0; --i) loop.push_back({width * i / n, left.back()});
  for (std::size_t k = left.size() - 1; k-- > 0;) loop.push_back({0, left[k]});
  return loop;
}

/// Heights up to `end`, each longer than the one before by the slope.
inline std::vector<double> growing(double at, double slope, double end) {
  std::vector<double> y{at * (1 + slope / 2)};
  while (y.back() + 1.5 * (at + slope * y.back()) < end)
    y.push_back(y.back() + (at + slope * y.back()) * (1 + slope / 2));
  y.push_back(end);
  return y;
}

/// Six times as long along a direction at an angle to the x axis; a metric in space, or none.
class SlantedField : public WallField {
 public:
  SlantedField(double angle_deg, bool has_metrics)
      : WallField(0.1, 0, 0.6), angle_(radians(angle_deg)), has_metrics_(has_metrics) {}
  LocalSize local(Vec3, int&) const override { return {0.1, 0.6, {std::cos(angle_), std::sin(angle_), 0}}; }
  bool has_metrics() const override { return has_metrics_; }
  /// Of as many rows, between sides as long as asked for.
  std::vector<Vec2> band_of(int n_rows) const {
    int hint = 0;
    const double height = length_along({}, {0, 1, 0}, hint);
    std::vector<double> side;
    for (int k = 1; k <= n_rows; ++k) side.push_back(height * k);
    return band(10, 10 * length_along({}, {1, 0, 0}, hint), side, side);
  }

 private:
  double angle_;
  bool has_metrics_;
};

}  // namespace st::test
