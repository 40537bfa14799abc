#include "geometry/import/air_pieces.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/disjoint_sets.h"
#include "geometry/brep/uv_box.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/surface.h"

namespace st::occt {
namespace {

constexpr int kPointsPerEdge = 5;
constexpr int kGrid = 8;                 // samples of a face along u and along v
constexpr double kInPlane = 1e-4;        // over the model's diagonal: edges have tolerances
constexpr double kRounding = 1e-6;       // likewise: of places in a plane
constexpr double kCell = 16;             // of the grid in which edges are looked for, over the rounding
constexpr double kRough = 10;            // of that: of a plane through three points of a face
constexpr double kAlong = 0.999;         // cosine between normals in a plane
constexpr double kLargePlane = 0.25;     // diagonal of the box of faces that may be a symmetry plane, over the model's
constexpr double kLargePiece = 0.02;     // likewise of the largest of its faces: twenty planes may have cut it
constexpr double kStraight = 20;         // degrees
constexpr std::size_t kMostPlanes = 12;  // that are looked at: a prism of 10 sides

Vec3 point_at(const BRepAdaptor_Surface& surface, double u, double v, Vec3& normal) {
  gp_Pnt p;
  gp_Vec du, dv;
  surface.D1(u, v, p, du, dv);
  const gp_Vec n = du.Crossed(dv);
  normal = normalized(Vec3{n.X(), n.Y(), n.Z()});
  return vec(p);
}

Vec3 farthest(const std::vector<Vec3>& points, Vec3 from) {
  return *std::max_element(points.begin(), points.end(),
                           [&](Vec3 a, Vec3 b) { return norm2(a - from) < norm2(b - from); });
}

}  // namespace

double size_of(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  const Vec3 end = farthest(points, points[0]);
  return distance(end, farthest(points, end));
}

std::vector<FaceSample> sample_face(const TopoDS_Face& face) {
  std::vector<FaceSample> samples;
  try {
    const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
    const BRepAdaptor_Surface surface(forward);
    BRepTopAdaptor_FClass2d classifier(forward, Precision::PConfusion());
    const Box2 box = uv_box(forward);
    const Vec2 extent = box.size();
    for (int i = 0; i < kGrid; ++i)
      for (int k = 0; k < kGrid; ++k) {
        const gp_Pnt2d uv(box.lo.x + (i + 0.5) / kGrid * extent.x, box.lo.y + (k + 0.5) / kGrid * extent.y);
        if (classifier.Perform(uv) != TopAbs_IN) continue;
        FaceSample sample;
        sample.xyz = point_at(surface, uv.X(), uv.Y(), sample.normal);
        if (norm2(sample.normal) > 0) samples.push_back(sample);
      }
  } catch (const Standard_Failure&) {  // a face that cannot be measured says nothing
    samples.clear();
  }
  return samples;
}

AirPieces::AirPieces(const ImportedShape& model, const ModelTables& tables)
    : model_(model), t_(tables), box_(tables.box()), diagonal_(box_.diagonal()) {
  TopExp::MapShapes(model_.shape, TopAbs_EDGE, edges_);
  find_edge_points();
  find_first_edges();
  find_first_faces();
  find_ways();
}

void AirPieces::find_edge_points() {
  edge_points_.reserve(static_cast<std::size_t>(kPointsPerEdge) * t_.n_edges());
  for (EdgeId e = 0; e < t_.n_edges(); ++e) {
    double t0 = 0, t1 = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges_(e + 1)), t0, t1);
    for (int k = 0; k < kPointsPerEdge; ++k)
      edge_points_.push_back(curve.IsNull() ? t_.vertex_xyz[t_.edge_vertices[2 * e]]
                                            : vec(curve->Value(t0 + k * (t1 - t0) / (kPointsPerEdge - 1))));
  }
}

bool AirPieces::are_at_one_place(EdgeId a, EdgeId b) const {
  const Vec3* p = &edge_points_[static_cast<std::size_t>(kPointsPerEdge) * a];
  const Vec3* q = &edge_points_[static_cast<std::size_t>(kPointsPerEdge) * b];
  bool is_same = true, is_opposite = true;
  for (int k = 0; k < kPointsPerEdge; ++k) {
    is_same = is_same && distance(p[k], q[k]) <= kRounding * diagonal_;
    is_opposite = is_opposite && distance(p[k], q[kPointsPerEdge - 1 - k]) <= kRounding * diagonal_;
  }
  return is_same || is_opposite;
}

