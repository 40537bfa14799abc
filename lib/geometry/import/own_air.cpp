#include "geometry/import/own_air.h"

#include <BRepAdaptor_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax1.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <limits>
#include <optional>

#include "base/boxes.h"
#include "geometry/import/air_pieces.h"
#include "geometry/import/air_sides.h"

namespace st::occt {
namespace {

// Lengths over the model's diagonal, sizes over its size.
constexpr double kLargestBody = 0.25;       // a fifth, and room for one
constexpr double kPlainBody = 0.15;         // of planes, cylinders, spheres alone: a larger one is a cavity
constexpr double kAskedBody = 0.95;         // where the user says that it is one
constexpr double kClear = 0.5;              // from body to far field, over the body's size
constexpr double kSpread = 1e-3;            // of outer faces from the sides of the model's box, from a convex shape
constexpr double kRounding = 0.05;          // a curved outer face narrower than this is the rounding of a part
constexpr double kInPlane = 1e-4;           // edges have tolerances
constexpr double kFlat = 1e-3;              // of a flat face, over the diagonal of its box
constexpr double kRound = 1e-3;             // of a sphere or circle, over its radius
constexpr double kAcross = 0.02;            // cosine: normals of a wall that stands on a plane
constexpr double kSharpTail = radians(60);  // of a section between two planes
constexpr double kTaper = 0.35;             // likewise of its faces: 20 degrees by taper, twist and sweep
constexpr double kAlongSpan = 0.7;          // cosine between its tail and the planes' normal: 45 degrees of sweep
constexpr double kBaseCorner = radians(140);
constexpr double kNarrowBase = 0.05;     // width of its base over the chord
constexpr double kThinSection = 0.25;    // its thickness over the chord: wings have 6 to 24 per cent, holes mostly more
constexpr double kDeep = 0.5;            // height of a wing on its plane over its width there: less is an engraving
constexpr double kInnerBox = 0.5;        // a box in the air, over the air around it
constexpr double kInInnerBox = 0.8;      // what is in it, over the box
constexpr double kClearOfBox = 0.01;     // from it to the box, over its size: ribs end on their skin
constexpr std::size_t kMostOuter = 100;  // sides: a domain has few
constexpr std::size_t kMostFaces = 1000;  // of them: twenty planes cut a box into 200 to 700

/// The point that all normals pass at one distance: centre of a sphere, or of a circle in its plane.
std::optional<Vec3> common_center(const std::vector<FaceSample>& samples) {
  if (samples.size() < 3) return std::nullopt;
  const FaceSample& a = samples[0];
  const FaceSample& b = *std::min_element(
      samples.begin(), samples.end(),
      [&](const FaceSample& p, const FaceSample& q) { return dot(p.normal, a.normal) < dot(q.normal, a.normal); });
  const double turned = norm(b.normal - a.normal);
  if (turned < 1e-6) return std::nullopt;
  double radius = norm(b.xyz - a.xyz) / turned;
  if (dot(b.xyz - a.xyz, b.normal - a.normal) < 0) radius = -radius;
  const Vec3 center = a.xyz - radius * a.normal;
  for (const FaceSample& s : samples)
    if (std::abs(distance(s.xyz, center) - std::abs(radius)) > kRound * std::abs(radius)) return std::nullopt;
  return center;
}

struct Axis {
  Vec3 point, direction;  // no direction: a sphere's centre
};

Vec3 vec(const gp_Dir& d) { return {d.X(), d.Y(), d.Z()}; }

/// The axis of a face of revolution.
std::optional<Axis> axis_of(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face, false);
  const auto of = [](const gp_Ax1& a) { return Axis{occt::vec(a.Location()), vec(a.Direction())}; };
  switch (surface.GetType()) {
    case GeomAbs_Cylinder:
      return of(surface.Cylinder().Axis());
    case GeomAbs_Cone:
      return of(surface.Cone().Axis());
    case GeomAbs_Torus:
      return of(surface.Torus().Axis());
    case GeomAbs_SurfaceOfRevolution:
      return of(surface.AxeOfRevolution());
    case GeomAbs_Sphere:
      return Axis{occt::vec(surface.Sphere().Location()), {}};
    default:
      return std::nullopt;
  }
}

/// The pieces of a model seen as air: who is outside, who inside.
struct Split {
  std::vector<const HullPlane*> planes;
  std::vector<FaceId> outer, interface, body;
  std::vector<FaceId> outer_and_planes() const {
    std::vector<FaceId> all = outer;
    for (const HullPlane* plane : planes) all.insert(all.end(), plane->faces.begin(), plane->faces.end());
    return all;
  }
};

class AirFinder {
 public:
  AirFinder(const ImportedShape& model, const ModelTables& t, AirSearch search)
      : pieces_(model, t), t_(t), is_asked_(search == AirSearch::kAsked) {}

