#include "stages/thumbnail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/base64.h"
#include "base/boxes.h"
#include "base/face_labels.h"

namespace st {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr double kDarkest = 40, kBrightest = 220;  // of 255, at grazing and at full sight

/// Right, up, and towards the eye, which looks from ahead, above and beside: axes at right angles.
struct View {
  Vec3 right, up, eye;
};

/// `open`: sum of the area vectors of what is seen, away from the plane in which a half model is open; zero of a whole
/// one, of `area`.
View usual_view(Vec3 open, double area) {
  constexpr double kHalf = 0.01;  // of the area: what rounding and small holes leave is less
  Vec3 eye = {-1, -1.2, 0.8};
  if (norm(open) > kHalf * area) {
    const double most = std::max({std::abs(open.x), std::abs(open.y), std::abs(open.z)});
    for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z})
      if (std::abs(open.*axis) == most) eye.*axis = std::copysign(eye.*axis, open.*axis);
  }
  eye = normalized(eye);
  const Vec3 right = normalized(cross(Vec3{0, 0, 1}, eye));
  return {right, cross(eye, right), eye};
}

/// Depth and brightness of each point.
class Canvas {
 public:
  /// Corners in points of the picture, z towards the eye.
  void draw(const std::array<Vec3, 3>& p, std::uint8_t brightness) {
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    const auto range = [](double a, double b, double c, int n) {
      const int lo = static_cast<int>(std::floor(std::min({a, b, c})));
      const int hi = static_cast<int>(std::ceil(std::max({a, b, c})));
      return std::array{std::clamp(lo, 0, n - 1), std::clamp(hi, 0, n - 1)};
    };
    const auto x = range(p[0].x, p[1].x, p[2].x, kWidth), y = range(p[0].y, p[1].y, p[2].y, kHeight);
    if (area == 0) return;
    constexpr double kHalf = 0.5;  // a triangle smaller than a point still has one
    for (int j = y[0]; j <= y[1]; ++j)
      for (int i = x[0]; i <= x[1]; ++i) {
        double depth = 0;
        bool is_in = true;
        for (int k = 0; k < 3 && is_in; ++k) {
          const Vec3 a = p[(k + 1) % 3], b = p[(k + 2) % 3];
          const double w = ((b.x - a.x) * (j - a.y) - (b.y - a.y) * (i - a.x)) / area;
          is_in = w * std::abs(area) >= -kHalf * std::hypot(b.x - a.x, b.y - a.y);
          depth += w * p[k].z;
        }
        if (is_in && depth > depth_[index(i, j)]) depth_[index(i, j)] = depth, grey_[index(i, j)] = brightness;
      }
  }

  std::string data_uri() const;

 private:
  static std::size_t index(int i, int j) { return static_cast<std::size_t>(j) * kWidth + static_cast<std::size_t>(i); }
  std::vector<double> depth_ = std::vector<double>(kWidth * kHeight, -std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> grey_ = std::vector<std::uint8_t>(kWidth * kHeight, 255);
};

std::string Canvas::data_uri() const {
  constexpr std::uint32_t kHeader = 54, kPalette = 4 * 256, kBytes = kHeader + kPalette + kWidth * kHeight;
  std::vector<std::uint8_t> file;
  const auto add = [&](std::uint32_t value, int n_bytes) {
    for (int b = 0; b < n_bytes; ++b) file.push_back(static_cast<std::uint8_t>(value >> 8 * b));
  };
  file = {'B', 'M'};
  for (const std::uint32_t v : {kBytes, 0U, kHeader + kPalette, 40U, std::uint32_t{kWidth}, std::uint32_t{kHeight}})
    add(v, 4);
  add(1, 2);
  add(8, 2);
  for (const std::uint32_t v : {0U, std::uint32_t{kWidth * kHeight}, 0U, 0U, 256U, 0U}) add(v, 4);
  for (std::uint32_t grey = 0; grey < 256; ++grey) add(grey | grey << 8 | grey << 16, 4);
  file.insert(file.end(), grey_.begin(), grey_.end());  // rows from below, as they are here
  return "data:image/bmp;base64," + base64(std::as_bytes(std::span(file)));
}

/// [n_groups] 1: its triangles are shown.
std::vector<std::uint8_t> shown_groups(const SurfaceMesh& mesh) {
  std::vector<std::uint8_t> shown;
  for (std::size_t g = 0; g < mesh.labels.group_name.size(); ++g)
    shown.push_back(!is_outer_role(role_of(mesh.labels, g)));
  return shown;
}

/// Normals of a domain around a body point into it.
template <class IsShown>
View view_of(const SurfaceMesh& mesh, const IsShown& is_shown) {
  bool has_far_field = false;
  for (std::size_t g = 0; g < mesh.labels.group_name.size(); ++g)
    has_far_field |= role_of(mesh.labels, g) == "farfield";
  Vec3 open = {};
  double area = 0;
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    if (!is_shown(t)) continue;
    const auto [a, b, c] = mesh.triangles[t].n;
    const Vec3 n = cross(mesh.node_xyz[b] - mesh.node_xyz[a], mesh.node_xyz[c] - mesh.node_xyz[a]);
    open = has_far_field ? open - n : open + n;
    area += norm(n);
  }
  return usual_view(open, area);
}

}  // namespace

std::string thumbnail(const SurfaceMesh& mesh) {
  const std::vector<std::uint8_t> shown = shown_groups(mesh);
  const auto is_shown = [&](TriangleId t) {
    const std::int32_t g = mesh.triangle_group.empty() ? kNone : mesh.triangle_group[t];
    return g == kNone || shown[g] != 0;
  };
  const View view = view_of(mesh, is_shown);
  Box3 box;
  std::vector<Vec3> place;
  for (const Vec3 x : mesh.node_xyz) place.push_back({dot(x, view.right), dot(x, view.up), dot(x, view.eye)});
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t)
    if (is_shown(t))
      for (const NodeId n : mesh.triangles[t].n) box.add(place[n]);
  if (box.is_empty()) return "";
  constexpr double kMargin = 4;
  const double scale = std::min((kWidth - 2 * kMargin) / std::max(box.hi.x - box.lo.x, 1e-300),
                                (kHeight - 2 * kMargin) / std::max(box.hi.y - box.lo.y, 1e-300));
  const Vec3 middle = box.center();
  Canvas canvas;
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    if (!is_shown(t)) continue;
    const auto corner = [&](int k) { return place[mesh.triangles[t].n[k]]; };
    std::array<Vec3, 3> p;
    for (int k = 0; k < 3; ++k)
      p[k] = {kWidth / 2.0 + scale * (corner(k).x - middle.x), kHeight / 2.0 + scale * (corner(k).y - middle.y),
              corner(k).z};
    const Vec3 n = cross(corner(1) - corner(0), corner(2) - corner(0));
    const double facing = norm(n) > 0 ? std::abs(n.z) / norm(n) : 0;
    canvas.draw(p, static_cast<std::uint8_t>(kDarkest + (kBrightest - kDarkest) * facing));
  }
  return canvas.data_uri();
}

}  // namespace st
