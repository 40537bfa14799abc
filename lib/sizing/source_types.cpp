#include "sizing/source_types.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace st {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_to_triangle(Vec3 x, const std::array<Vec3, 3>& p) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], n = cross(a, b), r = x - p[0];
  const double n2 = norm2(n), wb = dot(cross(r, b), n), wc = dot(cross(a, r), n);
  if (n2 > 0 && wb >= 0 && wc >= 0 && wb + wc <= n2) return std::abs(dot(r, n)) / std::sqrt(n2);
  return std::min({segment_distance(x, p[0], p[1]), segment_distance(x, p[1], p[2]), segment_distance(x, p[2], p[0])});
}

/// Negative inside, as below: how far from the surface.
double distance_to_box(Vec3 x, const SourceSpec& s) {
  double d2 = 0, deepest = -kInfinity;
  for (const Vec3& axis : s.half_axis) {
    const double half = norm(axis), outside = std::abs(dot(x - s.point[0], axis)) / half - half;
    if (outside > 0) d2 += outside * outside;
    deepest = std::max(deepest, outside);
  }
  return deepest < 0 ? deepest : std::sqrt(d2);
}

/// `axis`: unit vector from one end to the other, `height` away; a disc has no height.
double distance_to_cylinder(Vec3 x, Vec3 a, Vec3 axis, double height, double radius) {
  const Vec3 r = x - a;
  const double along = dot(r, axis), across = norm(r - along * axis);
  const double lengthwise = std::max(-along, along - height), sideways = across - radius;
  if (lengthwise < 0 && sideways < 0) return std::max(lengthwise, sideways);
  return std::hypot(std::max(lengthwise, 0.0), std::max(sideways, 0.0));
}

template <double (*Distance)(const SourceSpec&, Vec3)>
std::unique_ptr<SizeSource> make_shape(const SourceSpec& spec, double slope) {
  return make_shape_source(spec, slope, Distance);
}

double from_point(const SourceSpec& s, Vec3 x) { return distance(x, s.point[0]); }
double from_line(const SourceSpec& s, Vec3 x) { return segment_distance(x, s.point[0], s.point[1]); }
double from_triangle(const SourceSpec& s, Vec3 x) { return distance_to_triangle(x, s.point); }
double from_box(const SourceSpec& s, Vec3 x) { return distance_to_box(x, s); }
double from_cylinder(const SourceSpec& s, Vec3 x) {
  const auto& p = s.point;
  return distance_to_cylinder(x, p[0], normalized(p[1] - p[0]), distance(p[0], p[1]), s.extent);
}
double from_sphere(const SourceSpec& s, Vec3 x) { return distance(x, s.point[0]) - s.extent; }
double from_disc(const SourceSpec& s, Vec3 x) {
  return distance_to_cylinder(x, s.point[0], normalized(s.half_axis[0]), 0, s.extent);
}

/// A line or triangle.
std::string require_extent(SourceSpec& s) {
  if (SourceSpec simpler = s; !simplify(simpler)) return "";
  return s.kind == SourceKind::kLine
             ? "line: its points are the same; move one, or write type = \"point\" and at"
             : "triangle: its points lie on one line; move one, or write type = \"line\" with two points";
}

/// Its corners become its middle and half axes.
std::string complete_box(SourceSpec& s) {
  const Vec3 lo = s.point[0], hi = s.point[1], half = 0.5 * (hi - lo);
  if (!(half.x > 0 && half.y > 0 && half.z > 0)) return "box: lo must be below hi in x, y and z";
  s.point = {0.5 * (lo + hi), {}, {}};
  s.half_axis = {{{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}}};
  return "";
}

std::string require_height(SourceSpec& s) {
  return s.point[0] == s.point[1] ? "cylinder: from and to are the same point" : "";
}

std::string require_normal(SourceSpec& s) { return norm(s.half_axis[0]) > 0 ? "" : "disc: normal is zero"; }

constexpr SourceType::Key kAt{"at", SourceKey::kFirstPoint}, kPoints{"points", SourceKey::kPoints},
    kExtent{"extent", SourceKey::kExtent};

}  // namespace

std::vector<SourceType>& source_types() {
  static std::vector<SourceType> table{
      {SourceKind::kPoint, "point", {kAt}, make_shape<from_point>},
      {SourceKind::kLine, "line", {kPoints}, make_shape<from_line>, 2, true, require_extent},
      {SourceKind::kTriangle, "triangle", {kPoints}, make_shape<from_triangle>, 3, false, require_extent},
      {SourceKind::kBox,
       "box",
       {{"lo", SourceKey::kFirstPoint}, {"hi", SourceKey::kSecondPoint}},
       make_shape<from_box>,
       1,
       false,
       complete_box},
      {SourceKind::kCylinder,
       "cylinder",
       {{"from", SourceKey::kFirstPoint}, {"to", SourceKey::kSecondPoint}, kExtent},
       make_shape<from_cylinder>,
       1,
       true,
       require_height},
      {SourceKind::kSphere, "sphere", {kAt, kExtent}, make_shape<from_sphere>},
      {SourceKind::kDisc,
       "disc",
       {{"normal", SourceKey::kDirection}, kAt, kExtent},
       make_shape<from_disc>,
       1,
       false,
       require_normal},
  };
  return table;
}

const SourceType* find_source_type(SourceKind kind) {
  for (const SourceType& type : source_types())
    if (type.kind == kind) return &type;
  return nullptr;
}

const SourceType* find_source_type(const std::string& name) {
  for (const SourceType& type : source_types())
    if (type.name == name) return &type;
  return nullptr;
}

std::string source_type_names() {
  const std::vector<SourceType>& types = source_types();
  std::string names;
  for (std::size_t i = 0; i < types.size(); ++i)
    names += (i == 0 ? "" : i + 1 == types.size() ? " or " : ", ") + std::string(types[i].name);
  return names;
}

}  // namespace st