  OwnAir find() {
    if (try_planes({})) return result_;
    const std::vector<HullPlane> planes = pieces_.hull_planes();
    for (const HullPlane& plane : planes)
      if (try_planes({&plane})) return result_;
    for (std::size_t i = 0; i < planes.size(); ++i)
      for (std::size_t k = i + 1; k < planes.size(); ++k) {
        if (try_planes({&planes[i], &planes[k]})) return result_;
      }
    return result_;
  }

 private:
  double length(double share) const { return share * pieces_.diagonal(); }

  bool try_planes(const std::vector<const HullPlane*>& planes) {
    const std::optional<Split> split = split_at(planes);
    if (!split || !is_air(*split)) return false;
    result_ = OwnAir{split->outer, {}, split->interface, ""};
    for (const HullPlane* plane : planes)
      result_.symmetry.insert(result_.symmetry.end(), plane->faces.begin(), plane->faces.end());
    for (auto* faces : {&result_.farfield, &result_.symmetry, &result_.interface})
      std::sort(faces->begin(), faces->end());
    return true;
  }

  /// Nothing where no single piece is outside, or nothing is inside.
  std::optional<Split> split_at(const std::vector<const HullPlane*>& planes) const {
    std::vector<char> is_plane(t_.n_faces(), 0);
    for (const HullPlane* plane : planes)
      for (const FaceId f : plane->faces) is_plane[f] = 1;
    std::vector<AirPiece> pieces = pieces_.pieces_without(is_plane);
    const auto outside = [&](const AirPiece& piece) { return encloses(piece.box, pieces_.box()); };
    const auto outer = std::find_if(pieces.begin(), pieces.end(), outside);
    if (pieces.size() < 2 || outer == pieces.end() || std::count_if(pieces.begin(), pieces.end(), outside) > 1)
      return std::nullopt;
    Split split{planes, outer->faces, {}, {}};
    pieces.erase(outer);
    take_sheets(pieces, split);
    take_inner_boxes(pieces, split);
    for (const AirPiece& piece : pieces) split.body.insert(split.body.end(), piece.faces.begin(), piece.faces.end());
    if (split.body.empty() || split.outer.size() > kMostFaces) return std::nullopt;
    for (const HullPlane* plane : planes)
      if (!touches(plane->faces, split.body) && !touches(plane->faces, split.interface)) return std::nullopt;
    return split;
  }

  static bool encloses(const Box3& outer, const Box3& inner) {
    return contains(outer, inner, kSpread * outer.diagonal());
  }

  /// Whether some face of the one shares an edge with one of the other.
  bool touches(const std::vector<FaceId>& some, const std::vector<FaceId>& others) const {
    std::vector<char> is_other(t_.n_faces(), 0);
    for (const FaceId f : others) is_other[f] = 1;
    for (const FaceId f : some)
      for (const EdgeId e : t_.edges_of(f))
        for (const FaceId g : pieces_.faces_at(e))
          if (is_other[g]) return true;
    return false;
  }

  /// Cuts through the domain, sheets from the body to its sides: they end on outer faces that go on there.
  void take_sheets(std::vector<AirPiece>& pieces, Split& split) const {
    std::vector<char> is_outer(t_.n_faces(), 0);
    for (const FaceId f : split.outer) is_outer[f] = 1;
    std::erase_if(pieces, [&](const AirPiece& piece) {
      for (const FaceId f : piece.faces)
        for (const EdgeId e : t_.edges_of(f)) {
          const std::span<const FaceId> at = pieces_.faces_at(e);
          if (!pieces_.is_crowded(e) || std::none_of(at.begin(), at.end(), [&](FaceId g) { return is_outer[g]; }))
            continue;
          split.interface.insert(split.interface.end(), piece.faces.begin(), piece.faces.end());
          return true;
        }
      return false;
    });
  }