void AirPieces::find_first_edges() {
  first_edge_.resize(t_.n_edges());
  std::iota(first_edge_.begin(), first_edge_.end(), 0);
  const double cell = kCell * kRounding * diagonal_;
  std::map<std::array<std::int64_t, 3>, std::vector<EdgeId>> cells;  // first edges by their middles
  const auto key = [&](Vec3 x, double by) {
    const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v / cell + by)); };
    return std::array{index(x.x), index(x.y), index(x.z)};
  };
  for (EdgeId e = 0; e < t_.n_edges() && cell > 0; ++e) {
    if (t_.edge_is_degenerate[e]) continue;
    const Vec3 middle = edge_points_[static_cast<std::size_t>(kPointsPerEdge) * e + kPointsPerEdge / 2];
    const auto lo = key(middle, -1.0 / kCell), hi = key(middle, 1.0 / kCell);
    for (std::int64_t i = lo[0]; i <= hi[0]; ++i)
      for (std::int64_t j = lo[1]; j <= hi[1]; ++j)
        for (std::int64_t k = lo[2]; k <= hi[2]; ++k)
          if (const auto near = cells.find({i, j, k}); near != cells.end())
            for (const EdgeId other : near->second)
              if (first_edge_[e] == e && are_at_one_place(e, other)) first_edge_[e] = other;
    if (first_edge_[e] == e) cells[key(middle, 0)].push_back(e);
  }
  faces_at_ = {static_cast<std::size_t>(t_.n_edges()), [&](const auto& visit) {
                 for (FaceId f = 0; f < t_.n_faces(); ++f)
                   for (const EdgeId e : t_.edges_of(f)) visit(first_edge_[e], f);
               }};
}

void AirPieces::find_first_faces() {
  std::map<std::vector<EdgeId>, std::vector<FaceId>> by_edges;
  for (FaceId f = 0; f < t_.n_faces(); ++f) {
    std::vector<EdgeId> edges;
    for (const EdgeId e : t_.edges_of(f)) edges.push_back(first_edge_[e]);
    std::sort(edges.begin(), edges.end());
    std::vector<FaceId>& same = by_edges[edges];
    const auto twin = std::find_if(same.begin(), same.end(), [&](FaceId g) {
      return std::abs(t_.face_area[f] - t_.face_area[g]) <= kAboutSameArea * t_.face_area[f] &&
             distance(t_.face_box[f].center(), t_.face_box[g].center()) <= kAboutSameArea * t_.face_box[f].diagonal();
    });
    first_face_.push_back(twin == same.end() ? f : *twin);
    if (twin == same.end()) same.push_back(f);
  }
}

TopoDS_Face AirPieces::face(FaceId f) const { return TopoDS::Face(model_.faces(f + 1)); }

const std::vector<FaceSample>& AirPieces::samples_of(FaceId f) const {
  const auto known = samples_.find(f);
  return known != samples_.end() ? known->second : samples_.emplace(f, sample_face(face(f))).first->second;
}

std::vector<Vec3> AirPieces::points_of(EdgeId e) const {
  const auto first = edge_points_.begin() + static_cast<std::ptrdiff_t>(kPointsPerEdge) * e;
  return {first, first + kPointsPerEdge};
}

std::vector<Vec3> AirPieces::edge_points(std::span<const FaceId> faces) const {
  std::vector<Vec3> points;
  for (const FaceId f : faces)
    for (const EdgeId e : t_.edges_of(f)) {
      const auto first = edge_points_.begin() + static_cast<std::ptrdiff_t>(kPointsPerEdge) * e;
      points.insert(points.end(), first, first + kPointsPerEdge);
    }
  return points;
}

bool AirPieces::has_edges_in(FaceId f, const HullPlane& plane, double tolerance) const {
  for (const EdgeId e : t_.edges_of(f))
    for (int k = 0; k < kPointsPerEdge; ++k)
      if (std::abs(dot(edge_points_[static_cast<std::size_t>(kPointsPerEdge) * e + k] - plane.point, plane.normal)) >
          tolerance)
        return false;
  return true;
}

bool AirPieces::is_in_plane(FaceId f, const HullPlane& plane) const {
  double tolerance = std::max(kRounding * diagonal_, t_.face_tolerance[f]);
  for (const EdgeId e : t_.edges_of(f)) tolerance = std::max(tolerance, t_.edge_tolerance[e]);
  const auto is_off = [&](Vec3 x) { return std::abs(dot(x - plane.point, plane.normal)) > tolerance; };
  if (!has_edges_in(f, plane, tolerance)) return false;
  const std::vector<FaceSample>& samples = samples_of(f);
  return std::none_of(
             samples.begin(), samples.end(),
             [&](const FaceSample& s) { return is_off(s.xyz) || std::abs(dot(s.normal, plane.normal)) < kAlong; }) &&
         (!samples.empty() || t_.face_type[f] == SurfaceType::kPlane);
}

