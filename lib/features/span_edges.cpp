#include "features/span_edges.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>

#include "base/boxes.h"
#include "base/eigen.h"
#include "base/share.h"
#include "features/smooth_edges.h"
#include "geometry/model/edge_faces.h"

namespace st {
namespace {

constexpr double kLeastLength = 0.005;      // of the reference diagonal: of an edge
constexpr double kSmooth = radians(30);     // between the faces there
constexpr double kStraight = 0.7;           // between the ends of an edge over its length, at least
constexpr double kChordMost = 2;            // over the length of the edge
constexpr double kSlab = 0.06;              // of the edge's length: samples are no further from the plane
constexpr double kSlabOfRing = 0.03;        // likewise
constexpr std::size_t kLeastSamples = 8;    // in the slab
constexpr double kThick = 0.45;             // of the chord: samples lie in a flatter rectangle
constexpr double kLooksAcross = 0.5;        // cosine between normals and the direction across the chord
constexpr int kGrid = 24;                   // samples of a face along u and v
constexpr std::size_t kPiece = 8;           // samples of a face beside each other, with a box of their own
constexpr double kRounding = 1e-6;          // of the edge's length, about: of distances from boxes
constexpr std::size_t kMostFaces = 12;      // around an edge
constexpr std::int32_t kEdgesPerTask = 64;  // ranks sample the faces beside their edges anew

enum class Known : unsigned char { kNotYet, kNo, kYes };

/// For any thread.
class SpanEdgeFinder {
 public:
  SpanEdgeFinder(const Model& model, const FaceRoles& roles, std::span<const std::uint8_t> is_taken)
      : model_(model),
        t_(model.tables()),
        roles_(roles),
        faces_at_(t_),
        is_taken_(is_taken),
        is_smooth_(static_cast<std::size_t>(t_.n_edges())),
        is_sampled_(static_cast<std::size_t>(t_.n_faces())),
        samples_(is_sampled_.size()) {
    is_turned_ = is_material_ahead(t_, roles);
  }

  /// Among `kEdgesPerTask` edges.
  std::vector<EdgeWithChord> run(std::int32_t task) {
    std::vector<EdgeWithChord> found;
    for (EdgeId e = task * kEdgesPerTask; e < std::min((task + 1) * kEdgesPerTask, t_.n_edges()); ++e) {
      if (!is_candidate(e)) continue;
      if (const double chord = thin_chord(e); chord > 0) found.push_back({e, chord});
    }
    return found;
  }

 private:
  bool is_free_form(FaceId f) const {
    constexpr std::array kAnalytic = {SurfaceType::kPlane, SurfaceType::kCylinder, SurfaceType::kCone,
                                      SurfaceType::kSphere, SurfaceType::kTorus};
    return roles_.role[f] == FaceRole::kWall && !is_taken_[f] && std::ranges::count(kAnalytic, t_.face_type[f]) == 0;
  }

  bool is_candidate(EdgeId e) {
    if (t_.edge_is_degenerate[e] || t_.edge_length[e] < kLeastLength * roles_.reference_diagonal) return false;
    const auto at = faces_at_[e];
    if (at.size() != 2 || !is_free_form(at[0]) || !is_free_form(at[1])) return false;
    const VertexId a = t_.edge_vertices[2 * e], b = t_.edge_vertices[2 * e + 1];
    if (a != b && distance(t_.vertex_xyz[a], t_.vertex_xyz[b]) < kStraight * t_.edge_length[e]) return false;
    return at[0] == at[1] || is_smooth(e);
  }

  bool is_smooth(EdgeId e) {
    std::atomic<Known>& known = is_smooth_[static_cast<std::size_t>(e)];
    if (known == Known::kNotYet)
      known = is_smooth_half_way(model_, e, faces_at_[e], kSmooth) ? Known::kYes : Known::kNo;
    return known == Known::kYes;
  }

