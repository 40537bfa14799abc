#include "judge/same_place.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "geometry/model/bodies.h"
#include "geometry/model/sameness.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr double kSameBox = 1e-3;  // of the face's diagonal: boxes are made of samples and tolerances
constexpr int kStations = 3;       // along u and v

/// Edges that bound the face: seams and slits, which it uses twice, and poles do not.
std::vector<EdgeId> outline(const ModelTables& t, FaceId f) {
  std::map<EdgeId, int> uses;
  for (const EdgeId e : t.edges_of(f)) ++uses[e];
  std::vector<EdgeId> edges;
  for (const auto& [e, n] : uses)
    if (n == 1 && !t.edge_is_degenerate[e]) edges.push_back(e);
  return edges;
}

class PlaceSearch {
 public:
  PlaceSearch(const Model& model, std::span<const std::int32_t> placement)
      : model_(model), t_(model.tables()), placement_(placement) {}

  std::vector<std::pair<FaceId, FaceId>> find() const {
    std::vector<FaceId> order;
    for (FaceId f = 0; f < t_.n_faces(); ++f) order.push_back(f);
    std::sort(order.begin(), order.end(), [&](FaceId a, FaceId b) {
      return std::tuple(t_.face_box[a].lo.x, a) < std::tuple(t_.face_box[b].lo.x, b);
    });
    std::vector<std::pair<FaceId, FaceId>> found;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size(); ++k) {
        const FaceId a = std::min(order[i], order[k]), b = std::max(order[i], order[k]);
        if (t_.face_box[order[k]].lo.x - t_.face_box[order[i]].lo.x > slack(order[i])) break;
        if (placement_[a] != placement_[b] && are_alike(a, b) && lies_on(a, b) && lies_on(b, a))
          found.emplace_back(a, b);
      }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  double slack(FaceId f) const { return kSameBox * t_.face_box[f].diagonal(); }

  bool are_alike(FaceId a, FaceId b) const {
    const double most = std::min(slack(a), slack(b));
    return distance(t_.face_box[a].lo, t_.face_box[b].lo) <= most &&
           distance(t_.face_box[a].hi, t_.face_box[b].hi) <= most &&
           std::abs(t_.face_area[a] - t_.face_area[b]) <= kSameArea * std::abs(t_.face_area[a]);
  }

  /// Points of the one surface are on the other, and those of the one's outline on the other's.
  bool lies_on(FaceId a, FaceId b) const {
    const double tolerance = meeting_distance(t_, a, b);
    const auto of = model_.surface(a), on = model_.surface(b);
    const double* uv = &t_.face_uv_bounds[4 * static_cast<std::size_t>(a)];
    for (int i = 0; i < kStations; ++i)
      for (int k = 0; k < kStations; ++k) {
        const double u = uv[0] + (uv[1] - uv[0]) * (i + 0.5) / kStations,
                     v = uv[2] + (uv[3] - uv[2]) * (k + 0.5) / kStations;
        if (closest_point(*on, of->point({u, v})).distance > tolerance) return false;
      }
    const std::vector<EdgeId> rim = outline(t_, a), others = outline(t_, b);
    return rim.empty() == others.empty() &&
           std::all_of(rim.begin(), rim.end(), [&](EdgeId e) { return is_on_any(e, others, tolerance); });
  }

  /// The middle of the edge is on one of the others.
  bool is_on_any(EdgeId e, const std::vector<EdgeId>& others, double tolerance) const {
    const auto curve = model_.curve(e);
    const Vec3 middle = curve->point(0.5 * (curve->t_min() + curve->t_max()));
    return std::any_of(others.begin(), others.end(),
                       [&](EdgeId other) { return closest_point(*model_.curve(other), middle).distance <= tolerance; });
  }

  const Model& model_;
  const ModelTables& t_;
  std::span<const std::int32_t> placement_;
};

/// Pairs of bodies of which each face has a partner in the other.
std::vector<std::pair<FaceId, FaceId>> whole_bodies(const ModelTables& t, std::span<const std::int32_t> placement,
                                                    const std::vector<std::pair<FaceId, FaceId>>& faces) {
  using Body = std::pair<std::int32_t, std::int32_t>;  // placement, and body
  const std::vector<std::int32_t> body = bodies_of(t);
  const auto body_at = [&](FaceId f) { return Body{placement[f], body[f]}; };
  std::map<Body, std::size_t> n_faces;
  for (FaceId f = 0; f < t.n_faces(); ++f) ++n_faces[body_at(f)];
  std::map<std::pair<Body, Body>, std::pair<std::set<FaceId>, std::set<FaceId>>> partners;
  for (const auto& [a, b] : faces) {
    auto& [first, second] = partners[{body_at(a), body_at(b)}];
    first.insert(a);
    second.insert(b);
  }
  std::vector<std::pair<FaceId, FaceId>> whole;
  for (const auto& [bodies, own] : partners)
    if (own.first.size() == n_faces[bodies.first] && own.second.size() == n_faces[bodies.second])
      whole.emplace_back(*own.first.begin(), *own.second.begin());
  std::sort(whole.begin(), whole.end());
  return whole;
}

}  // namespace

SamePlaces find_same_places(const Model& model, std::span<const std::int32_t> placement) {
  SamePlaces result;
  result.faces = PlaceSearch(model, placement).find();
  result.bodies = whole_bodies(model.tables(), placement, result.faces);
  return result;
}

}  // namespace st