/// By its edges; the plane through the three points that are far apart.
std::optional<HullPlane> AirPieces::rough_plane_of(FaceId f) const {
  const std::vector<Vec3> points = edge_points({&f, 1});
  if (points.empty()) return std::nullopt;
  const Vec3 a = farthest(points, points[0]), along = farthest(points, a) - a;
  Vec3 across;
  for (const Vec3 x : points)
    if (const Vec3 n = cross(along, x - a); norm2(n) > norm2(across)) across = n;
  HullPlane plane{a, normalized(across), {}, 0};
  return norm2(across) > 0 && has_edges_in(f, plane, kInPlane * diagonal_) ? std::optional(plane) : std::nullopt;
}

std::optional<HullPlane> AirPieces::hull_plane_of(FaceId f) const {
  if (t_.face_box[f].diagonal() < kLargePiece * diagonal_) return std::nullopt;
  std::optional<HullPlane> plane = rough_plane_of(f);
  if (!plane || !turn_outward(*plane, kRough * kInPlane * diagonal_)) return std::nullopt;
  const std::vector<FaceSample>& samples = samples_of(f);
  if (samples.empty()) return std::nullopt;
  plane->point = samples[0].xyz, plane->normal = samples[0].normal;
  return turn_outward(*plane, kInPlane * diagonal_) && is_in_plane(f, *plane) ? plane : std::nullopt;
}

bool AirPieces::turn_outward(HullPlane& plane, double rounding) const {
  double below = 0, above = 0;
  for (const Vec3 x : t_.vertex_xyz) {
    const double height = dot(x - plane.point, plane.normal);
    below = std::max(below, -height), above = std::max(above, height);
    if (std::min(below, above) > rounding) return false;
  }
  if (above > below) plane.normal = -plane.normal;
  return true;
}

/// Whether some of its faces that hang together span much of the model.
bool AirPieces::is_large(const HullPlane& plane) const {
  std::map<EdgeId, std::int32_t> first;
  DisjointSets sets(static_cast<std::int64_t>(plane.faces.size()));
  for (std::size_t i = 0; i < plane.faces.size(); ++i)
    for (const EdgeId e : t_.edges_of(plane.faces[i])) {
      const auto [known, is_new] = first.emplace(first_edge_[e], static_cast<std::int32_t>(i));
      if (!is_new) sets.join(static_cast<std::int32_t>(i), known->second);
    }
  return std::ranges::any_of(sets.groups(), [&](const std::vector<std::int32_t>& some) {
    Box3 box;
    for (const std::int32_t i : some) box.add(t_.face_box[plane.faces[static_cast<std::size_t>(i)]]);
    return box.diagonal() >= kLargePlane * diagonal_;
  });
}

std::vector<HullPlane> AirPieces::hull_planes() const {
  std::vector<HullPlane> planes;
  std::vector<char> is_known(t_.n_faces(), 0);
  for (FaceId f = 0; f < t_.n_faces(); ++f) {
    if (is_known[f]) continue;
    std::optional<HullPlane> plane = hull_plane_of(f);
    if (!plane) continue;
    for (FaceId g = 0; g < t_.n_faces(); ++g)
      if (!is_known[g] && is_in_plane(g, *plane)) {
        is_known[g] = 1;
        plane->faces.push_back(g);
        plane->area += t_.face_area[g];
      }
    if (is_large(*plane)) planes.push_back(std::move(*plane));
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const HullPlane& a, const HullPlane& b) { return a.area > b.area; });
  if (planes.size() > kMostPlanes) planes.resize(kMostPlanes);
  return planes;
}

std::vector<FaceRim> AirPieces::rims(FaceId f, EdgeId e) const {
  std::vector<FaceRim> all;
  const TopoDS_Face own_face = face(f);
  for (TopExp_Explorer at(own_face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); at.More(); at.Next()) {
    if (!at.Current().IsSame(edges_(e + 1))) continue;
    const TopoDS_Edge own = TopoDS::Edge(at.Current());
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(own, own_face, first, last);
    if (curve.IsNull()) return all;
    gp_Pnt2d uv;
    gp_Vec2d way;
    curve->D1(0.5 * (first + last), uv, way);
    gp_Pnt p;
    gp_Vec du, dv, duu, dvv, duv;
    BRepAdaptor_Surface(own_face, false).D2(uv.X(), uv.Y(), p, du, dv, duu, dvv, duv);
    gp_Vec along = way.X() * du + way.Y() * dv;
    if (own.Orientation() == TopAbs_REVERSED) along.Reverse();
    const auto to_vec = [](const gp_Vec& v) { return Vec3{v.X(), v.Y(), v.Z()}; };
    const Vec3 normal = normalized(to_vec(du.Crossed(dv)));
    FaceRim rim{normalized(cross(normal, to_vec(along))), {}};
    if (const auto step = tangent_step(to_vec(du), to_vec(dv), rim.into)) {
      const gp_Vec bend = step->x * step->x * duu + 2 * step->x * step->y * duv + step->y * step->y * dvv;
      rim.bend = dot(to_vec(bend), normal) * normal;
    }
    all.push_back(rim);
  }
  return all;
}