  /// Its faces, and those beyond their edges, without walls that turn away there.
  std::vector<FaceId> faces_around(EdgeId e) {
    std::vector<FaceId> faces(faces_at_[e].begin(), faces_at_[e].end());
    if (faces[0] == faces[1]) faces.pop_back();
    for (std::size_t k = 0, n = faces.size(); k < n; ++k)
      for (const EdgeId next : t_.edges_of(faces[k]))
        for (const FaceId f : faces_at_[next])
          if (faces.size() < kMostFaces && std::ranges::count(faces, f) == 0 && is_free_form(f) && is_smooth(next))
            faces.push_back(f);
    return faces;
  }

  /// A place on a face, and the unit normal there, out of the body.
  struct Sample {
    Vec3 x, normal;
  };

  struct FaceSamples {
    std::vector<Sample> all;
    std::vector<Box3> box;  // of each piece
    Box3 whole;
  };

  const FaceSamples& samples_of(FaceId f) {
    FaceSamples& samples = samples_[static_cast<std::size_t>(f)];
    std::call_once(is_sampled_[static_cast<std::size_t>(f)], [&] { samples = sample(f); });
    return samples;
  }

  FaceSamples sample(FaceId f) const {
    FaceSamples samples;
    const auto surface = model_.surface(f);
    const Vec2 low{surface->u_min(), surface->v_min()}, way = Vec2{surface->u_max(), surface->v_max()} - low;
    const double sign = (t_.face_is_reversed[f] != 0) != is_turned_ ? -1 : 1;
    samples.all.resize(kGrid * kGrid);
    samples.box.resize((kGrid * kGrid + kPiece - 1) / kPiece);
    std::array<Vec2, kGrid> row;
    std::array<SurfacePoint, kGrid> points;
    for (int k = 0; k < kGrid; ++k) {
      for (int i = 0; i < kGrid; ++i) row[i] = {low.x + way.x * (i + 0.5) / kGrid, low.y + way.y * (k + 0.5) / kGrid};
      surface->evaluate_batch(row, points);
      for (int i = 0; i < kGrid; ++i) {
        const SurfacePoint& p = points[i];
        const std::size_t at = static_cast<std::size_t>(i) * kGrid + k;
        samples.whole.add(p.x);
        samples.box[at / kPiece].add(p.x);
        samples.all[at] = {p.x, sign * normalized(cross(p.du, p.dv))};
      }
    }
    return samples;
  }

  /// A slab about the plane square to an edge half way.
  struct Slab {
    Vec3 x, normal;    // a point of the plane; unit
    double half = 0;   // thickness, model unit
    double reach = 0;  // from the point, model unit

    /// False: nothing in the box is in the slab, nor within reach.
    bool may_meet(const Box3& box) const {
      const double margin = kRounding * reach;
      const Vec3 size = 0.5 * (box.hi - box.lo);
      const double off = std::abs(dot(box.center() - x, normal)),
                   across = std::abs(normal.x) * size.x + std::abs(normal.y) * size.y + std::abs(normal.z) * size.z;
      return off - across <= half + margin && distance2(x, box) <= (reach + margin) * (reach + margin);
    }
  };

  /// In the plane square to an edge half way, as seen from there; of a ring on this side of its middle.
  std::vector<Sample> samples_near(EdgeId e) {
    const auto curve = model_.curve(e);
    const CurvePoint p = curve->evaluate(0.5 * (curve->t_min() + curve->t_max()));
    const bool is_ring = t_.edge_vertices[2 * e] == t_.edge_vertices[2 * e + 1];
    const Vec3 inward = 0.5 * (curve->point(curve->t_min()) - p.x);
    const double length = t_.edge_length[e];
    const Slab slab{p.x, normalized(p.d1), (is_ring ? kSlabOfRing : kSlab) * length, kChordMost * length};
    std::vector<Sample> near;
    const auto add = [&](const Sample& s) {
      const Vec3 way = s.x - slab.x;
      const double height = dot(way, slab.normal);
      if (std::abs(height) <= slab.half && norm(way) <= slab.reach && (!is_ring || dot(way, inward) < norm2(inward)))
        near.push_back({way - height * slab.normal, s.normal});
    };
    for (const FaceId f : faces_around(e)) {
      const FaceSamples& samples = samples_of(f);
      if (!slab.may_meet(samples.whole)) continue;
      for (std::size_t k = 0; k < samples.box.size(); ++k) {
        if (!slab.may_meet(samples.box[k])) continue;
        const std::span rest = std::span(samples.all).subspan(k * kPiece);
        for (const Sample& s : rest.first(std::min(rest.size(), kPiece))) add(s);
      }
    }
    return near;
  }