  /// Boxes around the body with air on both sides, and what divides them or stands on them; such a wall may be there
  /// twice, once for each side.
  void take_inner_boxes(std::vector<AirPiece>& pieces, Split& split) const {
    for (bool is_found = true; is_found && pieces.size() > 1;) {
      is_found = false;
      for (std::size_t i = 0; i < pieces.size() && !is_found; ++i) {
        std::vector<AirPiece> same, sheets, others;
        for (const AirPiece& p : pieces) {
          const bool is_same = encloses(p.box, pieces[i].box) && encloses(pieces[i].box, p.box);
          (is_same ? same : pieces_.hangs_on(p, pieces[i]) ? sheets : others).push_back(p);
        }
        if (!is_inner_box(same, others, split)) continue;
        for (const auto* own : {&same, &sheets})
          for (const AirPiece& p : *own) split.interface.insert(split.interface.end(), p.faces.begin(), p.faces.end());
        pieces = others;
        is_found = true;
      }
    }
  }

  bool is_inner_box(const std::vector<AirPiece>& same, const std::vector<AirPiece>& others, const Split& split) const {
    if (others.empty() || !has_few_sides(same[0].faces)) return false;
    std::vector<FaceId> inside;
    for (const AirPiece& p : others) {
      if (!encloses(same[0].box, p.box)) return false;
      inside.insert(inside.end(), p.faces.begin(), p.faces.end());
    }
    const double own = size(same[0].faces);
    const bool is_apart = same.size() > 1 || own <= kInnerBox * size(split.outer) ||
                          std::any_of(same[0].faces.begin(), same[0].faces.end(),
                                      [&](FaceId f) { return t_.face_solid[f] != t_.face_solid[split.outer[0]]; });
    if (!is_apart || size(inside) > kInInnerBox * own) return false;
    const std::vector<Vec3> points = pieces_.edge_points(inside);
    return least_height(same[0].faces, pieces_.edge_points(same[0].faces), points) >= -kSpread * own &&
           least_height(same[0].faces, points, points) > kClearOfBox * size(inside);
  }

  double size(const std::vector<FaceId>& faces) const { return size_of(pieces_.edge_points(faces)); }

  /// Least height of points over the planes that touch the faces, on the side of the body; for a convex shape, how far
  /// the points are inside it.
  double least_height(const std::vector<FaceId>& faces, const std::vector<Vec3>& points,
                      const std::vector<Vec3>& body) const {
    Vec3 middle;
    for (const Vec3 x : body) middle += x / static_cast<double>(body.size());
    double least = std::numeric_limits<double>::infinity();
    for (const FaceId f : faces) {
      std::vector<FaceSample> samples = pieces_.samples_of(f);
      if (t_.face_type[f] == SurfaceType::kPlane && !samples.empty()) samples.resize(1);
      for (const FaceSample& s : samples) {
        const Vec3 inward = dot(middle - s.xyz, s.normal) > 0 ? s.normal : -s.normal;
        for (const Vec3 x : points) least = std::min(least, dot(x - s.xyz, inward));
      }
    }
    return least;
  }

  bool is_air(const Split& split) {
    if (!is_closed(split)) return false;
    const std::vector<Vec3> body = pieces_.edge_points(split.body),
                            outer = pieces_.edge_points(split.outer_and_planes());
    const double body_size = size_of(body), share = body_size / size_of(outer);
    if (!(share > 0) || share > kAskedBody) return false;
    if (!has_few_sides(split.outer)) return false;
    if (is_asked_) return true;
    const bool is_between = stands_between_planes(split);
    if (share > 2 * kLargestBody && !has_free_form(split.body)) return false;
    if (is_between ? has_roundings_across(split) : has_roundings(split.outer)) return false;
    if (least_height(split.outer_and_planes(), outer, body) < -length(kSpread)) return false;
    const double clear = least_height(split.outer, body, body);
    if (clear <= 0) return false;
    if (is_between && !has_free_form(split.body))
      return is_section(split) && doubt("is a section with plane faces between two planes, as a hole may be");
    if (share > kLargestBody) return doubt("is larger than a quarter of what is around it");
    if (clear < kClear * body_size) return doubt("is nearer to what is around it than half its own size");
    if (is_between) return is_section(split) || doubt("stands between two planes as a hole does");
    if (!split.planes.empty())
      return is_cut_by_symmetry(split) || doubt("stands on a plane as a pocket or a hole does");
    return share <= kPlainBody || has_free_form(split.body) || is_sphere(split.outer) ||
           doubt("has plain faces only and is larger than 0.15 of what is around it");
  }