void AirPieces::find_ways() {
  for (EdgeId e = 0; e < t_.n_edges(); ++e) {
    if (first_edge_[e] != e || faces_at(e).size() < 3 || t_.edge_is_degenerate[e]) continue;
    std::vector<Way> ways;
    for (const FaceId f : faces_at(e))
      if (std::none_of(ways.begin(), ways.end(), [&](const Way& way) { return way.face == first_face_[f]; }))
        ways.push_back({first_face_[f], {}});
    if (ways.size() < 3) continue;
    for (Way& way : ways)
      for (const EdgeId own : t_.edges_of(way.face))
        if (first_edge_[own] == e)
          for (const FaceRim& rim : rims(way.face, own)) way.into = rim.into;
    ways_.emplace(e, std::move(ways));
  }
}

double AirPieces::least_angle(EdgeId e) const {
  std::vector<Vec3> into;
  std::vector<FaceId> done;
  for (const FaceId f : faces_at(e)) {
    if (std::ranges::count(done, f) > 0) continue;
    done.push_back(f);
    std::vector<EdgeId> own;
    for (const EdgeId k : t_.edges_of(f))
      if (first_edge_[k] == first_edge_[e] && std::ranges::count(own, k) == 0) own.push_back(k);
    for (const EdgeId k : own)
      for (const FaceRim& rim : rims(f, k)) into.push_back(rim.into);
  }
  double least = kPi;
  for (std::size_t i = 0; i < into.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, angle_between(into[i], into[k]));
  return least;
}

bool AirPieces::hangs_on(const AirPiece& piece, const AirPiece& other) const {
  const auto count = [&](EdgeId e, const AirPiece& of) {
    return std::ranges::count_if(faces_at(e), [&](FaceId f) { return std::ranges::binary_search(of.faces, f); });
  };
  return std::ranges::any_of(piece.faces, [&](FaceId f) {
    return std::ranges::any_of(t_.edges_of(f),
                               [&](EdgeId e) { return is_crowded(e) && count(e, piece) == 1 && count(e, other) == 2; });
  });
}

std::vector<AirPiece> AirPieces::pieces_without(const std::vector<char>& is_left_out) const {
  DisjointSets sets(t_.n_faces());
  for (FaceId f = 0; f < t_.n_faces(); ++f)
    if (!is_left_out[f] && !is_left_out[first_face_[f]]) sets.join(f, first_face_[f]);
  for (EdgeId e = 0; e < t_.n_edges(); ++e) {
    FaceId first = kNone;
    for (const FaceId f : faces_at(e))
      if (!is_left_out[f] && first_edge_[e] == e && !is_crowded(e))
        first == kNone ? void(first = f) : sets.join(first, f);
  }
  std::vector<std::pair<FaceId, FaceId>> pairs;
  for (const auto& [e, ways] : ways_) {
    std::vector<Way> single;
    for (const Way& way : ways)
      if (!is_left_out[way.face] && std::count_if(ways.begin(), ways.end(), [&](const Way& other) {
                                      return !is_left_out[other.face] && sets.find(other.face) == sets.find(way.face);
                                    }) == 1)
        single.push_back(way);
    if (const auto pair = straight_pair(single)) pairs.push_back(*pair);
  }
  for (const auto& [f, g] : pairs) sets.join(f, g);
  std::vector<AirPiece> pieces;
  for (std::vector<FaceId>& faces : sets.groups()) {
    if (is_left_out[faces[0]]) continue;
    pieces.emplace_back();
    for (const FaceId f : faces) pieces.back().box.add(t_.face_box[f]);
    pieces.back().faces = std::move(faces);
  }
  return pieces;
}

std::optional<std::pair<FaceId, FaceId>> AirPieces::straight_pair(std::span<const Way> at) {
  double least = -std::cos(radians(kStraight));
  std::optional<std::pair<FaceId, FaceId>> best;
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t k = i + 1; k < at.size(); ++k)
      if (const double d = dot(at[i].into, at[k].into); d < least) least = d, best = std::pair(at[i].face, at[k].face);
  return best;
}

}  // namespace st::occt