  /// 0: not thin there, or too short for its chord, or there are no two sides that look away from each other.
  double thin_chord(EdgeId e) {
    const std::vector<Sample> near = samples_near(e);
    if (near.size() < kLeastSamples) return 0;
    Vec3 middle;
    for (const Sample& s : near) middle += s.x / static_cast<double>(near.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Sample& s : near) spread += to_eigen(s.x - middle) * to_eigen(s.x - middle).transpose();
    const PrincipalAxes shape = principal_axes(spread);  // the first one is the plane's normal
    Box3 box;
    std::array<std::size_t, 2> n_sides = {0, 0};
    std::array<double, 2> height = {0, 0};
    for (const Sample& s : near) {
      const Vec3 own{0, dot(s.x - middle, shape.axis[1]), dot(s.x - middle, shape.axis[2])};
      box.add(own);
      const double across = dot(s.normal, shape.axis[1]);
      if (std::abs(across) < kLooksAcross) continue;
      ++n_sides[across > 0];
      height[across > 0] += own.y;
    }
    const Vec3 size = box.hi - box.lo;
    if (size.y > kThick * size.z || n_sides[0] == 0 || n_sides[1] == 0) return 0;
    const bool looks_away = height[1] / static_cast<double>(n_sides[1]) > height[0] / static_cast<double>(n_sides[0]);
    return looks_away || !t_.volume ? size.z : 0;  // open surfaces may be turned either way
  }

  const Model& model_;
  const ModelTables& t_;
  const FaceRoles& roles_;
  bool is_turned_ = false;  // normals point into the material
  EdgeFaces faces_at_;
  std::span<const std::uint8_t> is_taken_;     // [n_faces] of a lifting surface that is known
  std::vector<std::atomic<Known>> is_smooth_;  // [n_edges] between the faces there
  std::vector<std::once_flag> is_sampled_;     // [n_faces]
  std::vector<FaceSamples> samples_;           // [n_faces] over the face's (u,v) box
};

}  // namespace

std::vector<EdgeWithChord> find_span_edges(const Model& model, const FaceRoles& roles,
                                           std::span<const LiftingSurface> wings, const Executor& executor) {
  std::vector<std::uint8_t> is_taken(static_cast<std::size_t>(model.tables().n_faces()), 0);
  for (const LiftingSurface& wing : wings)
    for (const FaceId f : wing.faces) is_taken[static_cast<std::size_t>(f)] = 1;
  share(executor, is_taken);
  SpanEdgeFinder finder(model, roles, is_taken);
  std::vector<std::vector<EdgeWithChord>> parts((model.tables().n_edges() + kEdgesPerTask - 1) / kEdgesPerTask);
  executor.run_tasks(
      static_cast<std::int32_t>(parts.size()), heaviest_first(std::vector<double>(parts.size(), 1)),
      [&](std::int32_t task) { return packed(finder.run(task)); },
      [&](std::int32_t task, Bytes&& bytes) { unpack(bytes, parts[static_cast<std::size_t>(task)]); });
  std::vector<EdgeWithChord> found;
  for (const std::vector<EdgeWithChord>& part : parts) found.insert(found.end(), part.begin(), part.end());
  return found;
}

}  // namespace st