  /// Keeps the first one.
  bool doubt(const std::string& why) {
    if (result_.doubt.empty()) result_.doubt = why;
    return false;
  }

  /// No edge of the outer faces is free, or all of these lie in a plane beside the model: it is still to be closed
  /// there.
  bool is_closed(const Split& split) const {
    std::vector<Vec3> open;
    for (const FaceId f : split.outer)
      for (const EdgeId e : t_.edges_of(f))
        if (pieces_.faces_at(e).size() < 2 && !t_.edge_is_degenerate[e]) {
          const std::vector<Vec3> own = pieces_.points_of(e);
          open.insert(open.end(), own.begin(), own.end());
        }
    return open.empty() || (split.planes.empty() && are_beside(open));
  }

  bool are_beside(const std::vector<Vec3>& points) const {
    const Vec3 a = points[0];
    const auto farther = [&](Vec3 p, Vec3 q) { return norm2(p - a) < norm2(q - a); };
    const Vec3 along = normalized(*std::max_element(points.begin(), points.end(), farther) - a);
    Vec3 across;
    for (const Vec3 x : points)
      if (const Vec3 n = cross(along, x - a); norm2(n) > norm2(across)) across = n;
    const Vec3 normal = normalized(across);
    const double rounding = length(kInPlane);
    if (std::any_of(points.begin(), points.end(), [&](Vec3 x) { return std::abs(dot(x - a, normal)) > rounding; }))
      return false;
    double below = 0, above = 0;
    for (const Vec3 x : t_.vertex_xyz)
      below = std::max(below, -dot(x - a, normal)), above = std::max(above, dot(x - a, normal));
    return std::min(below, above) <= rounding;
  }

  bool is_flat(FaceId f) const {
    const Vec3 extent = t_.face_box[f].hi - t_.face_box[f].lo;
    return t_.face_type[f] == SurfaceType::kPlane || std::min({extent.x, extent.y, extent.z}) <= kFlat * norm(extent);
  }

  bool has_few_sides(const std::vector<FaceId>& faces) const {
    return faces.size() <= kMostFaces && (faces.size() <= kMostOuter || sides_of(pieces_, faces).size() <= kMostOuter);
  }

  bool has_roundings(const std::vector<FaceId>& faces) const {
    return std::ranges::any_of(sides_of(pieces_, faces), [&](const AirSide& side) {
      return side.width < length(kRounding) && !is_flat(side.faces.front());
    });
  }

  /// Between two planes near each other all faces are narrow: their length along the planes counts.
  bool has_roundings_across(const Split& split) const {
    const double height = std::abs(dot(split.planes[1]->point - split.planes[0]->point, split.planes[0]->normal));
    return std::ranges::any_of(sides_of(pieces_, split.outer), [&](const AirSide& side) {
      return side.area < length(kRounding) * height && !is_flat(side.faces.front());
    });
  }

  bool has_free_form(const std::vector<FaceId>& faces) const {
    return std::any_of(faces.begin(), faces.end(),
                       [&](FaceId f) { return t_.face_type[f] >= SurfaceType::kBezier && !is_flat(f); });
  }

  bool is_sphere(const std::vector<FaceId>& faces) const {
    std::vector<FaceSample> all;
    for (const FaceId f : faces) {
      const std::vector<FaceSample>& own = pieces_.samples_of(f);
      all.insert(all.end(), own.begin(), own.end());
    }
    return common_center(all).has_value();
  }

  static bool stands_between_planes(const Split& split) {
    return split.planes.size() == 2 && dot(split.planes[0]->normal, split.planes[1]->normal) < -1 + kSpread;
  }

  /// A section of a wing between two planes: all faces about across, thin on both planes, and with a sharp edge or a
  /// narrow base. A hole has none of these edges.
  bool is_section(const Split& split) const {
    const Vec3 normal = split.planes[0]->normal;
    const double height = std::abs(dot(split.planes[1]->point - split.planes[0]->point, normal));
    double chord = 0;
    for (const HullPlane* plane : split.planes) {
      const std::vector<Vec3> points = points_on(*plane, split.body);
      if (points.empty() || width_across(points, normal) > kThinSection * size_of(points)) return false;
      chord = std::max(chord, size_of(points));
    }
    bool has_tail = false;
    for (const FaceId f : split.body) {
      for (const FaceSample& s : pieces_.samples_of(f))
        if (std::abs(dot(s.normal, normal)) > kTaper) return false;
      bool has_corners = t_.face_area[f] < kNarrowBase * chord * height;
      int n_along = 0;
      for (const EdgeId e : t_.edges_of(f)) {
        if (!is_along(e, normal)) continue;
        ++n_along;
        const double angle = pieces_.least_angle(e);
        has_corners = has_corners && angle < kBaseCorner;
        has_tail = has_tail || angle < kSharpTail;
      }
      has_tail = has_tail || (has_corners && n_along > 1);
    }
    return has_tail;
  }

  /// Of the edges of faces that lie in a plane.
  std::vector<Vec3> points_on(const HullPlane& plane, const std::vector<FaceId>& faces) const {
    std::vector<Vec3> on;
    for (const Vec3 x : pieces_.edge_points(faces))
      if (std::abs(dot(x - plane.point, plane.normal)) <= length(kInPlane)) on.push_back(x);
    return on;
  }

  /// Of points in a plane, square to the way between two that are far apart.
  static double width_across(const std::vector<Vec3>& points, Vec3 normal) {
    const auto furthest_from = [&](Vec3 x) {
      return *std::ranges::max_element(points, {}, [&](Vec3 p) { return norm2(p - x); });
    };
    const Vec3 a = furthest_from(points.front()), across = normalized(cross(normal, furthest_from(a) - a));
    double low = 0, high = 0;
    for (const Vec3 p : points) low = std::min(low, dot(p - a, across)), high = std::max(high, dot(p - a, across));
    return high - low;
  }

  bool is_along(EdgeId e, Vec3 direction) const {
    const std::vector<Vec3> x = pieces_.points_of(e);
    return std::abs(dot(normalized(x.back() - x.front()), direction)) > kAlongSpan;
  }

  /// What a symmetry plane cuts was whole once; what is milled or drilled into a plane was not.
  bool is_cut_by_symmetry(const Split& split) const {
    return std::any_of(split.planes.begin(), split.planes.end(),
                       [&](const HullPlane* plane) { return stands_as_half(split.body, *plane); });
  }

  bool stands_as_half(const std::vector<FaceId>& body, const HullPlane& plane) const {
    return std::any_of(body.begin(), body.end(), [&](FaceId f) {
      if (is_flat(f)) return false;
      const std::optional<Axis> axis = axis_of(pieces_.face(f));
      return axis ? is_in(*axis, plane, kSpread * t_.face_box[f].diagonal()) : is_free_over(f, plane, body);
    });
  }

  static bool is_in(const Axis& axis, const HullPlane& plane, double rounding) {
    return std::abs(dot(axis.direction, plane.normal)) < kSpread &&
           std::abs(dot(axis.point - plane.point, plane.normal)) < rounding;
  }

  /// A face of free form that is no wall of a hole or of an engraving in the plane.
  bool is_free_over(FaceId f, const HullPlane& plane, const std::vector<FaceId>& body) const {
    if (t_.face_type[f] < SurfaceType::kBezier) return false;
    std::vector<FaceSample> samples = pieces_.samples_of(f);
    const auto is_across = [&](const FaceSample& s) { return std::abs(dot(s.normal, plane.normal)) < kAcross; };
    if (!std::all_of(samples.begin(), samples.end(), is_across)) return true;
    for (FaceSample& s : samples) {
      s.xyz -= dot(s.xyz - plane.point, plane.normal) * plane.normal;
      s.normal = normalized(s.normal - dot(s.normal, plane.normal) * plane.normal);
    }
    if (samples.empty() || common_center(samples)) return false;
    std::vector<Vec3> points = pieces_.edge_points(body);
    double height = 0;
    for (Vec3& x : points) {
      const double own = -dot(x - plane.point, plane.normal);
      height = std::max(height, own);
      x += own * plane.normal;
    }
    return height >= kDeep * size_of(points);
  }

  const AirPieces pieces_;
  const ModelTables& t_;
  const bool is_asked_;
  OwnAir result_;
};

}  // namespace

OwnAir find_own_air(const ImportedShape& model, const ModelTables& tables, AirSearch search) {
  if (tables.n_faces() < 2) return {};
  return AirFinder(model, tables, search).find();
}

}  // namespace st::occt
